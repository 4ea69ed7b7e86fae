// OpenEXR headers, looked through before OpenEXR itself allocates what they ask for.
#pragma once

#include <string>

#include "base/limits.h"

namespace scotopic {

/// Walks the headers of all parts of a file that begins as OpenEXR does, reading no attribute that is larger
/// than the rest of the file. Throws Error(limit) where side, pixels, channels or a tile exceed `limits`, and
/// Error(input) where the file is too short for its own attributes or for the tables of chunks that its sizes
/// call for. What is wrong in other ways is left to OpenEXR to say.
void check_exr_headers(const std::string& file, const Limits& limits);

}  // namespace scotopic
