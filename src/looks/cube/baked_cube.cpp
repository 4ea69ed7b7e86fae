#include "looks/cube/baked_cube.h"

#include <algorithm>
#include <utility>

#include "color/primaries.h"
#include "looks/chain/ocio_chain.h"
#include "looks/cube/cube_colours.h"
#include "looks/cube/cube_fit.h"

namespace scotopic {
namespace {

// Half a stop more than is measured, so that the outermost cells are held, and other mixtures.
constexpr StopRange fitted_stops{cube_darkest - 0.5, cube_brightest + 0.5, 0.25};
// Our choice, by trial: what films mostly hold counts most.
constexpr double own_gamut_weight = 0.05;

/// Some dozens for each cell that colours of a gamut pass through.
std::size_t fitted_colours(std::size_t edge) {
  return std::min<std::size_t>(9 * edge * edge * edge / 2, 800000);
}

std::vector<double> nodes_of(const CubeGoal& goal, const LookSpec& spec, const ColourConfig& config,
                             bool fit) {
  std::vector<double> nodes = sampled_nodes(goal, spec.edge);
  if (!fit) return nodes;
  const Matrix3<double>& working = spec.parameters.xyz_from_rgb;
  const std::size_t count = fitted_colours(spec.edge);
  const std::vector<FitColours> sets = {
      {coded_colours(goal, gamut_xyz_matrix("rec709").value(), working, count, fitted_stops).codes, 1},
      {coded_colours(goal, own_gamut(spec, config), working, count / 2, fitted_stops).codes,
       own_gamut_weight}};
  return fitted_nodes(goal, spec.edge, std::move(nodes), sets);
}

}  // namespace

BakedCube bake_cube(const LookSpec& spec, const ColourConfig& config, bool fit) {
  BakedCube out;
  out.edge = spec.edge;
  Lut3DStep lut{spec.edge, nodes_of(CubeGoal(spec, config), spec, config, fit), 7};
  out.chain.steps = {RangeStep{0, 1}, std::move(lut)};
  round_as_written(out.chain);
  const auto raw = OCIO_NAMESPACE::Config::CreateRaw();
  out.error = measure_cube(spec, config,
                           {cpu_processor(ocio_transform(out.chain, OCIO_NAMESPACE::INTERP_TETRAHEDRAL), raw),
                            cpu_processor(ocio_transform(out.chain, OCIO_NAMESPACE::INTERP_LINEAR), raw)});
  return out;
}

bool wants_larger(const CubeError& error) noexcept {
  const BakeError& e = error.rec709.worse();
  return e.mean > 0.08 || e.p99 > 1;
}

}  // namespace scotopic
