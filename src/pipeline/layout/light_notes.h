// What is said of a file's light: what is taken for it, what stays as it is, and why there is none.
#pragma once

#include <string>
#include <vector>

#include "pipeline/layout/layout.h"

namespace scotopic {

/// For a layer that was asked for (empty: none was); `data`: names of what is no light. Lists what there is.
[[noreturn]] void fail_without_light(const PixelSource& source, const std::string& layer,
                                     const std::vector<std::string>& data);

/// What stays as it is though it has names of colour, and what is not read of spectra.
std::vector<std::string> notes_of(const PixelSource& source, const std::vector<LightSubimage>& light);

/// Where several layers, parts or views are light: which, and what is metered; else empty.
std::string alike_note(const std::vector<LightSubimage>& light);

}  // namespace scotopic
