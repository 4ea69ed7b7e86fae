// Small files that the program is run on; made once.
#pragma once

#include <string>

namespace scotopic::test {

/// in.exr: RGB half, ZIP, 24 x 20. big.exr: the same of 1024 x 768. pages.tif: two pages of float RGB.
/// spectral.exr: eight bands. studio.ocio: a small config. The path of one of them.
std::string input(const std::string& name);

}  // namespace scotopic::test
