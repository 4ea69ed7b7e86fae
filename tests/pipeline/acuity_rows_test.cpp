#include "pipeline/rows/acuity_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "stages/acuity/scenes.h"

namespace scotopic {
namespace {

using test::Image;

/// The image through AcuityRows in bands of `step` rows, in the file's coordinates.
Image in_bands(const AcuityFilter& filter, const Image& in, int step, bool descending,
               std::vector<std::uint8_t>& touched) {
  const Window data{-7, 40, -7 + in.width, 40 + in.height};
  AcuityRows rows(filter, data, descending, true);
  Image out(in.width, in.height);
  LightRow light(static_cast<std::size_t>(in.width));
  touched.assign(in.planes[0].size(), 2);
  const int count = (in.height + step - 1) / step;
  std::vector<int> order;
  for (int i = 0; i < count; ++i) {
    Band band;
    band.y0 = data.y0 + (descending ? count - 1 - i : i) * step;
    band.rows = std::min(step, data.y1 - band.y0);
    band.width = in.width;
    const Band& added = *rows.add(std::move(band));
    for (int row = 0; row < added.rows; ++row) {
      const auto at = static_cast<std::ptrdiff_t>(in.at(0, added.y0 - data.y0 + row));
      std::copy_n(in.planes[0].begin() + at, in.width, light.r.begin());
      std::copy_n(in.planes[1].begin() + at, in.width, light.g.begin());
      std::copy_n(in.planes[2].begin() + at, in.width, light.b.begin());
      std::fill(light.alpha.begin(), light.alpha.end(), static_cast<float>(added.y0 + row));
      std::fill(light.touched.begin(), light.touched.end(), std::uint8_t{0});
      rows.set_row(row, light);
    }
    while (rows.next()) {
      order.push_back(rows.band().y0);
      for (int row = 0; row < rows.band().rows; ++row) {
        rows.get_row(row, light);
        EXPECT_EQ(light.alpha[0], static_cast<float>(rows.band().y0 + row));
        const auto at = static_cast<std::ptrdiff_t>(in.at(0, rows.band().y0 - data.y0 + row));
        std::copy_n(light.r.begin(), in.width, out.planes[0].begin() + at);
        std::copy_n(light.g.begin(), in.width, out.planes[1].begin() + at);
        std::copy_n(light.b.begin(), in.width, out.planes[2].begin() + at);
        std::copy_n(light.touched.begin(), in.width, touched.begin() + at);
      }
    }
  }
  EXPECT_EQ(static_cast<int>(order.size()), count);
  EXPECT_TRUE(descending ? std::is_sorted(order.rbegin(), order.rend())
                         : std::is_sorted(order.begin(), order.end()));
  return out;
}

TEST(AcuityRows, bands_in_either_order_do_not_show_and_changed_pixels_count_as_touched) {
  Image image = test::night(57, 101);
  for (int x = 0; x < 57; ++x)  // a part that nothing changes
    for (int y = 0; y < 30; ++y)
      for (auto& plane : image.planes) plane[image.at(x, y)] = 0.25f;
  for (double sigma : {1.2, 5.0, 20.0}) {
    const AcuityParameters p = test::parameters(sigma);
    const Image whole = test::filtered(p, image);
    const AcuityFilter filter(p);
    for (int step : {1, 7, 16, 101})
      for (bool descending : {false, true}) {
        std::vector<std::uint8_t> touched;
        const Image out = in_bands(filter, image, step, descending, touched);
        for (std::size_t i = 0; i < touched.size(); ++i) {
          bool changed = false;
          for (int k = 0; k < 3; ++k) {
            ASSERT_EQ(std::memcmp(&out.planes[k][i], &whole.planes[k][i], sizeof(float)), 0)
                << "sigma " << sigma << " step " << step << " pixel " << i;
            changed = changed || std::memcmp(&out.planes[k][i], &image.planes[k][i], sizeof(float)) != 0;
          }
          ASSERT_EQ(touched[i], changed ? 1 : 0);
        }
        if (sigma < 6.0) {  // out of reach of everything else
          EXPECT_EQ(touched[0], 0);
        }
      }
  }
}

}  // namespace
}  // namespace scotopic
