#include "stages/acuity/filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "stages/acuity/scenes.h"

namespace scotopic {
namespace {

using test::Image;

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

std::vector<AcuityParameters> each_engine(double sigma) {
  std::vector<AcuityParameters> ways;
  for (AcuitySpace space : {AcuitySpace::light, AcuitySpace::lab})
    for (AcuityEngine engine : {AcuityEngine::window, AcuityEngine::cells}) {
      ways.push_back(test::parameters(sigma));
      ways.back().space = space;
      ways.back().engine = engine;
    }
  return ways;
}

Image constant(int width, int height, float r, float g, float b) {
  Image image(width, height);
  const float rgb[3] = {r, g, b};
  for (int k = 0; k < 3; ++k) std::fill(image.planes[k].begin(), image.planes[k].end(), rgb[k]);
  return image;
}

bool same_bits(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void expect_same_bits(const Image& a, const Image& b) {
  for (int k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < a.planes[k].size(); ++i)
      ASSERT_TRUE(same_bits(a.planes[k][i], b.planes[k][i]))
          << "plane " << k << " pixel " << i << ": " << a.planes[k][i] << " and " << b.planes[k][i];
}

TEST(AcuityFilter, constant_images_come_back_bit_for_bit) {
  for (double sigma : {1.3, 4.0, 17.0})
    for (const AcuityParameters& p : each_engine(sigma))
      for (const auto& [r, g, b] :
           {Vec3<float>{0.2f, 0.7f, 0.1f}, Vec3<float>{0, 0, 0}, Vec3<float>{-0.01f, 0.3f, 2e4f}}) {
        const Image image = constant(67, 53, r, g, b);
        expect_same_bits(test::filtered(p, image), image);
      }
}

TEST(AcuityFilter, sigma_0_and_strength_0_are_the_identity) {
  const Image image = test::night(40, 30);
  AcuityParameters p = test::parameters(0.0);
  expect_same_bits(test::filtered(p, image), image);
  EXPECT_EQ(AcuityFilter(p).halo(), 0);
  p = test::parameters(5.0);
  p.strength = 0.0;
  expect_same_bits(test::filtered(p, image), image);
}

TEST(AcuityFilter, strength_mixes_input_and_result_in_linear_light) {
  const Image image = test::night(60, 40);
  for (AcuityParameters p : each_engine(4.0)) {
    const Image whole = test::filtered(p, image);
    p.strength = 0.25;
    const Image part = test::filtered(p, image);
    for (int k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < image.planes[k].size(); ++i) {
        const double wanted = 0.75 * image.planes[k][i] + 0.25 * whole.planes[k][i];
        EXPECT_NEAR(part.planes[k][i], wanted, 1e-6 * (std::abs(wanted) + std::abs(image.planes[k][i])));
      }
  }
}

TEST(AcuityFilter, texture_goes_and_the_edge_stays) {
  Image image(80, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 80; ++x)
      for (int k = 0; k < 3; ++k) {
        const double grain = 0.1 * (test::noise(x, y, 0) - 0.5);
        image.planes[k][image.at(x, y)] = static_cast<float>((x < 40 ? 0.05 : 0.6) * (1.0 + grain));
      }
  const auto spread = [](const Image& i, int x0, int x1) {
    double sum = 0, squares = 0, n = 0;
    for (int y = 10; y < 30; ++y)
      for (int x = x0; x < x1; ++x) {
        const double v = i.planes[1][i.at(x, y)];
        sum += v;
        squares += v * v;
        ++n;
      }
    return std::sqrt(squares / n - sum * sum / (n * n)) / (sum / n);
  };
  for (const AcuityParameters& p : each_engine(4.0)) {
    const Image out = test::filtered(p, image);
    EXPECT_LT(spread(out, 45, 70), 0.12 * spread(image, 45, 70));
    for (int y = 0; y < 40; ++y) {
      EXPECT_NEAR(out.planes[1][out.at(39, y)], 0.05, 0.006);
      EXPECT_NEAR(out.planes[1][out.at(40, y)], 0.6, 0.03);
    }
  }
}

struct Hostile {
  const char* name;
  Vec3<float> rgb;
  bool seen_by_itself;  // a colour so far out that it may only stay itself
};

TEST(AcuityFilter, hostile_pixels_never_spread_and_stay_themselves) {
  const Hostile hostile[] = {
      {"NaN", {nan, 0.1f, 0.1f}, false},     {"Inf", {inf, inf, inf}, false},
      {"-Inf", {0.1f, -inf, 0.1f}, false},   {"1e30", {1e30f, 1e30f, 1e30f}, true},
      {"-1e30", {-1e30f, 1, 1}, true},       {"max", {3.4e38f, -3.4e38f, 3.4e38f}, true},
      {"1e12", {1e12f, 1e12f, 1e12f}, true}, {"1e7", {1e7f, 1e7f, 1e7f}, true},
  };
  for (const Hostile& h : hostile)
    for (double sigma : {2.0, 6.0, 30.0})
      for (const AcuityParameters& p : each_engine(sigma)) {
        Image image = constant(61, 47, 0.21f, 0.2f, 0.23f);
        const std::size_t at = image.at(30, 20);
        for (std::size_t k = 0; k < 3; ++k) image.planes[k][at] = h.rgb[k];
        const Image out = test::filtered(p, image);
        for (int k = 0; k < 3; ++k)
          for (std::size_t i = 0; i < out.planes[k].size(); ++i)
            ASSERT_TRUE(same_bits(out.planes[k][i], image.planes[k][i]))
                << h.name << " sigma " << sigma << " plane " << k << " pixel " << i << ": "
                << out.planes[k][i];
      }
}

TEST(AcuityFilter, results_are_finite_where_the_input_is_whatever_surrounds_it) {
  Image image = test::night(90, 70);
  const float bad[] = {nan, inf, -inf, 1e30f, -1e30f, 1e8f, -5.0f, 0.0f, 1e-30f, -0.0f};
  for (int i = 0; i < 600; ++i) {
    const int x = static_cast<int>(90 * test::noise(i, 0, 1)),
              y = static_cast<int>(70 * test::noise(i, 0, 2));
    image.planes[i % 3][image.at(x, y)] = bad[i % 10];
  }
  for (double sigma : {2.0, 5.0, 20.0})
    for (const AcuityParameters& p : each_engine(sigma)) {
      const Image out = test::filtered(p, image);
      for (std::size_t i = 0; i < out.planes[0].size(); ++i) {
        bool finite = true;
        for (const auto& plane : image.planes) finite = finite && std::isfinite(plane[i]);
        for (int k = 0; k < 3; ++k) {
          if (finite)
            ASSERT_TRUE(std::isfinite(out.planes[k][i])) << "sigma " << sigma << " pixel " << i;
          else
            ASSERT_TRUE(same_bits(out.planes[k][i], image.planes[k][i]));
        }
      }
    }
}

TEST(AcuityFilter, light_space_keeps_results_between_the_neighbours_extremes) {
  const Image image = test::night(70, 60, 0.05);
  AcuityParameters p = test::parameters(2.5);
  p.engine = AcuityEngine::window;
  const Image out = test::filtered(p, image);
  for (int k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax_element(image.planes[k].begin(), image.planes[k].end());
    for (float v : out.planes[k]) {
      EXPECT_GE(v, *low * (1 - 1e-5f));
      EXPECT_LE(v, *high * (1 + 1e-5f));
    }
  }
}

TEST(AcuityFilter, parameters_outside_their_domain_are_refused) {
  AcuityParameters p = test::parameters(-1.0);
  EXPECT_THROW(AcuityFilter{p}, std::invalid_argument);
  p = test::parameters(nan);
  EXPECT_THROW(AcuityFilter{p}, std::invalid_argument);
  p = test::parameters(1.0, 0.0);
  EXPECT_THROW(AcuityFilter{p}, std::invalid_argument);
  p = test::parameters(1.0);
  p.white = 0.0;
  EXPECT_THROW(AcuityFilter{p}, std::invalid_argument);
  p = test::parameters(1.0);
  p.strength = 1.5;
  EXPECT_THROW(AcuityFilter{p}, std::invalid_argument);
  p = test::parameters(1.0);
  p.xyz_from_rgb = {};
  EXPECT_THROW(AcuityFilter{p}, std::invalid_argument);
}

TEST(AcuityFilter, a_window_without_the_halo_is_refused) {
  const Image image = test::night(64, 64);
  Image out(64, 64);
  const AcuityFilter filter(test::parameters(4.0));
  AcuityWindow window = test::window_of(image);
  window.width = 40;
  AcuityTile tile = test::tile_of(out);
  tile.width = 40 - filter.halo() + 1;
  EXPECT_THROW(filter.filter(window, tile), std::invalid_argument);
  tile.width = 40 - filter.halo();
  EXPECT_NO_THROW(filter.filter(window, tile));
}

}  // namespace
}  // namespace scotopic
