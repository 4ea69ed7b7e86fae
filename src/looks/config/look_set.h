// A whole set of looks: which there are, their files, the configs that hold them, the manifest.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "looks/lut/baked_look.h"
#include "looks/config/look_config.h"

namespace scotopic {

/// A file not yet written.
struct TextFile {
  std::string name;  ///< relative to its folder
  std::string text;
};

/// Everything that a config of looks is made of.
struct LookSet {
  std::vector<BakedLook> looks;
  std::vector<LookEntry> entries;  ///< of the looks, the context look and the matrix looks
  std::vector<TextFile> luts;      ///< of the looks, then of the night views
  std::vector<BakedLook> night_luts;
  std::vector<NightViewEntry> nights;
};

/// Bakes `specs` (linear ones, all with the same working space), in their order. `context`: add the look that
/// takes its luminance from $SCOTOPIC_LA, over the first spec's model.
LookSet bake_set(const std::vector<LookSpec>& specs, const ColourConfig& config, const std::string& version,
                 bool context);

/// Adds the night views of the own config for each adaptation of `specs`, for displays of BT.709 and P3 (100
/// cd/m2) and for Rec.2100 (1000 cd/m2).
void add_nights(LookSet& set, const std::vector<LookSpec>& specs, const ColourConfig& config,
                const std::string& version);

/// luts/MANIFEST: what `sha256sum -c` checks; a comment before each file states its error.
std::string manifest_text(const LookSet& set, const std::string& version, const std::string& command);

/// Of the shipped config, whose LUTs are beside its folder: there, or beside the config itself. (OpenColorIO
/// archives no paths that lead out of a config's folder: a config with its LUTs in a folder of its own names
/// that alone.)
inline constexpr const char* lut_search_path = "luts:../luts";

/// The own config with the set's looks and night views, its LUTs on `search_path`.
std::string look_config_text(const LookSet& set, const std::string& search_path = lut_search_path);

}  // namespace scotopic
