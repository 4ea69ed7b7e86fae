// Stage lamp: an eye that is used to a coloured lamp, before the receptors.
#include <fmt/format.h>

#include "pipeline/stages/stages.h"
#include "receptors/receptor_space.h"
#include "stages/lamp/description.h"
#include "stages/lamp/lamp.h"

namespace scotopic {
namespace {

class LampStage : public LightStage {
 public:
  explicit LampStage(const std::optional<Lamp>& lamp) : lamp_(lamp) {}

  std::string_view name() const noexcept override { return lamp_description.name; }

  EffectDecision decide(const StageScene& scene) const override {
    EffectDecision d{.effect = name(), .asked = lamp_.has_value()};
    d.reason = "no lamp is told (--adapt-white)";
    if (!d.asked) return d;
    d.number = lamp_degree(*lamp_, scene.parameters);
    d.needed = d.asked = changes_light(*lamp_, scene.parameters);
    d.share = d.needed ? 1 : 0;
    d.reason = d.needed ? fmt::format("the eye gets used to {:.3g} of the lamp's colour (x {:.4f}, y {:.4f})",
                                      d.number, lamp_->x(), lamp_->y())
                        : "the lamp is D65, or nothing of it is got used to";
    return d;
  }

  LightMatrices matrices(const StageScene& scene) const override {
    const Matrix3<double> m = lamp_matrix(*lamp_, scene.parameters);
    const Matrix3<double>& xyz = scene.parameters.xyz_from_rgb;
    return {inverse(xyz) * (m * xyz), lms_from_xyz() * (m * xyz_from_lms()), xyz[1]};
  }

  std::vector<Attribute> stamps(const StageScene& scene) const override {
    return {{"scotopic:adaptWhite", fmt::format("{:.5f} {:.5f}", lamp_->x(), lamp_->y())},
            {"scotopic:adaptWhiteDegree", lamp_degree(*lamp_, scene.parameters)}};
  }

 private:
  std::optional<Lamp> lamp_;
};

}  // namespace

void add_lamp(const StageValues&, ImageSettings& settings) {
  settings.light_stages.push_back(std::make_shared<const LampStage>(lamp_of(settings.choice)));
}

}  // namespace scotopic
