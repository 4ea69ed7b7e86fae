// Shaders against the operator in double, in every language that something here compiles: the table of their errors.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "shaders/hosts.h"

namespace scotopic {
namespace {

using test::Host;
using test::ShaderCase;
using Made = std::function<std::unique_ptr<Host>(const std::string& text)>;

/// Of the pixel's largest component.
constexpr double tolerance = 2e-5;

void expect_exact(const std::string& host, ShaderLanguage language, const Made& made) {
  std::printf("%-14s | %-30s | %-8s | %s\n", "language", "stages", "worst", "where");
  for (const ShaderCase& c : test::shader_cases()) {
    const std::unique_ptr<Host> shader = made(shader_text(c.spec, language));
    const test::Shown shown = [&](const auto& sliders, const auto& pixels) { return shader->show(sliders, pixels); };
    for (const auto& [what, pixels] : {std::pair(c.name, &test::light()), std::pair(c.name + "*", &test::beyond_gamut())}) {
      const test::Worst worst = test::worst_of(c.spec, *pixels, shown);
      std::printf("%-14s | %-30s | %-8.2g | %s\n", host.c_str(), what.c_str(), worst.error, worst.place.c_str());
      EXPECT_LE(worst.error, tolerance) << host << ", " << what << ": " << worst.place;
    }
  }
}

TEST(Shaders, dctl_compiled_by_gcc_is_the_operator_to_2e_5) {
  expect_exact("dctl, g++", ShaderLanguage::dctl, [](const std::string& text) { return test::dctl_host("g++", text); });
}

TEST(Shaders, dctl_compiled_by_clang_is_the_operator_to_2e_5) {
  if (!test::have("clang++")) GTEST_SKIP() << "NOTICE: clang++ is not installed, not tested with it";
  expect_exact("dctl, clang++", ShaderLanguage::dctl,
               [](const std::string& text) { return test::dctl_host("clang++", text); });
}

TEST(Shaders, glsl_on_llvmpipe_is_the_operator_to_2e_5) {
  expect_exact("glsl, llvmpipe", ShaderLanguage::glsl, test::glsl_host);
}

}  // namespace
}  // namespace scotopic
