// Bakes that exist already, held to the operator again.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "looks/lut/baked_look.h"
#include "color/colour_config.h"

namespace scotopic {

/// What was found about one look or LUT.
struct Inspected {
  std::string name;  ///< of the look, or the file
  std::string file;  ///< of the LUT; empty for looks without one
  std::optional<LookSpec> spec;
  std::optional<BakeError> error;
  std::optional<CubeError> cube;  ///< of encoded ones
  std::optional<double> stated;   ///< the largest error that the file admits to
  OddPixels odd;
  std::vector<std::string> problems;  ///< empty: sound
};

/// A LUT file by itself. `config` knows the space of encoded LUTs. Error(config) if it is no LUT, or none of
/// ours.
Inspected inspect_lut(const std::string& file, const ColourConfig& config);

/// The looks of a config that are ours: those whose LUT says so, and matrix looks without LUT are left out.
/// `only`: one look by name, which must then be there (empty: all).
std::vector<Inspected> inspect_config(const ColourConfig& config, const std::string& only);

/// What runs a look of a config, scene-linear in and out. Error(config) if there is none of that name.
OCIO_NAMESPACE::ConstCPUProcessorRcPtr look_processor(const ColourConfig& config, const std::string& look);

/// What runs a LUT file. Error(config) if it is none.
OCIO_NAMESPACE::ConstCPUProcessorRcPtr lut_processor(
    const std::string& file, OCIO_NAMESPACE::Interpolation reading = OCIO_NAMESPACE::INTERP_TETRAHEDRAL);

/// Whole text of a file of no more than limits.lut bytes; Error(input).
std::string text_of(const std::string& file, const Limits& limits = {});

}  // namespace scotopic
