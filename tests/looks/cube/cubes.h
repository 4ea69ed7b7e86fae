// Specs of cubes between codes of the own config's spaces.
#pragma once

#include <string>

#include "color/colour_config.h"
#include "color/primaries.h"
#include "looks/lut/look_spec.h"
#include "looks/support.h"

namespace scotopic::test {

inline LookSpec cube_spec(const std::string& space, double adaptation, std::size_t edge) {
  const ColourConfig config = ColourConfig::own();
  LookSpec spec;
  spec.parameters = adapted_to(adaptation);
  spec.parameters.xyz_from_rgb = config.xyz_from_working();
  spec.parameters.xyz_from_gamut = config.xyz_from_working();
  spec.space = config.resolve(space);
  spec.encoded = true;
  spec.edge = edge;
  return spec;
}

inline LookSpec night_cube_spec(const std::string& space, double adaptation, std::size_t edge,
                                const std::string& display = "sRGB - Display") {
  const ColourConfig config = ColourConfig::own();
  LookSpec spec = cube_spec(space, adaptation, edge);
  spec.display = display;
  spec.night.emplace().xyz_from_display = config.encoding(config.space(display))->xyz_from_rgb;
  return spec;
}

}  // namespace scotopic::test
