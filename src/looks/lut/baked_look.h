// One look, baked and measured, ready to be written.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "looks/chain/chain.h"
#include "looks/cube/cube_error.h"
#include "looks/lut/look_spec.h"
#include "looks/verify/measure.h"
#include "color/colour_config.h"

namespace scotopic {

/// A look that holds its own error.
struct BakedLook {
  LookSpec spec;
  Chain chain;      ///< with all that the file says about itself
  BakeError error;  ///< over colours of the working gamut; encoded: over those of Rec.709, read tetrahedrally
  std::optional<CubeError> cube = std::nullopt;  ///< encoded: the whole of it

  /// By whichever reading.
  double largest_error() const noexcept;
};

/// `version`: the program's. `config` holds spec.space where spec.encoded.
/// A linear look of La >= 5 cd/m2 is an identity without a LUT. An encoded one of edge 0 gets 33 nodes a
/// side, or 65 where wants_larger().
BakedLook bake_look(const LookSpec& spec, const ColourConfig& config, const std::string& version);

/// CIE XYZ (D65) from values of a space, where these are proportional to light; else nullopt.
std::optional<Matrix3<double>> linear_space_matrix(const ColourConfig& config, const std::string& space);

/// The largest error that a LUT file's text admits to; nullopt if it states none.
std::optional<double> stated_max(std::string_view file_text);

}  // namespace scotopic
