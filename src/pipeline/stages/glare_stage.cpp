#include "pipeline/stages/glare_stage.h"

#include <algorithm>
#include <stdexcept>

#include "base/error.h"
#include "stages/glare/filter.h"

namespace scotopic {
namespace {

class GlareStage : public FrameStage {
 public:
  GlareStage(const GlareChoice& choice, EffectWish wish, const NightDisplayParameters& shown)
      : choice_(choice), wish_(wish), shown_(shown) {}

  std::string_view name() const noexcept override { return "glare"; }
  EffectDecision asked(const StageScene& scene) const override;
  std::int64_t bytes(const FrameSize& size, const StageScene& scene) const override;
  FrameOutcome run(const FramePlanes& light, const StageScene& scene,
                   const ParallelFor& parallel_for) const override;
  std::vector<Attribute> stamps(const StageScene& scene) const override;

 private:
  double strength(const StageScene& scene) const { return choice_.strength * scene.parameters.strength.all; }
  double threshold(const StageScene& scene) const;
  GlareFilter filter(int width, int height, double threshold, const StageScene& scene) const;

  GlareChoice choice_;
  EffectWish wish_;
  NightDisplayParameters shown_;
};

EffectDecision GlareStage::asked(const StageScene& scene) const {
  EffectDecision d;
  d.effect = name();
  d.unit = "pixels";
  const bool known = scene.resolution.known;
  const bool model_has_it = scene.parameters.model != Model::safko2019;
  const bool by_name = (wish_ == EffectWish::yes && model_has_it) || (choice_.named && !choice_.off);
  const bool wished = by_name || (wish_ == EffectWish::if_known && model_has_it && known);
  d.asked = !choice_.off && strength(scene) > 0 && wished;
  if (by_name && d.asked && !known)
    throw Error(ExitCode::usage, "", "glare needs pixels per degree, which are not known: --fov or --ppd");
  d.reason = known ? "not asked for" : "pixels per degree are not known (--ppd, --fov)";
  return d;
}

// Image units: what the display cannot show.
double GlareStage::threshold(const StageScene& scene) const {
  if (choice_.threshold) return *choice_.threshold;
  NightDisplayParameters shown = shown_;
  shown.adaptation = scene.parameters.adaptation;
  shown.white_luminance = scene.parameters.white_luminance;
  return 1 / display_scale(shown);
}

GlareFilter GlareStage::filter(int width, int height, double threshold, const StageScene& scene) const {
  GlareParameters p;
  p.eye = choice_.eye;
  p.rule = choice_.rule;
  p.threshold = threshold;
  p.grid.width = width;
  p.grid.height = height;
  p.grid.ppd_x = scene.resolution.pixels_per_degree;
  p.grid.ppd_y = scene.resolution.pixels_per_degree * scene.resolution.pixel_aspect;
  p.grid.sides = scene.wraps ? GlareSides::meet : GlareSides::end;
  p.grid.strength = strength(scene);
  try {
    return GlareFilter(p);
  } catch (const std::invalid_argument& e) {
    throw Error(ExitCode::usage, "", std::string("glare: ") + e.what());
  }
}

std::int64_t GlareStage::bytes(const FrameSize& size, const StageScene& scene) const {
  const GlareFilter any = filter(size.width, size.height, 1, scene);  // its memory depends on no threshold
  return static_cast<std::int64_t>(any.bytes(size.planes, size.threads));
}

FrameOutcome GlareStage::run(const FramePlanes& light, const StageScene& scene,
                             const ParallelFor& parallel_for) const {
  GlarePicture picture;
  std::copy(light.rgb.begin(), light.rgb.end(), picture.rgb.begin());
  picture.light.assign(light.rgb.begin(), light.rgb.end());
  if (light.receptors[0])
    picture.light.insert(picture.light.end(), light.receptors.begin(), light.receptors.end());
  picture.stride = light.stride;
  const GlareFilter glare = filter(light.width, light.height, threshold(scene), scene);
  const Vec3<double>& y = scene.parameters.xyz_from_rgb[1];
  const GlareNeed need = glare.need(picture, {y[0], y[1], y[2]}, parallel_for);
  if (need.called_for) glare.apply(picture, parallel_for);
  return {need.called_for, need.reason, static_cast<double>(need.above)};
}

std::vector<Attribute> GlareStage::stamps(const StageScene& scene) const {
  return {{"scotopic:glareThreshold", choice_.rule == GlareRule::all ? 0.0 : threshold(scene)},
          {"scotopic:glareAge", choice_.eye.age},
          {"scotopic:glarePigmentation", choice_.eye.pigmentation},
          {"scotopic:glareStrength", choice_.strength},
          {"scotopic:glarePixelsPerDegree", scene.resolution.pixels_per_degree}};
}

}  // namespace

std::shared_ptr<const FrameStage> glare_stage(const GlareChoice& choice, EffectWish wish,
                                              const NightDisplayParameters& shown) {
  return std::make_shared<const GlareStage>(choice, wish, shown);
}

}  // namespace scotopic
