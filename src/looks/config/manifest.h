// MANIFEST: which files of a folder are ours, with their SHA-256, as sha256sum -c takes it.
#pragma once

#include <string>
#include <vector>

namespace scotopic {

/// `fresh`, a whole manifest, after what an older one says of files that `fresh` does not name.
std::string merged_manifest(const std::string& older, const std::string& fresh);

/// Whether a text is a manifest of ours.
bool is_manifest(const std::string& text);

/// What is wrong with the folder's MANIFEST: files missing, changed, or not listed.
std::vector<std::string> manifest_problems(const std::string& folder);

}  // namespace scotopic
