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
  int steps = 30;     ///< of conjugate gradients at first, half of them in each round: more are not seen
  int rounds = 2;     ///< of counting differences instead of their squares
  double hold = 0.1;  ///< share of a colour's weight that holds a node where the goal has it
};

/// How far a fitted node may lie beyond codes 0 to 1. The darks need it: where black is code 0 (DaVinci
/// Intermediate), a pure red's green and blue lie in the first cell, whose nodes at 0 must go below it for
/// the colours between to be right. What is read between nodes lies in 0 to 1 but for rounding.
inline constexpr double nodes_beyond = 0.125;

/// The goal at the nodes themselves: edge^3 triplets, blue fastest, 0 to 1.
std::vector<double> sampled_nodes(const CubeGoal& goal, std::size_t edge);

/// Makes the sum of differences between goal and cube small over `sets`, tetrahedral and trilinear reading
/// alike: from `nodes` on, by reweighted least squares (conjugate gradients) in the differences' local metric
/// (of the goal's difference() at each colour). Where no colour lies the nodes stay. The same on every run.
std::vector<double> fitted_nodes(const CubeGoal& goal, std::size_t edge, std::vector<double> nodes,
                                 const std::vector<FitColours>& sets, const FitOptions& options = {});

}  // namespace scotopic
