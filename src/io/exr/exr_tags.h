// What an OpenEXR header states of its values, by the standard attributes' names and types.
#pragma once

#include <OpenEXR/ImfHeader.h>

#include <optional>
#include <string>
#include <vector>

#include "color/file/colour_tags.h"

namespace scotopic {

/// Empty if there is no such text.
std::string text_attribute(const Imf::Header& header, const char* name);

/// A float, double or int.
std::optional<double> number_attribute(const Imf::Header& header, const char* name);

/// By the Color Interop Forum's "Identifying the Color Space of OpenEXR Files" the first part's identifier
/// holds for the whole file; other parts need none, but may be data.
ColourTags colour_tags(const Imf::Header& header, const Imf::Header& first);

/// A sentence for each attribute with a name that is known here, but of another type, which says nothing.
std::vector<std::string> mistyped_attributes(const Imf::Header& header);

}  // namespace scotopic
