// Builds cells: divides the pixels of each small square into clusters of like colour.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "acuity/cells_build.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "acuity/engines.h"
#include "acuity/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::acuity::HWY_NAMESPACE {
namespace {

/// Four floats in one register whatever the lanes of the instruction set (GCC and clang).
using Quad [[gnu::vector_size(16)]] = float;

/// Two quads a pixel, so that sums take two additions: (L, a, b, x) and (R, G, B, y).
struct CellPixel {
  Quad lab_x;
  Quad rgb_y;
};

struct Cluster {
  float values[cluster_fields];
};

/// Pixels [begin, end) of a cell, with their moments.
struct Part {
  int begin, end;
  Quad lab_x, rgb_y;  // means
  Quad variance;      // of lab_x
  float urgency;      // of dividing it: count times variance up to urgent_variance; 0: narrow enough
  int widest_channel;
};

/// In units of the range kernel's variance, scaled: beyond these a cluster's spread counts no more, for which
/// to divide first and for how wide it looks. Pixels too far apart for one cluster must not look like a
/// little of everything between them. Both measured to be near the best on HDR images.
constexpr float range_variance = static_cast<float>(0.5 / weight_end);
constexpr float urgent_variance = 10.0f * range_variance, widest_variance = 4.0f * range_variance;

HWY_INLINE Part measured(const Constants& c, const CellPixel* pixels, int begin, int end) {
  Part part{begin, end, pixels[begin].lab_x, pixels[begin].rgb_y, Quad{}, 0.0f, 0};
  if (end - begin == 1) return part;
  // Sums of differences from the first pixel: equal pixels have exactly their own mean.
  Quad sum_a{}, sum_b{};
  for (int i = begin + 1; i < end; ++i) {
    sum_a += pixels[i].lab_x - part.lab_x;
    sum_b += pixels[i].rgb_y - part.rgb_y;
  }
  const float per_pixel = 1.0f / static_cast<float>(end - begin);
  part.lab_x += sum_a * per_pixel;
  part.rgb_y += sum_b * per_pixel;
  for (int i = begin; i < end; ++i) {
    const Quad a = pixels[i].lab_x - part.lab_x;
    part.variance += a * a;
  }
  part.variance *= per_pixel;
  part.widest_channel = part.variance[1] > part.variance[0] ? 1 : 0;
  if (part.variance[2] > part.variance[part.widest_channel]) part.widest_channel = 2;
  const float widest = part.variance[part.widest_channel];
  if (widest > c.split_variance)
    part.urgency = static_cast<float>(end - begin) * std::min(widest, urgent_variance);
  return part;
}

/// d RGB / d scaled CIELAB at a colour, a column for each of L, a, b.
HWY_INLINE void light_slopes(const Constants& c, Quad lab, Quad (&slopes)[3]) {
  const float unscale = 1.0f / c.lab_scale;
  const float fy = (lab[0] * unscale + 16.0f) / 116.0f;
  const float f[3] = {fy + lab[1] * unscale / 500.0f, fy, fy - lab[2] * unscale / 200.0f};
  Quad columns[3];
  for (int k = 0; k < 3; ++k) {
    const float slope = unscale * (f[k] > 6.0f / 29.0f ? 3.0f * f[k] * f[k] : 108.0f / 841.0f);
    columns[k] = slope * Quad{c.rgb_from_f3[0][k], c.rgb_from_f3[1][k], c.rgb_from_f3[2][k], 0.0f};
  }
  slopes[0] = (columns[0] + columns[1] + columns[2]) / 116.0f;
  slopes[1] = columns[0] / 500.0f;
  slopes[2] = columns[2] / -200.0f;
}

HWY_INLINE void store_cluster(const Constants& c, const Part& part, Cluster& out) {
  constexpr float ends = static_cast<float>(2.0 * weight_end);
  Quad variance = part.variance;
  for (int k = 0; k < 3; ++k) variance[k] = std::min(variance[k], widest_variance);
  const Quad gain = 1.0f / (1.0f + ends * variance);
  const Quad root{std::sqrt(gain[0]), std::sqrt(gain[1]), std::sqrt(gain[2]), 1.0f};
  const Quad lab = part.lab_x * root;
  Quad slopes[3];
  light_slopes(c, part.lab_x, slopes);
  out.values[cluster_x] = part.lab_x[3];
  out.values[cluster_y] = part.rgb_y[3];
  out.values[cluster_weight] = static_cast<float>(part.end - part.begin) * (root[0] * root[1] * root[2]);
  for (int k = 0; k < 3; ++k) {
    out.values[cluster_root + k] = root[k];
    out.values[cluster_lab + k] = lab[k];
    out.values[cluster_light + k] = part.rgb_y[k];
    for (int j = 0; j < 3; ++j)
      out.values[cluster_slope + 3 * k + j] = slopes[j][k] * (ends * variance[j] * root[j]);
  }
}

constexpr int clusters_at_most = 32;

/// Divides the part that most needs it at its mean until all are narrow, and appends the clusters.
HWY_INLINE void append_clusters(const Constants& c, CellPixel* pixels, int count,
                                std::vector<Cluster>& clusters) {
  Part parts[clusters_at_most];
  int used = 1, next = 0;
  parts[0] = measured(c, pixels, 0, count);
  const int most = std::min(c.most_clusters, clusters_at_most);
  while (parts[next].urgency > 0.0f && used < most) {
    Part& part = parts[next];
    const int channel = part.widest_channel;
    const float at = part.lab_x[channel];
    const int begin = part.begin, end = part.end;
    CellPixel* middle = std::partition(pixels + begin, pixels + end,
                                       [=](const CellPixel& p) { return p.lab_x[channel] < at; });
    const int split = static_cast<int>(middle - pixels);
    if (split == begin || split == end) {  // rounding put the mean at an extreme
      part.urgency = 0.0f;
    } else {
      parts[next] = measured(c, pixels, begin, split);
      parts[used++] = measured(c, pixels, split, end);
    }
    next = 0;
    for (int i = 1; i < used; ++i)
      if (parts[i].urgency > parts[next].urgency) next = i;
  }
  const std::size_t at = clusters.size();
  clusters.resize(at + static_cast<std::size_t>(used));
  for (int i = 0; i < used; ++i) store_cluster(c, parts[i], clusters[at + static_cast<std::size_t>(i)]);
}

/// Scaled CIELAB of `count` pixels of a row.
void lab_of_row(const Constants& c, const float* r, const float* g, const float* b, int count,
                float* lab[3]) {
  const hn::ScalableTag<float> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto convert = [&](const float* pr, const float* pg, const float* pb, float* l, float* a,
                           float* bb) HWY_ATTR {
    const auto out =
        scaled_lab(d, c, Three<hn::Vec<decltype(d)>>{hn::LoadU(d, pr), hn::LoadU(d, pg), hn::LoadU(d, pb)});
    hn::StoreU(out.x, d, l);
    hn::StoreU(out.y, d, a);
    hn::StoreU(out.z, d, bb);
  };
  int i = 0;
  for (; i + lanes <= count; i += lanes) convert(r + i, g + i, b + i, lab[0] + i, lab[1] + i, lab[2] + i);
  if (i >= count) return;
  HWY_ALIGN float rest[6][HWY_MAX_BYTES / sizeof(float)] = {};
  for (int j = 0; j < count - i; ++j) {
    rest[0][j] = r[i + j];
    rest[1][j] = g[i + j];
    rest[2][j] = b[i + j];
  }
  convert(rest[0], rest[1], rest[2], rest[3], rest[4], rest[5]);
  for (int j = 0; j < count - i; ++j)
    for (int k = 0; k < 3; ++k) lab[k][i + j] = rest[3 + k][j];
}

void field_by_field(const std::vector<Cluster>& clusters, CellRow& out) {
  out.stride = static_cast<std::ptrdiff_t>(clusters.size() + 16);
  out.values.resize(static_cast<std::size_t>(out.stride) * cluster_fields);
  float* to = out.values.data();
  for (const Cluster& cluster : clusters) {
    for (int f = 0; f < cluster_fields; ++f) to[f * out.stride] = cluster.values[f];
    ++to;
  }
}

}  // namespace

void BuildCellRow(const Constants& c, const AcuityWindow& window, int row, CellRow& out) {
  const int first_y = std::max(row * c.cell, window.y);
  const int last_y = std::min((row + 1) * c.cell, window.y + window.height);
  const int rows = last_y - first_y;
  const auto width = static_cast<std::size_t>(window.width);
  std::vector<float> planes(3 * width * static_cast<std::size_t>(rows));
  const auto plane = [&](int k, int y) {
    return planes.data() + (static_cast<std::size_t>(y * 3 + k)) * width;
  };
  for (int y = 0; y < rows; ++y) {
    const std::ptrdiff_t offset = (first_y + y - window.y) * window.stride;
    float* lab[3] = {plane(0, y), plane(1, y), plane(2, y)};
    lab_of_row(c, window.r + offset, window.g + offset, window.b + offset, window.width, lab);
  }
  const int first_cell = window.x / c.cell;
  const int last_cell = (window.x + window.width - 1) / c.cell;
  std::vector<CellPixel> pixels(static_cast<std::size_t>(c.cell * c.cell));
  std::vector<Cluster> clusters;
  clusters.reserve(2 * static_cast<std::size_t>(last_cell - first_cell + 1));
  out.first.clear();
  for (int cell = first_cell; cell <= last_cell; ++cell) {
    out.first.push_back(static_cast<std::uint32_t>(clusters.size()));
    const int x0 = std::max(cell * c.cell, window.x),
              x1 = std::min((cell + 1) * c.cell, window.x + window.width);
    int count = 0;
    for (int y = 0; y < rows; ++y) {
      const std::ptrdiff_t offset = (first_y + y - window.y) * window.stride - window.x;
      const float *l = plane(0, y) - window.x, *a = plane(1, y) - window.x, *b = plane(2, y) - window.x;
      for (int x = x0; x < x1; ++x) {
        if (l[x] == absent) continue;
        CellPixel& pixel = pixels[static_cast<std::size_t>(count++)];
        pixel.lab_x = Quad{l[x], a[x], b[x], static_cast<float>(x)};
        pixel.rgb_y = Quad{window.r[offset + x], window.g[offset + x], window.b[offset + x],
                           static_cast<float>(first_y + y)};
      }
    }
    if (count > 0) append_clusters(c, pixels.data(), count, clusters);
  }
  out.first.push_back(static_cast<std::uint32_t>(clusters.size()));
  field_by_field(clusters, out);
}

void BuildLabRow(const Constants& c, const AcuityWindow& window, int y, LabRows& out, int i) {
  float* row = out.row(i);
  const bool exists = y >= window.y && y < window.y + window.height;
  const std::ptrdiff_t margin = out.margin, right = margin + window.width;
  for (int k = 0; k < 6; ++k) {
    float* plane = row + k * out.stride;
    const float outside = k == 0 ? absent : 0.0f;
    std::fill(plane, plane + (exists ? margin : out.stride), outside);
    if (exists) std::fill(plane + right, plane + out.stride, outside);
  }
  if (!exists) return;
  const std::ptrdiff_t offset = (y - window.y) * window.stride;
  row += margin;
  float* lab[3] = {row, row + out.stride, row + 2 * out.stride};
  const float* planes[3] = {window.r + offset, window.g + offset, window.b + offset};
  lab_of_row(c, planes[0], planes[1], planes[2], window.width, lab);
  for (int k = 0; k < 3; ++k) {
    float* light = row + (3 + k) * out.stride;
    for (int x = 0; x < window.width; ++x) light[x] = row[x] == absent ? 0.0f : planes[k][x];
  }
}

}  // namespace scotopic::acuity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scotopic::acuity {
HWY_EXPORT(BuildCellRow);
HWY_EXPORT(BuildLabRow);

void build_cell_row(const Constants& constants, const AcuityWindow& window, int row, CellRow& out) {
  HWY_DYNAMIC_DISPATCH(BuildCellRow)(constants, window, row, out);
}

void build_lab_row(const Constants& constants, const AcuityWindow& window, int y, LabRows& out, int i) {
  HWY_DYNAMIC_DISPATCH(BuildLabRow)(constants, window, y, out, i);
}
}  // namespace scotopic::acuity
#endif
