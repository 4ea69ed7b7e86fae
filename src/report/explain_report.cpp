#include "report/explain_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "batch/batch.h"
#include "stages/limits.h"

namespace scotopic {
namespace {

constexpr int lowest_octave = -60;
constexpr int octaves = 120;

// Median of a few runs over all samples, ns per pixel.
double time_of(const AppearanceParameters& parameters, const SceneStatistics& s) {
  const AppearanceBatch batch(parameters);
  const std::size_t count = s.samples.size() / 3;
  std::vector<float> planes[3], work[3];
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < count; ++i) planes[c].push_back(s.samples[3 * i + c]);
  std::vector<double> times;
  for (int run = 0; run < 15; ++run) {
    for (std::size_t c = 0; c < 3; ++c) work[c] = planes[c];
    const auto start = std::chrono::steady_clock::now();
    batch.apply({work[0].data(), work[1].data(), work[2].data(), nullptr, nullptr, nullptr, nullptr, count});
    times.push_back(
        std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + 7, times.end());
  return times[7] / static_cast<double>(count);
}

std::string bar(double share, double greatest, int width) {
  const int length = greatest > 0 ? static_cast<int>(std::lround(share / greatest * width)) : 0;
  return std::string(static_cast<std::size_t>(share > 0 ? std::max(1, length) : 0), '#');
}

std::string_view verdict(const EffectDecision& d) {
  if (!d.asked) return "off";
  return d.needed ? "yes" : "no";
}

}  // namespace

std::vector<double> measure_costs(const AppearanceParameters& asked, const ScenePlan& plan,
                                  const SceneStatistics& s) {
  std::vector<double> costs(plan.effects.size());
  if (s.samples.size() < 3 * 256) return costs;
  const double whole = time_of(asked, s);
  for (std::size_t i = 0; i < plan.effects.size(); ++i) {
    const EffectDecision& d = plan.effects[i];
    AppearanceParameters without = asked;
    if (d.effect == "shift")
      without.strength.shift = 0;
    else if (d.effect == "luminance")
      without.luminance = LuminancePolicy::none;
    else if (d.effect == "chroma")
      without.strength.chroma = 0;
    else
      continue;
    if (d.runs()) costs[i] = std::max(0.0, whole - time_of(without, s));
  }
  return costs;
}

std::vector<LuminanceBar> luminance_bars(const SceneStatistics& s, double white_luminance) {
  // Octaves of image values, labelled in cd/m2: exact whatever the unit.
  const std::vector<std::uint64_t> counts = s.photopic.octaves(lowest_octave, octaves);
  const auto lit = [](std::uint64_t n) { return n > 0; };
  const auto first = std::find_if(counts.begin(), counts.end(), lit);
  const auto last = std::find_if(counts.rbegin(), counts.rend(), lit).base();
  std::vector<LuminanceBar> bars;
  for (auto it = first; it < last; ++it)
    bars.push_back({white_luminance * std::ldexp(1.0, lowest_octave + static_cast<int>(it - counts.begin())),
                    static_cast<double>(*it) / static_cast<double>(s.finite())});
  return bars;
}

double dark_share(const SceneStatistics& s) {
  return s.finite() ? static_cast<double>(s.photopic.dark()) / static_cast<double>(s.finite()) : 0;
}

std::string unit_advice(const SceneStatistics& s, double adaptation, double white_luminance) {
  constexpr double lamps = 100;       // times the log-average: what is so bright and rare shines by itself
  constexpr double lamp_cdm2 = 1000;  // what the dimmest street lamps have
  const double mean = s.log_mean_luminance();
  if (!(mean > 0)) return "";
  const double stops = std::log2(white_luminance * mean / adaptation);
  if (std::abs(stops) > 1)
    return fmt::format(
        "the picture's log-average is {:.3g} cd/m2, {:.1f} stops {} what the eye is adapted to: "
        "--white-luminance {:.3g} would make them agree",
        white_luminance * mean, std::abs(stops), stops > 0 ? "above" : "below", adaptation / mean);
  const double bright = s.photopic.quantile(0.999);
  if (bright > lamps * mean && white_luminance * bright < photopic_limit)
    return fmt::format(
        "the brightest 0.1 % have {:.3g} cd/m2, too dim for lamps: if they are, --white-luminance {:.3g} "
        "gives them {:g}",
        white_luminance * bright, lamp_cdm2 / bright, lamp_cdm2);
  return "";
}

std::string luminance_text(const SceneStatistics& s, double white_luminance) {
  const std::vector<LuminanceBar> bars = luminance_bars(s, white_luminance);
  double greatest = dark_share(s);
  for (const LuminanceBar& b : bars) greatest = std::max(greatest, b.share);
  std::string text = "luminance, cd/m2     share of pixels\n";
  if (dark_share(s) > 0)
    text += fmt::format("  {:<18} {:5.1f} % {}\n", "0 or below", 100 * dark_share(s),
                        bar(dark_share(s), greatest, 40));
  for (const LuminanceBar& b : bars)
    if (b.share > 0)
      text += fmt::format("  {:<18} {:5.1f} % {}\n", fmt::format("{:.2g} to {:.2g}", b.from, 2 * b.from),
                          100 * b.share, bar(b.share, greatest, 40));
  return text;
}

std::string effects_text(const ScenePlan& plan, const std::vector<double>& costs) {
  std::string text = "effect     needed  pixels  dE00 max  ns/px  why\n";
  for (std::size_t i = 0; i < plan.effects.size(); ++i) {
    const EffectDecision& d = plan.effects[i];
    const auto number = [&](bool shown, const std::string& value) {
      return shown ? value : std::string("-");
    };
    text += fmt::format("{:<10} {:<7} {:>6} {:>9} {:>6}  {}\n", d.effect, verdict(d),
                        number(true, fmt::format("{:.0f} %", 100 * d.share)),
                        number(d.difference > 0, fmt::format("{:.3g}", d.difference)),
                        number(costs[i] > 0, fmt::format("{:.1f}", costs[i])), d.reason);
  }
  return text;
}

std::string luminance_csv(const SceneStatistics& s, double white_luminance) {
  std::string text = "from_cdm2,to_cdm2,share\n";
  if (dark_share(s) > 0) text += fmt::format("-inf,0,{:g}\n", dark_share(s));
  for (const LuminanceBar& b : luminance_bars(s, white_luminance))
    text += fmt::format("{:g},{:g},{:g}\n", b.from, 2 * b.from, b.share);
  return text;
}

}  // namespace scotopic
