// The comment at the head of a shader: what goes in, what comes out, what it is of, what its sliders are, how
// exact it is.
#pragma once

#include <string>

#include "shaders/print/statements.h"
#include "shaders/shader.h"

namespace scotopic::shaders {

/// Lines of "// ..."; `what` says of what kind the file is.
std::string header_of(const ShaderSpec& spec, const Statements& statements, const std::string& what);

/// The statements, `indent` before each and a comment where another stage begins.
std::string text_of(const std::vector<Statement>& statements, const std::string& indent);

/// The same without types: assignments to what is declared elsewhere.
std::string assignments_of(const std::vector<Statement>& statements, const std::string& indent);

}  // namespace scotopic::shaders
