// Whose colours a file's are: what it states of itself, and what is made of that.
#pragma once

#include <string>
#include <vector>

#include "color/colour_config.h"
#include "color/file/colour_tags.h"
#include "color/file/interop_id.h"
#include "color/primaries.h"

namespace scotopic {

/// The space of a file's values, why, and what else is to be said (a tag that says something else).
struct FileColour {
  ColourSpace space;
  std::string reason;
  std::vector<std::string> notes;
};

/// By the first of these that the file has: acesImageContainerFlag, colorInteropID, cICP (which PNG 3 ranks
/// above iCCP), ICC profile, sRGB, gAMA and cHRM, chromaticities, Exif, the config's rules for the file's
/// name and its roles. Of integers with primaries but no curve the curve is sRGB's, of others none. Throws
/// Error(input) for colours that are not understood: an identifier that neither is published nor names one of
/// the config's spaces, a camera's log curve, code points that are reserved, primaries on one line, a damaged
/// profile.
FileColour colour_of_file(const ColourTags& tags, const std::string& file, bool integer, int bits,
                          const ColourConfig& config);

/// Whether the file states that its values are no colours at all: colorInteropID is `data`.
bool are_data(const ColourTags& tags);

/// What H.273 has for these code points; Error(input) for others. `bits` of a sample tell narrow range.
RgbEncoding encoding_of(const CodePoints& points, int bits, const std::string& file);

}  // namespace scotopic
