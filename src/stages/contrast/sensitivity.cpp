#include "stages/contrast/sensitivity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace scotopic::contrast {
namespace {

/// Parameters of the CSF's shape at the luminances measured: HDR-VDP-2 (csf_hdrvdp.m).
constexpr std::size_t node_count = 6;
constexpr std::array<double, node_count> node_luminance = {0.002, 0.02, 0.2, 2.0, 20.0, 150.0};
constexpr std::array<std::array<double, node_count>, 4> shape_nodes = {{
    {0.991265, 0.800889, 0.476505, 0.405782, 0.334278, 0.394533},
    {3.74038, 3.54104, 4.37453, 4.40602, 3.79542, 2.7755},
    {0.50722, 0.682505, 0.750315, 0.935314, 1.07327, 1.16577},
    {4.46044, 4.94958, 5.28678, 5.61425, 6.4635, 7.45665},
}};

/// Wanat and Mantiuk 2014: absolute sensitivity, and the least product that still has a threshold below 1.
constexpr double absolute_sensitivity = 8.6;
constexpr double least_sensitivity = 1.0202;

/// The four parameters at a luminance.
std::array<double, 4> shape_at(double luminance) noexcept {
  std::size_t i = 1;
  while (i + 1 < node_count && luminance > node_luminance[i]) ++i;
  const double low = std::log10(node_luminance[i - 1]), high = std::log10(node_luminance[i]);
  const double f = std::clamp((std::log10(luminance) - low) / (high - low), 0.0, 1.0);
  std::array<double, 4> p{};
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = (1.0 - f) * shape_nodes[k][i - 1] + f * shape_nodes[k][i];
  return p;
}

/// Sensitivity of rods and cones together to a change of uniform light (HDR-VDP-2).
double joint_sensitivity(double luminance) noexcept {
  return 30.162 * std::pow(std::pow(4.0627 / luminance, 1.6596) + 1.0, -0.2712);
}

/// Least threshold of a band on a display: its sensitivity does not quite rise with luminance up to `peak`.
double least_threshold(double frequency, double peak) {
  double least = threshold_contrast(frequency, peak);
  for (double luminance = peak; luminance > 1e-3 * peak; luminance *= 0.9)
    least = std::min(least, threshold_contrast(frequency, luminance));
  return least;
}

}  // namespace

double optical_transfer(double frequency) noexcept {
  constexpr std::array<double, 4> weight = {0.42483860, 0.57243510, 0.00016758, 0.00255872};
  constexpr std::array<double, 4> decay = {0.028, 0.37, 37.0, 360.0};
  double sum = 0.0;
  for (std::size_t i = 0; i < weight.size(); ++i) sum += weight[i] * std::exp(-decay[i] * frequency);
  return sum;
}

double contrast_sensitivity(double frequency, double luminance) noexcept {
  const auto [p0, p1, p2, p3] = shape_at(luminance);
  const double rolloff = 1.0 + std::pow(p0 * frequency, p1);
  const double lift = std::pow(-std::expm1(-frequency * frequency / 49.0), p2);
  return p3 * std::sqrt(lift / rolloff) * optical_transfer(frequency) * joint_sensitivity(luminance);
}

double threshold_contrast(double frequency, double luminance) noexcept {
  const double sensitivity = absolute_sensitivity * contrast_sensitivity(frequency, luminance);
  const double t = 1.0 / std::max(sensitivity, least_sensitivity);
  return 0.5 * std::log10((1.0 + t) / (1.0 - t));
}

double kept_share(double contrast, double excess) noexcept {
  if (excess <= 0.0 || contrast <= least_contrast) return 1.0;
  return std::max(contrast - excess, least_contrast) / contrast;
}

std::vector<double> band_frequencies(double pixels_per_degree) {
  constexpr double lowest = 2.0;
  constexpr std::size_t most = 24;
  std::vector<double> bands;
  for (double rho = pixels_per_degree / 4.0; rho >= lowest && bands.size() < most; rho /= 2.0)
    bands.push_back(rho);
  return bands;
}

double threshold_excess(double frequency, double adaptation, double luminance, const DisplayLight& display) {
  // Luminance 0 has no logarithm; below this every threshold is at its limit.
  const double shown = std::max(std::min(display.scale * luminance, display.peak), 1e-12);
  const double scene = threshold_contrast(frequency, adaptation + luminance);
  return std::max(0.0, scene - threshold_contrast(frequency, shown));
}

ContrastNeed contrast_need(double adaptation, double pixels_per_degree, double peak) {
  ContrastNeed need;
  need.reason = "the picture is too coarse: none of its bands reaches 2 cycles per degree";
  for (double rho : band_frequencies(pixels_per_degree)) {
    const double excess = threshold_contrast(rho, adaptation) - least_threshold(rho, peak);
    if (need.frequency > 0.0 && excess <= need.excess) continue;
    need.excess = excess;
    need.frequency = rho;
  }
  if (need.frequency == 0.0) return need;
  need.needed = need.excess >= negligible_excess;
  need.reason = need.needed ? "the eye needs more contrast than the display's viewer"
                            : "the eye needs no more contrast than the display's viewer";
  return need;
}

}  // namespace scotopic::contrast
