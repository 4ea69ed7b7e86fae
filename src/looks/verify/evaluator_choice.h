// Which evaluator to take: the cheapest that is accurate enough, or the most accurate that is cheap enough.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "looks/verify/evaluators.h"
#include "pipeline/evaluator.h"
#include "stages/shared/parameters.h"

namespace scotopic {

/// What is asked for; at least one of the two.
struct EvaluatorDemand {
  std::optional<double> max_error;  ///< CIEDE2000 exposed to Y = .184, of the worst colour
  std::optional<double> budget;     ///< nanoseconds per pixel on one thread
};

/// An evaluator, its worst error (CIEDE2000) and its cost per pixel.
using MeasuredEvaluator = EvaluatorMeasure;

/// The place of the one to take: among those that meet the demand the cheapest, or, where there is only a
/// budget, the most accurate. nullopt: none does.
std::optional<std::size_t> pick_evaluator(std::span<const MeasuredEvaluator> measured,
                                          const EvaluatorDemand& demand);

/// What was measured, and what came of it.
struct EvaluatorChoice {
  std::vector<MeasuredEvaluator> measured;
  std::optional<std::size_t> picked;
  RowOperator apply;  ///< of the one picked
};

/// Measures evaluators here and now, over colours of all brightness of the working gamut, and picks. LUTs,
/// from the smallest, are looked at only while they are cheaper than computing in float, which is closer than
/// any LUT. `luts`: whether LUTs will do at all.
EvaluatorChoice choose_evaluator(const AppearanceParameters& parameters, const EvaluatorDemand& demand,
                                 bool luts);

/// Evaluators by name, or such as meet a demand. One is prepared once for frames of the same scene
/// parameters, so that a LUT is baked once; what a demand picks for the first frame is used for all, so that
/// timings cannot make frames differ.
class ChosenEvaluators : public EvaluatorSource {
 public:
  /// What is named.
  explicit ChosenEvaluators(const EvaluatorKind& named) : kind_(&named) {}
  /// What is picked, for the first scene, by pick_evaluator().
  explicit ChosenEvaluators(const EvaluatorDemand& demand) : demand_(demand) {}

  /// Says what was picked. Error(usage) for a LUT where rows have signals of `receptors`; Error(limit) if no
  /// evaluator meets the demand.
  std::shared_ptr<const Evaluator> evaluator(const AppearanceParameters& parameters, bool receptors,
                                             const Notes& notes) override;

 private:
  std::shared_ptr<const Evaluator> make(const AppearanceParameters& parameters, bool receptors,
                                        const Notes& notes);

  const EvaluatorKind* kind_ = nullptr;
  EvaluatorDemand demand_;
  std::mutex lock_;
  std::shared_ptr<const Evaluator> kept_;
  AppearanceParameters parameters_;
  bool receptors_ = false;
};

}  // namespace scotopic
