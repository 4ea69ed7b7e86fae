#include "looks/cube/cube_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "color/primaries.h"
#include "looks/chain/number_text.h"
#include "looks/cube/cube_colours.h"
#include "looks/lut/look_chain.h"

namespace scotopic {
namespace {

constexpr double seen_difference = 1;  // CIEDE2000: just seen

void clamp_codes(Colours& codes) {
  for (auto* plane : {&codes.r, &codes.g, &codes.b})
    for (float& x : *plane) x = x > 0 ? std::min(x, 1.f) : 0.f;
}

double share_changed(const Colours& a, const Colours& b) {
  std::size_t changed = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    changed += a.r[i] != b.r[i] || a.g[i] != b.g[i] || a.b[i] != b.b[i];
  return a.size() > 0 ? static_cast<double>(changed) / static_cast<double>(a.size()) : 0;
}

double greatest_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    worst = std::max(worst, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  return worst;
}

ReadingError measured(const CubeGoal& goal, const CodedColours& set, const Matrix3<double>& xyz_from_rgb,
                      const CubeReaders& readers) {
  ReadingError out;
  out.without_code = set.without_code;
  const Colours exact = goal.exact(set.codes), in = goal.light(set.codes);
  Colours wanted = exact;
  clamp_codes(wanted);
  out.clamped = share_changed(exact, wanted);
  const Colours expected = goal.light_out(wanted);
  for (std::size_t k = 0; k < readings.size(); ++k) {
    Colours got = set.codes;
    apply(readers[k], got);
    out.worst_code[k] = std::max({greatest_difference(got.r, wanted.r), greatest_difference(got.g, wanted.g),
                                  greatest_difference(got.b, wanted.b)});
    Comparison comparison(xyz_from_rgb, goal.difference());
    comparison.add(in, expected, goal.light_out(std::move(got)));
    out.by_reading[k] = comparison.result();
  }
  return out;
}

std::string figures(const BakeError& e, double code) {
  return fmt::format("mean {}; 99 % {}; max {}; worst code {}", rounded_text(e.mean, 2),
                     rounded_text(e.p99, 2), rounded_text(e.max, 2), rounded_text(code, 2));
}

void state(std::vector<std::string>& lines, const ReadingError& e, const std::string& colours) {
  if (e.by_reading[0].samples == 0) return;
  for (std::size_t k = 0; k < readings.size(); ++k)
    lines.push_back(fmt::format("{} of {:g} to {:g} stops, {}: {}", colours, cube_darkest, cube_brightest,
                                readings[k] == Reading::tetrahedral ? "tetrahedral" : "trilinear",
                                figures(e.by_reading[k], e.worst_code[k])));
  if (e.without_code > 0)
    lines.push_back(fmt::format("{}: {:.1f} % have no code in 0 to 1 and are not counted", colours,
                                100 * e.without_code));
  if (e.clamped > 0)
    lines.push_back(
        fmt::format("{}: {:.1f} % come out beyond 0 to 1 and are clamped", colours, 100 * e.clamped));
}

}  // namespace

const BakeError& ReadingError::worse() const noexcept {
  return by_reading[0].p99 >= by_reading[1].p99 ? by_reading[0] : by_reading[1];
}

Matrix3<double> own_gamut(const LookSpec& spec, const ColourConfig& config) {
  const auto encoding = config.encoding(config.space(spec.space));
  if (!encoding)
    throw Error(ExitCode::config, config.file(), "'" + spec.space + "' is no encoding of R, G, B");
  return encoding->xyz_from_rgb;
}

CubeError measure_cube(const LookSpec& spec, const ColourConfig& config, const CubeReaders& readers,
                       std::size_t count) {
  const CubeGoal goal(spec, config);
  const Matrix3<double>& working = spec.parameters.xyz_from_rgb;
  const auto over = [&](const Matrix3<double>& gamut) {
    return measured(goal, coded_colours(goal, gamut, working, count, {cube_darkest, cube_brightest}), working,
                    readers);
  };
  return {over(gamut_xyz_matrix("rec709").value()), over(own_gamut(spec, config))};
}

std::vector<std::string> error_lines(const CubeError& error, const LookSpec& spec) {
  const bool itp = spec.night && spec.night->peak > display_white;
  std::vector<std::string> lines = {
      fmt::format("Error against the operator{}, {}", spec.night ? " and the display stage" : "",
                  itp          ? "delta E ITP of what is shown"
                  : spec.night ? "CIEDE2000 of what is shown"
                               : "CIEDE2000 with each pixel exposed to Y = 0.184")};
  state(lines, error.rec709, "Rec.709 colours");
  state(lines, error.own, "Colours of the space's own gamut (within AP1)");
  return lines;
}

std::string warning_of(const CubeError& error) {
  const BakeError& e = error.rec709.worse();
  if (e.p99 <= seen_difference) return "";
  return fmt::format(
      "one in a hundred colours is off by {:.2g} and more, which is seen: a log space, a larger --size or a "
      ".clf is better",
      e.p99);
}

}  // namespace scotopic
