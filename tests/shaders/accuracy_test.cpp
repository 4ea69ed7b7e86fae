// Shaders against the operator in double, in every language that something here compiles: the table of their
// errors.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "shaders/hosts.h"
#include "shaders/osl_grammar.h"

namespace scotopic {
namespace {

using test::Host;
using test::ShaderCase;
using Made = std::function<std::unique_ptr<Host>(const std::string& text)>;

/// Of the pixel's largest component.
constexpr double tolerance = 2e-5;
/// Where the batch computes in double, which shaders have not got: colours of no light.
constexpr double tolerance_of_remnants = 5e-3;

struct Row {
  std::string name;
  const test::Pixels* pixels;
  double tolerance;
};
std::vector<Row> rows_of(const ShaderCase& c) {
  return {{c.name, &test::light(), tolerance},
          {c.name + " *", &test::beyond_gamut(), tolerance},
          {c.name + " **", &test::remnants(), tolerance_of_remnants}};
}

void expect_exact(const std::string& host, ShaderLanguage language, const Made& made) {
  std::puts("* outside the gamut, ** left over from a cancellation");
  std::printf("%-14s | %-32s | %-8s | %s\n", "language", "stages", "worst", "where");
  for (const ShaderCase& c : test::shader_cases()) {
    const std::unique_ptr<Host> shader = made(shader_text(c.spec, language));
    const test::Shown shown = [&](const auto& sliders, const auto& pixels) {
      return shader->show(sliders, pixels);
    };
    for (const Row& row : rows_of(c)) {
      const test::Worst worst = test::worst_of(c.spec, *row.pixels, shown);
      std::printf("%-14s | %-32s | %-8.2g | %s\n", host.c_str(), row.name.c_str(), worst.error,
                  worst.place.c_str());
      EXPECT_LE(worst.error, row.tolerance) << host << ", " << row.name << ": " << worst.place;
    }
  }
}

TEST(Shaders, dctl_compiled_by_gcc_is_the_operator_to_2e_5) {
  expect_exact("dctl, g++", ShaderLanguage::dctl,
               [](const std::string& text) { return test::dctl_host("g++", text); });
}

TEST(Shaders, dctl_compiled_by_clang_is_the_operator_to_2e_5) {
  if (!test::have("clang++")) GTEST_SKIP() << "NOTICE: clang++ is not installed, not tested with it";
  expect_exact("dctl, clang++", ShaderLanguage::dctl,
               [](const std::string& text) { return test::dctl_host("clang++", text); });
}

TEST(Shaders, blink_compiled_by_gcc_is_the_operator_to_2e_5) {
  expect_exact("blink, g++", ShaderLanguage::blink,
               [](const std::string& text) { return test::blink_host("g++", text); });
}

TEST(Shaders, blink_compiled_by_clang_is_the_operator_to_2e_5) {
  if (!test::have("clang++")) GTEST_SKIP() << "NOTICE: clang++ is not installed, not tested with it";
  expect_exact("blink, clang++", ShaderLanguage::blink,
               [](const std::string& text) { return test::blink_host("clang++", text); });
}

TEST(Shaders, hlsl_by_glslang_on_llvmpipe_is_the_operator_to_2e_5) {
  for (const char* program : {"glslangValidator", "spirv-cross"})
    if (!test::have(program))
      GTEST_SKIP() << "NOTICE: " << program << " is not installed, not tested with it";
  expect_exact("hlsl, llvmpipe", ShaderLanguage::hlsl, test::hlsl_host);
}

TEST(Shaders, the_arithmetic_of_osl_is_the_operator_to_2e_5) {
  expect_exact("osl, as C++", ShaderLanguage::osl,
               [](const std::string& text) { return test::osl_host("g++", text); });
}

TEST(Shaders, osl_is_of_its_grammar) {
  for (const ShaderCase& c : test::shader_cases())
    EXPECT_EQ(test::osl_fault(shader_text(c.spec, ShaderLanguage::osl)), "") << c.name;
}

TEST(Shaders, what_is_not_of_osl_s_grammar_is_found) {
  const std::string head =
      "shader s(color Cin = color(0.0, 0.0, 0.0), output color Cout = color(0.0, 0.0, 0.0)) { ";
  EXPECT_EQ(
      test::osl_fault(
          head + "float t = Cin[0]; int b = t < 1.0 && !(t > 2.0); Cout = color(b ? t : 0.0, -t, 1e-05); }"),
      "");
  for (const char* body : {"float t = Cin[0] }", "float t = Cin; }", "int b = 1.0; }", "bool b = 1; }",
                           "float t = fmin(1.0, 2.0); }", "float t = u; }", "float t = 1.0; float t = 2.0; }",
                           "float t = max(1.0); }", "float t = 1.0 ? 1.0 : 2.0; }",
                           "Cout = color(0.0, 0.0); }", "Cout = color(0.0, 0.0, 0.0); "})
    EXPECT_NE(test::osl_fault(head + body), "") << body;
}

TEST(Shaders, glsl_on_llvmpipe_is_the_operator_to_2e_5) {
  expect_exact("glsl, llvmpipe", ShaderLanguage::glsl, test::glsl_host);
}

TEST(Shaders, a_pixel_that_is_not_finite_passes_as_it_is_and_black_stays_black) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                  infinity = std::numeric_limits<float>::infinity();
  const test::Pixels pixels = {0.5, infinity, 0, 0, 3, -infinity, 0, 0, 0, 0x1p121F, 1, 1, nan, 1, 2};
  const ShaderCase& whole = test::shader_cases()[5];
  const shaders::SliderValues sliders = test::settings_of(whole.spec).front();
  for (const auto& [name, language, made] :
       {std::tuple("dctl", ShaderLanguage::dctl,
                   Made([](const auto& text) { return test::dctl_host("g++", text); })),
        std::tuple("blink", ShaderLanguage::blink,
                   Made([](const auto& text) { return test::blink_host("g++", text); })),
        std::tuple("glsl", ShaderLanguage::glsl, Made(test::glsl_host))}) {
    const auto shader = made(shader_text(whole.spec, language));
    const test::Pixels got = shader->show(sliders, pixels);
    // Of NaN GLSL promises nothing.
    const std::size_t promised = pixels.size() - (language == ShaderLanguage::glsl ? 3 : 0);
    for (std::size_t i = 0; i < promised; ++i)
      EXPECT_TRUE(got[i] == pixels[i] || (std::isnan(got[i]) && std::isnan(pixels[i]))) << name << " " << i;
  }
}

}  // namespace
}  // namespace scotopic
