// Filters from cells: each pixel sums the clusters around it. 8x4 or 8x8 pixels at a time, on
// the image's own grid.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "acuity/cells_filter.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <type_traits>
#include <vector>

#include "acuity/engines.h"
#include "acuity/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::acuity::HWY_NAMESPACE {
namespace {

using D = Lanes;
using V = Vector;

/// The clusters that the pixels of a block see, field by field, places relative to the block's middle. The
/// distance of pixel p and cluster c takes |p - c|^2 from u; |p|^2 is the same for all clusters of a pixel
/// and drops out of the mean, so two products are left, and what c's own |c|^2 leaves of u.
class ClusterList {
 public:
  static constexpr int near_u = cluster_fields;
  // Not a multiple of 4 KiB: the fields of a cluster must not share one set of the cache.
  static constexpr std::ptrdiff_t stride = list_capacity + 16;

  explicit ClusterList(int fields)
      : fields_(fields), values_(std::make_unique_for_overwrite<float[]>(stride * (cluster_fields + 1))) {}

  int count() const { return count_; }
  const float* values() const { return values_.get(); }
  void clear() { count_ = 0; }
  void append(const Constants& c, const Clusters& row, std::uint32_t begin, std::uint32_t end, float x,
              float y);

 private:
  int fields_;  // that are used, near_u besides
  int count_ = 0;
  std::unique_ptr<float[]> values_;
};

HWY_INLINE void ClusterList::append(const Constants& c, const Clusters& row, std::uint32_t begin,
                                    std::uint32_t end, float x, float y) {
  const D d;
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(d));
  const V twice = hn::Set(d, 2.0f * c.space_scale), scale = hn::Set(d, c.space_scale);
  const V middle_x = hn::Set(d, x), middle_y = hn::Set(d, y);
  for (std::uint32_t i = begin; i < end; i += lanes) {
    const float* from = row.values.get() + i;
    float* to = values_.get() + count_;
    const V dx = hn::Sub(hn::LoadU(d, from + cluster_x * row.stride), middle_x);
    const V dy = hn::Sub(hn::LoadU(d, from + cluster_y * row.stride), middle_y);
    const V square = hn::MulAdd(dx, dx, hn::Mul(dy, dy));
    hn::StoreU(hn::Mul(twice, dx), d, to + cluster_x * stride);
    hn::StoreU(hn::Mul(twice, dy), d, to + cluster_y * stride);
    hn::StoreU(hn::NegMulAdd(square, scale, hn::Set(d, 1.0f)), d, to + near_u * stride);
    for (int f = cluster_weight; f < fields_; ++f)
      hn::StoreU(hn::LoadU(d, from + f * row.stride), d, to + f * stride);
    count_ += static_cast<int>(std::min(lanes, end - i));
  }
}

constexpr int block_width = 8;

/// A rectangle of pixels, plane after plane.
template <int height>
struct alignas(64) Block {
  static constexpr int area = block_width * height;
  float rgb[3][area];
};

/// Places of a block's pixels relative to its middle.
template <int height>
struct alignas(64) Places {
  Places() {
    for (int i = 0; i < block_width * height; ++i) {
      x[i] = static_cast<float>(i % block_width) - 0.5f * (block_width - 1);
      y[i] = static_cast<float>(i / block_width) - 0.5f * (height - 1);
    }
  }
  float x[block_width * height], y[block_width * height];
};

/// What pixels have summed.
struct Sums {
  Wide x, y, z, total;
};

struct Pixels {
  V x;  // of each vector: those worked on together begin in the same column
  Wide y;
  Wide l, a, b;
  Wide red, green, blue;
};

HWY_INLINE V field(const float* cluster, int f) { return hn::Set(D(), cluster[f * ClusterList::stride]); }

/// How far a cluster is from pixels in channel `i`, its gain counted.
template <bool flat>
HWY_INLINE Wide apart(const float* cluster, int i, Wide own) {
  const V mean = field(cluster, cluster_lab + i);
  if constexpr (flat) return sub_from(own, mean);
  const V root = field(cluster, cluster_root + i);
  return each([&](V v) HWY_ATTR { return hn::NegMulAdd(v, root, mean); }, own);
}

/// What a cluster would change each pixel's RGB to, less what it is: its mean, moved towards the pixel as the
/// range kernel moves it within the cluster.
template <bool flat>
HWY_INLINE Wide light_change(const float* cluster, int i, Wide l, Wide a, Wide b, Wide own) {
  const Wide mean = sub_from(own, field(cluster, cluster_light + i));
  if constexpr (flat) return mean;
  const int slope = cluster_slope + 3 * i;
  return scaled_add(l, field(cluster, slope),
                    scaled_add(a, field(cluster, slope + 1), scaled_add(b, field(cluster, slope + 2), mean)));
}

/// Mean less pixel, the range kernel's gain counted.
template <bool flat>
HWY_INLINE Wide lab_change(const float* cluster, int i, Wide difference) {
  if constexpr (flat) return difference;
  return scaled(difference, field(cluster, cluster_root + i));
}

/// `sums` and all the clusters of the list, seen from the pixels.
template <AcuitySpace space, bool flat>
HWY_INLINE Sums sum_clusters(const ClusterList& list, const Pixels& p, Sums sums) {
  Wide x = sums.x, y = sums.y, z = sums.z, total = sums.total;
  const float* end = list.values() + list.count();
  for (const float* cluster = list.values(); cluster != end; ++cluster) {
    const Wide l = apart<flat>(cluster, 0, p.l), a = apart<flat>(cluster, 1, p.a),
               b = apart<flat>(cluster, 2, p.b);
    const V near = hn::MulAdd(p.x, field(cluster, cluster_x), field(cluster, ClusterList::near_u));
    const V to_y = field(cluster, cluster_y);
    const Wide u = each([&](V v) HWY_ATTR { return hn::MulAdd(v, to_y, near); }, p.y);
    const Wide rest = less_square(b, less_square(a, less_square(l, u)));
    const Wide w = scaled(weights(rest), field(cluster, cluster_weight));
    total = add(total, w);
    if constexpr (space == AcuitySpace::lab) {
      x = mul_add(w, lab_change<flat>(cluster, 0, l), x);
      y = mul_add(w, lab_change<flat>(cluster, 1, a), y);
      z = mul_add(w, lab_change<flat>(cluster, 2, b), z);
    } else {
      x = mul_add(w, light_change<flat>(cluster, 0, l, a, b, p.red), x);
      y = mul_add(w, light_change<flat>(cluster, 1, l, a, b, p.green), y);
      z = mul_add(w, light_change<flat>(cluster, 2, l, a, b, p.blue), z);
    }
  }
  return {x, y, z, total};
}

/// The clusters of the cells that a block's pixels see.
struct Seen {
  ClusterList flat{flat_cluster_fields}, spread{cluster_fields};
};

/// Changes `lanes` pixels of the block from `at` on by their sums.
template <AcuitySpace space>
HWY_INLINE void finish(const Constants& c, Three<V> sums, V total, Three<V> lab, float* red,
                       std::ptrdiff_t plane) {
  const D d;
  // A pixel weighs at least 1 in its own mean. One unlike all the rest of a cell of many colours may not have
  // been counted: it is now, and changes by less.
  const V whole = hn::Max(total, hn::Set(d, 1.0f));
  const auto present = hn::Lt(lab.x, hn::Set(d, 0.5f * absent));
  const Three<V> change = mean_change<space>(c, sums, whole, lab);
  const V strength = hn::Set(d, c.strength);
  const auto store = [&](float* at, V delta) HWY_ATTR {
    const V own = hn::Load(d, at);
    hn::Store(hn::IfThenElse(present, hn::MulAdd(strength, delta, own), own), d, at);
  };
  store(red, change.x);
  store(red + plane, change.y);
  store(red + 2 * plane, change.z);
}

template <AcuitySpace space, int height>
HWY_INLINE void filter_block(const Constants& c, const Seen& seen, const Places<height>& places,
                             Block<height>& block) {
  const D d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  constexpr int area = Block<height>::area;
  static_assert(area % (16 * ways) == 0);
  for (int i = 0; i < area; i += ways * lanes) {
    const auto load = [&](const float* plane) HWY_ATTR {
      return from_place([&](int v) HWY_ATTR { return hn::Load(d, plane + i + v * lanes); });
    };
    Pixels p;
    p.red = load(block.rgb[0]);
    p.green = load(block.rgb[1]);
    p.blue = load(block.rgb[2]);
    p.x = hn::Load(d, places.x + i % block_width);
    p.y = load(places.y);
    const auto convert = [&](V Three<V>::*channel) HWY_ATTR {
      return each(
          [&](V r, V g, V b) HWY_ATTR {
            return scaled_lab(d, c, Three<V>{r, g, b}).*channel;
          },
          p.red, p.green, p.blue);
    };
    p.l = convert(&Three<V>::x);
    p.a = convert(&Three<V>::y);
    p.b = convert(&Three<V>::z);
    const Wide zero = from_place([&](int) HWY_ATTR { return hn::Zero(d); });
    const Sums flat = sum_clusters<space, true>(seen.flat, p, {zero, zero, zero, zero});
    const Sums s = sum_clusters<space, false>(seen.spread, p, flat);
    float* out = block.rgb[0] + i;
    finish<space>(c, {s.x.a, s.y.a, s.z.a}, s.total.a, {p.l.a, p.a.a, p.b.a}, out, area);
#if HWY_TARGET <= HWY_AVX3
    finish<space>(c, {s.x.b, s.y.b, s.z.b}, s.total.b, {p.l.b, p.a.b, p.b.b}, out + lanes, area);
#endif
  }
}

/// The block at (x, y) of the image; places outside the tile repeat a pixel of it.
template <int height>
void load_block(const AcuityWindow& window, const AcuityTile& tile, int x, int y, Block<height>& block) {
  const float* planes[3] = {window.r, window.g, window.b};
  const bool whole = x >= tile.x && x + block_width <= tile.x + tile.width;
  for (int j = 0; j < height; ++j) {
    const int row = std::clamp(y + j, tile.y, tile.y + tile.height - 1);
    const std::ptrdiff_t offset = (row - window.y) * window.stride - window.x;
    for (int k = 0; k < 3; ++k) {
      float* to = block.rgb[k] + j * block_width;
      if (whole) {
        std::memcpy(to, planes[k] + offset + x, sizeof(float) * block_width);
      } else {
        for (int i = 0; i < block_width; ++i)
          to[i] = planes[k][offset + std::clamp(x + i, tile.x, tile.x + tile.width - 1)];
      }
    }
  }
}

template <int height>
void store_block(const Block<height>& block, int x, int y, const AcuityTile& tile) {
  float* planes[3] = {tile.r, tile.g, tile.b};
  const int x0 = std::max(x, tile.x), x1 = std::min(x + block_width, tile.x + tile.width);
  const int y0 = std::max(y, tile.y), y1 = std::min(y + height, tile.y + tile.height);
  for (int row = y0; row < y1; ++row) {
    const std::ptrdiff_t offset = (row - tile.y) * tile.stride - tile.x;
    for (int k = 0; k < 3; ++k) {
      const float* from = block.rgb[k] + (row - y) * block_width;
      if (x1 - x0 == block_width)
        std::memcpy(planes[k] + offset + x, from, sizeof(float) * block_width);
      else
        for (int column = x0; column < x1; ++column) planes[k][offset + column] = from[column - x];
    }
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

template <AcuitySpace space, int height>
void filter_block_row(const Constants& c, const AcuityWindow& window, const AcuityTile& tile, int y,
                      const CellRow* const* rows, int first_row, int row_count) {
  const double middle_x = 0.5 * (block_width - 1), middle_y = y + 0.5 * (height - 1);
  const std::vector<Reach> disc = reaches(c, middle_y, rows, first_row, row_count);
  Seen seen;
  const Places<height> places;
  Block<height> block;
  const int first_cell = window.x / c.cell, last_cell = (window.x + window.width - 1) / c.cell;
  for (int x = tile.x / block_width * block_width; x < tile.x + tile.width; x += block_width) {
    const double centre = (x + middle_x - 0.5 * (c.cell - 1)) / c.cell;
    seen.flat.clear();
    seen.spread.clear();
    for (const Reach& reach : disc) {
      const int begin = std::max(static_cast<int>(std::ceil(centre - reach.half)), first_cell);
      const int end = std::min(static_cast<int>(std::floor(centre + reach.half)), last_cell) + 1;
      if (begin >= end) continue;
      const auto append = [&](const Clusters& clusters, ClusterList& list) {
        const std::uint32_t* first = clusters.first.data() - first_cell;
        list.append(c, clusters, first[begin], first[end], static_cast<float>(x + middle_x),
                    static_cast<float>(middle_y));
      };
      append(reach.row->flat, seen.flat);
      append(reach.row->spread, seen.spread);
    }
    load_block(window, tile, x, y, block);
    filter_block<space>(c, seen, places, block);
    store_block(block, x, y, tile);
  }
}

}  // namespace

void FilterFromCells(const Constants& c, const AcuityWindow& window, const AcuityTile& tile, int y,
                     const CellRow* const* rows, int first_row, int row_count) {
  const auto filter = [&](auto space) {
    if (c.block_height == 8)
      filter_block_row<space.value, 8>(c, window, tile, y, rows, first_row, row_count);
    else
      filter_block_row<space.value, 4>(c, window, tile, y, rows, first_row, row_count);
  };
  if (c.space == AcuitySpace::lab)
    filter(std::integral_constant<AcuitySpace, AcuitySpace::lab>());
  else
    filter(std::integral_constant<AcuitySpace, AcuitySpace::light>());
}

}  // namespace scotopic::acuity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scotopic::acuity {
HWY_EXPORT(FilterFromCells);

void filter_from_cells(const Constants& constants, const AcuityWindow& window, const AcuityTile& tile, int y,
                       const CellRow* const* rows, int first_row, int row_count) {
  HWY_DYNAMIC_DISPATCH(FilterFromCells)(constants, window, tile, y, rows, first_row, row_count);
}
}  // namespace scotopic::acuity
#endif
