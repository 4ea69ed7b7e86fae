#include "looks/lut/baked_look.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "looks/lut/ladder.h"
#include "looks/lut/look_chain.h"
#include "looks/lut/look_matrix.h"
#include "looks/chain/number_text.h"
#include "looks/chain/ocio_chain.h"
#include "color/primaries.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

constexpr std::string_view max_marker = "; max ";

Encoding encoding(const RowConverter& converter) {
  return [converter](float* r, float* g, float* b, std::size_t count) { converter.apply(r, g, b, count); };
}

void convert(const RowConverter& converter, Colours& c) {
  converter.apply(c.r.data(), c.g.data(), c.b.data(), c.size());
}

/// Encoded values all over the unit cube, but for those that stand for less than no light.
Colours encoded_colours(const RowConverter& to_linear) {
  Colours all = stop_colours(100000, identity3<double>(), identity3<double>());
  for (std::vector<float>* plane : {&all.r, &all.g, &all.b})
    for (float& x : *plane) x = x > 0 ? std::clamp((std::log2(x) + 20) / 28, 0.f, 1.f) : 0.f;
  Colours linear = all;
  convert(to_linear, linear);
  Colours light;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!(linear.r[i] >= 0 && linear.g[i] >= 0 && linear.b[i] >= 0)) continue;
    light.r.push_back(all.r[i]);
    light.g.push_back(all.g[i]);
    light.b.push_back(all.b[i]);
  }
  return light;
}

std::string stated_of_night(const BakeError& e, const LookSpec& spec) {
  return fmt::format("Error against the operator and the display stage, {} of what is shown, {} colours of the working "
                     "gamut, 2^-20 to 2^8 of white: mean {}; 99 % {}{}{}",
                     spec.night->peak > display_white ? "delta E ITP" : "CIEDE2000", e.samples, rounded_text(e.mean, 2),
                     rounded_text(e.p99, 2), max_marker, rounded_text(e.max, 2));
}

std::string stated(const BakeError& e, const LookSpec& spec) {
  if (spec.night) return stated_of_night(e, spec);
  return fmt::format(
      "Error against the operator, CIEDE2000 with each pixel exposed to Y = 0.184, {} colours {}: mean {}; "
      "99 % {}{}{}",
      e.samples, spec.encoded ? "of encoded values 0 to 1" : "of the working gamut, 2^-20 to 2^8 of white",
      rounded_text(e.mean, 2), rounded_text(e.p99, 2), max_marker, rounded_text(e.max, 2));
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

BakeError measure_encoded(const LookSpec& spec, const ColourConfig& config,
                          const OCIO::ConstCPUProcessorRcPtr& processor) {
  const RowConverter to = config.to_working(config.space(spec.space));
  const RowConverter from = config.from_working(config.space(spec.space));
  const Colours encoded = encoded_colours(to);
  Colours in = encoded;
  convert(to, in);
  // What the encoding itself cannot hold is not the LUT's fault.
  Colours expected = exact(spec.parameters, in);
  convert(from, expected);
  for (auto* plane : {&expected.r, &expected.g, &expected.b})
    for (float& x : *plane) x = std::clamp(x, 0.f, 1.f);
  convert(to, expected);
  Colours got = encoded;
  apply(processor, got);
  convert(to, got);
  Comparison comparison(spec.parameters.xyz_from_rgb);
  comparison.add(in, expected, got);
  return comparison.result();
}

BakedLook bake_look(const LookSpec& spec, const ColourConfig& config, const std::string& version) {
  BakedLook look{spec, {}, {}};
  Chain& chain = look.chain;
  const OCIO::ConstConfigRcPtr raw = OCIO::Config::CreateRaw();
  if (spec.encoded) {
    const ColourSpace space = config.space(spec.space);
    chain = encoded_lut(spec.parameters, spec.edge, encoding(config.to_working(space)),
                        encoding(config.from_working(space)));
    look.error = measure_encoded(spec, config, cpu_processor(ocio_transform(chain), raw));
  } else if (spec.night) {
    chain = night_chain(spec.parameters, *spec.night, spec.edge);
    look.error = measure_night(spec.parameters, *spec.night, cpu_processor(ocio_transform(chain), raw),
                               spec.parameters.xyz_from_rgb);
  } else {
    const std::optional<Matrix3<double>> matrix = look_matrix(spec.parameters);
    if (is_identity(spec.parameters))
      chain.steps = {MatrixStep{}};
    else if (matrix)
      chain.steps = {RangeStep{-look_limit, look_limit}, MatrixStep{*matrix, {}}};
    else
      chain = look_chain(spec.parameters, spec.edge);
    look.error = measure_bake(spec.parameters, cpu_processor(ocio_transform(chain), raw),
                              spec.parameters.xyz_from_rgb);
  }
  const AppearanceParameters& p = spec.parameters;
  chain.name = spec.night ? night_name(p.adaptation) : look_name(p);
  chain.id = fmt::format("scotopic-{}-{}{}", spec.night ? night_file_stem(spec) : look_file_stem(p), spec.edge,
                         spec.encoded ? "-encoded" : "");
  chain.input = fmt::format("{}, 1 stands for {} cd/m2", spec.space, rounded_text(p.white_luminance, 6));
  chain.output = spec.night ? fmt::format("light of a display ({}, peak {} cd/m2) in {}, 1 stands for {} cd/m2", spec.display,
                                          rounded_text(spec.night->peak, 6), spec.space, display_white)
                            : spec.space;
  chain.descriptions = {
      fmt::format("What an eye adapted to {} cd/m2 sees, by the scotopic appearance operator {}, model {}",
                  adaptation_text(p.adaptation), version, name_of(p.model)),
      "Forward only: the operator has no inverse. Alpha is not touched", stated(look.error, spec),
      spec_text(spec)};
  chain.info = {{"Application", "scotopic"}, {"Version", version}};
  return look;
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
