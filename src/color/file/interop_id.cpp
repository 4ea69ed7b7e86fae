#include "color/file/interop_id.h"

#include <array>
#include <utility>

namespace scotopic {
namespace {

struct Curve {
  std::string_view prefix;
  TransferCurve curve;
};

const std::array<Curve, 9> curves = {{{"lin", {}},
                                      {"srgb", {Transfer::srgb}},
                                      {"srgbe", {Transfer::srgb}},
                                      {"srgbx", {Transfer::srgb}},
                                      {"g18", {Transfer::power, 1.8}},
                                      {"g22", {Transfer::power, 2.2}},
                                      {"g24", {Transfer::power, 2.4}},
                                      {"g26", {Transfer::power, 2.6}},
                                      {"pq", {Transfer::pq}}}};

// All that are published; what an identifier is made of alone is none yet.
constexpr std::array<std::string_view, 31> published = {
    "lin_ap1_scene",        "lin_ap0_scene",      "lin_rec709_scene",    "lin_p3d65_scene",
    "lin_rec2020_scene",    "lin_adobergb_scene", "lin_ciexyzd65_scene", "srgb_rec709_scene",
    "g24_rec709_scene",     "g22_rec709_scene",   "g18_rec709_scene",    "srgb_ap1_scene",
    "g22_ap1_scene",        "srgb_p3d65_scene",   "g22_adobergb_scene",  "srgb_rec709_display",
    "g24_rec709_display",   "srgb_p3d65_display", "srgbe_p3d65_display", "srgbx_p3d65_display",
    "pq_p3d65_display",     "pq_rec2020_display", "hlg_rec2020_display", "g22_rec709_display",
    "g22_adobergb_display", "g26_p3d65_display",  "g26_xyzd65_display",  "pq_xyzd65_display",
    "lin_rec709_display",   "lin_p3d65_display",  "lin_rec2020_display"};

Matrix3<double> matrix_of(std::string_view gamut) {
  if (gamut == "adobergb") return xyz_d65_from_rgb(adobe_rgb_primaries);
  if (gamut == "p3d65") return gamut_xyz_matrix("p3").value();
  if (gamut == "ciexyzd65" || gamut == "xyzd65") return identity3<double>();
  return gamut_xyz_matrix(gamut).value();
}

TransferCurve curve_of(std::string_view id, std::string_view prefix) {
  if (id == "g26_xyzd65_display") return {Transfer::dcdm};
  if (id == "hlg_rec2020_display") return {Transfer::hlg};
  if (id == "g22_adobergb_scene" || id == "g22_adobergb_display") return {Transfer::power, adobe_rgb_gamma};
  for (const Curve& known : curves)
    if (known.prefix == prefix) return known.curve;
  return {};
}

}  // namespace

std::optional<RgbEncoding> interop_encoding(std::string_view id) {
  for (const std::string_view known : published) {
    if (known != id) continue;
    const std::size_t first = id.find('_'), last = id.rfind('_');
    return RgbEncoding{curve_of(id, id.substr(0, first)), matrix_of(id.substr(first + 1, last - first - 1))};
  }
  return std::nullopt;
}

std::string without_namespace(const std::string& id) {
  const std::size_t colon = id.find(':');
  return colon == std::string::npos ? "" : id.substr(colon + 1);
}

std::string camera_curve(std::string_view id) {
  // First words of the names that the OpenColorIO ACES configs give to such spaces.
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 21> names = {{
      {"acescct", "ACEScct"},     {"acescc", "ACEScc"},        {"adx10", "ADX10"},
      {"adx16", "ADX16"},         {"arrilogc3", "ARRI LogC3"}, {"arrilogc4", "ARRI LogC4"},
      {"logc", "ARRI LogC"},      {"bmdfilm", "BMDFilm"},      {"davinci", "DaVinci Intermediate"},
      {"canonlog", "Canon Log"},  {"clog", "Canon Log"},       {"slog", "Sony S-Log"},
      {"sonyslog", "Sony S-Log"}, {"vlog", "Panasonic V-Log"}, {"panasonicvlog", "Panasonic V-Log"},
      {"redlog", "RED Log3G10"},  {"log3g10", "RED Log3G10"},  {"nlog", "Nikon N-Log"},
      {"flog", "Fujifilm F-Log"}, {"applelog", "Apple Log"},   {"cineon", "Cineon"},
  }};
  const std::size_t colon = id.rfind(':');
  if (colon != std::string_view::npos) id = id.substr(colon + 1);
  for (const auto& [prefix, name] : names)
    if (id.substr(0, prefix.size()) == prefix) return std::string(name);
  return "";
}

}  // namespace scotopic
