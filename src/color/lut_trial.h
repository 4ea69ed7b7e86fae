// LUT and profile files given to OpenColorIO first in a process of their own, which may crash, hang or eat
// memory.
#pragma once

#include <string>

namespace scotopic {

/// Throws Error(config) where OpenColorIO's readers crash on a file or do not come to an end within 1 s of
/// processor time and 1 s for each 4 MiB, and Error(limit) where they want more than 1 GiB and 64 times its
/// size. What they merely refuse is left to the caller to meet. A file is tried once, as long as it does not
/// change.
void try_lut_file(const std::string& file);

}  // namespace scotopic
