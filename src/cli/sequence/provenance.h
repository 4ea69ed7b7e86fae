// What an output was made from: enough to tell, later, whether the same command would write the same again.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/sequence/frame_job.h"
#include "color/colour_config.h"
#include "io/pixel_source.h"

namespace scotopic {

/// Options on the command line, "name=value" each, without those that cannot change what is written (threads,
/// limits, what is said, which frames). An option that nobody thought of here counts: too much is computed
/// again rather than too little.
std::vector<std::string> typed_options(const CLI::App& verb);

/// OpenColorIO's hash of a config, of the environment it looks at, and of its LUTs (these by inode and time).
std::string colour_identity(const ColourConfig& config);

/// What the provenance of all images of one command have in common: version, verb, options (one that names a
/// file with the file's contents), and the job's own settings.
std::string common_provenance(const std::string& verb, const FrameJob& job,
                              const std::vector<std::string>& typed);

/// SHA-256 of that, of every byte of the input, and of both files' names without folders (rules of a colour
/// config may go by them). Error(input) for an input that is missing.
std::string provenance_of(const std::string& common, const FramePaths& paths);

/// Whether the file is there, has this provenance, and is whole: its header, and the last rows of its
/// pictures are read.
bool holds_provenance(const std::string& file, const std::string& provenance, const Limits& limits);

/// Files that an input stands for: itself, or those of a pattern of wavelengths. Error(input) for one that is
/// missing.
std::vector<std::string> input_files(const std::string& input);

}  // namespace scotopic
