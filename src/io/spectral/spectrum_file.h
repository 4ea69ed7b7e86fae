// A light's spectrum from a table in a text file.
#pragma once

#include <string>
#include <string_view>

#include "receptors/spectrum.h"

namespace scotopic {

/// Two columns, nm and relative power, apart by comma, semicolon, tab or blanks; lines that begin with '#'
/// are comments, one line of titles may come first; wavelengths ascend. Sampled at whole nm of 300 to 900:
/// linear between rows a nm or more apart, the mean over each nm where they are closer; 0 outside. Throws
/// Error(ExitCode::input, file) with the line's number.
Spectrum spectrum_from_text(std::string_view text, const std::string& file);

/// The same from a file of at most 1 MiB.
Spectrum read_spectrum_file(const std::string& file);

}  // namespace scotopic
