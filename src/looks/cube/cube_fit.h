// Nodes of a cube by least squares against what it is to hold, as hosts read it between them.
#pragma once

#include <cstddef>
#include <vector>

#include "looks/cube/cube_goal.h"

namespace scotopic {

/// Codes that go in, all counted alike.
struct FitColours {
  Colours codes;
  double weight = 1;  ///< of all of them together
};

/// How far the fit goes.
struct FitOptions {
  int steps =
      40;  ///< of conjugate gradients: the tenth part of a step that is left is not seen in any figure
  double hold = 0.1;  ///< share of a colour's weight that holds a node where the goal has it
};

/// The goal at the nodes themselves: edge^3 triplets, blue fastest, 0 to 1.
std::vector<double> sampled_nodes(const CubeGoal& goal, std::size_t edge);

/// Makes the sum of squared differences between goal and cube small over `sets`, tetrahedral and trilinear
/// reading alike: from `nodes` on, by conjugate gradients in the differences' local metric (of the goal's
/// difference() at each colour). Where no colour lies the nodes stay. They stay in 0 to 1, too. The same on
/// every run.
std::vector<double> fitted_nodes(const CubeGoal& goal, std::size_t edge, std::vector<double> nodes,
                                 const std::vector<FitColours>& sets, const FitOptions& options = {});

}  // namespace scotopic
