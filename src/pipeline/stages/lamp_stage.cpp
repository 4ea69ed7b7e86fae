// Stage lamp: an eye that is used to a coloured lamp, before the receptors.
#include <fmt/format.h>

#include "adaptation/chromatic_adaptation.h"
#include "pipeline/stages/stages.h"
#include "receptors/receptor_space.h"
#include "stages/lamp/description.h"

namespace scotopic {
namespace {

constexpr double surrounds[] = {average_surround, dim_surround, dark_surround};

class LampStage : public LightStage {
 public:
  LampStage(const StageValues& values, const std::optional<Vec3<double>>& lamp)
      : surround_(surrounds[static_cast<std::size_t>(values.number("surround"))]), lamp_(lamp) {}

  std::string_view name() const noexcept override { return lamp_description.name; }

  EffectDecision decide(const StageScene& scene) const override {
    EffectDecision d{.effect = name(), .asked = lamp_.has_value()};
    d.reason = "no lamp is told (--adapt-white)";
    if (!d.asked) return d;
    d.number = degree(scene);
    d.needed = d.asked = adapt_to_lamp(*lamp_, d.number).rows != identity3<double>().rows;
    d.share = d.needed ? 1 : 0;
    d.reason = d.needed ? fmt::format("the eye gets used to {:.3g} of the lamp's colour (x {:.4f}, y {:.4f})",
                                      d.number, (*lamp_)[0] / sum(), (*lamp_)[1] / sum())
                        : "the lamp is D65, or nothing of it is got used to";
    return d;
  }

  LightMatrices matrices(const StageScene& scene) const override {
    const Matrix3<double> m = adapt_to_lamp(*lamp_, degree(scene));
    const Matrix3<double>& xyz = scene.parameters.xyz_from_rgb;
    return {inverse(xyz) * (m * xyz), lms_from_xyz() * (m * xyz_from_lms()), xyz[1]};
  }

  std::vector<Attribute> stamps(const StageScene& scene) const override {
    return {{"scotopic:adaptWhite", fmt::format("{:.5f} {:.5f}", (*lamp_)[0] / sum(), (*lamp_)[1] / sum())},
            {"scotopic:adaptWhiteDegree", degree(scene)}};
  }

 private:
  double degree(const StageScene& scene) const {
    return scene.parameters.strength.all * adaptation_degree(scene.parameters.adaptation, surround_);
  }
  double sum() const { return (*lamp_)[0] + (*lamp_)[1] + (*lamp_)[2]; }

  double surround_;
  std::optional<Vec3<double>> lamp_;
};

}  // namespace

void add_lamp(const StageValues& values, ImageSettings& settings) {
  settings.light_stages.push_back(std::make_shared<const LampStage>(values, settings.choice.lamp));
}

}  // namespace scotopic
