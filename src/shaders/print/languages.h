// The printers, one a language.
#pragma once

#include <string>

#include "shaders/record/record.h"

namespace scotopic::shaders {

std::string dctl_text(const ShaderSpec& spec, const Record& record);
std::string blink_text(const ShaderSpec& spec, const Record& record);
std::string osl_text(const ShaderSpec& spec, const Record& record);
std::string hlsl_text(const ShaderSpec& spec, const Record& record);
std::string glsl_text(const ShaderSpec& spec, const Record& record);

}  // namespace scotopic::shaders
