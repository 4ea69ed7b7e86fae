#include "shaders/shader.h"

#include "shaders/print/languages.h"

namespace scotopic {

std::string shader_text(const ShaderSpec& spec, ShaderLanguage language) {
  const shaders::Record record = shaders::record_of(spec);
  switch (language) {
    case ShaderLanguage::dctl:
      return shaders::dctl_text(spec, record);
    case ShaderLanguage::blink:
      return shaders::blink_text(spec, record);
    case ShaderLanguage::osl:
      return shaders::osl_text(spec, record);
    case ShaderLanguage::hlsl:
      return shaders::hlsl_text(spec, record);
    case ShaderLanguage::glsl:
      break;
  }
  return shaders::glsl_text(spec, record);
}

}  // namespace scotopic
