// How strongly rods feed the cone pathways, by the light they are in: it falls as cones take over.
#pragma once

#include <algorithm>
#include <cstddef>

#include "kernel/matrix3.h"

namespace scotopic {

/// Rod input at the levels where it was measured.
struct RodInputTable {
  double level[3];  ///< cd/m2
  double of_lm[3], of_s[3];
};

/// Cao, Pokorny, Smith and Zele 2008 (Rod contributions to color perception: linear with rod contrast), by
/// the numbers that Wanat and Mantiuk 2014 put into their program (generate_purkinje_tables.m), S halved as
/// there.
inline constexpr RodInputTable cao2008_table = {
    {0.1027, 0.6228, 10.0459}, {0.172619, 0.0172619, 0.0}, {0.714286, 0.0202381, 0.0}};

/// kappa of (L, M, S), rod input relative to cone input, at a local luminance `lloc` in cd/m2; a NaN counts
/// as the darkest. Straight lines in luminance between the levels of cao2008_table, held beyond; 0 from
/// 10.0459 cd/m2 up: there the data themselves end the effect.
constexpr Vec3<double> cao2008_kappa(double lloc) noexcept {
  const auto& [level, of_lm, of_s] = cao2008_table;
  if (!(lloc > level[0])) return {of_lm[0], of_lm[0], of_s[0]};
  const std::size_t i = lloc < level[1] ? 0 : 1;
  const double f = std::min(1.0, (lloc - level[i]) / (level[i + 1] - level[i]));
  const double lm = (1.0 - f) * of_lm[i] + f * of_lm[i + 1];
  return {lm, lm, (1.0 - f) * of_s[i] + f * of_s[i + 1]};
}

}  // namespace scotopic
