#include "shaders/record/record.h"

#include "shaders/record/recorder-inl.h"
#include "stages/display/night_display-inl.h"
#include "stages/pixel_stages-inl.h"

namespace scotopic::shaders {
namespace {

namespace formulas = HWY_NAMESPACE;
using formulas::Recorder;
using Colour = formulas::Triple<Recorded>;

/// Sliders as nodes. The white that the user leaves at 0 follows adaptation.
class Sliders {
 public:
  explicit Sliders(Graph& graph) : graph_(&graph) {
    const Recorded white = (*this)(Slider::white_luminance);
    white_ = chosen(white > 0.0, white, (*this)(Slider::adaptation) / middle_grey);
  }
  Recorded operator()(Slider slider) const { return {*graph_, graph_->parameter(static_cast<int>(slider))}; }
  Recorded white() const { return white_; }

 private:
  Graph* graph_;
  Recorded white_;
};

/// Strength 0 of all would switch the stages off that its slider is to bring back.
AppearanceParameters all_switched_on(AppearanceParameters p) {
  p.strength.all = 1;
  return p;
}

Bindings bindings_of(const StageConstants<float>& k, const OperatorConstants& c, const Sliders& slider) {
  Bindings out;
  out.name(k.weight, "weight");
  out.name(k.shift, "shift");
  out.name(k.luminance, "luminance");
  out.name(k.chroma, "chroma");
  out.name(k.mix, "strength");
  out.bind(k.weight.unit, slider.white());
  out.bind(k.weight.luminance_rounding, 0x1p-20 * slider.white());
  out.bind(k.weight.adaptation, slider(Slider::adaptation));
  const Vec3<double> gain = kernel_preset(c.parameters.model).gain;
  const Recorded kernel_units = kernel_scale_at(c.parameters, slider(Slider::adaptation)) * slider.white();
  for (std::size_t i = 0; i < 3; ++i) out.bind(k.shift.gain[i], gain[i] * kernel_units);
  out.bind(k.shift.strength, slider(Slider::strength_shift));
  out.bind(k.luminance.left, 1.0 - slider(Slider::strength_luminance));
  out.bind(k.chroma.strength, slider(Slider::strength_chroma));
  out.bind(k.mix, slider(Slider::strength));
  return out;
}

Colour stages_of(Graph& graph, const ShaderSpec& spec, const Sliders& slider, const Colour& rgb) {
  const OperatorConstants c(all_switched_on(spec.parameters));
  const StageConstants<float> k(c);
  StageSwitches on(c);
  on.mix = !on.safko;
  const Bindings bindings = bindings_of(k, c, slider);
  const Recorder n(graph, bindings);
  const formulas::PixelStages<Recorder> see(n, k, on);
  const formulas::PixelIn<Recorded> in{rgb, {}, {}, false, false};
  formulas::PixelStages<Recorder>::Seen seen{{}, false, false};
  see(in, seen);
  return select(n, seen.active, seen.rgb, rgb);
}

Bindings bindings_of(const DisplayConstants<float>& k, const NightDisplayParameters& p,
                     const Sliders& slider) {
  const Recorded scale = display_scale(
      DisplayLight<Recorded>{slider(Slider::adaptation), slider.white(), slider(Slider::viewing),
                             slider(Slider::peak), slider(Slider::strength_display)},
      p.rule);
  Bindings out;
  out.name(k, "display");
  out.bind(k.scale, scale);
  const Matrix3<double> to_display = inverse(p.xyz_from_display) * p.xyz_from_rgb;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out.bind(k.display_from_rgb[i][j], scale * to_display[i][j]);
  return out;
}

Colour displayed(Graph& graph, const NightDisplayParameters& p, const Sliders& slider, const Colour& rgb) {
  graph.enter("display");
  const DisplayConstants<float> k(p);
  const DisplaySwitches on(p);
  const Bindings bindings = bindings_of(k, p, slider);
  const Recorder n(graph, bindings);
  const auto operable = [](const Recorded& x) { return abs(x) <= operable_limit; };
  const RecordedTruth finite = both(both(operable(rgb.x), operable(rgb.y)), operable(rgb.z));
  return select(n, finite, night_display(n, k, on, rgb), rgb);
}

SliderValues defaults_of(const ShaderSpec& spec) {
  const AppearanceParameters& p = spec.parameters;
  const NightDisplayParameters d = spec.display.value_or(NightDisplayParameters{});
  return {p.adaptation,
          spec.white_from_adaptation ? 0.0 : p.white_luminance,
          p.strength.all,
          p.strength.shift,
          p.strength.luminance,
          p.strength.chroma,
          d.strength,
          d.viewing,
          d.peak};
}

}  // namespace

Record record_of(const ShaderSpec& spec) {
  Record out;
  out.defaults = defaults_of(spec);
  Graph& graph = out.graph;
  const Sliders slider(graph);
  const Colour rgb = {{graph, graph.input(0)}, {graph, graph.input(1)}, {graph, graph.input(2)}};
  Colour seen = stages_of(graph, spec, slider, rgb);
  if (spec.display) {
    NightDisplayParameters display = *spec.display;
    display.xyz_from_rgb = spec.parameters.xyz_from_rgb;
    seen = displayed(graph, display, slider, seen);
  }
  out.out = {seen.x.node_in(graph), seen.y.node_in(graph), seen.z.node_in(graph)};
  return out;
}

}  // namespace scotopic::shaders
