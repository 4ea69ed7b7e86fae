// Evaluators: ways to compute the same operator, from double to a small LUT: what each is, and how far from
// exact it is.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "stages/shared/parameters.h"
#include "looks/verify/measure.h"
#include "pipeline/apply_image.h"

namespace scotopic {

/// One of them.
struct EvaluatorKind {
  std::string_view name;  ///< as --precision says it
  std::size_t edge;       ///< of the LUT, which OpenColorIO applies; 0: the operator itself
};

inline constexpr std::array<EvaluatorKind, 6> evaluator_kinds = {
    {{"double", 0}, {"float", 0}, {"lut129", 129}, {"lut65", 65}, {"lut33", 33}, {"lut17", 17}}};

/// The one of that name; throws Error(ExitCode::internal) if there is none.
const EvaluatorKind& evaluator_named(std::string_view name);

/// An evaluator with everything worked out that does not depend on the pixel.
struct PreparedEvaluator {
  RowOperator apply;      ///< any number of threads at once
  double seconds = 0;     ///< that preparing took: baking, for a LUT
  std::size_t bytes = 0;  ///< of the LUT
};

/// All evaluators leave alone what the operator leaves alone, bit for bit: pixels that are not finite and
/// photopic ones. A LUT takes RGB only: signals of receptors, where rows have them, are not looked at.
PreparedEvaluator prepare_evaluator(const AppearanceParameters& parameters, const EvaluatorKind& kind);

/// A quantity's statistics over pixels.
struct ErrorStatistics {
  double mean = 0, p99 = 0, max = 0;
};
/// Zeros for no values.
ErrorStatistics statistics_of(std::vector<double> values);

/// A pixel that came out far off.
struct WorstPixel {
  Vec3<double> in{}, expected{}, got{};
  double error = 0;
};

/// How far an evaluator is from the reference, in double, over some colours; results are float.
struct EvaluatorError {
  ErrorStatistics difference;  ///< CIEDE2000 exposed to Y = .184 (stages/shared/colour_difference.h)
  ErrorStatistics pixel;       ///< greatest error of a component over the pixel's largest, in or out
  ErrorStatistics
      component;  ///< error of a component in float ulps of its exact value; greatest of the three
  std::vector<WorstPixel> worst;  ///< by `pixel`, a few, the worst first
};

/// Error of planar results `got` for colours `in`: against those `expected`, or the reference's.
EvaluatorError error_between(const Matrix3<double>& xyz_from_rgb, const Colours& in,
                             const std::vector<Vec3<double>>& expected, const Colours& got);
EvaluatorError evaluator_error(const AppearanceParameters& parameters, const Colours& in, const Colours& got);

/// The same of an evaluator on these colours.
EvaluatorError evaluator_error(const AppearanceParameters& parameters, const RowOperator& kind,
                               const Colours& in);

}  // namespace scotopic
