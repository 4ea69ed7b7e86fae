// Stage glare on whole pictures: what of a scene scatters in the eye.
#include <algorithm>
#include <stdexcept>

#include "base/error.h"
#include "pipeline/stages/stages.h"
#include "stages/glare/description.h"
#include "stages/glare/filter.h"

namespace scotopic {
namespace {

class GlareStage : public FrameStage {
 public:
  GlareStage(const StageValues& values, const NightDisplayParameters& shown)
      : values_(values),
        shown_(shown),
        off_(values.word<Word>("glare") == Word::none),
        rule_(values.word<Word>("glare") == Word::all ? GlareRule::all : GlareRule::above) {}

  std::string_view name() const noexcept override { return glare_description.name; }
  EffectDecision decide(const StageScene& scene) const override;
  std::int64_t bytes(const FrameSize& size, const StageScene& scene) const override;
  FrameOutcome run(const FramePlanes& light, const StageScene& scene,
                   const ParallelFor& parallel_for) const override;
  std::vector<Attribute> stamps(const StageScene& scene) const override;

 private:
  enum class Word { above, all, none };

  double strength(const StageScene& scene) const {
    return values_.number("strength-glare") * scene.parameters.strength.all;
  }
  double threshold(const StageScene& scene) const;
  GlareFilter filter(int width, int height, double threshold, const StageScene& scene) const;

  StageValues values_;
  NightDisplayParameters shown_;
  bool off_;
  GlareRule rule_;
};

EffectDecision GlareStage::decide(const StageScene& scene) const {
  const bool named = values_.given("glare") && !off_;
  EffectDecision d = asked_at_resolution(values_, glare_description, named, scene);
  d.unit = "pixels";
  if (off_ || !(strength(scene) > 0)) d.asked = false;
  return d;
}

// Image units: what the display cannot show.
double GlareStage::threshold(const StageScene& scene) const {
  if (values_.number("glare-threshold") > 0) return values_.number("glare-threshold");
  NightDisplayParameters shown = shown_;
  shown.adaptation = scene.parameters.adaptation;
  shown.white_luminance = scene.parameters.white_luminance;
  return 1 / display_scale(shown);
}

GlareFilter GlareStage::filter(int width, int height, double threshold, const StageScene& scene) const {
  GlareParameters p;
  p.eye.age = values_.number("age");
  p.eye.pigmentation = values_.number("pigmentation");
  p.rule = rule_;
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
  return {{"scotopic:glareThreshold", rule_ == GlareRule::all ? 0.0 : threshold(scene)},
          {"scotopic:glareAge", values_.number("age")},
          {"scotopic:glarePigmentation", values_.number("pigmentation")},
          {"scotopic:glareStrength", values_.number("strength-glare")},
          {"scotopic:glarePixelsPerDegree", scene.resolution.pixels_per_degree}};
}

}  // namespace

void add_glare(const StageValues& values, ImageSettings& settings) {
  settings.frame_stages.push_back(std::make_shared<const GlareStage>(values, settings.display.night));
}

}  // namespace scotopic
