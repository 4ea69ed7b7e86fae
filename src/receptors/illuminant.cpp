#include "receptors/illuminant.h"

#include <array>
#include <charconv>
#include <cmath>

#include "receptors/rods.h"
#include "receptors/tables.h"

namespace scotopic {
namespace {

// S/P by CIE 1951 V' and CIE 1924 V. D65 is the ratio that the rod estimate is exact for, so that the default
// changes nothing; the lamps are those of src/receptors/tables.
constexpr std::array illuminants = {
    NamedIlluminant{"d65", sp_ratio_d65, "daylight, CIE D65"},
    NamedIlluminant{"e", 2.26, "equal energy"},
    NamedIlluminant{"moon", 2.04, "full moon at the ground, about 4490 K"},
    NamedIlluminant{"a", 1.41, "tungsten, CIE A"},
    NamedIlluminant{"hps", 0.645, "high-pressure sodium"},
    NamedIlluminant{"led3000", 1.33, "phosphor-converted LED, about 3000 K"},
    NamedIlluminant{"led4000", 1.72, "white and red LED, about 4000 K"},
};

constexpr double moon_kelvin = 4490.0;

Spectrum copy_of(const TabulatedCurve& curve) {
  return {curve.first_nm, curve.step_nm, {curve.values.begin(), curve.values.end()}};
}

}  // namespace

std::span<const NamedIlluminant> named_illuminants() { return illuminants; }

std::string illuminant_names() {
  std::string names;
  for (const NamedIlluminant& illuminant : illuminants) {
    if (!names.empty()) names += ", ";
    names += illuminant.name;
  }
  return names;
}

std::optional<Spectrum> illuminant_spectrum(std::string_view name) {
  if (name == "d65") return copy_of(tables::illuminant_cie_d65_d65);
  // Constant wherever a sensitivity is not 0.
  if (name == "e") return Spectrum{300.0, 600.0, {1.0, 1.0}};
  if (name == "moon") return cie_daylight(moon_kelvin);
  if (name == "a") return copy_of(tables::illuminant_cie_a_a);
  if (name == "hps") return copy_of(tables::lamps_houser_2013_hps);
  if (name == "led3000") return copy_of(tables::lamps_houser_2013_led3000);
  if (name == "led4000") return copy_of(tables::lamps_houser_2013_led4000);
  return std::nullopt;
}

std::optional<double> parse_sp_ratio(std::string_view name_or_number) {
  for (const NamedIlluminant& illuminant : illuminants)
    if (illuminant.name == name_or_number) return illuminant.sp_ratio;
  double ratio = 0.0;
  const char* const end = name_or_number.data() + name_or_number.size();
  const auto [stop, error] = std::from_chars(name_or_number.data(), end, ratio);
  if (error != std::errc() || stop != end || !std::isfinite(ratio) || !(ratio > 0.0)) return std::nullopt;
  return ratio;
}

}  // namespace scotopic
