// Numbers as LUT files hold them, whatever the locale.
#pragma once

#include <string>

namespace scotopic {

/// Shortest decimal that reads back as the same number: "0.18", "1e-05". Finite values only.
std::string number_text(float value);
/// The same for double.
std::string number_text(double value);

/// Rounded to so many decimals, trailing zeros cut: "0.25", "-3", "0". Never "-0".
std::string fixed_text(double value, int decimals);

/// Rounded to so many significant digits: "0.000123", "17".
std::string rounded_text(double value, int digits);

}  // namespace scotopic
