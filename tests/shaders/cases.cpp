#include "shaders/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "adaptation/named_adaptations.h"
#include "color/primaries.h"
#include "stages/reference.h"

namespace scotopic::test {
namespace {

using shaders::Slider;
using shaders::SliderValues;

ShaderSpec usual(const Matrix3<double>& xyz_from_rgb) {
  ShaderSpec spec;
  spec.parameters.xyz_from_rgb = xyz_from_rgb;
  spec.parameters.xyz_from_gamut = xyz_from_rgb;
  spec.space = "test";
  spec.gamut = "working";
  spec.version = "0";
  return spec;
}

template <class Change>
ShaderCase case_of(const std::string& name, const Matrix3<double>& primaries, Change change) {
  ShaderCase out{name, usual(primaries)};
  change(out.spec);
  return out;
}

NightDisplayParameters display_of(const ShaderSpec& spec, VisibilityRule rule) {
  NightDisplayParameters out;
  out.rule = rule;
  out.xyz_from_rgb = spec.parameters.xyz_from_rgb;
  out.xyz_from_display = gamut_xyz_matrix("rec709").value();
  return out;
}

double largest(const double* v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }

double of(const SliderValues& values, Slider slider) { return values[static_cast<std::size_t>(slider)]; }

AppearanceParameters parameters_at(const ShaderSpec& spec, const SliderValues& s) {
  AppearanceParameters p = spec.parameters;
  const double white = of(s, Slider::white_luminance);
  p.adaptation = of(s, Slider::adaptation);
  p.white_luminance = white > 0 ? white : p.adaptation / middle_grey;
  p.strength = {of(s, Slider::strength), p.strength.shift * of(s, Slider::strength_shift),
                p.strength.luminance * of(s, Slider::strength_luminance),
                p.strength.chroma * of(s, Slider::strength_chroma)};
  return p;
}

NightDisplayParameters display_at(const ShaderSpec& spec, const SliderValues& s) {
  NightDisplayParameters d = *spec.display;
  d.adaptation = of(s, Slider::adaptation);
  d.white_luminance = parameters_at(spec, s).white_luminance;
  d.viewing = of(s, Slider::viewing);
  d.peak = of(s, Slider::peak);
  d.strength = of(s, Slider::strength_display);
  return d;
}

void add_levels(Pixels& out, const std::vector<Vec3<double>>& hues) {
  for (int stop = -16; stop <= 12; ++stop)
    for (const Vec3<double>& hue : hues)
      for (const double x : hue) out.push_back(static_cast<float>(x * std::exp2(stop)));
}

}  // namespace

const std::vector<ShaderCase>& shader_cases() {
  static const std::vector<ShaderCase> all = [] {
    const Matrix3<double> rec709 = gamut_xyz_matrix("rec709").value(), ap1 = gamut_xyz_matrix("ap1").value();
    const auto off = [](ShaderSpec& s) -> Strengths& { return s.parameters.strength = {1, 0, 0, 0}; };
    return std::vector<ShaderCase>{
        case_of("shift", rec709, [&](ShaderSpec& s) { off(s).shift = 1; }),
        case_of("shift, gamut rec709 of ap1", ap1,
                [&](ShaderSpec& s) {
                  off(s).shift = 1;
                  s.parameters.xyz_from_gamut = rec709;
                }),
        case_of("shift, no gamut", rec709,
                [&](ShaderSpec& s) {
                  off(s).shift = 1;
                  s.parameters.xyz_from_gamut.reset();
                }),
        case_of("luminance mesopic", rec709, [&](ShaderSpec& s) { off(s).luminance = 1; }),
        case_of("chroma", rec709, [&](ShaderSpec& s) { off(s).chroma = 1; }),
        case_of("filament2021, all", rec709, [](ShaderSpec&) {}),
        case_of("filament2021, all, of ap1", ap1, [](ShaderSpec&) {}),
        case_of("kirk2011, all", rec709, [](ShaderSpec& s) { s.parameters.model = Model::kirk2011; }),
        case_of("cao2008, all", rec709, [](ShaderSpec& s) { s.parameters.model = Model::cao2008; }),
        case_of("safko2019", rec709,
                [](ShaderSpec& s) {
                  s.parameters.model = Model::safko2019;
                  s.parameters.safko_scale = 20;
                }),
        case_of("global weight, photopic", rec709,
                [](ShaderSpec& s) {
                  s.parameters.weight = Weight::global;
                  s.parameters.luminance = LuminancePolicy::photopic;
                }),
        case_of("quadratic rods, S/P 1.4", rec709,
                [](ShaderSpec& s) {
                  s.parameters.rods = RodEstimate::quadratic;
                  s.parameters.sp_ratio = 1.4;
                }),
        case_of("all, display hdrvdp2", rec709,
                [](ShaderSpec& s) { s.display = display_of(s, VisibilityRule::hdrvdp2); }),
        case_of("all, display ward1997, of ap1", ap1,
                [](ShaderSpec& s) { s.display = display_of(s, VisibilityRule::ward1997); }),
        case_of("display alone", rec709,
                [&](ShaderSpec& s) {
                  off(s);
                  s.display = display_of(s, VisibilityRule::hdrvdp2);
                }),
    };
  }();
  return all;
}

const Pixels& light() {
  static const Pixels pixels = [] {
    std::vector<Vec3<double>> hues;
    for (const double g : {0.0, 0.02, 0.3, 0.9, 1.0})
      for (const double b : {0.0, 0.02, 0.3, 0.9, 1.0}) {
        hues.push_back({1, g, b});
        hues.push_back({g, 1, b});
        hues.push_back({b, g, 1});
      }
    Pixels out;
    add_levels(out, hues);
    out.insert(out.end(), {0, 0, 0});
    return out;
  }();
  return pixels;
}

const Pixels& beyond_gamut() {
  static const Pixels pixels = [] {
    std::vector<Vec3<double>> hues;
    for (const double less : {-0.02, -0.1, -0.25})
      for (const double other : {-0.02, 0.0, 0.4, 1.0}) {
        hues.push_back({less, 1, other});
        hues.push_back({other, 1, less});
        hues.push_back({1, less, std::max(other, 0.0)});
        hues.push_back({1, std::max(other, 0.0), less});
      }
    Pixels out;
    add_levels(out, hues);
    return out;
  }();
  return pixels;
}

const Pixels& remnants() {
  static const Pixels pixels = [] {
    std::vector<Vec3<double>> hues;
    // Red against green and blue against both, to luminances of Rec.709 around 0.
    for (const double off : {-0.01, -1e-4, 0.0, 1e-5, 1e-3, 0.03}) {
      hues.push_back({1, -0.2126 / 0.7152 + off, 0});
      hues.push_back({-0.0722 / 0.2126 + off, 0, 1});
      hues.push_back({0.2, -(0.0722 + 0.2126 * 0.2) / 0.7152 + off, 1});
      hues.push_back({-1, 0.2126 / 0.7152 + off, 0});
    }
    Pixels out;
    add_levels(out, hues);
    return out;
  }();
  return pixels;
}

std::vector<SliderValues> settings_of(const ShaderSpec& spec) {
  std::vector<double> adaptations = {1e-5, 4.9, 100};
  for (const NamedAdaptation& step : named_adaptations) adaptations.push_back(step.adaptation);
  std::vector<SliderValues> out;
  const auto add = [&](double adaptation, double white, const std::array<double, 4>& strengths,
                       double display) {
    out.push_back({adaptation, white, strengths[0], strengths[1], strengths[2], strengths[3], display,
                   display == 1 ? viewing_adaptation : 30.0, display == 1 ? 100.0 : 1000.0});
  };
  for (const double adaptation : adaptations) {
    add(adaptation, 100, {1, 1, 1, 1}, 1);
    add(adaptation, 0, {1, 1, 1, 1}, 1);
    if (spec.display) add(adaptation, 0, {1, 1, 1, 1}, 0);
    for (std::size_t i = 0; i < 4; ++i)
      for (const double strength : {0.0, 0.5}) {
        std::array<double, 4> strengths = {1, 1, 1, 1};
        strengths[i] = strength;
        add(adaptation, 0, strengths, 0.5);
      }
    add(adaptation, 0, {0.9, 0.75, 0.25, 0.6}, 0.3);
  }
  return out;
}

std::vector<double> wanted(const ShaderSpec& spec, const SliderValues& sliders, const Pixels& pixels) {
  const AppearanceReference see(parameters_at(spec, sliders));
  std::vector<double> out;
  for (std::size_t i = 0; i < pixels.size(); i += 3) {
    Vec3<double> seen = see({{pixels[i], pixels[i + 1], pixels[i + 2]}, {}, {}});
    if (spec.display) seen = night_display(display_at(spec, sliders), seen);
    out.insert(out.end(), seen.begin(), seen.end());
  }
  return out;
}

Worst worst_of(const ShaderSpec& spec, const Pixels& pixels, const Shown& shown) {
  Worst worst;
  for (const SliderValues& sliders : settings_of(spec)) {
    const std::vector<double> want = wanted(spec, sliders, pixels);
    const Pixels got = shown(sliders, pixels);
    if (got.size() != want.size())
      return {std::numeric_limits<double>::infinity(), "another number of pixels"};
    for (std::size_t i = 0; i < want.size(); i += 3) {
      Vec3<double> in = {pixels[i], pixels[i + 1], pixels[i + 2]};
      if (spec.display) in = night_display(display_at(spec, sliders), in);
      const double scale = std::max({largest(&want[i]), largest(in.data()), 1e-30});
      for (std::size_t c = 0; c < 3; ++c) {
        const double error = std::abs(static_cast<double>(got[i + c]) - want[i + c]) / scale;
        if (!(error > worst.error) && !std::isnan(error)) continue;
        worst.error = std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
        worst.place =
            fmt::format("({:.4g}, {:.4g}, {:.4g}) at La {:g}, W {:g}, strengths {:g} {:g} {:g} {:g} {:g}",
                        pixels[i], pixels[i + 1], pixels[i + 2], sliders[0], sliders[1], sliders[2],
                        sliders[3], sliders[4], sliders[5], sliders[6]);
      }
    }
  }
  return worst;
}

}  // namespace scotopic::test
