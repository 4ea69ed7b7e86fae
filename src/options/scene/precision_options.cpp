#include "options/scene/precision_options.h"

#include "looks/verify/evaluator_choice.h"
#include "options/values.h"

namespace scotopic {

void add_precision_options(CLI::App& verb, PrecisionOptions& o) {
  const TextOptions add{verb, "Accuracy and time"};
  CLI::Option* const name =
      add("--precision", o.precision,
          "float (default), double, or through a LUT in OpenColorIO: lut129, lut65, lut33, lut17", "NAME");
  add("--max-error", o.max_error,
      "The cheapest way whose worst colour is at most this far off, measured here and now", "DE00")
      ->excludes(name);
  add("--budget", o.budget, "The most accurate way that takes no longer for a pixel on one thread", "NS")
      ->excludes(name);
}

std::unique_ptr<EvaluatorSource> parse(const PrecisionOptions& o) {
  EvaluatorDemand demand;
  if (!o.max_error.empty())
    demand.max_error =
        number_in("--max-error", o.max_error, 0, 1000, "a colour difference of 0 to 1000 (CIEDE2000)");
  if (!o.budget.empty())
    demand.budget = number_in("--budget", o.budget, 0, 1e9, "nanoseconds per pixel, 0 to 1e9");
  std::vector<std::pair<std::string, const EvaluatorKind*>> names;
  for (const EvaluatorKind& kind : evaluator_kinds) names.emplace_back(kind.name, &kind);
  const EvaluatorKind& named = *choice("--precision", o.precision, names);
  if (demand.max_error || demand.budget) return std::make_unique<ChosenEvaluators>(demand);
  if (named.edge > 0) return std::make_unique<ChosenEvaluators>(named);
  return std::make_unique<ExactEvaluators>(named.name == "double" ? Precision::dual : Precision::single);
}

}  // namespace scotopic
