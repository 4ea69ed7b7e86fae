// As much of OSL's grammar and types as shaders of ours use, from the Open Shading Language
// specification 1.12, chapters 4 to 6: no oslc is in Debian 12 and 13.
#pragma once

#include <string>

namespace scotopic::test {

/// Empty where `text` is a shader; else what is wrong, and where.
std::string osl_fault(const std::string& text);

}  // namespace scotopic::test
