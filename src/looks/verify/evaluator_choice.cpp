#include "looks/verify/evaluator_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "base/error.h"
#include "looks/verify/timing.h"

namespace scotopic {
namespace {

constexpr std::size_t colours_compared = 20000;
constexpr int rounds = 5;

struct Candidate {
  const EvaluatorKind* kind;
  PreparedEvaluator prepared;
  double max_error;
};

class Contest {
 public:
  explicit Contest(const AppearanceParameters& p)
      : parameters_(p), colours_(stop_colours(colours_compared, p.xyz_from_rgb, p.xyz_from_rgb)) {}

  void enter(std::string_view name) {
    const EvaluatorKind& kind = evaluator_named(name);
    PreparedEvaluator prepared = prepare_evaluator(parameters_, kind);
    const double max_error = evaluator_error(parameters_, prepared.apply, colours_).difference.max;
    candidates_.push_back({&kind, std::move(prepared), max_error});
  }

  std::vector<MeasuredEvaluator> measure() const {
    Colours work = colours_;
    PixelRows rows;
    rows.r = work.r.data(), rows.g = work.g.data(), rows.b = work.b.data(), rows.count = work.size();
    std::vector<TimedRun> runs;
    for (const Candidate& c : candidates_)
      runs.push_back({[&] {
                        std::copy(colours_.r.begin(), colours_.r.end(), work.r.begin());
                        std::copy(colours_.g.begin(), colours_.g.end(), work.g.begin());
                        std::copy(colours_.b.begin(), colours_.b.end(), work.b.begin());
                      },
                      [&rows, &c] { c.prepared.apply(rows, nullptr); }, work.size()});
    const std::vector<RunTime> times = time_interleaved(runs, rounds);
    std::vector<MeasuredEvaluator> out;
    for (std::size_t i = 0; i < candidates_.size(); ++i)
      out.push_back({candidates_[i].kind->name, candidates_[i].max_error, times[i].median});
    return out;
  }

  PreparedEvaluator take(std::size_t i) { return std::move(candidates_[i].prepared); }

 private:
  const AppearanceParameters& parameters_;
  Colours colours_;
  std::vector<Candidate> candidates_;
};

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

/// The evaluator of a way; a LUT's is prepared already.
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

EvaluatorChoice choose_evaluator(const AppearanceParameters& parameters, const EvaluatorDemand& demand,
                                 bool luts) {
  Contest contest(parameters);
  contest.enter("float");
  contest.enter("double");
  EvaluatorChoice out;
  out.measured = contest.measure();
  for (const char* name : {"lut17", "lut33", "lut65", "lut129"}) {
    if (!luts) break;
    contest.enter(name);
    out.measured = contest.measure();
    if (out.measured.back().nanoseconds > out.measured.front().nanoseconds) break;
  }
  out.picked = pick_evaluator(out.measured, demand);
  if (out.picked) out.kind = contest.take(*out.picked);
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
  const std::shared_ptr<Evaluator> out = evaluator_of(*kind_, parameters, std::move(chosen.kind.apply));
  out->measured = std::move(chosen.measured);
  return out;
}

}  // namespace scotopic
