// One look, baked and measured, ready to be written.
#pragma once

#include <string>

#include "looks/chain/chain.h"
#include "looks/lut/look_spec.h"
#include "looks/verify/measure.h"
#include "color/colour_config.h"

namespace scotopic {

/// A look that holds its own error.
struct BakedLook {
  LookSpec spec;
  Chain chain;      ///< with all that the file says about itself
  BakeError error;  ///< over colours of the working gamut; encoded: over the cube of encoded values
};

/// `version`: the program's. `config` holds spec.space where spec.encoded.
/// A linear look of La >= 5 cd/m2 is an identity without a LUT.
BakedLook bake_look(const LookSpec& spec, const ColourConfig& config, const std::string& version);

/// CIE XYZ (D65) from values of a space, where these are proportional to light; else nullopt.
std::optional<Matrix3<double>> linear_space_matrix(const ColourConfig& config, const std::string& space);

/// Error of a processor that takes and gives values of spec.space, which is not linear.
BakeError measure_encoded(const LookSpec& spec, const ColourConfig& config,
                          const OCIO_NAMESPACE::ConstCPUProcessorRcPtr& processor);

/// The largest error that a LUT file's text admits to; nullopt if it states none.
std::optional<double> stated_max(std::string_view file_text);

}  // namespace scotopic
