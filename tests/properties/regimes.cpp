#include "properties/regimes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "adaptation/mesopic.h"
#include "stages/limits.h"
#include "support/primaries.h"

namespace scotopic::test {
namespace {

constexpr std::array<const char*, regime_count> names = {"ordinary",
                                                         "zero",
                                                         "subnormal",
                                                         "tiny",
                                                         "huge",
                                                         "half_extremes",
                                                         "grey",
                                                         "opponent_zero",
                                                         "pure_rods",
                                                         "one_channel",
                                                         "negative",
                                                         "out_of_gamut",
                                                         "threshold_photopic",
                                                         "threshold_scotopic",
                                                         "threshold_floor",
                                                         "luminance_zero",
                                                         "kernel_clamp",
                                                         "projection_face",
                                                         "mixed_exponents",
                                                         "equal_cones"};

constexpr std::array<const char*, threshold_count> threshold_names = {
    "Lloc 5",    "Lloc 4.998",     "Lloc .005",       "Lloc .00203",       "Lloc .001", "L = M",
    "L = M = S", "Y = largest/64", "q + kappa r = 0", "face of the gamut", "2^120"};

// In cd/m2, of the first five.
const std::array<double, 5> local_luminances = {photopic_limit, mesopic_photopic_limit(), 0.005,
                                                mesopic_scotopic_limit(), 0.001};

// A wide gamut, sums of primaries equal to white's: AP0-like, with imaginary primaries.
constexpr Matrix3<double> ap0_like =
    xyz_from_rgb({0.7347, 0.0, 0.0001}, {0.2653, 1.0, -0.077}, 0.3127, 0.3290);
const std::array<Matrix3<double>, 4> spaces = {rec709, rec2020, ap0_like, identity3<double>()};

// Of 0: up to four of the smallest subnormals on either side, the nearest to a face that a float comes.
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

// The colour between two at which f changes its sign, far below a float's ulp; nothing if both have the same.
template <typename F>
std::optional<Rgb> crossing(Rgb below, Rgb above, F f) {
  if (f(below) >= 0) std::swap(below, above);
  if (!(f(below) < 0 && f(above) >= 0)) return std::nullopt;
  for (int i = 0; i < 40; ++i) {
    Rgb middle;
    for (std::size_t k = 0; k < 3; ++k) middle[k] = (below[k] + above[k]) / 2;
    (f(middle) < 0 ? below : above) = middle;
  }
  return above;
}

// A sum, and the sum of its |terms|.
struct Sum {
  double value = 0, terms = 0;
  void add(double x) { value += x, terms += std::abs(x); }
  bool is_0() const { return std::abs(value) <= 0x1p-20 * terms; }
};

Sum sum_of(const Vec3<double>& row, const Vec3<double>& v) {
  Sum out;
  for (std::size_t i = 0; i < 3; ++i) out.add(row[i] * v[i]);
  return out;
}

Vec3<double> cones_of(const OperatorConstants& c, const ReferencePixel& pixel) {
  return pixel.cones ? *pixel.cones : c.lms_from_rgb * pixel.rgb;
}

double rod_of(const OperatorConstants& c, const ReferencePixel& pixel) {
  return std::max(0.0, pixel.rod ? *pixel.rod : rod_signal_from_rgb(c, pixel.rgb));
}

// Components of the gamut after the shift, before the projection, by the product in double: to aim, not to
// judge.
std::array<Sum, 3> shifted(const OperatorConstants& c, const ReferencePixel& pixel) {
  const auto& p = c.parameters;
  const Vec3<double> q = cones_of(c, pixel);
  const double unit = p.white_luminance;
  const double w = c.shift * (1 - mesopic_coefficient(local_luminance(c, pixel.rgb))) / unit;
  const Vec3<double> rgb =
      c.rgb_from_lms * c.kernel.shift({unit * q[0], unit * q[1], unit * q[2]}, unit * rod_of(c, pixel));
  std::array<Sum, 3> out;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (const double x : {pixel.rgb[j], w * rgb[j]}) out[i].add(c.gamut_from_rgb[i][j] * x);
  return out;
}

// Of two colours dark enough to be shifted, a mixture whose shifted colour lies on a face.
std::optional<Rgb> on_a_face(const OperatorConstants& c, Random& random) {
  const auto& p = c.parameters;
  const double room = photopic_limit - p.adaptation;
  if (!(c.project && c.shift > 0 && room > 0) || p.model == Model::safko2019) return std::nullopt;
  for (int attempt = 0; attempt < 8; ++attempt) {
    const double high = room / p.white_luminance;
    const Rgb a = positive(random, 1e-7 * high, high);
    Rgb b = a;
    b[static_cast<std::size_t>(random.below(3))] *= random.uniform(0, 0.1);
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto found = crossing(a, b, [&](const Rgb& rgb) {
            return shifted(c, {rgb, {}, {}})[k].value;
          }))
        return found;
  }
  return std::nullopt;
}

double floor_margin(const OperatorConstants& c, const Vec3<double>& rgb) {
  double largest = 0;
  const Vec3<double> q = c.lms_from_rgb * rgb;
  for (std::size_t i = 0; i < 3; ++i) largest = std::max(largest, std::abs(q[i]) / c.cone_white[i]);
  return std::abs(dot(c.luminance_from_rgb, rgb)) - luminance_floor * largest;
}

// One of the local luminances from `first` to `last` that lie above La, if any does.
double reachable(std::size_t first, std::size_t last, const OperatorConstants& c, Random& random) {
  while (first < last && local_luminances[last] <= c.parameters.adaptation) --last;
  return local_luminances[first + static_cast<std::size_t>(random.below(static_cast<int>(last - first + 1)))];
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
    case Regime::subnormal:
      return signed_values(1.5e-45, 1.1e-38);
    case Regime::tiny:
      return signed_values(1e-38, 1e-20);
    case Regime::huge:
      if (random.chance(0.2)) return signed_values(1e36, 3.4e38);
      rgb = signed_values(1e20, operable_limit);
      if (random.chance(0.4)) rgb[any] = random.sign() * operable_limit;
      return rgb;
    case Regime::half_extremes: {
      constexpr std::array<double, 6> ends = {65504,          -65504, 5.9604644775390625e-8,
                                              6.103515625e-5, 0,      6.1e-5};
      for (auto& x : rgb) x = ends[static_cast<std::size_t>(random.below(6))];
      return rgb;
    }
    case Regime::grey:
      return {rgb[0], rgb[0], rgb[0]};
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
    case Regime::negative:
      return signed_values(1e-6 / unit, 1e2 / unit);
    case Regime::out_of_gamut:
      rgb[any] *= -random.log_uniform(1e-6, 10);
      return rgb;
    case Regime::threshold_photopic:
      return at_local_luminance(rgb, reachable(0, 1, c, random), c);
    case Regime::threshold_scotopic:
      return at_local_luminance(rgb, reachable(2, 4, c, random), c);
    case Regime::threshold_floor: {
      const double share = random.sign() * (std::abs(rgb[0]) + std::abs(rgb[1]) + std::abs(rgb[2])) / 64;
      if (random.chance(0.5)) return solved_for(c.luminance_from_rgb, rgb, random.log_uniform(.2, 5) * share);
      const auto found = crossing(solved_for(c.luminance_from_rgb, rgb, 0),
                                  solved_for(c.luminance_from_rgb, rgb, 64 * share),
                                  [&](const Rgb& x) { return floor_margin(c, x); });
      return found.value_or(rgb);
    }
    case Regime::luminance_zero: {
      rgb[any] = -rgb[any];
      const double rest = (photopic_limit * random.uniform(0.99, 1.01) - c.parameters.adaptation) / unit;
      if (rest > 0 && random.chance(0.3)) {  // of large numbers, about as much as decides whether rods see
        const double scale = rest * random.log_uniform(1e2, 1e7) / std::abs(rgb[any]);
        for (auto& x : rgb) x *= scale;
        return solved_for(c.luminance_from_rgb, rgb, rest);
      }
      const double largest = std::abs(rgb[0]) + std::abs(rgb[1]) + std::abs(rgb[2]);
      return solved_for(c.luminance_from_rgb, rgb,
                        random.chance(0.3) ? 0 : largest * random.log_uniform(1e-9, 1e-3));
    }
    case Regime::kernel_clamp: {
      const double kappa_rod = 0.15 * (rgb[0] + rgb[1] + rgb[2]) * random.uniform(0, 2);
      const Rgb negative = solved_for(c.lms_from_rgb[any], rgb, -kappa_rod);
      if (random.chance(0.5)) return negative;
      const auto found = crossing(negative, rgb, [&](const Rgb& x) {
        return dot(c.lms_from_rgb[any], Vec3<double>(x)) + c.kernel.kappa()[any] * rod_signal_from_rgb(c, x);
      });
      return found.value_or(negative);
    }
    case Regime::projection_face:
      if (random.chance(0.7))
        if (const auto found = on_a_face(c, random)) return *found;
      rgb[any] *= random.chance(0.3) ? 0.0 : 1e-3 * random.uniform(-1, 1);
      return rgb;
    case Regime::mixed_exponents:
      return signed_values(1e-30, 1e30);
    case Regime::equal_cones: {
      const double cone = random.log_uniform(low, high);
      return c.rgb_from_lms * Vec3<double>{cone, cone, cone};
    }
    case Regime::ordinary:
    case Regime::count:
      break;
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

double Random::log_uniform(double from, double to) {
  return from * std::exp2(uniform(0, std::log2(to / from)));
}

const char* name(Regime regime) { return names[static_cast<std::size_t>(regime)]; }

double local_luminance(const OperatorConstants& c, const Vec3<double>& rgb) {
  const auto& p = c.parameters;
  const double y = p.weight == Weight::global ? 0 : dot(c.luminance_from_rgb, rgb);
  return p.adaptation + std::max(0.0, p.white_luminance * y);
}

const char* name(Threshold threshold) { return threshold_names[static_cast<std::size_t>(threshold)]; }

bool is_at(Threshold threshold, const OperatorConstants& c, const Sample& sample, Planes planes) {
  const ReferencePixel pixel = sample.widened(planes);
  const Vec3<double> q = cones_of(c, pixel);
  const auto near = [](double x, double y) { return std::abs(x - y) <= 0x1p-20 * std::abs(y); };
  switch (threshold) {
    case Threshold::opponent:
    case Threshold::equal_cones:
      return near(q[0], q[1]) && (threshold == Threshold::opponent || near(q[2], q[1]));
    case Threshold::floor:
      return std::abs(floor_margin(c, pixel.rgb)) <= 0x1p-20 * sum_of(c.luminance_from_rgb, pixel.rgb).terms;
    case Threshold::clamp: {
      const double rod = rod_of(c, pixel);
      for (std::size_t i = 0; i < 3; ++i) {
        Sum sum = pixel.cones ? Sum{q[i], std::abs(q[i])} : sum_of(c.lms_from_rgb[i], pixel.rgb);
        sum.add(c.kernel.kappa()[i] * rod);
        if (rod > 0 && sum.is_0()) return true;
      }
      return false;
    }
    case Threshold::face: {
      if (!c.project || !(c.shift > 0) || c.parameters.model == Model::safko2019) return false;
      if (!(local_luminance(c, pixel.rgb) < mesopic_photopic_limit())) return false;
      const auto sums = shifted(c, pixel);
      return std::any_of(sums.begin(), sums.end(),
                         [](const Sum& sum) { return sum.terms > 0 && sum.is_0(); });
    }
    case Threshold::operable:
      return std::any_of(pixel.rgb.begin(), pixel.rgb.end(),
                         [&](double x) { return near(std::abs(x), operable_limit); });
    default:
      return near(local_luminance(c, pixel.rgb), local_luminances[static_cast<std::size_t>(threshold)]);
  }
}

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
  p.model = random.chance(0.5)   ? Model::filament2021
            : random.chance(0.8) ? Model::kirk2011
                                 : Model::safko2019;
  p.adaptation = random.log_uniform(1e-6, 6);
  const double threshold = local_luminances[static_cast<std::size_t>(random.below(5))];
  if (random.chance(0.1)) p.adaptation = few_ulp(static_cast<float>(threshold), random);
  p.white_luminance = random.chance(0.5) ? p.adaptation / 0.18 : random.log_uniform(1e-4, 1e4);
  p.weight = random.chance(0.8) ? Weight::local : Weight::global;
  p.luminance = random.chance(0.7)   ? LuminancePolicy::mesopic
                : random.chance(0.5) ? LuminancePolicy::photopic
                                     : LuminancePolicy::none;
  const auto strength = [&] {
    return random.chance(0.6) ? 1.0 : random.chance(0.2) ? 0.0 : random.uniform(0, 1);
  };
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
  constexpr std::array edges = {
      Regime::threshold_photopic, Regime::threshold_scotopic, Regime::threshold_floor,
      Regime::luminance_zero,     Regime::projection_face,    Regime::opponent_zero,
      Regime::equal_cones,        Regime::kernel_clamp,       Regime::huge};
  const bool edge = std::find(edges.begin(), edges.end(), regime) != edges.end();
  if (edge && random.chance(0.8))
    for (auto& x : out.rgb) x = few_ulp(x, random);
  // Receptors of a spectrum agree with RGB but roughly: metamers differ. Where an edge is to be met, they
  // agree.
  const Vec3<double> q = c.lms_from_rgb * Vec3<double>(rgb);
  constexpr double largest = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < 3; ++i) {
    const double metamer = edge || random.chance(0.5) ? 1 : random.uniform(0.8, 1.2);
    out.cones[i] = static_cast<float>(std::clamp(q[i] * metamer, -largest, largest));
  }
  if (regime == Regime::opponent_zero && random.chance(0.7)) out.cones[1] = few_ulp(out.cones[0], random);
  if (regime == Regime::equal_cones && random.chance(0.7))
    out.cones = {out.cones[0], few_ulp(out.cones[0], random), few_ulp(out.cones[0], random)};
  double rod = 0.5 * (q[0] + q[1]) * random.uniform(0, 2);
  if (regime == Regime::pure_rods) rod = random.log_uniform(1e-6, 1e2) / c.parameters.white_luminance;
  if (regime == Regime::zero && random.chance(0.5)) rod = random.sign() * 0.0;
  if (regime == Regime::projection_face) rod = rod_signal_from_rgb(c, rgb);
  if (regime == Regime::kernel_clamp) {
    std::size_t cone = 0;  // the most negative
    for (std::size_t i = 1; i < 3; ++i)
      if (q[i] < q[cone]) cone = i;
    const double balance = -q[cone] / c.kernel.kappa()[cone];
    rod = random.chance(0.5) ? static_cast<double>(few_ulp(static_cast<float>(balance), random))
                             : balance * (1 + random.uniform(-1e-6, 1e-6));
  }
  rod = std::clamp(rod, -largest, largest);
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
  for (const double x :
       {static_cast<double>(p.model), p.adaptation, p.white_luminance, static_cast<double>(p.weight),
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
