// Looks inside OpenColorIO configs: as look, as view and as colour space.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <optional>
#include <string>
#include <vector>

#include "kernel/matrix3.h"

namespace scotopic {

/// A look as a config holds it. It has a file, a matrix or a transform.
struct LookEntry {
  std::string name;
  std::string description;
  std::string file;                               ///< found on the config's search path; may hold $VARIABLES
  std::optional<Matrix3<double>> matrix;          ///< instead of a file
  OCIO_NAMESPACE::ConstTransformRcPtr transform;  ///< instead of either
  std::optional<double> gain;                     ///< of what comes out of the file
  bool view = true;                               ///< on the displays' menus, too
};

/// A view of the own config: a LUT from scene light to light of a display, for displays with these primaries.
struct NightViewEntry {
  std::string name;
  std::string description;
  std::string file;
  std::string gamut;  ///< rec709, p3, rec2020
};

/// Where in a config looks go, and what the colour spaces of theirs have as their neighbours have it.
struct LookPlace {
  std::string process_space;    ///< the scene-linear space that looks are made for
  std::string reference_space;  ///< a space that is the scene reference itself
  std::string encoding = "scene-linear";
  std::vector<std::string> categories = {};
  bool equality_groups =
      false;  ///< each space names its own: one that is shared would pass for no conversion
};

/// Around the config's `process_space`.
LookPlace place_beside(const OCIO_NAMESPACE::Config& config, const std::string& process_space);

/// Adds look and colour space. A look is forward only, unless it is a matrix: its inverse is declared to be
/// the identity, since OCIO's own inverse of a 3D LUT would be wrong without a word. Pixels read from the
/// colour space are likewise taken as linear light that has been through the look.
void add_look(OCIO_NAMESPACE::Config& config, const LookEntry& look, const LookPlace& place);

/// A no-op look of this name: the first one of a config, because some programs apply the first unasked.
void add_noop_look(OCIO_NAMESPACE::Config& config, const std::string& name, const LookPlace& place);

/// The scene reference: a space without transforms that is not data. Error(config) if there is none.
std::string reference_space(const OCIO_NAMESPACE::Config& config);

/// The project's own config with looks; each display offers the night views made for its primaries.
OCIO_NAMESPACE::ConfigRcPtr make_look_config(const std::vector<LookEntry>& looks,
                                             const std::vector<NightViewEntry>& nights,
                                             const std::string& search_path);

/// The text of a config after OCIO's own validation; Error(config) if it finds fault.
std::string config_text(const OCIO_NAMESPACE::Config& config);

/// The luminance that $SCOTOPIC_LA has where nobody sets it.
inline constexpr const char* context_variable = "SCOTOPIC_LA";
inline constexpr const char* context_default = "0.1";

}  // namespace scotopic
