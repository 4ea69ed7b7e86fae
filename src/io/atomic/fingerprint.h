// Whether a file is still the one it was: a hash of every byte of it.
#pragma once

#include <string>

namespace scotopic {

/// 32 hexadecimal digits of the file's contents (XXH64 twice, from two seeds, and so no defence against somebody who
/// wants two files to agree) and its size. Neither name nor times count. Error(input) where it cannot be read.
std::string fingerprint(const std::string& file);

}  // namespace scotopic
