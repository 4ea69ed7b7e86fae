// Stage time: what an eye sees that is still adapting, and what all stages have in common of it.
#include <fmt/format.h>

#include <cmath>

#include "pipeline/stages/stages.h"
#include "stages/limits.h"
#include "stages/time/description.h"

namespace scotopic {
namespace {

class ExposureRows : public RowStage {
 public:
  explicit ExposureRows(double exposure) : exposure_(static_cast<float>(exposure)) {}
  void apply(const PixelRows& rows, const RowSight&, std::uint8_t* touched) const override {
    for (std::size_t i = 0; i < rows.count; ++i) {
      const auto operable = [](float x) { return std::abs(x) <= static_cast<float>(operable_limit); };
      if (!operable(rows.r[i]) || !operable(rows.g[i]) || !operable(rows.b[i])) continue;
      rows.r[i] *= exposure_;
      rows.g[i] *= exposure_;
      rows.b[i] *= exposure_;
      touched[i] = 1;
    }
  }

 private:
  float exposure_;
};

class TimeStage : public PointStage {
 public:
  std::string_view name() const noexcept override { return time_description.name; }

  EffectDecision decide(const StageScene& scene) const override {
    EffectDecision d{.effect = name(), .asked = scene.adapting.has_value(), .unit = "times"};
    d.threshold = 0.01;
    d.reason = "the eye has been in this light for ever (--adaptation-history)";
    if (!d.asked) return d;
    const AdaptationThresholds& t = scene.adapting->thresholds;
    d.needed = adaptation_is_called_for(t, scene.parameters.adaptation);
    d.number = std::abs(t.exposure - 1);
    d.share = d.needed ? 1 : 0;
    d.reason = fmt::format(
        "rods are as in {:.3g} cd/m2, cones in {:.3g}, what is seen is {:.3g} of what an "
        "adapted eye sees{}",
        t.rod_luminance, t.cone_luminance, t.exposure, d.needed ? "" : ": within 1 %");
    return d;
  }

  /// A mixture in linear light, as --strength is.
  static double exposure(const StageScene& scene) {
    return 1 + scene.parameters.strength.all * (scene.adapting->thresholds.exposure - 1);
  }

  std::unique_ptr<const RowStage> make(const StageScene& scene, const Notes&) const override {
    return std::make_unique<const ExposureRows>(exposure(scene));
  }

  std::vector<Attribute> stamps(const StageScene& scene) const override {
    const AdaptationThresholds& t = scene.adapting->thresholds;
    return {{"scotopic:timeExposure", t.exposure},
            {"scotopic:timeEquivalentLuminance", t.rod_luminance},
            {"scotopic:timeRodLog10Threshold", t.rod_log10},
            {"scotopic:timeConeLog10Threshold", t.cone_log10}};
  }
};

}  // namespace

void add_time(const StageValues&, ImageSettings& settings) {
  settings.point_stages.push_back(std::make_shared<const TimeStage>());
}

}  // namespace scotopic
