#include "looks/lut/look_matrix.h"

#include "stages/shared/constants.h"
#include "scene/plan.h"

namespace scotopic {
namespace {

/// Y + keep (RGB - Y), for each of R, G, B.
Matrix3<double> chroma_matrix(const AppearanceParameters& p) {
  const double factor = chroma_factor(p.adaptation);
  const double keep = factor + (1 - p.strength.all * p.strength.chroma) * (1 - factor);
  Matrix3<double> matrix = diagonal<double>({keep, keep, keep});
  for (auto& row : matrix.rows)
    for (std::size_t j = 0; j < 3; ++j) row[j] += (1 - keep) * p.xyz_from_rgb[1][j];
  return matrix;
}

}  // namespace

std::optional<Matrix3<double>> look_matrix(const AppearanceParameters& p) {
  const ScenePlan plan = plan_scene(p, nullptr);
  if (plan.nothing()) return identity3<double>();
  const bool chroma_alone = !plan.effect("shift").runs() && !plan.effect("luminance").runs();
  if (!chroma_alone || p.weight == Weight::local) return std::nullopt;
  return chroma_matrix(p);
}

}  // namespace scotopic
