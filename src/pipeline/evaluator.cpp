#include "pipeline/evaluator.h"

#include <utility>

namespace scotopic {

Evaluator::Evaluator(std::string name, const AppearanceParameters& parameters, Precision precision)
    : name_(std::move(name)),
      precision_(precision),
      exact_(std::make_unique<const AppearanceBatch>(parameters, precision)) {}

std::shared_ptr<const Evaluator> ExactEvaluators::evaluator(const AppearanceParameters& parameters, bool,
                                                            const Notes&) {
  return std::make_shared<const Evaluator>(precision_ == Precision::dual ? "double" : "float", parameters,
                                           precision_);
}

}  // namespace scotopic
