#include "color/file/file_colour.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "base/error.h"
#include "color/file/written_tags.h"
#include "color/icc/embedded_profile.h"

namespace scotopic {
namespace {

constexpr const char* say_it = "; --colorspace says what its colours are";

/// One thing that the file states.
struct Statement {
  ColourSpace space;
  std::string reason;
};

/// A linear space by its usual name, an encoded one by what it is made of.
ColourSpace space_of(const RgbEncoding& encoding, const std::string& name, const ColourConfig& config) {
  ColourSpace space{name, encoding.xyz_from_rgb};
  space.curve = encoding.curve;
  const NamedPrimaries* known = match_matrix(encoding.xyz_from_rgb);
  if (known && encoding.curve.linear()) space.name = known->label;
  if (known && known->name == "rec709" && encoding.curve == TransferCurve{Transfer::srgb}) {
    // The config's own, so that what it writes is known to be the same.
    const ColourSpace usual = config.space_of_file("name.png", true);
    if (config.is_srgb(usual)) return usual;
  }
  return space;
}

std::optional<Statement> by_id(const std::string& id, const std::string& file, const ColourConfig& config) {
  if (id.empty() || id == "unknown" || id == "data") return std::nullopt;
  const std::string reason = fmt::format("the file's colorInteropID {}", id);
  for (std::string name = id; !name.empty(); name = name == id ? without_namespace(id) : "") {
    if (const auto known = interop_encoding(name)) return Statement{space_of(*known, name, config), reason};
    if (config.has_space(name)) return Statement{config.space(name), reason};
  }
  const std::string camera = camera_curve(id);
  if (!camera.empty())
    throw Error(ExitCode::input, file,
                fmt::format("colorInteropID '{}' is {}, which the config has no space for under that name{}",
                            id, camera, say_it));
  throw Error(
      ExitCode::input, file,
      fmt::format(
          "colorInteropID '{}' is neither one of the Color Interop Forum's nor a space of the config{}", id,
          say_it));
}

void require_usable(const Primaries& primaries, const std::string& file) {
  if (!are_usable(primaries))
    throw Error(ExitCode::input, file, fmt::format("its chromaticities span no colour space{}", say_it));
}

/// Exif's Gamma.
std::optional<TransferCurve> exif_curve(const ColourTags& tags, const std::string& file) {
  if (!tags.exif_gamma) return std::nullopt;
  const double gamma = *tags.exif_gamma;
  if (!(gamma > 0.1 && gamma < 10))
    throw Error(ExitCode::input, file, fmt::format("Exif gamma {:.5g} is out of all use{}", gamma, say_it));
  if (std::abs(gamma - 1) < 1e-4) return TransferCurve{};
  return TransferCurve{Transfer::power, gamma};
}

/// Of integers whose curve nothing else states.
TransferCurve curve_beside_primaries(const ColourTags& tags, const std::string& file) {
  if (tags.exif == ExifColour::adobe_rgb) return {Transfer::power, adobe_rgb_gamma};
  if (tags.exif == ExifColour::srgb) return {Transfer::srgb};
  return exif_curve(tags, file).value_or(TransferCurve{Transfer::srgb});
}

std::optional<Statement> by_primaries(const ColourTags& tags, const std::string& file, bool integer,
                                      const ColourConfig& config) {
  if (!tags.primaries) return std::nullopt;
  if (are_cie_xyz(*tags.primaries)) {
    const Xy white = tags.adopted_neutral.value_or(white_d65);
    return Statement{
        {"CIE XYZ", bradford(white, white_d65)},
        tags.adopted_neutral ? "the file's chromaticities and neutral" : "the file's chromaticities"};
  }
  require_usable(*tags.primaries, file);
  const NamedPrimaries* known = match_primaries(*tags.primaries);
  RgbEncoding encoding;
  encoding.xyz_from_rgb = xyz_d65_from_rgb(known ? known->primaries : *tags.primaries);
  if (!integer)
    return Statement{space_of(encoding, "linear, the file's chromaticities", config),
                     "the file's chromaticities"};
  encoding.curve = curve_beside_primaries(tags, file);
  const std::string curve = describe(encoding.curve);
  return Statement{space_of(encoding, curve + ", the file's chromaticities", config),
                   encoding.curve.kind == Transfer::srgb ? "the file's chromaticities, with sRGB's curve"
                                                         : "the file's chromaticities, " + curve};
}

std::optional<Statement> by_gamma(const ColourTags& tags, const std::string& file,
                                  const ColourConfig& config) {
  if (!tags.gamma) return std::nullopt;
  if (tags.primaries) require_usable(*tags.primaries, file);
  if (!(*tags.gamma > 0.1 && *tags.gamma < 10))
    throw Error(ExitCode::input, file, fmt::format("gamma {} is out of all use{}", *tags.gamma, say_it));
  RgbEncoding encoding;
  if (std::abs(*tags.gamma - 1) > 1e-4) encoding.curve = {Transfer::power, *tags.gamma};
  const NamedPrimaries* known = tags.primaries ? match_primaries(*tags.primaries) : nullptr;
  encoding.xyz_from_rgb = known            ? xyz_d65_from_rgb(known->primaries)
                          : tags.primaries ? xyz_d65_from_rgb(*tags.primaries)
                                           : gamut_xyz_matrix("rec709").value();
  const std::string of = known || !tags.primaries ? "" : ", the file's chromaticities";
  return Statement{space_of(encoding, describe(encoding.curve) + of, config),
                   fmt::format("the file's {} {:.5g}{}", tags.radiance ? "GAMMA" : "gAMA", 1 / *tags.gamma,
                               !tags.primaries ? ""
                               : tags.radiance ? " and PRIMARIES"
                                               : " and cHRM")};
}

std::optional<Statement> by_profile(const ColourTags& tags, const std::string& file) {
  if (!tags.icc) return std::nullopt;
  auto profile = std::make_shared<const EmbeddedProfile>(*tags.icc, file);
  ColourSpace space{profile->description()};
  space.embedded = std::move(profile);
  return Statement{space, fmt::format("the file's ICC profile '{}'", space.name)};
}

/// TransferFunction, with the primaries if they are stated: as a profile, which holds tables.
std::optional<Statement> by_table(const ColourTags& tags, const std::string& file) {
  if (!tags.transfer_table) return std::nullopt;
  if (tags.primaries) require_usable(*tags.primaries, file);
  const Matrix3<double> matrix =
      tags.primaries ? xyz_d65_from_rgb(*tags.primaries) : gamut_xyz_matrix("rec709").value();
  std::vector<std::byte> bytes = make_table_profile(*tags.transfer_table, matrix);
  if (bytes.empty())
    throw Error(ExitCode::input, file, std::string("its TransferFunction is no curve that rises") + say_it);
  ColourSpace space{tags.primaries ? "TransferFunction, the file's chromaticities" : "TransferFunction"};
  space.embedded = std::make_shared<const EmbeddedProfile>(std::move(bytes), file);
  return Statement{space, tags.primaries ? "the file's TransferFunction and chromaticities"
                                         : "the file's TransferFunction"};
}

std::optional<Statement> by_exif(const ColourTags& tags, const ColourConfig& config) {
  if (tags.exif != ExifColour::srgb && tags.exif != ExifColour::adobe_rgb) return std::nullopt;
  const char* id = tags.exif == ExifColour::srgb ? "srgb_rec709_scene" : "g22_adobergb_scene";
  return Statement{space_of(interop_encoding(id).value(), id, config), "the file's Exif colour space"};
}

/// Of integers. Beside a space that Exif names 2.2 is what both of them are called.
std::optional<Statement> by_exif_gamma(const ColourTags& tags, const std::string& file, bool integer,
                                       const ColourConfig& config) {
  const std::optional<TransferCurve> curve = integer ? exif_curve(tags, file) : std::nullopt;
  const bool named = tags.exif == ExifColour::srgb || tags.exif == ExifColour::adobe_rgb;
  if (!curve || (named && std::abs(*tags.exif_gamma - 2.2) < 0.05)) return std::nullopt;
  RgbEncoding encoding{*curve, gamut_xyz_matrix("rec709").value()};
  if (tags.primaries) encoding.xyz_from_rgb = xyz_d65_from_rgb(*tags.primaries);
  return Statement{space_of(encoding, describe(*curve), config),
                   fmt::format("the file's Exif gamma {:.5g}", *tags.exif_gamma)};
}

/// All that the file states, the first of which holds.
std::vector<Statement> statements(const ColourTags& tags, const std::string& file, bool integer, int bits,
                                  const ColourConfig& config) {
  std::vector<Statement> out;
  const auto add = [&](std::optional<Statement> s) {
    if (s) out.push_back(std::move(*s));
  };
  if (tags.aces_container)
    add(Statement{space_of(interop_encoding("lin_ap0_scene").value(), "ACES2065-1", config),
                  "the file's acesImageContainerFlag"});
  add(by_id(tags.interop_id, file, config));
  if (tags.code_points) {
    const RgbEncoding encoding = encoding_of(*tags.code_points, bits, file);
    const std::string name =
        fmt::format("{}, primaries {} of H.273", describe(encoding.curve), tags.code_points->primaries);
    add(Statement{space_of(encoding, name, config), "the file's cICP"});
  }
  add(by_profile(tags, file));
  if (tags.srgb) {
    add(Statement{space_of(interop_encoding("srgb_rec709_scene").value(), "sRGB", config),
                  "the file's sRGB chunk"});
  } else if (tags.gamma) {
    // gAMA and cHRM belong together.
    add(by_gamma(tags, file, config));
  } else if (tags.transfer_table) {
    add(by_table(tags, file));
  } else {
    add(by_primaries(tags, file, integer, config));
  }
  add(by_exif(tags, config));
  add(by_exif_gamma(tags, file, integer, config));
  return out;
}

/// Light that a saturated encoded colour stands for; the same to 1 %, they say the same.
bool agree(const ColourSpace& a, const ColourSpace& b, const ColourConfig& config) {
  const auto light = [&](const ColourSpace& space) {
    std::array<float, 3> rgb = {0.5f, 0.25f, 0.75f};
    config.to_working(space).apply(&rgb[0], &rgb[1], &rgb[2], 1);
    return rgb;
  };
  const std::array<float, 3> x = light(a), y = light(b);
  for (std::size_t i = 0; i < 3; ++i)
    if (!(std::abs(x[i] - y[i]) <= 0.01f * (std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2])))) return false;
  return true;
}

}  // namespace

bool are_data(const ColourTags& tags) {
  return !tags.aces_container && (tags.interop_id == "data" || without_namespace(tags.interop_id) == "data");
}

FileColour colour_of_file(const ColourTags& tags, const std::string& file, bool integer, int bits,
                          const ColourConfig& config) {
  const std::vector<Statement> stated = statements(tags, file, integer, bits, config);
  FileColour out;
  if (stated.empty()) {
    const RuledSpace ruled = config.space_by_rules(file, integer);
    FileColour assumed{ruled.space, ruled.reason, {}};
    if (tags.exif == ExifColour::other)
      assumed.notes.emplace_back("its Exif says that it is not sRGB, and nothing says what it is");
    return assumed;
  }
  out.space = stated.front().space;
  out.reason = stated.front().reason;
  for (std::size_t i = 1; i < stated.size(); ++i)
    if (!agree(out.space, stated[i].space, config))
      out.notes.push_back(fmt::format("{} and {} say different things of its colours: the former holds",
                                      out.reason, stated[i].reason));
  return out;
}

}  // namespace scotopic
