#include "pipeline/non_finite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/error.h"
#include "pipeline/light_path.h"
#include "io/row_bands.h"
#include "scene/scene_statistics.h"

namespace scotopic {
namespace {

bool any_non_finite(const PixelRows& rows) {
  for (const float* plane :
       {static_cast<const float*>(rows.r), static_cast<const float*>(rows.g), static_cast<const float*>(rows.b),
        rows.cone_l, rows.cone_m, rows.cone_s, rows.rod})
    if (plane && scotopic::any_non_finite(plane, rows.count)) return true;
  return false;
}

void clean_pixel(const PixelRows& rows, std::size_t i) {
  const bool black = !finite_signals(rows, i);
  for (float* plane : {rows.r, rows.g, rows.b})
    if (black || !std::isfinite(plane[i])) plane[i] = 0;
}

}  // namespace

RowOperator NonFiniteWatch::watched(RowOperator apply) const {
  if (!apply && policy_ != NonFinite::clean) return {};
  return [clean = policy_ == NonFinite::clean, count = count_, apply = std::move(apply)](const PixelRows& rows,
                                                                                         std::uint8_t* touched) {
    std::vector<std::size_t> bad;
    if (any_non_finite(rows))
      for (std::size_t i = 0; i < rows.count; ++i)
        if (!is_finite(rows, i)) bad.push_back(i);
    if (clean)
      for (const std::size_t i : bad) clean_pixel(rows, i);
    if (apply) apply(rows, touched);
    else std::fill_n(touched, rows.count, std::uint8_t{0});
    if (bad.empty()) return;
    *count += bad.size();
    if (clean)
      for (const std::size_t i : bad) touched[i] = 1;
  };
}

std::uint64_t count_non_finite(const PixelRows& rows) {
  std::uint64_t count = 0;
  if (any_non_finite(rows))
    for (std::size_t i = 0; i < rows.count; ++i) count += !is_finite(rows, i);
  return count;
}

NonFinitePixels find_non_finite(PixelSource& source, const ImageLayout& layout, const ColourConfig& config) {
  NonFinitePixels found;
  for (const LightPicture& light : layout.light) {
    const Picture& picture = source.pictures()[light.index];
    if (picture.level_x != 0 || picture.level_y != 0) continue;
    const LightReader reader(light.channels, config, light.space);
    LightRow row(static_cast<std::size_t>(picture.data.width()));
    each_band(picture, false, [&](int y0, int rows) {
      Band band;
      source.read(light.index, y0, rows, band);
      for (int y = 0; y < rows; ++y) {
        reader.read(band, y, row);
        const PixelRows pixels = row.pixels(reader.receptors());
        for (std::size_t i = 0; i < pixels.count; ++i)
          if (!is_finite(pixels, i) && found.count++ == 0)
            found.x = picture.data.x0 + static_cast<int>(i), found.y = y0 + y;
      }
    });
  }
  return found;
}

std::string describe(const NonFinitePixels& pixels) {
  return fmt::format("{} {} not finite, the first at ({}, {})", pixels.count,
                     pixels.count == 1 ? "pixel is" : "pixels are", pixels.x, pixels.y);
}

void refuse_non_finite(PixelSource& source, const ImageLayout& layout, const ColourConfig& config) {
  const NonFinitePixels pixels = find_non_finite(source, layout, config);
  if (pixels.count > 0) throw Error(ExitCode::input, source.file(), describe(pixels));
}

}  // namespace scotopic
