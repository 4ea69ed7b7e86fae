// Filters from cells: for each block of pixels, on the image's own grid, the clusters around it become its
// palette, and each pixel sums the palette's colours.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/acuity/cells_filter.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "stages/acuity/engines.h"
#include "stages/acuity/palette-inl.h"
#include "stages/acuity/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::acuity::HWY_NAMESPACE {
namespace {

using D = Lanes8;
using V = Vector8;

/// Weighted means of what the colours of a palette would change pixels by, and the weights' sum.
struct Sums {
  V x, y, z, total;
};

/// Pixels at `x` from the block's middle: of scaled CIELAB, or of X/Xn, Y/Yn, Z/Zn.
template <AcuitySpace space>
HWY_INLINE Sums sum_colours(const Palette& palette, V x, Three<V> lab, Three<V> xyz) {
  const D d;
  const V zero = hn::Zero(d);
  Sums s{zero, zero, zero, zero};
  for (int i = 0; i < palette.count(); ++i) {
    const float *colour = palette.fields(i), *in_row = palette.in_row(i);
    const auto f = [&](int k) HWY_ATTR { return hn::Set(d, colour[k * palette.stride()]); };
    const auto r = [&](int k) HWY_ATTR { return hn::Set(d, in_row[k * palette.stride()]); };
    // How far the colour is from the pixels, its gain counted.
    const auto apart = [&](int k, V own) HWY_ATTR {
      return hn::NegMulAdd(own, f(colour_root + k), hn::MulAdd(x, f(colour_lab + 3 + k), r(row_lab + k)));
    };
    const V l = apart(0, lab.x), a = apart(1, lab.y), b = apart(2, lab.z);
    const V near = hn::MulAdd(x, hn::MulAdd(x, f(colour_u + 3), r(row_u_x)), r(row_u));
    const V u = hn::NegMulAdd(b, b, hn::NegMulAdd(a, a, hn::NegMulAdd(l, l, near)));
    const V w = hn::Mul(weight_of(d, u), f(colour_weight));
    s.total = hn::Add(s.total, w);
    if constexpr (space == AcuitySpace::lab) {
      s.x = hn::MulAdd(w, hn::Mul(l, f(colour_root)), s.x);
      s.y = hn::MulAdd(w, hn::Mul(a, f(colour_root + 1)), s.y);
      s.z = hn::MulAdd(w, hn::Mul(b, f(colour_root + 2)), s.z);
    } else {
      const auto change = [&](int k, V own) HWY_ATTR {
        return hn::Sub(hn::MulAdd(x, f(colour_light + 3 + k), r(row_light + k)), own);
      };
      const auto slope = [&](int k, V by, V to) HWY_ATTR { return hn::MulAdd(by, f(colour_slope + k), to); };
      s.x = hn::MulAdd(w, slope(0, l, slope(1, a, change(0, xyz.x))), s.x);
      s.y = hn::MulAdd(w, slope(2, l, change(1, xyz.y)), s.y);
      s.z = hn::MulAdd(w, slope(3, l, slope(4, b, change(2, xyz.z))), s.z);
    }
  }
  return s;
}

/// Changes a vector of pixels of three planes, at `x` from the block's middle.
template <AcuitySpace space>
HWY_INLINE void filter_lanes(const Constants& c, const Palette& palette, V x, float* rgb,
                             std::ptrdiff_t plane) {
  const D d;
  const Three<V> own{hn::LoadU(d, rgb), hn::LoadU(d, rgb + plane), hn::LoadU(d, rgb + 2 * plane)};
  const Three<V> xyz = relative_xyz(d, c, own), lab = scaled_lab(d, c, xyz);
  const Sums sums = sum_colours<space>(palette, x, lab, xyz);
  // A pixel weighs at least 1 in its own mean. One unlike all the rest of a cell of many colours may not have
  // been counted: it is now, and changes by less.
  const V per_weight = hn::Div(hn::Set(d, 1.0f), hn::Max(sums.total, hn::Set(d, 1.0f)));
  const Three<V> mean{hn::Mul(sums.x, per_weight), hn::Mul(sums.y, per_weight), hn::Mul(sums.z, per_weight)};
  Three<V> change;
  if constexpr (space == AcuitySpace::lab)
    change = rgb_difference(d, c, lab, moved(lab, mean));
  else
    change = transform(d, c.rgb_from_f3, mean);
  const auto present = hn::Lt(lab.x, hn::Set(d, 0.5f * absent));
  const V strength = hn::Set(d, c.strength);
  const auto store = [&](float* at, V before, V by) HWY_ATTR {
    hn::StoreU(hn::IfThenElse(present, hn::MulAdd(strength, by, before), before), d, at);
  };
  store(rgb, own.x, change.x);
  store(rgb + plane, own.y, change.y);
  store(rgb + 2 * plane, own.z, change.z);
}

/// The part of the tile in the block at (x, y); `room` is for three rows of it.
template <AcuitySpace space>
void filter_block(const Constants& c, const AcuityWindow& window, const AcuityTile& tile, int x, int y,
                  Palette& palette, std::vector<float>& room) {
  const D d;
  const int lanes = static_cast<int>(hn::Lanes(d)), width = c.block_width;
  const int x0 = std::max(x, tile.x), x1 = std::min(x + width, tile.x + tile.width);
  const int y0 = std::max(y, tile.y), y1 = std::min(y + c.block_height, tile.y + tile.height);
  const float* const in[3] = {window.r, window.g, window.b};
  float* const out[3] = {tile.r, tile.g, tile.b};
  // Places beside the tile are computed, of whatever colour, and not stored.
  room.assign(static_cast<std::size_t>(3 * width), 0.0f);
  for (int row = y0; row < y1; ++row) {
    const std::ptrdiff_t from = (row - window.y) * window.stride - window.x + x0;
    const std::ptrdiff_t to = (row - tile.y) * tile.stride - tile.x + x0;
    palette.set_row(static_cast<float>(row - y) - 0.5f * static_cast<float>(c.block_height - 1));
    for (int k = 0; k < 3; ++k) std::copy_n(in[k] + from, x1 - x0, room.data() + k * width + (x0 - x));
    for (int i = (x0 - x) / lanes * lanes; i < x1 - x; i += lanes)
      filter_lanes<space>(c, palette,
                          hn::Iota(d, static_cast<float>(i) - 0.5f * static_cast<float>(width - 1)),
                          room.data() + i, width);
    for (int k = 0; k < 3; ++k) std::copy_n(room.data() + k * width + (x0 - x), x1 - x0, out[k] + to);
  }
}

/// A stretch of a cell row that a block sees lies within `half` cells of the block's middle.
struct Reach {
  const CellRow* row;
  double half;
};

std::vector<Reach> reaches(const Constants& c, double middle_y, const CellRow* const* rows, int first_row,
                           int row_count) {
  std::vector<Reach> result;
  for (int j = 0; j < row_count; ++j) {
    const double dy = (first_row + j) * c.cell + 0.5 * (c.cell - 1) - middle_y;
    const double square = c.radius * c.radius - dy * dy;
    if (square >= 0.0) result.push_back({rows[j], std::sqrt(square) / c.cell});
  }
  return result;
}

/// Clusters of a row.
struct Stretch {
  const CellRow* row;
  std::uint32_t begin, end;
};

}  // namespace

void FilterFromCells(const Constants& c, const AcuityWindow& window, const AcuityTile& tile, int y, int begin,
                     int end, const CellRow* const* rows, int first_row, int row_count) {
  const double middle_y = y + 0.5 * (c.block_height - 1);
  const std::vector<Reach> disc = reaches(c, middle_y, rows, first_row, row_count);
  const int first_cell = window.x / c.cell, last_cell = (window.x + window.width - 1) / c.cell;
  std::vector<Stretch> seen;
  std::vector<float> room;
  Palette palette(c);
  for (int block = begin; block < end; ++block) {
    const int x = block * c.block_width;
    const double middle_x = x + 0.5 * (c.block_width - 1), centre = (middle_x - 0.5 * (c.cell - 1)) / c.cell;
    seen.clear();
    std::size_t most = 0;
    for (const Reach& reach : disc) {
      const int left = std::max(static_cast<int>(std::ceil(centre - reach.half)), first_cell);
      const int right = std::min(static_cast<int>(std::floor(centre + reach.half)), last_cell) + 1;
      if (left >= right) continue;
      const std::uint32_t* first = reach.row->first.data() - first_cell;
      seen.push_back({reach.row, first[left], first[right]});
      most += first[right] - first[left];
    }
    palette.clear(most);
    for (const Stretch& s : seen)
      palette.add(*s.row, s.begin, s.end, static_cast<float>(middle_x), static_cast<float>(middle_y));
    palette.finish();
    if (c.space == AcuitySpace::lab)
      filter_block<AcuitySpace::lab>(c, window, tile, x, y, palette, room);
    else
      filter_block<AcuitySpace::light>(c, window, tile, x, y, palette, room);
  }
}

}  // namespace scotopic::acuity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scotopic::acuity {
HWY_EXPORT(FilterFromCells);

void filter_from_cells(const Constants& constants, const AcuityWindow& window, const AcuityTile& tile, int y,
                       int begin, int end, const CellRow* const* rows, int first_row, int row_count) {
  HWY_DYNAMIC_DISPATCH(FilterFromCells)(constants, window, tile, y, begin, end, rows, first_row, row_count);
}
}  // namespace scotopic::acuity
#endif
