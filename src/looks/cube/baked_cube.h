// A cube between codes: fitted, measured, and as large as it needs to be.
#pragma once

#include "color/colour_config.h"
#include "looks/chain/chain.h"
#include "looks/cube/cube_error.h"
#include "looks/lut/look_spec.h"

namespace scotopic {

/// Its chain (a clamp to 0..1 and the 3D LUT) and its error.
struct BakedCube {
  std::size_t edge = 33;
  Chain chain;
  CubeError error;
};

/// `spec`: an encoded one; its edge is what is made. `fit`: else nodes hold the goal as it is there, for
/// comparison.
BakedCube bake_cube(const LookSpec& spec, const ColourConfig& config, bool fit = true);

/// Whether a larger cube is worth its bytes: over Rec.709 colours the mean is above 0.08 or the 99 % above 1.
bool wants_larger(const CubeError& error) noexcept;

}  // namespace scotopic
