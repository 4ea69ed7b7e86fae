// What computes the pixel stages of rows: the operator itself, or what stands in for it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "batch/batch.h"
#include "pipeline/notes.h"

namespace scotopic {

/// Pixel stages on rows, in place; what `touched` says is as AppearanceBatch::apply has it. Called from any
/// number of threads at once.
using RowOperator = std::function<void(const PixelRows& rows, std::uint8_t* touched)>;

/// An evaluator's worst error and its cost, where they were measured.
struct EvaluatorMeasure {
  std::string_view name;
  double max_error = 0;    ///< CIEDE2000 exposed to Y = 0.184, of the worst colour
  double nanoseconds = 0;  ///< per pixel on one thread
};

/// Immutable: any number of threads.
class Evaluator {
 public:
  /// The operator.
  Evaluator(std::string name, const AppearanceParameters& parameters, Precision precision);
  /// What stands in for it.
  Evaluator(std::string name, RowOperator stand_in)
      : name_(std::move(name)), stand_in_(std::move(stand_in)) {}

  void operator()(const PixelRows& rows, std::uint8_t* touched) const {
    if (exact_)
      exact_->apply(rows, touched);
    else
      stand_in_(rows, touched);
  }
  /// As --precision has it.
  const std::string& name() const noexcept { return name_; }
  /// The number type of stages beside it.
  Precision precision() const noexcept { return precision_; }

  /// What was compared to choose it; empty where it was named.
  std::vector<EvaluatorMeasure> measured;

 private:
  std::string name_;
  Precision precision_ = Precision::single;
  std::unique_ptr<const AppearanceBatch> exact_;
  RowOperator stand_in_;
};

/// Makes evaluators for scenes; any number of threads.
class EvaluatorSource {
 public:
  EvaluatorSource() = default;
  EvaluatorSource(const EvaluatorSource&) = delete;
  EvaluatorSource& operator=(const EvaluatorSource&) = delete;
  virtual ~EvaluatorSource() = default;
  /// `receptors`: rows bring signals of their own beside RGB.
  virtual std::shared_ptr<const Evaluator> evaluator(const AppearanceParameters& parameters, bool receptors,
                                                     const Notes& notes) = 0;
};

/// The operator itself, in float or double.
class ExactEvaluators : public EvaluatorSource {
 public:
  explicit ExactEvaluators(Precision precision = Precision::single) : precision_(precision) {}
  std::shared_ptr<const Evaluator> evaluator(const AppearanceParameters& parameters, bool receptors,
                                             const Notes& notes) override;

 private:
  Precision precision_;
};

}  // namespace scotopic
