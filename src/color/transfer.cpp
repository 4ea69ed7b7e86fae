#include "color/transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scotopic {
namespace {

double srgb_decode(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
double srgb_encode(double v) {
  return v <= 0.04045 / 12.92 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

double power_decode(double v, double g) { return v > 0 ? std::pow(v, g) : v; }

// SMPTE ST 2084:2014, 5.1 and 5.2.
constexpr double pq_m1 = 2610.0 / 16384, pq_m2 = 2523.0 / 4096 * 128;
constexpr double pq_c1 = 3424.0 / 4096, pq_c2 = 2413.0 / 4096 * 32, pq_c3 = 2392.0 / 4096 * 32;
constexpr double pq_peak = 10000.0;  // cd/m2

double pq_decode(double v) {
  const double p = std::pow(std::clamp(v, 0.0, 1.0), 1 / pq_m2);
  return pq_peak * std::pow(std::max(p - pq_c1, 0.0) / (pq_c2 - pq_c3 * p), 1 / pq_m1);
}

double pq_encode(double light) {
  const double p = std::pow(std::clamp(light / pq_peak, 0.0, 1.0), pq_m1);
  return std::pow((pq_c1 + pq_c2 * p) / (1 + pq_c3 * p), pq_m2);
}

// ITU-R BT.2100-2, table 5.
constexpr double hlg_a = 0.17883277, hlg_b = 1 - 4 * hlg_a;
const double hlg_c = 0.5 - hlg_a * std::log(4 * hlg_a);
constexpr double hlg_peak = 1000.0;  // cd/m2
constexpr double hlg_gamma = 1.2;
constexpr Vec3<double> luma_2020{0.2627, 0.6780, 0.0593};

double hlg_scene(double v) {
  const double e = std::clamp(v, 0.0, 1.0);
  return e <= 0.5 ? e * e / 3 : (std::exp((e - hlg_c) / hlg_a) + hlg_b) / 12;
}

double hlg_signal(double scene) {
  const double e = std::clamp(scene, 0.0, 1.0);
  return e <= 1.0 / 12 ? std::sqrt(3 * e) : hlg_a * std::log(12 * e - hlg_b) + hlg_c;
}

double luma(const Vec3<double>& v) { return luma_2020[0] * v[0] + luma_2020[1] * v[1] + luma_2020[2] * v[2]; }

template <typename Function>
Vec3<double> each(const Vec3<double>& v, Function f) {
  return {f(v[0]), f(v[1]), f(v[2])};
}

Vec3<double> hlg_decode(const Vec3<double>& v) {
  const Vec3<double> scene = each(v, hlg_scene);
  const double gain = hlg_peak * std::pow(std::max(luma(scene), 0.0), hlg_gamma - 1);
  return each(scene, [&](double e) { return gain * e; });
}

Vec3<double> hlg_encode(const Vec3<double>& light) {
  const Vec3<double> display = each(light, [](double v) { return std::max(v, 0.0) / hlg_peak; });
  const double y = luma(display);
  const double gain = y > 0 ? std::pow(y, 1 / hlg_gamma - 1) : 0;
  return each(display, [&](double e) { return hlg_signal(gain * e); });
}

// SMPTE ST 428-1: code 1 is 52.37 cd/m2, white 48.
constexpr double dcdm_headroom = 52.37 / 48;

}  // namespace

Vec3<double> TransferCurve::decode(const Vec3<double>& encoded) const {
  const Vec3<double> v = each(encoded, [&](double e) { return e * scale + offset; });
  switch (kind) {
    case Transfer::linear:
      return v;
    case Transfer::srgb:
      return each(v, srgb_decode);
    case Transfer::power:
      return each(v, [&](double e) { return power_decode(e, exponent); });
    case Transfer::pq:
      return each(v, [](double e) { return pq_decode(e) / hdr_reference_white; });
    case Transfer::hlg:
      return each(hlg_decode(v), [](double e) { return e / hdr_reference_white; });
    case Transfer::dcdm:
      return each(v, [](double e) { return dcdm_headroom * power_decode(e, 2.6); });
  }
  return v;
}

Vec3<double> TransferCurve::encode(const Vec3<double>& light) const {
  const auto out = [&]() -> Vec3<double> {
    switch (kind) {
      case Transfer::linear:
        return light;
      case Transfer::srgb:
        return each(light, srgb_encode);
      case Transfer::power:
        return each(light, [&](double e) { return power_decode(e, 1 / exponent); });
      case Transfer::pq:
        return each(light, [](double e) { return pq_encode(e * hdr_reference_white); });
      case Transfer::hlg:
        return hlg_encode(each(light, [](double e) { return e * hdr_reference_white; }));
      case Transfer::dcdm:
        return each(light, [](double e) { return power_decode(e / dcdm_headroom, 1 / 2.6); });
    }
    return light;
  }();
  return each(out, [&](double e) { return (e - offset) / scale; });
}

std::string describe(const TransferCurve& curve) {
  const auto name = [&]() -> std::string {
    switch (curve.kind) {
      case Transfer::linear:
        return "linear";
      case Transfer::srgb:
        return "sRGB curve";
      case Transfer::power:
        return fmt::format("gamma {:.4g}", curve.exponent);
      case Transfer::pq:
        return "PQ";
      case Transfer::hlg:
        return "HLG";
      case Transfer::dcdm:
        return "gamma 2.6 of the DCDM";
    }
    return "";
  };
  return name() + (curve.scale != 1 ? ", narrow range" : "");
}

}  // namespace scotopic
