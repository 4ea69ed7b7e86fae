// Stage noise on rows of pixels: where each row lies in the field, and when.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "batch/noise_batch.h"
#include "pipeline/stages/stages.h"
#include "stages/noise/description.h"
#include "stages/noise/field_rows.h"
#include "stages/noise/rod_noise.h"

namespace scotopic {
namespace {

RodNoiseParameters parameters_in(const StageValues& values, const StageScene& scene) {
  RodNoiseParameters p;
  p.eye = scene.parameters;
  p.pixels_per_degree = scene.resolution.pixels_per_degree;
  p.strength = values.number("strength-noise") * scene.parameters.strength.all;
  if (scene.adapting) {
    p.rod_adaptation = scene.adapting->thresholds.rod_luminance;
    p.bleach_light =
        std::max(0.0, scene.adapting->thresholds.rod_luminance - scene.adapting->state.rod_neural);
    p.exposure = scene.adapting->thresholds.exposure;
  }
  return p;
}

class NoiseRows : public RowStage {
 public:
  NoiseRows(const RodNoiseParameters& parameters, Precision precision, const noise::Field& field)
      : batch_(parameters, precision), field_(field), pixels_per_degree_(parameters.pixels_per_degree) {}

  bool asks_for_scene() const noexcept override { return true; }
  std::unique_ptr<RowMemory> memory() const override { return std::make_unique<Memory>(); }
  void apply(const PixelRows& rows, const RowSight& sight, std::uint8_t* touched) const override;

 private:
  struct Memory : RowMemory {
    std::optional<noise::FieldRows> field;
    std::vector<float> rod, local;
  };

  NoiseBatch batch_;
  noise::Field field_;
  double pixels_per_degree_;
};

void NoiseRows::apply(const PixelRows& rows, const RowSight& sight, std::uint8_t* touched) const {
  Memory& m = dynamic_cast<Memory&>(*sight.memory);
  const RowContext& at = sight.at;
  if (!m.field || m.field->width() != rows.count) {
    const noise::View view = {pixels_per_degree_, 0.5 * (at.display_x0 + at.display_x1),
                              0.5 * (at.display_y0 + at.display_y1), at.moment.seconds};
    m.field.emplace(field_, view, at.x, rows.count);
    m.rod.resize(rows.count);
    m.local.resize(rows.count);
  }
  batch_.receive(sight.scene, {m.rod.data(), m.local.data()});
  batch_.apply(rows, {m.rod.data(), m.local.data()}, m.field->row(at.y), touched);
}

class NoiseStage : public PointStage {
 public:
  explicit NoiseStage(const StageValues& values) : values_(values) {}

  std::string_view name() const noexcept override { return noise_description.name; }
  EffectDecision decide(const StageScene& scene) const override;
  std::unique_ptr<const RowStage> make(const StageScene& scene, const Notes& notes) const override;
  std::vector<Attribute> stamps(const StageScene& scene) const override;

 private:
  StageValues values_;
};

EffectDecision NoiseStage::decide(const StageScene& scene) const {
  EffectDecision d = asked_at_resolution(values_, noise_description, false, scene);
  const bool by_name = values_.wish(noise_description.name) == EffectWish::yes;
  if (!by_name && !scene.sequence) {
    d.asked = d.left_out = false;
    d.reason = "noise moves: not in a still, unless --effects names it";
  }
  const RodNoiseParameters p = parameters_in(values_, scene);
  if (!(p.strength > 0)) d.asked = d.left_out = false;
  if (!d.asked) return d;
  const RodNoiseNeed need = rod_noise_need(p);
  d.needed = need.needed;
  d.number = need.relative;
  d.threshold = p.hidden_fraction;
  d.reason = fmt::format("what few photons let rods' counts differ by is {:.3g} of their mean, {} {:g}",
                         need.relative, need.needed ? "above" : "not above", d.threshold);
  d.share = d.needed ? 1 : 0;
  return d;
}

std::unique_ptr<const RowStage> NoiseStage::make(const StageScene& scene, const Notes&) const {
  const RodNoiseParameters p = parameters_in(values_, scene);
  const auto seed = static_cast<std::uint64_t>(values_.number("seed"));
  const noise::Field field = scene.tracked ? rod_noise_octave_field(p, seed) : rod_noise_field(p, seed);
  return std::make_unique<const NoiseRows>(p, scene.precision, field);
}

std::vector<Attribute> NoiseStage::stamps(const StageScene& scene) const {
  return {{"scotopic:noiseStrength", values_.number("strength-noise")},
          {"scotopic:noiseSeed", values_.number("seed")},
          {"scotopic:noisePixelsPerDegree", scene.resolution.pixels_per_degree}};
}

}  // namespace

void add_noise(const StageValues& values, ImageSettings& settings) {
  settings.point_stages.push_back(std::make_shared<const NoiseStage>(values));
}

}  // namespace scotopic
