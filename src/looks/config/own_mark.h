// Which configs are ours to replace: those that bake wrote and nobody has changed since.
#pragma once

#include <string>

namespace scotopic {

/// `text` after a comment line that says who made it, with the SHA-256 of what follows.
std::string marked(const std::string& text, const std::string& version);

/// Whether `text` begins with such a line and is as it was then.
bool is_as_marked(const std::string& text);

}  // namespace scotopic
