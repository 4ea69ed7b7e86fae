#include "looks/verify/evaluator_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "base/error.h"
#include "looks/verify/contenders.h"

namespace scotopic {
namespace {

constexpr std::size_t colours_compared = 20000;
constexpr int rounds = 5;

std::vector<MeasuredEvaluator> measure(const std::vector<Contender>& contenders, std::size_t pixels) {
  std::vector<MeasuredEvaluator> out;
  for (const EvaluatorRow& row : time_contenders(contenders, pixels, rounds, nullptr))
    if (row.error)
      out.push_back({evaluator_named(row.name).name, row.error->difference.max, row.time.median});
  return out;
}

bool meets(const MeasuredEvaluator& kind, const EvaluatorDemand& demand) {
  return (!demand.max_error || kind.max_error <= *demand.max_error) &&
         (!demand.budget || kind.nanoseconds <= *demand.budget);
}

std::string demand_text(const EvaluatorDemand& d) {
  std::string out;
  if (d.max_error) out = fmt::format("an error of at most {:g} dE00", *d.max_error);
  if (d.budget) out += fmt::format("{}at most {:g} ns per pixel", out.empty() ? "" : " and ", *d.budget);
  return out;
}

std::string measured_text(const std::vector<MeasuredEvaluator>& measured) {
  std::string out;
  for (const MeasuredEvaluator& kind : measured)
    out += fmt::format("{}{} {:.2g} dE00 {:.3g} ns", out.empty() ? "" : ", ", kind.name, kind.max_error,
                       kind.nanoseconds);
  return out;
}

/// What a scene or its plan may change of the parameters; the rest is the command's.
auto of_scene(const AppearanceParameters& p) {
  return std::make_tuple(p.adaptation, p.white_luminance, p.luminance, p.strength.all, p.strength.shift,
                         p.strength.luminance, p.strength.chroma);
}

/// A LUT is prepared already.
std::shared_ptr<Evaluator> evaluator_of(const EvaluatorKind& kind, const AppearanceParameters& parameters,
                                        RowOperator lut) {
  const std::string name(kind.name);
  if (kind.edge > 0) return std::make_shared<Evaluator>(name, std::move(lut));
  return std::make_shared<Evaluator>(name, parameters,
                                     name == "double" ? Precision::dual : Precision::single);
}

}  // namespace

std::optional<std::size_t> pick_evaluator(std::span<const MeasuredEvaluator> measured,
                                          const EvaluatorDemand& demand) {
  std::optional<std::size_t> best;
  const auto cost = [&](std::size_t i) {
    return demand.max_error ? measured[i].nanoseconds : measured[i].max_error;
  };
  for (std::size_t i = 0; i < measured.size(); ++i)
    if (meets(measured[i], demand) && (!best || cost(i) < cost(*best))) best = i;
  return best;
}

EvaluatorChoice choose_evaluator(const AppearanceParameters& p, const EvaluatorDemand& demand, bool luts) {
  const TimedPicture picture{stop_colours(colours_compared, p.xyz_from_rgb, p.xyz_from_rgb),
                             colours_compared};
  const auto place = std::make_shared<Workplace>(picture);
  std::vector<Contender> entered;
  const auto enter = [&](const char* name) {
    entered.push_back(evaluator_contender(p, evaluator_named(name), place, picture.pixels));
  };
  enter("float");
  enter("double");
  EvaluatorChoice out;
  out.measured = measure(entered, picture.pixels.size());
  for (const char* name : {"lut17", "lut33", "lut65", "lut129"}) {
    if (!luts) break;
    enter(name);
    out.measured = measure(entered, picture.pixels.size());
    if (out.measured.back().nanoseconds > out.measured.front().nanoseconds) break;
  }
  out.picked = pick_evaluator(out.measured, demand);
  if (out.picked) out.apply = entered[*out.picked].apply;
  return out;
}

std::shared_ptr<const Evaluator> ChosenEvaluators::evaluator(const AppearanceParameters& parameters,
                                                             bool receptors, const Notes& notes) {
  const std::lock_guard guard(lock_);
  if (kept_ && receptors == receptors_ && of_scene(parameters) == of_scene(parameters_)) return kept_;
  kept_ = make(parameters, receptors, notes);
  parameters_ = parameters;
  receptors_ = receptors;
  return kept_;
}

std::shared_ptr<const Evaluator> ChosenEvaluators::make(const AppearanceParameters& parameters,
                                                        bool receptors, const Notes& notes) {
  if (kind_) {
    if (kind_->edge > 0 && receptors)
      throw Error(ExitCode::usage, "", "no LUT holds signals of receptors: --precision float or double");
    return evaluator_of(*kind_, parameters,
                        kind_->edge > 0 ? prepare_evaluator(parameters, *kind_).apply : RowOperator());
  }
  EvaluatorChoice chosen = choose_evaluator(parameters, demand_, !receptors);
  if (!chosen.picked)
    throw Error(ExitCode::limit, "",
                fmt::format("no way has {}: {}", demand_text(demand_), measured_text(chosen.measured)));
  kind_ = &evaluator_named(chosen.measured[*chosen.picked].name);
  notes.note(fmt::format("computed in {}, for {} (measured: {})", kind_->name, demand_text(demand_),
                         measured_text(chosen.measured)));
  const std::shared_ptr<Evaluator> out = evaluator_of(*kind_, parameters, std::move(chosen.apply));
  out->measured = std::move(chosen.measured);
  return out;
}

}  // namespace scotopic
