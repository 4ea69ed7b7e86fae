#include "properties/judge.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "kernel/rod_input.h"
#include "stages/limits.h"

namespace scotopic::test {

double size_in(const Sample& in, Planes planes) {
  double size = 0;
  for (const float x : in.rgb) size = std::max(size, std::abs(static_cast<double>(x)));
  if (planes != Planes::rgb) size = std::max(size, std::abs(static_cast<double>(in.rod)));
  if (planes == Planes::all)
    for (const float cone : in.cones) size = std::max(size, std::abs(static_cast<double>(cone)));
  return size;
}

namespace {

double least_size(Way way) { return way == Way::dual ? 0x1p-126 : way == Way::single ? 0x1p-120 : 0; }

}  // namespace

double component_error(const Vec3<double>& got, const Summed<long double>& exact, Way way) {
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto error = static_cast<double>(std::abs(got[i] - exact.value[i]));
    if (error == 0) continue;
    const double size = std::max(least_size(way), static_cast<double>(exact.terms[i]));
    worst = std::isfinite(error) && size > 0 ? std::max(worst, error / size) : INFINITY;
  }
  return worst;
}

template <typename Real>
double relative_error(const Vec3<double>& got, const Vec3<Real>& exact, const Sample& in, Planes planes,
                      Way way) {
  using std::abs;
  double size = least_size(way), worst = 0;
  size = std::max(size, size_in(in, planes));
  for (const Real& x : exact) size = std::max(size, std::abs(static_cast<double>(x)));
  for (std::size_t i = 0; i < 3; ++i) {
    const double error = static_cast<double>(abs(Real(Real(got[i]) - exact[i])));
    worst = std::isfinite(error) ? std::max(worst, error) : INFINITY;
  }
  return worst == 0 ? 0 : worst / size;
}
template double relative_error(const Vec3<double>&, const Vec3<Mp>&, const Sample&, Planes, Way);
template double relative_error(const Vec3<double>&, const Vec3<long double>&, const Sample&, Planes, Way);

Strain strain(const OperatorConstants& c, const Sample& sample, Planes planes) {
  const ReferencePixel pixel = sample.widened(planes);
  const bool operable = size_in(sample, planes) <= operable_limit;
  const bool photopic =
      c.parameters.model != Model::safko2019 && local_luminance(c, pixel.rgb) >= photopic_limit;
  if (!operable || photopic) return {};
  const double rod = std::max(0.0, pixel.rod ? *pixel.rod : rod_signal_from_rgb(c, pixel.rgb));
  const bool by_level = c.parameters.model == Model::cao2008;
  const Vec3<double> kappa = by_level ? cao2008_kappa(local_luminance(c, pixel.rgb)) : c.kernel.kappa();
  Strain out;
  double size = 0;
  for (std::size_t j = 0; j < 3; ++j) size += std::abs(c.luminance_from_rgb[j] * pixel.rgb[j]);
  out.cancelled = dot(c.luminance_from_rgb, pixel.rgb) < 0.5 * size;
  for (std::size_t i = 0; i < 3; ++i) {
    double q = 0, magnitude = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      const double term =
          pixel.cones ? (j == i ? (*pixel.cones)[i] : 0) : c.lms_from_rgb[i][j] * pixel.rgb[j];
      q += term, magnitude += std::abs(term);
    }
    const double gain = c.kernel.gain()[i] * c.parameters.white_luminance;
    out.cancelled = out.cancelled || q < 0.1 * magnitude;
    const double rods = kappa[i] * rod, sum = q + rods, terms = magnitude + rods;
    if (sum < -0x1p-20 * terms) continue;
    out.root = std::max(out.root, gain * terms / (1 + gain * std::max(0.0, sum)));
  }
  return out;
}

double allowed_in_double(const Strain& strain) {
  return strain.cancelled ? 1e-7 + 0x1p-44 * strain.root : 2e-13 + 0x1p-47 * strain.root;
}

double allowed_component_error(Way way) {
  return way == Way::reference ? 2e-12 : way == Way::dual ? 0x1p-24 + 2e-12 : 1e-3;
}

double allowed_error(Way way, RodEstimate rods, const Strain& strain) {
  const double in_double = allowed_in_double(strain);
  if (way == Way::reference) return in_double;
  if (way == Way::dual) return 0x1p-24 + in_double;
  return (strain.cancelled ? 8e-6 : rods == RodEstimate::quadratic ? 4e-6 : 2e-6) + in_double;
}

std::string to_text(Regime regime, Way way, const Worst& w) {
  char numbers[300];
  std::snprintf(numbers, sizeof numbers, "%s,%s,%d,%.3g,%a,%a,%a,%a,%a,%a,%a,", name(regime),
                way_names[static_cast<std::size_t>(way)], static_cast<int>(w.planes), w.error,
                w.sample.rgb[0], w.sample.rgb[1], w.sample.rgb[2], w.sample.cones[0], w.sample.cones[1],
                w.sample.cones[2], w.sample.rod);
  return numbers + w.setting;
}

std::vector<Kept> read_worst(const std::string& path) {
  std::ifstream file(path);
  std::vector<Kept> out;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    if (cells.size() != 12 || !regime_named(cells[0])) throw std::runtime_error("worst.csv: " + line);
    const auto number = [&cells](std::size_t i) { return std::strtof(cells[i].c_str(), nullptr); };
    const auto way = std::find(way_names.begin(), way_names.end(), cells[1]) - way_names.begin();
    out.push_back({*regime_named(cells[0]),
                   static_cast<Way>(way),
                   static_cast<Planes>(std::stoi(cells[2])),
                   std::strtod(cells[3].c_str(), nullptr),
                   {{number(4), number(5), number(6)}, {number(7), number(8), number(9)}, number(10)},
                   parameters_from_text(cells[11])});
  }
  return out;
}

}  // namespace scotopic::test
