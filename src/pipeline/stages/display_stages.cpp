#include "pipeline/stages/display_stages.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "base/error.h"

namespace scotopic {
namespace {

class NightRows : public RowStage {
 public:
  NightRows(const NightDisplayParameters& parameters, Precision precision) : batch_(parameters, precision) {}
  void apply(const PixelRows& rows, const RowSight&, std::uint8_t* touched) const override {
    batch_.apply(rows, touched);
  }

 private:
  DisplayBatch batch_;
};

/// The tone map's parameters in a scene.
DisplayParameters tone_parameters(const DisplayChoice& choice, const AppearanceParameters& scene,
                                  const Window& data, double exposure) {
  DisplayParameters p = choice.parameters;
  p.adaptation = scene.adaptation;
  p.white_luminance = scene.white_luminance;
  p.weight = scene.weight;
  p.strength = scene.strength.all;
  p.exposure = exposure;
  p.sigma = display_sigma(data.width(), data.height());
  p.xyz_from_rgb = scene.xyz_from_rgb;
  p.xyz_from_gamut = scene.xyz_from_gamut.value_or(scene.xyz_from_rgb);
  return p;
}

DisplayRange measured_range(const DisplayParameters& p, PixelSource& source, const ImageLayout& layout,
                            const ColourConfig& config, ImageStages stages) {
  const BaseLayer base(p);
  stages.filters.push_back(&base);
  return range_of(measure_base(source, layout, config, stages), p);
}

}  // namespace

NightDisplayParameters night_parameters(const StageValues& values) {
  NightDisplayParameters out;
  out.rule = values.number("visibility") == 0 ? VisibilityRule::hdrvdp2 : VisibilityRule::ward1997;
  out.viewing = values.number("viewing-adaptation");
  out.peak = values.number("peak");
  out.strength = values.number("strength-display");
  return out;
}

void refuse_idle_options(const DisplayChoice& choice, const ImageLayout& layout) {
  if (!layout.night && !choice.of_night.empty())
    throw Error(
        ExitCode::usage, "",
        choice.of_night + " is of the display stage, which this output has only with --display night");
}

void check_view(const ImageRequest& request, const ColourConfig& config, const Notes& notes) {
  if (!request.view) return;
  const std::string looks = config.looks_of(*config.view(*request.view).view);
  if (!looks.empty())
    notes.note(fmt::format("view '{}' applies a look of its own ({}), on top of this operator", *request.view,
                           looks));
}

ToneStage tone_stage(const DisplayChoice& choice, const AppearanceParameters& scene, PixelSource& source,
                     ImageLayout& layout, const ColourConfig& config, const ImageStages& stages,
                     const Notes& notes) {
  ToneStage out;
  if (!choice.tone) return out;
  const Window& data = source.subimages()[layout.light.front().index].data;
  const DisplayParameters p = tone_parameters(choice, scene, data, layout.exposure);
  layout.exposure = 0;
  const DisplayRange range = choice.range ? *choice.range : measured_range(p, source, layout, config, stages);
  auto filter = std::make_unique<DisplayFilter>(p, range);
  notes.note(
      fmt::format("{}: display: {:.3g} to {:.3g} cd/m2 of large shapes ({}) shown up to {:g} cd/m2, "
                  "their contrast to the power {:.2g}",
                  source.file(), range.low, range.high, choice.range ? "--display-range" : "measured", p.peak,
                  filter->compression()));
  out.stamps = {{"scotopic:displayLow", range.low},
                {"scotopic:displayHigh", range.high},
                {"scotopic:displayContrast", p.contrast},
                {"scotopic:displayPeak", p.peak},
                {"scotopic:displayNightRange", p.night_range},
                {"scotopic:displayNightExponent", p.night_exponent}};
  out.report = ToneReport{range.low, range.high, filter->compression(), p.sigma};
  out.filter = std::move(filter);
  return out;
}

NightStage night_stage(const StageValues& values, const AppearanceParameters& scene, Precision precision,
                       const std::string& file, ImageLayout& layout, const Notes& notes) {
  NightStage out;
  if (!layout.night) return out;
  NightDisplayParameters p = night_parameters(values);
  p.adaptation = scene.adaptation;
  p.white_luminance = scene.white_luminance * std::exp2(layout.exposure);
  p.xyz_from_rgb = scene.xyz_from_rgb;
  p.xyz_from_display = layout.night->xyz_from_display;
  const double scale = display_scale(p),
               stops = p.strength * visibility_stops(p.adaptation, p.rule, p.viewing);
  // By what the format can hold, not by what a frame holds: a shot does not change.
  if (layout.night->greatest > 0 && scale * layout.night->greatest <= 1 + 1e-6) p.shoulder = Shoulder::clip;
  layout.exposure = std::log2(p.peak / display_unit);
  out.rows = std::make_unique<const NightRows>(p, precision);
  notes.note(fmt::format(
      "{}: display '{}' of {:g} cd/m2: {:.2f} stops darker than by day, white is {:.3g} cd/m2 of the "
      "scene{}",
      file, layout.output_space.name, p.peak, std::abs(stops), scene.white_luminance / scale,
      p.shoulder == Shoulder::clip ? "" : ", brighter light bends towards it"));
  out.stamps = {{"scotopic:display", layout.output_space.name},
                {"scotopic:displayPeak", p.peak},
                {"scotopic:displayStops", stops},
                {"scotopic:displayVisibility",
                 std::string(p.rule == VisibilityRule::hdrvdp2 ? "hdrvdp2" : "ward1997")}};
  out.report = NightReport{layout.output_space.name, p.peak, stops, scale, p.shoulder == Shoulder::bend};
  return out;
}

}  // namespace scotopic
