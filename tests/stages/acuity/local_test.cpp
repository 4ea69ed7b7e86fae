#include "stages/acuity/local.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "stages/acuity/cutoff.h"
#include "stages/acuity/scenes.h"

namespace scotopic {
namespace {

using test::Image;

LocalAcuityParameters local(double adaptation, double ppd) {
  LocalAcuityParameters p;
  p.filter = test::parameters(0.0);
  p.adaptation = adaptation;
  p.white_luminance = adaptation / 0.18;
  p.pixels_per_degree = ppd;
  return p;
}

Image filtered(const SpatialFilter& filter, const Image& in) {
  Image out(in.width, in.height);
  filter.filter(test::window_of(in), test::tile_of(out));
  return out;
}

bool same_bits(const Image& a, const Image& b) {
  for (int k = 0; k < 3; ++k)
    if (std::memcmp(a.planes[k].data(), b.planes[k].data(), a.planes[k].size() * sizeof(float)) != 0)
      return false;
  return true;
}

/// Faint texture, and a lamp in the middle that is `lamp` times the scene's white.
Image lamp_in_the_dark(int size, float lamp) {
  Image image(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (auto& plane : image.planes)
        plane[image.at(x, y)] = std::hypot(x - size / 2, y - size / 2) < 4
                                    ? lamp
                                    : static_cast<float>(0.1 + 0.02 * test::noise(x, y, 1));
  return image;
}

double roughness(const Image& image, int x0, int y0) {
  double sum = 0;
  for (int y = y0; y < y0 + 8; ++y)
    for (int x = x0; x < x0 + 8; ++x)
      sum += std::abs(image.planes[1][image.at(x + 1, y)] - image.planes[1][image.at(x, y)]);
  return sum;
}

TEST(LocalAcuity, without_light_around_it_is_the_filter_of_la_bit_for_bit) {
  Image image = test::night(90, 70);
  // Alternating signs: colour everywhere, luminance clamped at 0.
  for (auto& plane : image.planes)
    for (float& v : plane) v = -v;
  const LocalAcuityParameters p = local(0.01, 60.0);
  AcuityParameters global = p.filter;
  global.sigma = acuity_sigma_pixels(0.01, 60.0);
  EXPECT_TRUE(same_bits(filtered(LocalAcuityFilter(p), image), filtered(AcuityFilter(global), image)));
}

TEST(LocalAcuity, a_lamp_keeps_the_detail_around_it) {
  const Image image = lamp_in_the_dark(300, 3000.0f);
  const LocalAcuityParameters p = local(0.01, 40.0);
  const Image out = filtered(LocalAcuityFilter(p), image);
  const double near = roughness(out, 160, 160) / roughness(image, 160, 160);
  const double far = roughness(out, 10, 10) / roughness(image, 10, 10);
  EXPECT_GT(near, 0.95);
  EXPECT_LT(far, 0.5);
}

TEST(LocalAcuity, constant_images_come_back_bit_for_bit) {
  for (float level : {0.0f, 0.02f, 0.2f, 50.0f}) {
    Image image(80, 60);
    for (auto& plane : image.planes) std::fill(plane.begin(), plane.end(), level);
    EXPECT_TRUE(same_bits(filtered(LocalAcuityFilter(local(0.02, 60.0)), image), image)) << level;
  }
}

TEST(LocalAcuity, hostile_pixels_stay_and_others_stay_finite) {
  Image image = test::night(120, 90);
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30f,
                       -1e30f};
  for (int i = 0; i < 40; ++i)
    image.planes[i % 3][image.at(static_cast<int>(120 * test::noise(i, 1, 1)),
                                 static_cast<int>(90 * test::noise(i, 1, 2)))] = bad[i % 4];
  const Image out = filtered(LocalAcuityFilter(local(0.003, 60.0)), image);
  for (int k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < out.planes[k].size(); ++i) {
      const float in = image.planes[k][i];
      if (std::isfinite(in))
        ASSERT_TRUE(std::isfinite(out.planes[k][i]));
      else
        ASSERT_EQ(std::memcmp(&in, &out.planes[k][i], sizeof in), 0);
    }
}

TEST(LocalAcuity, tiles_do_not_show_bit_for_bit) {
  const Image image = lamp_in_the_dark(310, 200.0f);
  const LocalAcuityFilter filter(local(0.01, 30.0));
  const Image whole = filtered(filter, image);
  Image tiled(310, 310);
  for (int y = 0; y < 310; y += 70)
    for (int x = 0; x < 310; x += 155) {
      const int halo = filter.halo(), x0 = std::max(0, x - halo), y0 = std::max(0, y - halo);
      AcuityTile tile = test::tile_of(tiled);
      tile.x = x;
      tile.y = y;
      tile.width = 155;
      tile.height = std::min(70, 310 - y);
      tile.r += tiled.at(x, y);
      tile.g += tiled.at(x, y);
      tile.b += tiled.at(x, y);
      AcuityWindow window = test::window_of(image);
      window.x = x0;
      window.y = y0;
      window.width = std::min(310, x + 155 + halo) - x0;
      window.height = std::min(310, y + tile.height + halo) - y0;
      window.r += image.at(x0, y0);
      window.g += image.at(x0, y0);
      window.b += image.at(x0, y0);
      filter.filter(window, tile);
    }
  EXPECT_TRUE(same_bits(tiled, whole));
}

TEST(LocalAcuity, parameters_outside_their_domain_are_refused) {
  EXPECT_THROW(LocalAcuityFilter(local(0.0, 60.0)), std::invalid_argument);
  EXPECT_THROW(LocalAcuityFilter(local(0.1, std::numeric_limits<double>::infinity())), std::invalid_argument);
  LocalAcuityParameters p = local(0.1, 60.0);
  p.white_luminance = -1.0;
  EXPECT_THROW(LocalAcuityFilter{p}, std::invalid_argument);
}

}  // namespace
}  // namespace scotopic
