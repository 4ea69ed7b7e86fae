// Metadata that described pixels or colours which have changed.
#pragma once

#include <string>
#include <string_view>

namespace scotopic {

/// Whether an attribute is of the pixels that were: hashes and average colours of texture makers, thumbnails.
/// By OpenImageIO's hash its texture cache would take the new picture for the old one.
bool describes_pixels(std::string_view name);

/// Whether an attribute says whose colours the values are: it holds for no other space.
bool describes_colours(std::string_view name);

/// An image description without the hashes and average colours that maketx writes into that of a TIFF.
std::string without_pixel_facts(const std::string& description);

}  // namespace scotopic
