// Numbers as LUT files hold them.
#pragma once

#include <string>

namespace scotopic {

/// Shortest decimal that reads back as the same float, whatever the locale: "0.18", "1e-05". Finite values only.
std::string float_text(float value);

}  // namespace scotopic
