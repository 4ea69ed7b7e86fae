#include "io/exr/exr_tags.h"

#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace scotopic {
namespace {

std::optional<Xy> adopted_neutral_of(const Imf::Header& header) {
  const auto* const found = header.findTypedAttribute<Imf::V2fAttribute>("adoptedNeutral");
  if (!found) return std::nullopt;
  const Xy xy = {static_cast<double>(found->value().x), static_cast<double>(found->value().y)};
  // Farther than that from equal energy lies no white, and adaptation to it breaks down.
  const auto near = [](double c) { return std::abs(c - 1.0 / 3) < 0.12; };
  return near(xy.x) && near(xy.y) ? std::optional(xy) : std::nullopt;
}

std::optional<Primaries> primaries_of(const Imf::Header& header) {
  if (!Imf::hasChromaticities(header)) return std::nullopt;
  const Imf::Chromaticities& c = Imf::chromaticities(header);
  const auto xy = [](const Imath::V2f& v) { return Xy{v.x, v.y}; };
  return Primaries{xy(c.red), xy(c.green), xy(c.blue), xy(c.white)};
}

}  // namespace

std::string text_attribute(const Imf::Header& header, const char* name) {
  const auto* found = header.findTypedAttribute<Imf::StringAttribute>(name);
  return found ? found->value() : "";
}

std::optional<double> number_attribute(const Imf::Header& header, const char* name) {
  if (const auto* found = header.findTypedAttribute<Imf::FloatAttribute>(name)) return found->value();
  if (const auto* found = header.findTypedAttribute<Imf::DoubleAttribute>(name)) return found->value();
  if (const auto* found = header.findTypedAttribute<Imf::IntAttribute>(name)) return found->value();
  return std::nullopt;
}

ColourTags colour_tags(const Imf::Header& header, const Imf::Header& first) {
  ColourTags tags;
  const auto* container = header.findTypedAttribute<Imf::IntAttribute>("acesImageContainerFlag");
  tags.aces_container = container && container->value() == 1;
  tags.interop_id = text_attribute(header, "colorInteropID");
  if (tags.interop_id.empty()) tags.interop_id = text_attribute(first, "colorInteropID");
  tags.primaries = primaries_of(header);
  tags.adopted_neutral = adopted_neutral_of(header);
  return tags;
}

std::vector<std::string> mistyped_attributes(const Imf::Header& header) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 5> types = {
      {{"chromaticities", "chromaticities"},
       {"colorInteropID", "string"},
       {"acesImageContainerFlag", "int"},
       {"adoptedNeutral", "v2f"},
       {"whiteLuminance", "float"}}};
  std::vector<std::string> out;
  for (const auto& [name, type] : types) {
    const auto found = header.find(name.data());
    if (found == header.end() || found.attribute().typeName() == type) continue;
    if (type == "float" && number_attribute(header, name.data())) continue;
    out.push_back("its attribute " + std::string(name) + " is of type " + found.attribute().typeName() +
                  ", not " + std::string(type) + ", and is left alone");
  }
  return out;
}

}  // namespace scotopic
