// workload WAY TIMES: 4096 pixels of a night scene through the operator, TIMES times; prints the SIMD target.
#include <hwy/targets.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <vector>

#include "batch/batch.h"
#include "support/primaries.h"

int main(int argc, char** argv) {
  using namespace scotopic;
  if (argc != 3) return 2;
  constexpr std::size_t pixels = 4096;
  std::vector<float> r(pixels), g(pixels), b(pixels);
  std::mt19937 random(1);
  for (std::size_t i = 0; i < pixels; ++i) {
    const float level = static_cast<float>(random() % 1000 + 1) * 1e-4f;
    r[i] = level * static_cast<float>(random() % 64 + 1) / 64;
    g[i] = level * static_cast<float>(random() % 64 + 1) / 64;
    b[i] = level * static_cast<float>(random() % 64 + 1) / 64;
  }
  AppearanceParameters p;
  p.adaptation = std::strcmp(argv[1], "photopic") == 0 ? 10 : 0.01;
  p.white_luminance = p.adaptation / 0.18;
  p.xyz_from_rgb = test::rec709;
  p.xyz_from_gamut = test::rec709;
  if (std::strcmp(argv[1], "shift") == 0) {
    p.strength.chroma = 0;
    p.luminance = LuminancePolicy::none;
  }
  // The darkest pixel has a component of 1e-4/64: lit beyond 5 cd/m2.
  if (std::strcmp(argv[1], "lit") == 0) p.white_luminance = 1e8;
  if (std::strcmp(argv[1], "general") == 0) p.weight = Weight::global;
  if (std::strcmp(argv[1], "kernel") == 0) p.model = Model::safko2019;
  const bool half = std::strcmp(argv[1], "half") == 0;
  const bool dual = std::strcmp(argv[1], "double") == 0;
  const AppearanceBatch batch(p, dual ? Precision::dual : Precision::single);
  std::vector<float> r_out(pixels), g_out(pixels), b_out(pixels);
  // Any bits of light will do for halves: 0x2000 to 0x27ff is .008 to .03.
  std::vector<std::uint16_t> halves(3 * pixels), halves_out;
  for (auto& x : halves) x = static_cast<std::uint16_t>(0x2000 + random() % 0x800);
  for (int i = 0; i < std::atoi(argv[2]); ++i) {
    if (half) {
      halves_out = halves;
      std::uint16_t* const at = halves_out.data();
      batch.apply(HalfRows{at, at + pixels, at + 2 * pixels, pixels});
      continue;
    }
    r_out = r, g_out = g, b_out = b;
    batch.apply({r_out.data(), g_out.data(), b_out.data(), nullptr, nullptr, nullptr, nullptr, pixels});
  }
  std::puts(hwy::TargetName(hwy::SupportedTargets() & -hwy::SupportedTargets()));
  return 0;
}
