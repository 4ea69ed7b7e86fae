#include "cli/scene/glare_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <thread>

#include "cli/options/values.h"

namespace scotopic {
namespace {

constexpr const char* rules = "above, above:T (T in image units), all, or none";

double pixel_aspect(const PixelSource& source, std::size_t index) {
  for (const Attribute& a : source.attributes(index))
    if (a.name == "pixelAspectRatio")
      if (const double* value = std::get_if<double>(&a.value)) return *value > 0 ? *value : 1;
  return 1;
}

GlareFilter filter_for(const GlareChoice& choice, double threshold, const PixelSource& source, const LightPicture& light,
                       const AngularResolution& resolution, bool panorama, double strength) {
  const Window& data = source.pictures()[light.index].data;
  GlareParameters p;
  p.eye = choice.eye;
  p.rule = choice.rule;
  p.threshold = choice.threshold.value_or(threshold);
  p.grid.width = data.width();
  p.grid.height = data.height();
  p.grid.ppd_x = resolution.pixels_per_degree;
  p.grid.ppd_y = resolution.pixels_per_degree * pixel_aspect(source, light.index);
  p.grid.sides = panorama ? GlareSides::meet : GlareSides::end;
  p.grid.strength = choice.strength * strength;
  try {
    return GlareFilter(p);
  } catch (const std::invalid_argument& e) {
    throw Error(ExitCode::usage, source.file(), std::string("glare: ") + e.what());
  }
}

void check_memory(const GlareFilter& filter, const PixelSource& source, const LightPicture& light, bool receptors,
                  const Limits& limits) {
  const Picture& picture = source.pictures()[light.index];
  const auto threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const std::int64_t bytes = FrameLight::bytes(picture, receptors) +
                             static_cast<std::int64_t>(filter.bytes(receptors ? 7 : 3, threads));
  check_limit(source.file(), "bytes of memory planned for glare", bytes, limits.memory, "--max-memory");
}

bool is_receptors(const LightPicture& light) {
  using Kind = ColourChannels::Kind;
  return light.channels.kind == Kind::lmsr || light.channels.kind == Kind::computed;
}

}  // namespace

void add_glare_options(CLI::App& verb, GlareOptions& o) {
  const std::string group = "Glare";
  const auto add = [&](const char* name, std::string& value, const std::string& text, const char* kind) {
    verb.add_option(name, value, text)->type_name(kind)->group(group);
  };
  add("--glare", o.rule,
      "What the eye scatters: above (default: light the display cannot show), above:T (image units), all (the image on the "
      "retina, to measure), none",
      "RULE");
  add("--age", o.age, "Of the eye, years (default 28.58)", "YEARS");
  add("--pigmentation", o.pigmentation, "Of the eye: 0 black, 0.5 brown (default), 1 blue, 1.2 very light", "X");
  add("--strength-glare", o.strength, "Of the scattered light, 0 to 1", "X");
}

GlareChoice understand(const GlareOptions& o) {
  GlareChoice out;
  constexpr std::string_view above = "above:";
  out.named = o.rule != GlareOptions().rule;
  if (o.rule.rfind(above, 0) == 0)
    out.threshold = number_in("--glare", o.rule.substr(above.size()), 1e-30, 1e30, rules);
  else if (o.rule == "all") out.rule = GlareRule::all;
  else if (o.rule == "none") out.off = true;
  else if (o.rule != "above") fail_value("--glare", o.rule, rules);
  out.eye.age = number_in("--age", o.age, 0, 100, "an age in years, 0 to 100");
  out.eye.pigmentation = number_in("--pigmentation", o.pigmentation, 0, 1.2, "a pigmentation from 0 (black) to 1.2 (very light)");
  out.strength = number_in("--strength-glare", o.strength, 0, 1, "a strength from 0 (off) to 1 (the model)");
  return out;
}

GlareOutcome scatter(const GlareChoice& choice, EffectWish wish, double threshold, PixelSource& source,
                     const ImageLayout& layout, const ColourConfig& config, const AppearanceParameters& parameters,
                     const AngularResolution& resolution, bool panorama, const Limits& limits) {
  GlareOutcome out;
  EffectDecision& d = out.decision;
  d.effect = "glare";
  d.unit = "pixels";
  const bool by_name = wish == EffectWish::yes || (choice.named && !choice.off);
  d.asked = !choice.off && choice.strength * parameters.strength.all > 0 && (by_name || (wish == EffectWish::if_known && resolution.known));
  if (by_name && d.asked && !resolution.known)
    throw Error(ExitCode::usage, source.file(), "glare needs pixels per degree, which are not known: --fov or --ppd");
  d.reason = resolution.known ? "not asked for" : "pixels per degree are not known (--ppd, --fov)";
  if (!d.asked) return out;
  const Vec3<double>& y = parameters.xyz_from_rgb[1];
  for (const LightPicture& light : layout.light) {
    const Picture& picture = source.pictures()[light.index];
    if (picture.level_x != 0 || picture.level_y != 0) continue;
    const GlareFilter filter = filter_for(choice, threshold, source, light, resolution, panorama, parameters.strength.all);
    check_memory(filter, source, light, is_receptors(light), limits);
    FrameLight frame = read_frame(source, light, config);
    const GlareNeed need = filter.need(frame.glare_picture(), {y[0], y[1], y[2]}, pool_for());
    d.number += static_cast<double>(need.above);
    d.reason = need.reason;
    if (!need.called_for) continue;
    d.needed = true;
    filter.apply(frame.glare_picture(), pool_for());
    out.frames.emplace(light.index, std::move(frame));
  }
  d.share = d.needed ? 1 : 0;
  if (!d.needed) return out;
  out.stamps = {{"scotopic:glareThreshold", choice.rule == GlareRule::all ? 0.0 : choice.threshold.value_or(threshold)},
                {"scotopic:glareAge", choice.eye.age},
                {"scotopic:glarePigmentation", choice.eye.pigmentation},
                {"scotopic:glareStrength", choice.strength},
                {"scotopic:glarePixelsPerDegree", resolution.pixels_per_degree}};
  return out;
}

}  // namespace scotopic
