// ITU-T H.273 (07/2024), tables 2 and 3: primaries and transfer characteristics that still images use.
#include <fmt/format.h>

#include <map>

#include "base/error.h"
#include "color/file/file_colour.h"

namespace scotopic {
namespace {

constexpr Xy white_c{0.310, 0.316};
constexpr Primaries smpte_170m{{0.630, 0.340}, {0.310, 0.595}, {0.155, 0.070}, white_d65};

const std::map<int, Primaries>& primaries_by_code() {
  static const std::map<int, Primaries> known = {
      {1, {{0.640, 0.330}, {0.300, 0.600}, {0.150, 0.060}, white_d65}},
      {4, {{0.67, 0.33}, {0.21, 0.71}, {0.14, 0.08}, white_c}},
      {5, {{0.64, 0.33}, {0.29, 0.60}, {0.15, 0.06}, white_d65}},
      {6, smpte_170m},
      {7, smpte_170m},
      {8, {{0.681, 0.319}, {0.243, 0.692}, {0.145, 0.049}, white_c}},
      {9, {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, white_d65}},
      {11, {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.314, 0.351}}},
      {12, {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, white_d65}},
      {22, {{0.630, 0.340}, {0.295, 0.605}, {0.155, 0.077}, white_d65}},
  };
  return known;
}

const std::map<int, TransferCurve>& curves_by_code() {
  // Of 1, 6, 14 and 15 the table has the camera's side; what a display makes of them is BT.1886.
  static const TransferCurve bt1886{Transfer::power, 2.4};
  static const std::map<int, TransferCurve> known = {
      {1, bt1886},
      {4, {Transfer::power, 2.2}},
      {5, {Transfer::power, 2.8}},
      {6, bt1886},
      {8, {}},
      {13, {Transfer::srgb}},
      {14, bt1886},
      {15, bt1886},
      {16, {Transfer::pq}},
      {17, {Transfer::dcdm}},
      {18, {Transfer::hlg}},
  };
  return known;
}

}  // namespace

RgbEncoding encoding_of(const CodePoints& points, int bits, const std::string& file) {
  const auto fail = [&](const std::string& what) {
    throw Error(ExitCode::input, file, what + "; --colorspace says what its colours are");
  };
  RgbEncoding out;
  const auto primaries = primaries_by_code().find(points.primaries);
  const auto curve = curves_by_code().find(points.transfer);
  if (points.matrix != 0) fail(fmt::format("cICP matrix {} is not RGB", points.matrix));
  if (primaries == primaries_by_code().end() && points.primaries != 10)
    fail(fmt::format("cICP colour primaries {} are not read here", points.primaries));
  if (curve == curves_by_code().end())
    fail(fmt::format("cICP transfer function {} is not read here", points.transfer));
  if (points.primaries != 10) out.xyz_from_rgb = xyz_d65_from_rgb(primaries->second);
  out.curve = curve->second;
  if (!points.full_range) {
    // ITU-R BT.2100-2, table 9: black 16, white 235, times 2^(bits - 8).
    const double full = bits == 16 ? 65535.0 / 256 : 255.0;
    out.curve.scale = full / 219;
    out.curve.offset = -16.0 / 219;
  }
  return out;
}

}  // namespace scotopic
