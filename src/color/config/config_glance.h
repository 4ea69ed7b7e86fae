// A config's file before OpenColorIO reads it: what would take memory or stack without end, and its profile
// version.
#pragma once

#include <string>

#include "base/limits.h"

namespace scotopic {

/// Throws Error(config) unless `file` is a regular file of text, or an archive (.ocioz), that nests at most
/// 128 deep; Error(limit) where it has more bytes than limits.config, as it stands or with its YAML aliases
/// written out.
void require_modest_config(const std::string& file, const Limits& limits);

/// Whether the file begins as a zip archive does: an .ocioz, whatever it is called.
bool is_archive(const std::string& file);

/// "needs OpenColorIO 2.5; this is 2.1.2" where the file's ocio_profile_version is beyond this OpenColorIO;
/// else empty.
std::string too_new(const std::string& file);

}  // namespace scotopic
