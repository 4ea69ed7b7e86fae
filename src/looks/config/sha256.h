// SHA-256 (FIPS 180-4), for manifests that `sha256sum -c` reads.
#pragma once

#include <string>
#include <string_view>

namespace scotopic {

/// 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace scotopic
