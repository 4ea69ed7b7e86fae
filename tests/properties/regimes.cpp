#include "properties/regimes.h"

#include <bit>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "support/primaries.h"

namespace scotopic::test {
namespace {

constexpr std::array<const char*, regime_count> names = {
    "ordinary",      "zero",        "subnormal",  "tiny",          "huge",
    "half_extremes", "grey",        "opponent_zero", "pure_rods",  "one_channel",
    "negative",      "out_of_gamut", "threshold_photopic", "threshold_scotopic", "threshold_floor",
    "luminance_zero", "kernel_clamp", "projection_face", "mixed_exponents"};

// A wide gamut, sums of primaries equal to white's: AP0-like, with imaginary primaries.
constexpr Matrix3<double> ap0_like = xyz_from_rgb({0.7347, 0.0, 0.0001}, {0.2653, 1.0, -0.077}, 0.3127, 0.3290);
const std::array<Matrix3<double>, 4> spaces = {rec709, rec2020, ap0_like, identity3<double>()};

float few_ulp(float x, Random& random) {
  const int steps = random.below(9) - 4;
  for (int i = 0; i < std::abs(steps); ++i) x = std::nextafter(x, steps < 0 ? -INFINITY : INFINITY);
  return x;
}

using Rgb = std::array<double, 3>;

Rgb positive(Random& random, double from, double to) {
  const double size = random.log_uniform(from, to);
  return {size * random.uniform(0, 1), size * random.uniform(0, 1), size * random.uniform(0, 1)};
}

// Scaled so that La + unit Y comes out at `local`, as far as there is room above La.
Rgb at_local_luminance(Rgb rgb, double local, const OperatorConstants& c) {
  const double room = local - c.parameters.adaptation;
  const double y = dot(c.luminance_from_rgb, Vec3<double>(rgb));
  if (!(room > 0 && y > 0)) return rgb;
  for (auto& x : rgb) x *= room / (y * c.parameters.white_luminance);
  return rgb;
}

// The third component moved so that dot(row, rgb) becomes `target`.
Rgb solved_for(const Vec3<double>& row, Rgb rgb, double target) {
  const std::size_t k = std::abs(row[0]) > std::abs(row[1]) ? (std::abs(row[0]) > std::abs(row[2]) ? 0 : 2)
                                                            : (std::abs(row[1]) > std::abs(row[2]) ? 1 : 2);
  rgb[k] = 0;
  rgb[k] = (target - dot(row, Vec3<double>(rgb))) / row[k];
  return rgb;
}

Rgb draw_rgb(Regime regime, const OperatorConstants& c, Random& random) {
  const double unit = c.parameters.white_luminance;
  const double low = 1e-6 / unit, high = 1e6 / unit;
  Rgb rgb = positive(random, low, high);
  const auto any = static_cast<std::size_t>(random.below(3));
  const auto signed_values = [&](double from, double to) -> Rgb {
    return {random.sign() * random.log_uniform(from, to), random.sign() * random.log_uniform(from, to),
            random.sign() * random.log_uniform(from, to)};
  };
  switch (regime) {
    case Regime::zero:
      for (auto& x : rgb)
        if (random.chance(0.6)) x = random.chance(0.5) ? -0.0 : 0.0;
      return rgb;
    case Regime::subnormal: return signed_values(1.5e-45, 1.1e-38);
    case Regime::tiny: return signed_values(1e-38, 1e-20);
    case Regime::huge: return random.chance(0.1) ? signed_values(0x0.fp120, 0x1.1p120) : signed_values(1e20, 0x1p120);
    case Regime::half_extremes: {
      constexpr std::array<double, 6> ends = {65504, -65504, 5.9604644775390625e-8, 6.103515625e-5, 0, 6.1e-5};
      for (auto& x : rgb) x = ends[static_cast<std::size_t>(random.below(6))];
      return rgb;
    }
    case Regime::grey: return {rgb[0], rgb[0], rgb[0]};
    case Regime::opponent_zero: {
      Vec3<double> row;
      for (std::size_t i = 0; i < 3; ++i) row[i] = c.lms_from_rgb[0][i] - c.lms_from_rgb[1][i];
      return solved_for(row, rgb, 0);
    }
    case Regime::pure_rods:
      for (auto& x : rgb) x *= random.chance(0.5) ? 0.0 : 1e-6;
      return rgb;
    case Regime::one_channel: {
      const double x = rgb[any];
      rgb = {0, 0, 0};
      rgb[any] = x;
      return rgb;
    }
    case Regime::negative: return signed_values(1e-6 / unit, 1e2 / unit);
    case Regime::out_of_gamut: rgb[any] *= -random.log_uniform(1e-6, 10); return rgb;
    case Regime::threshold_photopic:
      return at_local_luminance(rgb, random.chance(0.5) ? 5 : 4.998 * (1 + random.uniform(-2e-4, 2e-4)), c);
    case Regime::threshold_scotopic:
      return at_local_luminance(rgb, (random.chance(0.5) ? 0.00203 : 0.001) * (1 + random.uniform(-2e-2, 2e-2)), c);
    case Regime::threshold_floor: {
      // One step of a secant towards luminance = +-largest/64 is enough to land on both sides.
      const double largest = std::abs(rgb[0]) + std::abs(rgb[1]) + std::abs(rgb[2]);
      return solved_for(c.luminance_from_rgb, rgb, random.sign() * random.log_uniform(.2, 5) * largest / 64);
    }
    case Regime::luminance_zero: {
      rgb[any] = -rgb[any];
      const double largest = std::abs(rgb[0]) + std::abs(rgb[1]) + std::abs(rgb[2]);
      return solved_for(c.luminance_from_rgb, rgb, random.chance(0.3) ? 0 : largest * random.log_uniform(1e-9, 1e-3));
    }
    case Regime::kernel_clamp: {
      const auto cone = static_cast<std::size_t>(random.below(3));
      const double kappa_rod = 0.15 * (rgb[0] + rgb[1] + rgb[2]) * random.uniform(0, 2);
      return solved_for(c.lms_from_rgb[cone], rgb, -kappa_rod);
    }
    case Regime::projection_face: rgb[any] *= random.chance(0.3) ? 0.0 : 1e-3 * random.uniform(-1, 1); return rgb;
    case Regime::mixed_exponents: return signed_values(1e-30, 1e30);
    case Regime::ordinary:
    case Regime::count: break;
  }
  return rgb;
}

}  // namespace

std::uint64_t Random::bits() {
  std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double Random::uniform(double from, double to) {
  return from + (to - from) * (static_cast<double>(bits() >> 11) * 0x1p-53);
}

double Random::log_uniform(double from, double to) { return from * std::exp2(uniform(0, std::log2(to / from))); }

const char* name(Regime regime) { return names[static_cast<std::size_t>(regime)]; }

std::optional<Regime> regime_named(const std::string& text) {
  for (int i = 0; i < regime_count; ++i)
    if (text == names[static_cast<std::size_t>(i)]) return static_cast<Regime>(i);
  return std::nullopt;
}

ReferencePixel Sample::widened(Planes planes) const {
  ReferencePixel out;
  for (std::size_t i = 0; i < 3; ++i) out.rgb[i] = rgb[i];
  if (planes != Planes::rgb) out.rod = rod;
  if (planes == Planes::all) out.cones = Vec3<double>{cones[0], cones[1], cones[2]};
  return out;
}

Rows::Rows(const std::vector<Sample>& samples) {
  for (const Sample& x : samples) {
    r.push_back(x.rgb[0]), g.push_back(x.rgb[1]), b.push_back(x.rgb[2]);
    l.push_back(x.cones[0]), m.push_back(x.cones[1]), s.push_back(x.cones[2]), rod.push_back(x.rod);
  }
}

PixelRows Rows::view(Planes planes) {
  PixelRows out{r.data(), g.data(), b.data(), nullptr, nullptr, nullptr, nullptr, r.size()};
  if (planes != Planes::rgb) out.rod = rod.data();
  if (planes == Planes::all) out.cone_l = l.data(), out.cone_m = m.data(), out.cone_s = s.data();
  return out;
}

AppearanceParameters draw_parameters(Random& random) {
  AppearanceParameters p;
  p.model = random.chance(0.5) ? Model::filament2021 : random.chance(0.8) ? Model::kirk2011 : Model::safko2019;
  p.adaptation = random.log_uniform(1e-6, 6);
  p.white_luminance = random.chance(0.5) ? p.adaptation / 0.18 : random.log_uniform(1e-4, 1e4);
  p.weight = random.chance(0.8) ? Weight::local : Weight::global;
  p.luminance = random.chance(0.7)   ? LuminancePolicy::mesopic
                : random.chance(0.5) ? LuminancePolicy::photopic
                                     : LuminancePolicy::none;
  const auto strength = [&] { return random.chance(0.6) ? 1.0 : random.chance(0.2) ? 0.0 : random.uniform(0, 1); };
  p.strength = {strength(), strength(), strength(), strength()};
  p.rods = random.chance(0.7) ? RodEstimate::linear : RodEstimate::quadratic;
  p.sp_ratio = random.chance(0.6) ? sp_ratio_d65 : random.log_uniform(0.3, 3);
  p.safko_scale = random.log_uniform(1e-2, 1e4);
  p.xyz_from_rgb = spaces[static_cast<std::size_t>(random.below(4))];
  if (random.chance(0.7)) p.xyz_from_gamut = spaces[static_cast<std::size_t>(random.below(3))];
  if (random.chance(0.3)) p.xyz_from_gamut = p.xyz_from_rgb;
  return p;
}

Planes draw_planes(Random& random) {
  return random.chance(0.6) ? Planes::rgb : random.chance(0.5) ? Planes::rgb_rod : Planes::all;
}

Sample draw(Regime regime, const OperatorConstants& c, Random& random) {
  const Rgb rgb = draw_rgb(regime, c, random);
  Sample out;
  for (std::size_t i = 0; i < 3; ++i) out.rgb[i] = static_cast<float>(rgb[i]);
  const bool edge = regime == Regime::threshold_photopic || regime == Regime::threshold_floor ||
                    regime == Regime::luminance_zero || regime == Regime::projection_face;
  if (edge)
    for (auto& x : out.rgb) x = few_ulp(x, random);
  // Receptors of a spectrum agree with RGB but roughly: metamers differ.
  const Vec3<double> q = c.lms_from_rgb * Vec3<double>(rgb);
  for (std::size_t i = 0; i < 3; ++i)
    out.cones[i] = static_cast<float>(q[i] * (random.chance(0.5) ? 1 : random.uniform(0.8, 1.2)));
  double rod = 0.5 * (q[0] + q[1]) * random.uniform(0, 2);
  if (regime == Regime::pure_rods) rod = random.log_uniform(1e-6, 1e2) / c.parameters.white_luminance;
  if (regime == Regime::zero && random.chance(0.5)) rod = random.sign() * 0.0;
  if (regime == Regime::kernel_clamp) {
    const auto cone = static_cast<std::size_t>(random.below(3));
    rod = -q[cone] / (cone == 2 ? 0.3 : 0.2) * (1 + random.uniform(-1e-6, 1e-6));
  }
  out.rod = static_cast<float>(rod);
  return out;
}

std::string to_text(const AppearanceParameters& p) {
  std::string out;
  const auto add = [&out](double x) {
    char text[40];
    std::snprintf(text, sizeof text, "%a ", x);
    out += text;
  };
  for (const double x : {static_cast<double>(p.model), p.adaptation, p.white_luminance, static_cast<double>(p.weight),
                         static_cast<double>(p.luminance), p.strength.all, p.strength.shift, p.strength.luminance,
                         p.strength.chroma, static_cast<double>(p.rods), p.sp_ratio, p.safko_scale})
    add(x);
  for (const auto& row : p.xyz_from_rgb.rows)
    for (const double x : row) add(x);
  if (p.xyz_from_gamut)
    for (const auto& row : p.xyz_from_gamut->rows)
      for (const double x : row) add(x);
  out.pop_back();
  return out;
}

AppearanceParameters parameters_from_text(const std::string& text) {
  std::vector<double> n;
  std::istringstream stream(text);
  for (std::string word; stream >> word;) n.push_back(std::strtod(word.c_str(), nullptr));
  if (n.size() != 21 && n.size() != 30) throw std::runtime_error("not a setting: " + text);
  AppearanceParameters p;
  p.model = static_cast<Model>(n[0]);
  p.adaptation = n[1], p.white_luminance = n[2];
  p.weight = static_cast<Weight>(n[3]);
  p.luminance = static_cast<LuminancePolicy>(n[4]);
  p.strength = {n[5], n[6], n[7], n[8]};
  p.rods = static_cast<RodEstimate>(n[9]);
  p.sp_ratio = n[10], p.safko_scale = n[11];
  const auto matrix = [&n](std::size_t first) {
    Matrix3<double> m;
    for (std::size_t i = 0; i < 9; ++i) m[i / 3][i % 3] = n[first + i];
    return m;
  };
  p.xyz_from_rgb = matrix(12);
  if (n.size() == 30) p.xyz_from_gamut = matrix(21);
  return p;
}

}  // namespace scotopic::test
