#include "cli/scene/precision_options.h"

#include <fmt/format.h>

#include "cli/options/values.h"

namespace scotopic {
namespace {

std::string demand_text(const WayDemand& d) {
  std::string out;
  if (d.max_error) out = fmt::format("an error of at most {:g} dE00", *d.max_error);
  if (d.budget) out += fmt::format("{}at most {:g} ns per pixel", out.empty() ? "" : " and ", *d.budget);
  return out;
}

std::string measured_text(const std::vector<MeasuredWay>& measured) {
  std::string out;
  for (const MeasuredWay& way : measured)
    out += fmt::format("{}{} {:.2g} dE00 {:.3g} ns", out.empty() ? "" : ", ", way.name, way.max_error,
                       way.nanoseconds);
  return out;
}

nlohmann::ordered_json report_of(const WayChoice& choice) {
  nlohmann::ordered_json out;
  for (const MeasuredWay& way : choice.measured)
    out.push_back(
        {{"way", way.name}, {"maxDeltaE00", way.max_error}, {"nanosecondsPerPixel", way.nanoseconds}});
  return out;
}

}  // namespace

void add_precision_options(CLI::App& verb, PrecisionOptions& o) {
  const std::string group = "Accuracy and time";
  CLI::Option* const name =
      verb.add_option("--precision", o.precision,
                      "float (default), double, or through a LUT in OpenColorIO: lut129, lut65, lut33, lut17")
          ->type_name("NAME")
          ->group(group);
  const auto demand = [&](const char* option, std::string& value, const char* text, const char* kind) {
    verb.add_option(option, value, text)->type_name(kind)->group(group)->excludes(name);
  };
  demand("--max-error", o.max_error,
         "The cheapest way whose worst colour is at most this far off, measured here and now", "DE00");
  demand("--budget", o.budget, "The most accurate way that takes no longer for a pixel on one thread", "NS");
}

PrecisionChoice understand(const PrecisionOptions& o) {
  PrecisionChoice out;
  if (!o.max_error.empty())
    out.demand.max_error =
        number_in("--max-error", o.max_error, 0, 1000, "a colour difference of 0 to 1000 (CIEDE2000)");
  if (!o.budget.empty())
    out.demand.budget = number_in("--budget", o.budget, 0, 1e9, "nanoseconds per pixel, 0 to 1e9");
  std::vector<std::pair<std::string, const Way*>> names;
  for (const Way& way : ways) names.emplace_back(way.name, &way);
  const Way* const named = choice("--precision", o.precision, names);
  if (!out.demand.max_error && !out.demand.budget) out.way = named;
  return out;
}

ChosenWay settle(const PrecisionChoice& choice, const AppearanceParameters& parameters, bool receptors,
                 const Console& console) {
  if (choice.way) {
    if (choice.way->edge > 0 && receptors)
      throw Error(ExitCode::usage, "", "no LUT holds signals of receptors: --precision float or double");
    PreparedWay way = prepare_way(parameters, *choice.way);
    return {std::string(choice.way->name), std::move(way.apply), nullptr};
  }
  WayChoice chosen = choose_way(parameters, choice.demand, !receptors);
  if (!chosen.picked)
    throw Error(ExitCode::limit, "",
                fmt::format("no way has {}: {}", demand_text(choice.demand), measured_text(chosen.measured)));
  const MeasuredWay& way = chosen.measured[*chosen.picked];
  console.note(fmt::format("computed in {}, for {} (measured: {})", way.name, demand_text(choice.demand),
                           measured_text(chosen.measured)));
  return {std::string(way.name), std::move(chosen.way.apply), report_of(chosen)};
}

}  // namespace scotopic
