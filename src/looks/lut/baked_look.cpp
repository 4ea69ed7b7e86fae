#include "looks/lut/baked_look.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

#include "looks/cube/baked_cube.h"
#include "looks/lut/shipped_looks.h"
#include "looks/lut/look_chain.h"
#include "looks/lut/look_matrix.h"
#include "looks/chain/number_text.h"
#include "looks/chain/ocio_chain.h"
#include "color/primaries.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

constexpr std::string_view max_marker = "; max ";

std::string stated_of_night(const BakeError& e, const LookSpec& spec) {
  return fmt::format(
      "Error against the operator and the display stage, {} of what is shown, {} colours of the working "
      "gamut, 2^-20 to 2^8 of white: mean {}; 99 % {}{}{}",
      spec.night->peak > display_white ? "delta E ITP" : "CIEDE2000", e.samples, rounded_text(e.mean, 2),
      rounded_text(e.p99, 2), max_marker, rounded_text(e.max, 2));
}

std::string stated(const BakeError& e, const LookSpec& spec) {
  if (spec.night) return stated_of_night(e, spec);
  return fmt::format(
      "Error against the operator, CIEDE2000 with each pixel exposed to Y = 0.184, {} colours {}: mean {}; "
      "99 % {}{}{}",
      e.samples, "of the working gamut, 2^-20 to 2^8 of white", rounded_text(e.mean, 2),
      rounded_text(e.p99, 2), max_marker, rounded_text(e.max, 2));
}

/// What comes out of it.
std::string output_of(const LookSpec& spec) {
  if (!spec.night) return spec.space;
  if (spec.encoded) return fmt::format("{}, peak {} cd/m2", spec.display, rounded_text(spec.night->peak, 6));
  return fmt::format("light of a display ({}, peak {} cd/m2) in {}, 1 stands for {} cd/m2", spec.display,
                     rounded_text(spec.night->peak, 6), spec.space, display_white);
}

std::string id_of(const LookSpec& spec) {
  if (!spec.encoded)
    return fmt::format("scotopic-{}-{}", spec.night ? night_file_stem(spec) : look_file_stem(spec),
                       spec.edge);
  return fmt::format("scotopic-{}{}-{}-encoded", spec.night ? "night-" : "", look_file_stem(spec), spec.edge);
}

/// Where nodes lie beyond codes: a reader that holds them as integers loses, or wraps round, those.
std::vector<std::string> node_lines(const Chain& chain) {
  const auto* lut = std::get_if<Lut3DStep>(&chain.steps.back());
  if (lut == nullptr) return {};
  const auto [low, high] = std::minmax_element(lut->values.begin(), lut->values.end());
  if (*low >= 0 && *high <= 1) return {};
  return {fmt::format(
      "Nodes lie between {} and {} for the sake of what is between them: to be held as floating point",
      rounded_text(*low, 2), rounded_text(*high, 4))};
}

/// What the file says of itself.
void describe(BakedLook& look, const std::string& version) {
  const LookSpec& spec = look.spec;
  const AppearanceParameters& p = spec.parameters;
  Chain& chain = look.chain;
  chain.name = spec.night ? night_name(spec) : look_name(spec);
  chain.id = id_of(spec);
  chain.input = fmt::format("{}, 1 stands for {} cd/m2", spec.space, rounded_text(p.white_luminance, 6));
  if (spec.encoded)
    chain.input = fmt::format("codes of {}, light 1 stands for {} cd/m2", spec.space,
                              rounded_text(p.white_luminance, 6));
  chain.output = output_of(spec);
  chain.descriptions = {
      fmt::format("What an eye adapted to {} cd/m2 sees, by the scotopic appearance operator {}, model {}",
                  adaptation_text(p.adaptation), version, name_of(p.model)),
      "Forward only: the operator has no inverse. Alpha is not touched"};
  if (spec.lamp)
    chain.descriptions.push_back(
        fmt::format("The eye is used to {} of the colour of a lamp (x {:.4f}, y {:.4f}): CAT16 before the "
                    "receptors; what that "
                    "takes out of the gamut fades at its luminance",
                    rounded_text(lamp_degree(*spec.lamp, p), 4), spec.lamp->x(), spec.lamp->y()));
  for (const std::string& line :
       look.cube ? error_lines(*look.cube, spec) : std::vector{stated(look.error, spec)})
    chain.descriptions.push_back(line);
  if (look.cube)
    for (const std::string& line : node_lines(chain)) chain.descriptions.push_back(line);
  chain.descriptions.push_back(spec_text(spec));
  chain.info = {{"Application", "scotopic"}, {"Version", version}};
}

BakedCube cube_of(LookSpec spec, const ColourConfig& config) {
  if (spec.edge != 0) return bake_cube(spec, config);
  spec.edge = 33;
  BakedCube small = bake_cube(spec, config);
  if (!wants_larger(small.error)) return small;
  spec.edge = 65;
  return bake_cube(spec, config);
}

}  // namespace

std::optional<Matrix3<double>> linear_space_matrix(const ColourConfig& config, const std::string& space) {
  if (space == config.working_space()) return config.xyz_from_working();
  const RowConverter to = config.to_working(config.space(space));
  const auto image = [&](const Vec3<double>& v) {
    float p[3] = {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
    to.apply(&p[0], &p[1], &p[2], 1);
    return Vec3<double>{p[0], p[1], p[2]};
  };
  const Matrix3<double> working_from_space =
      transpose(Matrix3<double>{{{image({1, 0, 0}), image({0, 1, 0}), image({0, 0, 1})}}});
  for (const Vec3<double>& probe : {Vec3<double>{0, 0, 0}, {0.18, 0.09, 0.045}, {0.25, 4, 16}}) {
    const Vec3<double> got = image(probe), wanted = working_from_space * probe;
    for (std::size_t i = 0; i < 3; ++i)
      if (!(std::abs(got[i] - wanted[i]) <= 1e-5 * std::max({probe[0], probe[1], probe[2]})))
        return std::nullopt;
  }
  const Matrix3<double> xyz = config.xyz_from_working() * working_from_space;
  const NamedPrimaries* known = match_matrix(xyz);
  return known ? xyz_d65_from_rgb(known->primaries) : xyz;
}

BakedLook bake_look(const LookSpec& spec, const ColourConfig& config, const std::string& version) {
  BakedLook look{spec, {}, {}};
  Chain& chain = look.chain;
  if (spec.encoded) {
    BakedCube cube = cube_of(spec, config);
    look.spec.edge = cube.edge;
    chain = std::move(cube.chain);
    look.error = cube.error.rec709.by_reading[0];
    look.cube = std::move(cube.error);
  } else if (spec.night) {
    chain = night_chain(spec.parameters, *spec.night, spec.edge, spec.lamp);
  } else {
    const std::optional<Matrix3<double>> matrix = look_matrix(spec.parameters);
    if (is_identity(spec))
      chain.steps = {MatrixStep{}};
    else if (matrix && !spec.lamp)
      chain.steps = {RangeStep{-look_limit, look_limit}, MatrixStep{*matrix, {}}};
    else
      chain = look_chain(spec.parameters, spec.edge, spec.lamp);
  }
  if (!spec.encoded)
    look.error = measure_look(spec, cpu_processor(ocio_transform(chain), OCIO::Config::CreateRaw()));
  describe(look, version);
  return look;
}

double BakedLook::largest_error() const noexcept {
  return cube ? std::max(cube->rec709.by_reading[0].max, cube->rec709.by_reading[1].max) : error.max;
}

std::optional<double> stated_max(std::string_view text) {
  const std::size_t error = text.find("Error against the operator");
  const std::size_t at = error == std::string_view::npos ? error : text.find(max_marker, error);
  if (at == std::string_view::npos) return std::nullopt;
  double value = 0;
  const char* begin = text.data() + at + max_marker.size();
  const auto result = std::from_chars(begin, text.data() + text.size(), value);
  if (result.ec != std::errc()) return std::nullopt;
  return value;
}

}  // namespace scotopic
