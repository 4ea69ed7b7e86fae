// Stage glare on whole pictures: what of a scene scatters in the eye.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "adaptation/pupil.h"
#include "base/error.h"
#include "pipeline/stages/display_stages.h"
#include "pipeline/stages/stages.h"
#include "stages/glare/description.h"
#include "stages/glare/filter.h"
#include "stages/glare/halo.h"

namespace scotopic {
namespace {

class GlareStage : public FrameStage {
 public:
  GlareStage(const StageValues& values, bool measure)
      : values_(values),
        shown_(night_parameters(values)),
        measure_(measure),
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
  GlareEye eye() const { return {values_.number("age"), values_.number("pigmentation"), 0}; }
  double halo(const StageScene& scene) const;
  double threshold(const StageScene& scene) const;
  GlareFilter filter(int width, int height, double threshold, const StageScene& scene) const;

  StageValues values_;
  NightDisplayParameters shown_;
  bool measure_;
  bool off_;
  GlareRule rule_;
};

EffectDecision GlareStage::decide(const StageScene& scene) const {
  const bool named = values_.given("glare") && !off_;
  EffectDecision d = asked_at_resolution(values_, glare_description, named, scene);
  d.unit = "pixels";
  if (off_ || !(strength(scene) > 0)) d.asked = d.left_out = false;
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

// Wide pupils alone show it.
double GlareStage::halo(const StageScene& scene) const {
  return values_.number("glare-halo") * halo_share(pupil_diameter_mm(scene.parameters.adaptation));
}

GlareFilter GlareStage::filter(int width, int height, double threshold, const StageScene& scene) const {
  GlareParameters p;
  p.eye = eye();
  p.eye.halo = halo(scene);
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
  StageScene dark = scene;  // a wide pupil, whose halo takes memory
  dark.parameters.adaptation = 0;
  const GlareFilter any = filter(size.width, size.height, 1, dark);  // its memory depends on no threshold
  const std::int64_t measured = measure_ ? std::int64_t{8} * size.width * size.height : 0;  // see veil_text()
  return measured + static_cast<std::int64_t>(any.bytes(size.planes, size.threads));
}

/// Luminance of each pixel, cd/m2; NaN where it has none.
std::vector<float> luminances(const FramePlanes& light, const AppearanceParameters& scene) {
  const Vec3<double>& y = scene.xyz_from_rgb[1];
  std::vector<float> out;
  out.reserve(static_cast<std::size_t>(light.width) * static_cast<std::size_t>(light.height));
  for (int row = 0; row < light.height; ++row)
    for (int x = 0; x < light.width; ++x) {
      const std::ptrdiff_t at = row * light.stride + x;
      const double sum =
          y[0] * double{light.rgb[0][at]} + y[1] * double{light.rgb[1][at]} + y[2] * double{light.rgb[2][at]};
      out.push_back(static_cast<float>(sum * scene.white_luminance));
    }
  return out;
}

/// What was added to the luminances `before`: the largest share of what is under it (of a thousandth of what
/// the display shows, where that is more), and the median.
std::string veil_text(std::vector<float>& before, const std::vector<float>& after, double shown) {
  double largest = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double veil = double{after[i]} - double{before[i]};
    const double under = std::max(double{before[i]}, 1e-3 * shown);
    if (std::isfinite(veil)) largest = std::max(largest, veil / under);
    before[i] = std::isfinite(veil) ? static_cast<float>(veil) : 0.0f;
  }
  const auto middle = before.begin() + static_cast<std::ptrdiff_t>(before.size() / 2);
  std::nth_element(before.begin(), middle, before.end());
  return fmt::format("the veil is at most {:.3g} times what is under it, {:.3g} cd/m2 in the median pixel",
                     largest, *middle);
}

FrameOutcome GlareStage::run(const FramePlanes& light, const StageScene& scene,
                             const ParallelFor& parallel_for) const {
  GlarePicture picture;
  std::copy(light.rgb.begin(), light.rgb.end(), picture.rgb.begin());
  picture.light.assign(light.rgb.begin(), light.rgb.end());
  if (light.receptors[0])
    picture.light.insert(picture.light.end(), light.receptors.begin(), light.receptors.end());
  picture.stride = light.stride;
  picture.greatest = light.greatest;
  const double t = threshold(scene), shown = t * scene.parameters.white_luminance;
  const GlareFilter glare = filter(light.width, light.height, t, scene);
  const Vec3<double>& y = scene.parameters.xyz_from_rgb[1];
  const GlareNeed need = glare.need(picture, {y[0], y[1], y[2]}, parallel_for);
  std::vector<float> before =
      measure_ && need.called_for ? luminances(light, scene.parameters) : std::vector<float>();
  if (need.called_for) glare.apply(picture, parallel_for);
  FrameOutcome out = {need.called_for, need.reason, static_cast<double>(need.above)};
  if (!before.empty()) out.reason = veil_text(before, luminances(light, scene.parameters), shown);
  if (measure_ && rule_ == GlareRule::above)
    out.reason += fmt::format("; {} pixels are above {:.3g} cd/m2", need.above, shown);
  if (measure_)
    out.reason +=
        fmt::format("; this eye scatters {:.3g} times what the default eye does, 3 degrees from a lamp",
                    GlareFunction(eye()).psf(3) / GlareFunction(GlareEye()).psf(3));
  return out;
}

std::vector<Attribute> GlareStage::stamps(const StageScene& scene) const {
  return {{"scotopic:glareThreshold", rule_ == GlareRule::all ? 0.0 : threshold(scene)},
          {"scotopic:glareAge", values_.number("age")},
          {"scotopic:glarePigmentation", values_.number("pigmentation")},
          {"scotopic:glareHalo", values_.number("glare-halo")},
          {"scotopic:glareStrength", values_.number("strength-glare")},
          {"scotopic:glarePixelsPerDegree", scene.resolution.pixels_per_degree}};
}

}  // namespace

void add_glare(const StageValues& values, ImageSettings& settings) {
  settings.frame_stages.push_back(std::make_shared<const GlareStage>(values, settings.measure));
}

}  // namespace scotopic
