// SHA-256 (FIPS 180-4) by OpenSSL, as 64 lower-case hexadecimal digits: what `sha256sum` prints.
#pragma once

#include <string>
#include <string_view>

namespace scotopic {

std::string sha256(std::string_view bytes);

/// Of a regular file's contents, whatever its size; neither name nor times count. Error(input) where it
/// cannot be read.
std::string sha256_of_file(const std::string& file);

}  // namespace scotopic
