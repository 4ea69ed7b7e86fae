#include "report/time_report.h"

#include <fmt/format.h>

namespace scotopic {
namespace {

// Of the reference against 256-bit arithmetic, of the pixel's largest component: tests/properties.
constexpr double reference_error = 2e-13;

nlohmann::ordered_json json_of(const ErrorStatistics& e) {
  return {{"mean", e.mean}, {"p99", e.p99}, {"max", e.max}};
}

nlohmann::ordered_json json_of(const EvaluatorError& e) {
  nlohmann::ordered_json out;
  out["deltaE00"] = json_of(e.difference);
  out["relativePixel"] = json_of(e.pixel);
  out["componentUlps"] = json_of(e.component);
  for (const WorstPixel& w : e.worst)
    out["worst"].push_back({{"in", w.in}, {"expected", w.expected}, {"got", w.got}, {"relative", w.error}});
  return out;
}

std::string error_columns(const std::optional<EvaluatorError>& e) {
  if (!e) return fmt::format("{:>10}{:>10}{:>10}{:>10}", "", "", "", "");
  return fmt::format("{:10.2g}{:10.2g}{:10.2g}{:10.2g}", e->difference.mean, e->difference.p99,
                     e->difference.max, e->pixel.max);
}

std::string bytes_text(std::size_t bytes) {
  if (bytes == 0) return "";
  return bytes < 1000000 ? fmt::format("{:.0f} kB", 1e-3 * static_cast<double>(bytes))
                         : fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(bytes));
}

}  // namespace

std::string time_text(const std::vector<EvaluatorRow>& rows, const TimeConditions& c) {
  std::string out = fmt::format(
      "{}; OpenColorIO {}; load {:.2f}\n{}, {} pixels, median of {} rounds\n"
      "errors over {}, against double, which is within {:g} of exact arithmetic\n\n",
      c.machine, c.ocio, c.load, c.picture, c.pixels, c.rounds, c.colours, reference_error);
  if (c.outside_ap1 > 0)
    out.insert(out.size() - 1, fmt::format("{} of them lie outside AP1: a LUT clamps them to its border, "
                                           "and is as far off there as that changes them\n",
                                           c.outside_ap1));
  out += fmt::format("{:<32}{:>10}{:>8}{:>8}{:>10}{:>10}{:>10}{:>10}{:>9}{:>9}\n", "", "ns/pixel", "spread",
                     "memcpy", "dE00 mean", "99 %", "max", "pixel", "tables", "bake s");
  std::string group;
  for (const EvaluatorRow& row : rows) {
    if (row.group != group) out += fmt::format("{}\n", group = row.group);
    out += fmt::format("  {:<30}{:10.3g}{:7.0f}%{:8.3g}{}{:>9}{:>9}{}\n", row.name, row.time.median,
                       100 * row.time.spread(), row.memcpy_ratio, error_columns(row.error),
                       bytes_text(row.bytes), row.seconds >= 0.0005 ? fmt::format("{:.3f}", row.seconds) : "",
                       row.dominated ? "  dominated" : "");
  }
  return out;
}

std::string time_csv(const std::vector<EvaluatorRow>& rows) {
  std::string out =
      "group,evaluator,ns_per_pixel,ns_least,ns_quartile_low,ns_quartile_high,memcpy_ratio,de00_mean,de00_"
      "p99,de00_"
      "max,"
      "pixel_mean,pixel_p99,pixel_max,ulps_mean,ulps_p99,ulps_max,bytes,bake_seconds,dominated\n";
  for (const EvaluatorRow& row : rows) {
    out += fmt::format("\"{}\",\"{}\",{:g},{:g},{:g},{:g},{:g}", row.group, row.name, row.time.median,
                       row.time.least, row.time.quartile_low, row.time.quartile_high, row.memcpy_ratio);
    if (!row.error)
      out += ",,,,,,,,,";
    else
      for (const ErrorStatistics* e : {&row.error->difference, &row.error->pixel, &row.error->component})
        out += fmt::format(",{:g},{:g},{:g}", e->mean, e->p99, e->max);
    out += fmt::format(",{},{:g},{}\n", row.bytes, row.seconds, row.dominated ? 1 : 0);
  }
  return out;
}

nlohmann::ordered_json time_json(const std::vector<EvaluatorRow>& rows, const TimeConditions& c) {
  nlohmann::ordered_json out;
  out["machine"] = c.machine;
  out["openColorIO"] = c.ocio;
  out["load"] = c.load;
  out["picture"] = c.picture;
  out["pixels"] = c.pixels;
  out["rounds"] = c.rounds;
  out["errorsOver"] = c.colours;
  out["outsideAp1"] = c.outside_ap1;
  out["referenceError"] = reference_error;
  for (const EvaluatorRow& row : rows) {
    nlohmann::ordered_json evaluator = {{"group", row.group},
                                        {"evaluator", row.name},
                                        {"nanosecondsPerPixel", row.time.median},
                                        {"quartiles", {row.time.quartile_low, row.time.quartile_high}},
                                        {"least", row.time.least},
                                        {"memcpyRatio", row.memcpy_ratio},
                                        {"bytes", row.bytes},
                                        {"bakeSeconds", row.seconds},
                                        {"dominated", row.dominated}};
    if (row.error) evaluator["error"] = json_of(*row.error);
    out["evaluators"].push_back(std::move(evaluator));
  }
  return out;
}

}  // namespace scotopic
