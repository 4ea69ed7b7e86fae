// Stage detail: which of its filters, and what of the scene each is told.
#include <fmt/format.h>

#include "pipeline/stages/display_stages.h"
#include "pipeline/stages/stages.h"
#include "stages/acuity/cutoff.h"
#include "stages/acuity/filter.h"
#include "stages/acuity/local.h"
#include "stages/contrast/filter.h"
#include "stages/detail/description.h"

namespace scotopic {
namespace {

class DetailStage : public FilterStage {
 public:
  explicit DetailStage(const StageValues& values)
      : values_(values), shown_(night_parameters(values)), filter_(values.word<DetailFilter>("detail")) {}

  std::string_view name() const noexcept override { return detail_description.name; }
  EffectDecision decide(const StageScene& scene) const override;
  std::unique_ptr<SpatialFilter> make(const StageScene& scene, const Notes& notes) const override;
  std::vector<Attribute> stamps(const StageScene& scene) const override;

 private:
  double strength(const StageScene& scene) const {
    return values_.number("strength-detail") * scene.parameters.strength.all;
  }
  std::unique_ptr<SpatialFilter> contrast(const StageScene& scene) const;
  std::unique_ptr<SpatialFilter> bilateral(const StageScene& scene, const Notes& notes) const;

  StageValues values_;
  NightDisplayParameters shown_;
  DetailFilter filter_;
};

void decide_contrast(const StageScene& scene, double peak, EffectDecision& d) {
  const double adaptation = scene.parameters.adaptation;
  const contrast::ContrastNeed need =
      contrast::contrast_need(adaptation, scene.resolution.pixels_per_degree, peak);
  d.needed = need.needed;
  d.number = need.excess;
  d.threshold = contrast::negligible_excess;
  d.unit = "log10 contrast";
  d.reason = need.frequency == 0
                 ? fmt::format("the picture holds {:.3g} cycles/degree: no band of 2 or more",
                               scene.resolution.pixels_per_degree / 2)
                 : fmt::format(
                       "at {:.3g} cycles/degree the least contrast seen is {:.3g} log10 units above the "
                       "display's, {} {:g}",
                       need.frequency, need.excess, need.needed ? "not below" : "below", d.threshold);
}

void decide_acuity(const StageScene& scene, EffectDecision& d) {
  d.threshold = acuity_cutoff(scene.parameters.adaptation);
  d.number = scene.resolution.pixels_per_degree / 2;
  d.unit = "cycles/degree";
  d.needed = d.number > d.threshold;
  d.reason =
      d.needed ? fmt::format("the picture holds {:.3g} cycles/degree, the eye resolves {:.3g}", d.number,
                             d.threshold)
               : fmt::format("the picture holds {:.3g} cycles/degree, all of which the eye resolves ({:.3g})",
                             d.number, d.threshold);
}

EffectDecision DetailStage::decide(const StageScene& scene) const {
  const bool off = filter_ == DetailFilter::none || !(strength(scene) > 0);
  EffectDecision d = asked_at_resolution(values_, detail_description, values_.given("detail") && !off, scene);
  if (off) d.asked = d.left_out = false;
  if (!scene.resolution.known) return d;
  if (filter_ == DetailFilter::contrast)
    decide_contrast(scene, shown_.peak, d);
  else
    decide_acuity(scene, d);
  d.share = d.needed ? 1 : 0;
  return d;
}

std::unique_ptr<SpatialFilter> DetailStage::contrast(const StageScene& scene) const {
  const AppearanceParameters& seen = scene.parameters;
  NightDisplayParameters shown = shown_;
  shown.adaptation = seen.adaptation;
  shown.white_luminance = seen.white_luminance;
  ContrastParameters p;
  p.luminance = seen.xyz_from_rgb[1];
  p.unit = seen.white_luminance;
  p.adaptation = seen.adaptation;
  p.pixels_per_degree = scene.resolution.pixels_per_degree;
  const double exposure = scene.adapting ? scene.adapting->thresholds.exposure : 1;
  p.display = {exposure * display_scale(shown) * shown.peak / seen.white_luminance, shown.peak};
  p.strength = strength(scene);
  return std::make_unique<ContrastFilter>(p);
}

std::unique_ptr<SpatialFilter> DetailStage::bilateral(const StageScene& scene, const Notes& notes) const {
  const AppearanceParameters& seen = scene.parameters;
  const double ppd = scene.resolution.pixels_per_degree;
  const bool local = filter_ == DetailFilter::bilateral_local;
  AcuityParameters p;
  p.space = values_.word<AcuitySpace>("acuity-space");
  p.quality = values_.word<AcuityQuality>("acuity-quality");
  p.range_sigma = values_.number("acuity-range");
  p.strength = strength(scene);
  p.sigma = acuity_sigma_pixels(seen.adaptation, ppd);
  p.pixel_aspect = scene.resolution.pixel_aspect;
  p.white = seen.adaptation / middle_grey / seen.white_luminance;
  p.xyz_from_rgb = seen.xyz_from_rgb;
  notes.note(fmt::format("detail: {:.3g} cycles/degree are resolved, sigma {}{:.3g} pixels",
                         acuity_cutoff(seen.adaptation), local ? "up to " : "", p.sigma));
  if (!local) return std::make_unique<AcuityFilter>(p);
  return std::make_unique<LocalAcuityFilter>(
      LocalAcuityParameters{p, seen.adaptation, seen.white_luminance, ppd});
}

std::unique_ptr<SpatialFilter> DetailStage::make(const StageScene& scene, const Notes& notes) const {
  notes.note(fmt::format("{:.3g} pixels per degree ({})", scene.resolution.pixels_per_degree,
                         scene.resolution.source));
  return filter_ == DetailFilter::contrast ? contrast(scene) : bilateral(scene, notes);
}

std::vector<Attribute> DetailStage::stamps(const StageScene& scene) const {
  return {{"scotopic:detail", std::string(detail_words[static_cast<std::size_t>(filter_)])},
          {"scotopic:detailStrength", values_.number("strength-detail")},
          {"scotopic:detailPixelsPerDegree", scene.resolution.pixels_per_degree}};
}

}  // namespace

void add_detail(const StageValues& values, ImageSettings& settings) {
  settings.filter_stages.push_back(std::make_shared<const DetailStage>(values));
}

}  // namespace scotopic
