#include "io/spectral/spectral_header.h"

#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "io/exr/exr_tags.h"

namespace scotopic {

std::optional<double> wavelength_attribute(const Imf::Header& header, const std::string& channel) {
  const std::string name = channel + ".wavelength";
  if (const auto* value = header.findTypedAttribute<Imf::FloatAttribute>(name)) return value->value();
  if (const auto* value = header.findTypedAttribute<Imf::DoubleAttribute>(name)) return value->value();
  if (const auto* text = header.findTypedAttribute<Imf::StringAttribute>(name)) {
    double value = 0.0;
    const std::string& digits = text->value();
    const char* const end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, value);
    if (error == std::errc() && (stop == end || *stop == ' ')) return value;
  }
  return std::nullopt;
}

// The layout's own readers and every renderer known to write it (ART, pbrt, Mitsuba's scripts) hold values
// per nm and write "W.m^-2.sr^-1".
std::pair<BandUnit, std::string> band_unit_of(const std::string& units,
                                              const std::optional<BandUnit>& chosen) {
  if (chosen)
    return {*chosen,
            fmt::format("radiance taken per {}, as asked", *chosen == BandUnit::per_nm ? "nm" : "band")};
  if (units.find("nm^-1") != units.npos || units.find("/nm") != units.npos)
    return {BandUnit::per_nm, fmt::format("radiance per nm: emissiveUnits is \"{}\"", units)};
  if (units.empty()) return {BandUnit::per_nm, "radiance assumed to be W/(m2 sr nm): the file does not say"};
  return {BandUnit::per_nm,
          fmt::format("radiance assumed to be per nm: emissiveUnits is only \"{}\"", units)};
}

bool states_radiance(const std::string& units) {
  return units.empty() || (units.find('W') != units.npos && units.find("sr") != units.npos);
}

std::vector<Attribute> attributes_without_spectral_ones(const Imf::Header& header) {
  static const std::set<std::string> spectral = {"spectralLayoutVersion",
                                                 "emissiveUnits",
                                                 "polarisationHandedness",
                                                 "EV",
                                                 "whiteLuminance",
                                                 "name",
                                                 "type"};
  std::vector<Attribute> out;
  for (auto entry = header.begin(); entry != header.end(); ++entry) {
    const std::string name = entry.name();
    if (spectral.count(name) != 0 || name.find(".wavelength") != name.npos) continue;
    const Imf::Attribute& attribute = entry.attribute();
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute)) {
      out.push_back({name, text->value()});
    } else if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&attribute)) {
      out.push_back({name, static_cast<double>(number->value())});
    }
  }
  return out;
}

std::string later_layout(const std::vector<const Imf::Header*>& parts) {
  for (const Imf::Header* part : parts)
    if (std::string version = text_attribute(*part, "spectralLayoutVersion");
        !version.empty() && version != "1.0")
      return version;
  return "";
}

double widest_visible_step(const std::vector<double>& centres) {
  double widest = 0;
  for (std::size_t i = 1; i < centres.size(); ++i)
    widest = std::max(widest, std::min(centres[i], 780.0) - std::max(centres[i - 1], 380.0));
  return widest;
}

}  // namespace scotopic
