// What a shader's text says of itself, and what is left out of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <string>

#include "color/primaries.h"
#include "shaders/print/statements.h"
#include "shaders/record/recorded.h"
#include "shaders/shader.h"

namespace scotopic {
namespace {

ShaderSpec usual_spec() {
  ShaderSpec spec;
  spec.parameters.xyz_from_rgb = gamut_xyz_matrix("rec709").value();
  spec.parameters.xyz_from_gamut = spec.parameters.xyz_from_rgb;
  spec.space = "Linear Rec.709 (sRGB)";
  spec.gamut = "working";
  spec.version = "1.2.3";
  return spec;
}

bool has(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

TEST(ShaderText, says_what_goes_in_what_it_is_of_and_who_made_it) {
  for (const ShaderLanguageName& language : shader_languages) {
    const std::string text = shader_text(usual_spec(), language.language);
    for (const char* said : {"'Linear Rec.709 (sRGB)'", "scotopic 1.2.3", "filament2021",
                             "shift, luminance, chroma", "0.4123908 R", "no display stage", "2e-5"})
      EXPECT_TRUE(has(text, said)) << language.name << " does not say " << said;
  }
}

TEST(ShaderText, has_sliders_for_what_is_in_it_and_for_nothing_else) {
  struct Row {
    const char* slider;
    bool whole, chroma_alone, safko, displayed;
  };
  const Row rows[] = {
      {"adaptation", true, true, false, true},      {"white_luminance", true, true, true, true},
      {"strength_shift", true, false, false, true}, {"strength_luminance", true, false, false, true},
      {"strength_chroma", true, true, false, true}, {"strength_display", false, false, false, true},
      {"viewing", false, false, false, true},       {"peak", false, false, false, true}};
  ShaderSpec chroma = usual_spec(), safko = usual_spec(), displayed = usual_spec();
  chroma.parameters.strength = {1, 0, 0, 1};
  safko.parameters.model = Model::safko2019;
  displayed.display.emplace().xyz_from_display = displayed.parameters.xyz_from_rgb;
  const auto glsl = [](const ShaderSpec& spec) { return shader_text(spec, ShaderLanguage::glsl); };
  for (const Row& row : rows) {
    const std::string uniform = "uniform float " + std::string(row.slider) + " = ";
    EXPECT_EQ(has(glsl(usual_spec()), uniform), row.whole) << row.slider;
    EXPECT_EQ(has(glsl(chroma), uniform), row.chroma_alone) << row.slider;
    // White follows adaptation where it is not given.
    EXPECT_EQ(has(glsl(safko), uniform), row.safko || std::string(row.slider) == "adaptation") << row.slider;
    EXPECT_EQ(has(glsl(displayed), uniform), row.displayed) << row.slider;
  }
}

TEST(ShaderText, sliders_stand_where_the_parameters_are) {
  ShaderSpec spec = usual_spec();
  spec.parameters.adaptation = 0.01;
  spec.parameters.strength.chroma = 0.25;
  const std::string follows = shader_text(spec, ShaderLanguage::glsl);
  EXPECT_TRUE(has(follows, "uniform float adaptation = 0.01;")) << follows;
  EXPECT_TRUE(has(follows, "uniform float white_luminance = 0.0;"));
  EXPECT_TRUE(has(follows, "uniform float strength_chroma = 0.25;"));
  spec.white_from_adaptation = false;
  spec.parameters.white_luminance = 100;
  EXPECT_TRUE(has(shader_text(spec, ShaderLanguage::glsl), "uniform float white_luminance = 100.0;"));
  EXPECT_TRUE(has(shader_text(spec, ShaderLanguage::dctl), "DCTLUI_SLIDER_FLOAT, -2, -6, 4, 0.01)"));
}

TEST(ShaderText, is_ascii_and_the_same_in_every_locale) {
  for (const ShaderLanguageName& language : shader_languages) {
    const std::string text = shader_text(usual_spec(), language.language);
    EXPECT_TRUE(
        std::all_of(text.begin(), text.end(), [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); }));
    for (const char* locale : {"de_DE.UTF-8", "C.UTF-8"}) {
      if (!std::setlocale(LC_ALL, locale)) continue;
      EXPECT_EQ(shader_text(usual_spec(), language.language), text) << locale;
    }
    std::setlocale(LC_ALL, "C");
  }
}

TEST(ShaderText, a_name_from_a_config_stays_in_its_comment) {
  ShaderSpec spec = usual_spec();
  spec.space = "R\xc3\xa4umlich\nerror \\";
  spec.display.emplace().xyz_from_display = spec.parameters.xyz_from_rgb;
  spec.display_name = "a\rb\n#error";
  for (const ShaderLanguageName& language : shader_languages) {
    const std::string text = shader_text(spec, language.language);
    EXPECT_TRUE(has(text, "'R??umlich?error ?'")) << language.name;
    EXPECT_TRUE(has(text, "a?b?#error")) << language.name;
  }
}

TEST(ShaderText, of_nothing_hands_the_pixel_on) {
  ShaderSpec spec = usual_spec();
  spec.parameters.strength = {1, 0, 0, 0};
  EXPECT_TRUE(has(shader_text(spec, ShaderLanguage::dctl), "stages: none."));
}

using shaders::Graph;
using shaders::Recorded;

TEST(Recorded, numbers_alone_are_worked_out_at_once) {
  const Recorded x = (Recorded(2.0) + 3.0) * 4.0 - 1.0;
  EXPECT_EQ(x.graph(), nullptr);
  EXPECT_EQ(x.number(), 19);
  EXPECT_DOUBLE_EQ(log2(Recorded(8.0)).number(), 3);
  EXPECT_DOUBLE_EQ(log10(Recorded(0.01)).number(), -2);
  EXPECT_DOUBLE_EQ(exp2(Recorded(0.5)).number(), std::sqrt(2.0));
}

std::string written(shaders::Record& record, const Recorded& x) {
  record.out = {x.node_in(record.graph), x.node_in(record.graph), x.node_in(record.graph)};
  const shaders::Spelling c = {"f", "bool", "min", "max", "abs", "sqrt", "exp", "log", "pow"};
  const shaders::Statements s = statements_of(record, c);
  return s.of_pixel.empty() ? s.out[0] : s.of_pixel.back().expression;
}

TEST(Recorded, expressions_keep_their_order_and_have_the_parentheses_they_need) {
  shaders::Record record;
  Graph& g = record.graph;
  const Recorded r(g, g.input(0)), green(g, g.input(1)), b(g, g.input(2));
  EXPECT_EQ(written(record, r + green + b), "r + g + b");
  EXPECT_EQ(written(record, r + (green + b)), "r + (g + b)");
  EXPECT_EQ(written(record, r - (green - b)), "r - (g - b)");
  EXPECT_EQ(written(record, (r + green) * b), "(r + g) * b");
  EXPECT_EQ(written(record, r / (green / b)), "r / (g / b)");
  EXPECT_EQ(written(record, r * -2.0), "r * -2.0f");
  EXPECT_EQ(written(record, max(r, 0.5 * b)), "max(r, 0.5f * b)");
  EXPECT_EQ(written(record, chosen(either(both(r < b, b < green), r != b), r, 1.0)),
            "(r < b && b < g) || (r != b) ? r : 1.0f");
  EXPECT_EQ(written(record, chosen(without(r < b, green < b), r, green)), "g < b && !(r < b) ? r : g");
}

TEST(Recorded, what_a_matrix_has_no_part_in_is_left_out) {
  shaders::Record record;
  const Recorded r(record.graph, record.graph.input(0)), b(record.graph, record.graph.input(2));
  EXPECT_EQ(written(record, 0.0 * b + r * 2.0), "r * 2.0f");
  EXPECT_EQ(written(record, 1.0 * r + b), "r + b");
}

}  // namespace
}  // namespace scotopic
