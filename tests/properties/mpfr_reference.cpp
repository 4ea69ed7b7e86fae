#include "properties/mpfr_reference.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "receptors/tables.h"

namespace scotopic::test {
namespace {

using std::abs, std::atan, std::log, std::log10, std::pow, std::sqrt;

template <typename Real>
Real dec(const char* text) {
  return decimal<Real>(text);
}

template <typename Real>
Real clamp01(const Real& x) {
  return x < Real(0) ? Real(0) : x > Real(1) ? Real(1) : x;
}

template <typename Real>
Real at_least_0(const Real& x) {
  return x > Real(0) ? x : Real(0);
}

template <typename Real>
Triple<Real> widened(const Vec3<double>& v) {
  return {Real(v[0]), Real(v[1]), Real(v[2])};
}

const std::array<const TabulatedCurve*, 3> cone_curves = {&tables::cones_stockman_sharpe_2000_2deg_l,
                                                          &tables::cones_stockman_sharpe_2000_2deg_m,
                                                          &tables::cones_stockman_sharpe_2000_2deg_s};
const std::array<const TabulatedCurve*, 3> matching_curves = {
    &tables::xyz_cie_1931_2deg_x, &tables::xyz_cie_1931_2deg_y, &tables::xyz_cie_1931_2deg_z};

// Sum of products of two sets of curves over whole nanometres.
template <typename Real, std::size_t N>
Square<Real> curve_products(const std::array<const TabulatedCurve*, N>& rows,
                            const std::array<const TabulatedCurve*, 3>& columns, int first, int last) {
  Square<Real> out;
  for (int nm = first; nm <= last; ++nm)
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        out[i][j] = out[i][j] + Real(rows[i]->at(nm)) * Real(columns[j]->at(nm));
  return out;
}

// k: D65 of 1 cd/m2 has L + M = 1.
template <typename Real>
Real luminance_units_per_watt() {
  const std::array<const TabulatedCurve*, 1> d65 = {&tables::illuminant_cie_d65_d65};
  const auto cones = curve_products<Real>(d65, cone_curves, 380, 780);
  const auto xyz = curve_products<Real>(d65, matching_curves, 380, 780);
  return dec<Real>("683.002") * xyz[0][1] / (cones[0][0] + cones[0][1]);
}

// Least squares: matching ~ F cones, by the normal equations.
template <typename Real>
Square<Real> matching_from_cones() {
  return curve_products<Real>(matching_curves, cone_curves, 390, 830) *
         inverted(curve_products<Real>(cone_curves, cone_curves, 390, 830));
}

template <typename Real>
Square<Real> inverse_of_opponent_transform() {
  // A = [[-1,1,0],[-1,-1,1],[1,1,0]]: dL = (lum - rg)/2, dM = (lum + rg)/2, dS = by + lum.
  const Real half = Real(1) / Real(2);
  return {{{{-half, Real(0), half}, {half, Real(0), half}, {Real(0), Real(1), Real(1)}}}};
}

// Kirk & O'Brien 2011: rows (red-green, blue-yellow, luminance), columns gL, gM, gS.
template <typename Real>
Square<Real> kirk_rows() {
  const auto d = dec<Real>;
  const Real x = d("15"), y = d("15"), z = d("5"), k1 = d("0.25");
  const Real rho1 = d("1.111"), rho2 = d("0.939"), rho3 = d("0.400"), rho4 = d("0.150"), alpha = d("0.619");
  const Real l = d("0.637"), m = d("0.392"), s = d("1.606"), beta = Real(1) - alpha;
  return {{{{-(x * k1 * rho2 / l), x * k1 * rho1 / m, Real(0)},
            {-(y * rho4 * alpha / l), -(y * rho4 * beta / m), y * rho3 / s},
            {z * alpha / l, z * beta / m, Real(0)}}}};
}

// Filament's Cao-consistent variant.
template <typename Real>
Square<Real> filament_rows() {
  const auto d = dec<Real>;
  const Real big_k = d("45"), big_s = d("10"), k3 = d("0.6"), rw = d("0.139"), p = d("0.6189");
  const Real one = Real(1);
  const Square<Real> pathways{{{{-(k3 + rw), one + k3 * rw, Real(0)},
                                {p * k3, (one - p) * k3, one},
                                {p * big_s, (one - p) * big_s, Real(0)}}}};
  const Triple<Real> inputs = {d("0.2") / d("0.63721"), d("0.2") / d("0.39242"), d("0.3") / d("1.6064")};
  return (big_k / big_s) * (pathways * diagonal_of(inputs));
}

template <typename Real>
Square<Real> cat02() {
  const auto d = dec<Real>;
  return {{{{d("0.7328"), d("0.4296"), d("-0.1624")},
            {d("-0.7036"), d("1.6975"), d("0.0061")},
            {d("0.0030"), d("0.0136"), d("0.9834")}}}};
}

// Scotopic luminance from D65-adapted XYZ under an illuminant of the given S/P ratio.
template <typename Real>
Real scotopic_luminance(const Triple<Real>& xyz, RodEstimate estimate, const Real& sp) {
  const auto d = dec<Real>;
  Real under_d65(0);
  if (estimate == RodEstimate::linear) {
    under_d65 = d("-1.24550652") * xyz[0] + d("2.40735814") * xyz[1] + d("1.13998671") * xyz[2];
  } else {
    const Real cx = at_least_0(xyz[0]), cy = at_least_0(xyz[1]), sum = cx + cy + at_least_0(xyz[2]);
    if (sum > Real(0)) {
      const Real x = cx / sum, y = cy / sum;
      under_d65 = sum * (d("0.92170706") - d("3.50414354") * x + d("3.71453552") * y +
                         d("3.20585581") * x * x - d("4.58382815") * x * y - d("0.72925479") * y * y);
    }
  }
  const Real scotopic = under_d65 * sp / d("2.4648"), floor = d("0.016") * xyz[1];
  return scotopic > floor ? scotopic : floor;
}

// Between .1027, .6228 and 10.0459 cd/m2, held beyond: the two-point form of each line.
template <typename Real>
Real between_levels(const Real& level, const char* darkest, const char* middle) {
  const auto d = dec<Real>;
  const Real a = d(".1027"), b = d(".6228"), c = d("10.0459");
  if (level <= a) return d(darkest);
  if (level >= c) return Real(0);
  if (level <= b) return (d(darkest) * (b - level) + d(middle) * (level - a)) / (b - a);
  return d(middle) * (c - level) / (c - b);
}

// Cao et al. 2008 as Wanat & Mantiuk 2014 have it.
template <typename Real>
Triple<Real> cao_input(const Real& level) {
  const Real lm = between_levels(level, ".172619", ".0172619");
  return {lm, lm, between_levels(level, ".714286", ".0202381")};
}

bool operable(const ReferencePixel& pixel) {
  const auto fine = [](double x) { return std::abs(x) <= 0x1p120; };  // false for NaN
  for (std::size_t i = 0; i < 3; ++i)
    if (!fine(pixel.rgb[i]) || (pixel.cones && !fine((*pixel.cones)[i]))) return false;
  return !pixel.rod || fine(*pixel.rod);
}

template <typename Real>
Real kernel_scale(const AppearanceParameters& p) {
  switch (p.model) {
    case Model::safko2019:
      return Real(p.safko_scale);
    case Model::filament2021:
      return dec<Real>("19885.9");  // 380 * 52.3313, its spot-meter anchor
    case Model::kirk2011:
    case Model::cao2008:
      break;
  }
  const Real d = exact_pupil_diameter(Real(p.adaptation));
  return atan(Real(1)) * d * d;  // pi/4 D^2
}

// Factor of the luminance stage, as the contract of luminance_ratio() has it.
template <typename Real>
Real regularised_ratio(const Real& from, const Real& to, const Real& largest) {
  if (!(largest > Real(0))) return Real(1);
  const Real least = largest / Real(64), size = abs(from);
  const Real f = size > least ? size : least, u = from / f, cap = dec<Real>("1e18");
  const Real ratio = at_least_0(Real(u * to / f + (Real(1) - u * u)));
  return ratio < cap ? ratio : cap;
}

}  // namespace

template <>
long double decimal<long double>(const char* text) {
  return std::strtold(text, nullptr);
}

template <typename Real>
Real exact_pupil_diameter(const Real& adaptation) {
  const auto d = dec<Real>;
  if (!(adaptation > Real(0))) return d("7.75");
  const Real t = pow(Real(adaptation * d("2827.43") / d("846")), d("0.41"));
  return d("7.75") - d("5.75") * t / (t + Real(2));  // at age 28.58 the age term is 0
}

template <typename Real>
Real exact_mesopic_coefficient(const Real& photopic, const Real& sp) {
  const auto d = dec<Real>;
  if (!(photopic > Real(0))) return Real(0);
  const Real offset = d("0.767"), slope = d("0.3334"), c = d("683") / d("1699"), one(1);
  if (offset + slope * log10(photopic) >= one) return one;
  if (offset + slope * log10(Real(sp * photopic)) <= Real(0)) return Real(0);
  // The iteration as CIE 191 writes it brings m near; Newton's method on its explicit inverse ends it.
  Real m = one / Real(2);
  for (int i = 0; i < 6; ++i) {
    const Real mes = (m * photopic + (one - m) * sp * photopic * c) / (m + (one - m) * c);
    m = clamp01(Real(offset + slope * log10(mes)));
  }
  const Real per_m = log(Real(10)) / slope, target = log(photopic);
  for (int i = 0; i < 10; ++i) {
    const Real a = m + (one - m) * c, b = m + (one - m) * sp * c;
    const Real f = (m - offset) * per_m + log(a) - log(b) - target;
    const Real next = clamp01(Real(m - f / (per_m + (one - c) / a - (one - sp * c) / b)));
    const Real step = abs(Real(next - m));
    m = next;
    if (step < d("1e-18")) break;  // converges quadratically: the next step would be 1e-36 (long double: 0)
  }
  const Real a = m + (one - m) * c, b = m + (one - m) * sp * c;
  const Real f = (m - offset) * per_m + log(a) - log(b) - target;
  return clamp01(Real(m - f / (per_m + (one - c) / a - (one - sp * c) / b)));
}

template <typename Real>
Real exact_chroma_factor(const Real& luminance) {
  const Real half = dec<Real>("0.108"), s = luminance / (luminance + half) * ((Real(5) + half) / Real(5));
  return s < Real(1) ? s : Real(1);
}

template <typename Real>
ExactSetting<Real>::ExactSetting(const AppearanceParameters& p) : parameters(p) {
  const auto d = dec<Real>;
  static const Real k = luminance_units_per_watt<Real>();
  static const Square<Real> fit = matching_from_cones<Real>();
  units_per_watt = k;
  const auto wide = [](const Matrix3<double>& m) {
    return Square<Real>{{{widened<Real>(m[0]), widened<Real>(m[1]), widened<Real>(m[2])}}};
  };
  const Square<Real> xyz_from_lms = Real(d("683.002") / k) * fit, lms_from_xyz = inverted(xyz_from_lms);
  xyz_from_rgb = wide(p.xyz_from_rgb);
  const Square<Real> rgb_from_xyz = inverted(xyz_from_rgb);
  lms_from_rgb = lms_from_xyz * xyz_from_rgb;
  rgb_from_lms = rgb_from_xyz * xyz_from_lms;
  rgb_from_lms_safko = rgb_from_xyz * (Real(d("683.002") / k) * inverted(cat02<Real>()));
  const Square<Real> xyz_from_gamut = wide(p.xyz_from_gamut.value_or(p.xyz_from_rgb));
  gamut_from_rgb = inverted(xyz_from_gamut) * xyz_from_rgb;
  rgb_from_gamut = rgb_from_xyz * xyz_from_gamut;
  lms_from_gamut = lms_from_xyz * xyz_from_gamut;
  const bool filament = p.model == Model::filament2021;
  kappa =
      filament ? Triple<Real>{d("0.2"), d("0.2"), d("0.3")} : Triple<Real>{d("0.25"), d("0.25"), d("0.4")};
  const Real g = d("0.33");
  gain = filament ? Triple<Real>{g / d("0.63721"), g / d("0.39242"), g / d("1.6064")} : Triple<Real>{g, g, g};
  cone_shift = inverse_of_opponent_transform<Real>() * (filament ? filament_rows<Real>() : kirk_rows<Real>());
  scale = kernel_scale<Real>(p);
  cone_white = lms_from_rgb * Triple<Real>{Real(1), Real(1), Real(1)};
  // Image white, taken for D65: a grey of the image keeps its luminance to the last digit.
  const Triple<Real> white = xyz_from_rgb * Triple<Real>{Real(1), Real(1), Real(1)};
  rod_white = k / d("1700.06") * scotopic_luminance(white, p.rods, d("2.4648"));
}

template <typename Real>
Triple<Real> ExactOperator<Real>::damped_rods(const Triple<Real>& q, const Real& r,
                                              const Triple<Real>& kappa) const {
  const Real rods = s_.scale * at_least_0(r);
  Triple<Real> signal;
  for (std::size_t i = 0; i < 3; ++i)
    signal[i] =
        rods / sqrt(Real(Real(1) + at_least_0(Real(s_.gain[i] * (s_.scale * q[i] + kappa[i] * rods)))));
  return times(Real(Real(1) / s_.scale), signal);
}

template <typename Real>
Triple<Real> ExactOperator<Real>::rods_at(const Triple<Real>& q, const Real& r, const Real& local) const {
  if (s_.parameters.model != Model::cao2008) return damped_rods(q, r, s_.kappa);
  const Triple<Real> kappa = cao_input(local);
  Triple<Real> out = damped_rods(q, r, kappa);
  for (std::size_t i = 0; i < 3; ++i) out[i] = out[i] * kappa[i] / s_.kappa[i];
  return out;
}

template <typename Real>
Triple<Real> ExactOperator<Real>::shift(const Triple<Real>& q, const Real& r) const {
  return s_.cone_shift * damped_rods(q, r, s_.kappa);
}

template <typename Real>
Triple<Real> ExactOperator<Real>::nearest(const Triple<Real>& p, const Triple<Real>& bound) const {
  const Triple<Real> z = minus(p, bound);
  if (z[0] >= Real(0) && z[1] >= Real(0) && z[2] >= Real(0)) return p;
  const Square<Real> gram = transposed(s_.lms_from_gamut) * s_.lms_from_gamut;
  Triple<Real> best{Real(0), Real(0), Real(0)};
  Real least = inner(z, gram * z);  // all three at their bound
  for (unsigned set = 1; set < 7; ++set) {
    // Bit i: component i sits at its bound; the free ones solve gram_FF (x - z)_F = gram_FA z_A.
    Square<Real> free = diagonal_of(Triple<Real>{Real(1), Real(1), Real(1)});
    Triple<Real> right{Real(0), Real(0), Real(0)};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        if (set >> i & 1u) continue;
        free[i][j] = (set >> j & 1u) ? Real(0) : gram[i][j];
        right[i] = right[i] + gram[i][j] * z[j];
      }
    const Triple<Real> x = solution(free, right);
    if (x[0] < Real(0) || x[1] < Real(0) || x[2] < Real(0)) continue;
    const Triple<Real> gap = minus(x, z);
    const Real distance = inner(gap, gram * gap);
    if (distance < least) least = distance, best = x;
  }
  return plus(best, bound);
}

template <typename Real>
Real ExactOperator<Real>::rod_signal(const Triple<Real>& rgb) const {
  const Real scotopic =
      scotopic_luminance(s_.xyz_from_rgb * rgb, s_.parameters.rods, Real(s_.parameters.sp_ratio));
  return at_least_0(Real(s_.units_per_watt / dec<Real>("1700.06") * scotopic));
}

template <typename Real>
Real ExactOperator<Real>::policy_luminance(const Real& y, const Real& rod, const Real& m) const {
  if (s_.parameters.luminance == LuminancePolicy::photopic) return y;
  const Real one(1), relative = rod / s_.rod_white;
  const Real c = (one - m) * dec<Real>("683") / dec<Real>("1699") * dec<Real>("2.4648");
  return (m * y + c * relative) / (m + c);
}

template <typename Real>
Summed<Real> ExactOperator<Real>::safko(const Summed<Real>& q, const Real& r) const {
  const Real unit(s_.parameters.white_luminance), per_unit = Real(1) / unit;
  const Triple<Real> rods = times(per_unit, damped_rods(times(unit, q.value), Real(unit * r), s_.kappa));
  return {s_.rgb_from_lms_safko * plus(q.value, s_.cone_shift * rods),
          absolute(s_.rgb_from_lms_safko) * plus(q.terms, absolute(s_.cone_shift) * rods)};
}

template <typename Real>
Summed<Real> ExactOperator<Real>::with_terms(const ReferencePixel& pixel) const {
  const AppearanceParameters& p = s_.parameters;
  const Triple<Real> rgb = widened<Real>(pixel.rgb);
  Summed<Real> out{rgb, absolute(rgb)};
  if (!operable(pixel)) return out;
  Summed<Real> q{s_.lms_from_rgb * rgb, absolute(s_.lms_from_rgb) * out.terms};
  if (pixel.cones) q.value = widened<Real>(*pixel.cones), q.terms = absolute(q.value);
  const Real rod = pixel.rod ? Real(*pixel.rod) : rod_signal(rgb);
  if (p.model == Model::safko2019) return safko(q, rod);

  const Real unit(p.white_luminance), y = inner(s_.xyz_from_rgb[1], rgb), la(p.adaptation);
  const Real local = p.weight == Weight::global ? la : Real(la + unit * at_least_0(y));
  if (local >= Real(5)) return out;
  const Real m = exact_mesopic_coefficient(local, dec<Real>("2.4648"));
  if (!(p.strength.all > 0)) return out;
  const Real all(p.strength.all), full = Real(p.strength.shift), w = full * (Real(1) - m);
  const auto mixed = [&] {
    out.value = plus(rgb, times(all, minus(out.value, rgb)));
    out.terms = plus(absolute(rgb), times(all, plus(out.terms, absolute(rgb))));
    return out;
  };

  if (w > Real(0)) {
    const Triple<Real> rods =
        times(Real(Real(1) / unit), rods_at(times(unit, q.value), Real(unit * rod), local));
    out.value = plus(out.value, s_.rgb_from_lms * (s_.cone_shift * times(w, rods)));
    // Of w = 1 - m: 1, however little is left near 4.998 cd/m2.
    out.terms = plus(out.terms, absolute(s_.rgb_from_lms) * (absolute(s_.cone_shift) * times(full, rods)));
    if (p.xyz_from_gamut) {
      Triple<Real> bound = s_.gamut_from_rgb * rgb;
      for (auto& b : bound) b = b < Real(0) ? b : Real(0);
      const Triple<Real> shifted = s_.gamut_from_rgb * out.value, inside = nearest(shifted, bound);
      if (inside != shifted) {
        // Every component of the nearest colour is made of all that was shifted.
        Triple<Real> moved = absolute(s_.gamut_from_rgb) * out.terms;
        for (auto& x : moved) x = std::max({moved[0], moved[1], moved[2]});
        out.terms = plus(out.terms, absolute(s_.rgb_from_gamut) * moved);
      }
      out.value = plus(out.value, s_.rgb_from_gamut * minus(inside, shifted));
    }
  }
  if (p.luminance != LuminancePolicy::none && p.strength.luminance > 0) {
    const Real from = inner(s_.xyz_from_rgb[1], out.value);
    const Real goal = policy_luminance(y, at_least_0(rod), m);
    const Real to = from + Real(p.strength.luminance) * (goal - from);
    Real largest(0);
    for (const Triple<Real>& cones : {s_.lms_from_rgb * rgb, s_.lms_from_rgb * out.value})
      for (std::size_t i = 0; i < 3; ++i) {
        const Real relative = abs(Real(cones[i] / s_.cone_white[i]));
        if (relative > largest) largest = relative;
      }
    const Real ratio = regularised_ratio(from, to, largest), size = abs(from);
    out.value = times(ratio, out.value);
    out.terms = times(size * Real(64) < largest ? Real(ratio + Real(1)) : ratio, out.terms);
  }
  const Real faded = Real(p.strength.chroma) * (Real(1) - exact_chroma_factor(local));
  const Triple<Real>& weights = s_.xyz_from_rgb[1];
  const Real grey = inner(weights, out.value), grey_terms = inner(absolute(weights), out.terms);
  if (!(faded > Real(0))) return mixed();
  for (std::size_t i = 0; i < 3; ++i) {
    out.value[i] = grey + (Real(1) - faded) * (out.value[i] - grey);
    out.terms[i] = grey_terms + (Real(1) - faded) * out.terms[i];
  }
  return mixed();
}

template Mp exact_pupil_diameter(const Mp&);
template long double exact_pupil_diameter(const long double&);
template Mp exact_mesopic_coefficient(const Mp&, const Mp&);
template long double exact_mesopic_coefficient(const long double&, const long double&);
template Mp exact_chroma_factor(const Mp&);
template long double exact_chroma_factor(const long double&);
template struct ExactSetting<Mp>;
template struct ExactSetting<long double>;
template class ExactOperator<Mp>;
template class ExactOperator<long double>;

}  // namespace scotopic::test
