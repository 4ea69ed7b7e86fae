// Builds cells: divides the pixels of each small square into clusters of like colour.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/acuity/cells_build.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "stages/acuity/engines.h"
#include "stages/acuity/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::acuity::HWY_NAMESPACE {
namespace {

/// Four floats in one register whatever the lanes of the instruction set (GCC and clang).
using Quad [[gnu::vector_size(16)]] = float;

/// Two quads a pixel, so that sums take two additions: scaled L, a, b and x; X/Xn, Y/Yn, Z/Zn and y.
struct CellPixel {
  Quad lab_x;
  Quad xyz_y;
};

/// Pixels [begin, end) of a cell, with their moments.
struct Part {
  int begin, end;
  Quad lab_x, xyz_y;  // means
  Quad variance;      // of lab_x
  float urgency;      // of dividing it: count times variance up to urgent_variance; 0: narrow enough
  int widest_channel;
};

/// In units of the range kernel's variance, scaled: a wider part is no more urgent to divide.
constexpr float urgent_variance = static_cast<float>(10.0 * 0.5 / weight_end);

HWY_INLINE Part measured(const Constants& c, const CellPixel* pixels, int begin, int end) {
  Part part{begin, end, pixels[begin].lab_x, pixels[begin].xyz_y, Quad{}, 0.0f, 0};
  if (end - begin == 1) return part;
  // Sums of differences from the first pixel: equal pixels have exactly their own mean.
  Quad sum_a{}, sum_b{};
  for (int i = begin + 1; i < end; ++i) {
    sum_a += pixels[i].lab_x - part.lab_x;
    sum_b += pixels[i].xyz_y - part.xyz_y;
  }
  const float per_pixel = 1.0f / static_cast<float>(end - begin);
  part.lab_x += sum_a * per_pixel;
  part.xyz_y += sum_b * per_pixel;
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

/// In units of the range kernel's variance, scaled: a cluster looks no wider, as pixels too far apart for one
/// cluster must not look like a little of everything between them. Measured to be near the best on HDR
/// images.
constexpr float widest_variance = static_cast<float>(4.0 * 0.5 / weight_end);

/// Place of a colour in the lattice, 21 bits an axis.
std::uint64_t lattice_place(const Constants& c, const float* lab) {
  std::uint64_t place = 0;
  for (int k = 0; k < 3; ++k) {
    const float step = std::floor(c.per_pitch * lab[k]);
    const auto bounded = static_cast<std::int64_t>(std::clamp(step, -1048576.0f, 1048575.0f));
    place = place << 21 | static_cast<std::uint64_t>(bounded + 1048576);
  }
  return place;
}

void append(const Constants& c, const Cluster& cluster, int count, CellRow& out) {
  out.x.push_back(cluster.means[mean_x]);
  out.y.push_back(cluster.means[mean_y]);
  out.count.push_back(static_cast<float>(count));
  out.colour.push_back(lattice_place(c, cluster.means + mean_lab));
  out.clusters.push_back(cluster);
  for (int k = mean_lab; k < mean_light; ++k) {
    float& variance = out.clusters.back().variances[k];
    variance = std::min(variance, widest_variance);
  }
}

constexpr int clusters_at_most = 128;

/// Divides the part that most needs it at its mean until all are narrow, and appends the clusters.
HWY_INLINE void append_clusters(const Constants& c, CellPixel* pixels, int count, CellRow& out) {
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
  for (int i = 0; i < used; ++i) {
    const Part& part = parts[i];
    const Quad &lab = part.lab_x, &xyz = part.xyz_y, &v = part.variance;
    append(c, {{lab[3], xyz[3], lab[0], lab[1], lab[2], xyz[0], xyz[1], xyz[2]}, {0, 0, v[0], v[1], v[2]}},
           part.end - part.begin, out);
  }
}

constexpr int planes = 6;  // scaled L, a, b, X/Xn, Y/Yn, Z/Zn

/// Moments of as many squares of 2x2 pixels as there are lanes.
struct Squares {
  HWY_ALIGN float means[planes][HWY_MAX_BYTES / sizeof(float)];
  HWY_ALIGN float variances[3][HWY_MAX_BYTES / sizeof(float)];
  HWY_ALIGN float narrow[HWY_MAX_BYTES / sizeof(float)];  // 1: all four pixels are there, and one cluster

  /// Two rows of planes, from column `column`.
  void measure(const Constants& c, const float* const (&rows)[2][planes], int column);
};

HWY_INLINE void Squares::measure(const Constants& c, const float* const (&rows)[2][planes], int column) {
  const hn::ScalableTag<float> d;
  using V = hn::Vec<decltype(d)>;
  const V quarter = hn::Set(d, 0.25f);
  auto alike = hn::Eq(quarter, quarter);
  for (int k = 0; k < planes; ++k) {
    V p0, p1, p2, p3;
    hn::LoadInterleaved2(d, rows[0][k] + column, p0, p1);
    hn::LoadInterleaved2(d, rows[1][k] + column, p2, p3);
    // No fused multiplications: the sums are those of a cell that is measured alone.
    const V sum = hn::Add(hn::Add(hn::Sub(p1, p0), hn::Sub(p2, p0)), hn::Sub(p3, p0));
    const V mean = hn::Add(p0, hn::Mul(sum, quarter));
    hn::Store(mean, d, means[k]);
    if (k >= 3) continue;
    const auto square = [&](V v) HWY_ATTR { return hn::Mul(hn::Sub(v, mean), hn::Sub(v, mean)); };
    const V variance =
        hn::Mul(hn::Add(hn::Add(hn::Add(square(p0), square(p1)), square(p2)), square(p3)), quarter);
    hn::Store(variance, d, variances[k]);
    alike = hn::And(alike, hn::Le(variance, hn::Set(d, c.split_variance)));
    if (k > 0) continue;
    const V darkest_absent = hn::Max(hn::Max(p0, p1), hn::Max(p2, p3));
    alike = hn::And(alike, hn::Lt(darkest_absent, hn::Set(d, 0.5f * absent)));
  }
  hn::Store(hn::IfThenElseZero(alike, hn::Set(d, 1.0f)), d, narrow);
}

/// One row of cells being built.
class RowBuilder {
 public:
  RowBuilder(const Constants& c, const AcuityWindow& window, int row);
  void build(CellRow& out);

 private:
  float* plane(int channel, int y) {
    return planes_.get() + (static_cast<std::ptrdiff_t>(y) * planes + channel) * window_.width;
  }
  void begin_cell(CellRow& out) { out.first.push_back(static_cast<std::uint32_t>(out.clusters.size())); }
  int add_squares(int cell, CellRow& out);
  void add_cell(int cell, CellRow& out);

  const Constants& c_;
  const AcuityWindow& window_;
  int first_y_, rows_, first_cell_, last_cell_;
  std::unique_ptr<float[]> planes_;  // row by row
  std::vector<CellPixel> pixels_;
};

RowBuilder::RowBuilder(const Constants& c, const AcuityWindow& window, int row)
    : c_(c),
      window_(window),
      first_y_(std::max(row * c.cell, window.y)),
      rows_(std::min((row + 1) * c.cell, window.y + window.height) - first_y_),
      first_cell_(window.x / c.cell),
      last_cell_((window.x + window.width - 1) / c.cell),
      planes_(std::make_unique_for_overwrite<float[]>(static_cast<std::size_t>(planes) *
                                                      static_cast<std::size_t>(window.width) *
                                                      static_cast<std::size_t>(rows_))),
      pixels_(static_cast<std::size_t>(c.cell * c.cell)) {
  for (int y = 0; y < rows_; ++y) {
    float* const out[planes] = {plane(0, y), plane(1, y), plane(2, y), plane(3, y), plane(4, y), plane(5, y)};
    const std::ptrdiff_t from = (first_y_ + y - window.y) * window.stride;
    lab_of_row(c, {window.r + from, window.g + from, window.b + from}, window.width, out);
  }
}

void RowBuilder::build(CellRow& out) {
  for (int cell = first_cell_; cell <= last_cell_;) {
    const int done = add_squares(cell, out);
    cell += done;
    if (done > 0) continue;
    begin_cell(out);
    add_cell(cell++, out);
  }
  begin_cell(out);
  for (std::vector<float>* values : {&out.x, &out.y, &out.count}) values->resize(out.clusters.size() + 16);
}

/// Cells of 2x2 pixels, as many as there are lanes at once: most need no division. Returns how many were
/// added. The same sums in the same order as for any other cell: which way a cell goes does not show.
int RowBuilder::add_squares(int cell, CellRow& out) {
  const int lanes = static_cast<int>(hn::Lanes(hn::ScalableTag<float>()));
  const int x = 2 * cell - window_.x;
  if (c_.cell != 2 || rows_ != 2 || x < 0 || x + 2 * lanes > window_.width) return 0;
  Squares squares;
  squares.measure(c_,
                  {{plane(0, 0), plane(1, 0), plane(2, 0), plane(3, 0), plane(4, 0), plane(5, 0)},
                   {plane(0, 1), plane(1, 1), plane(2, 1), plane(3, 1), plane(4, 1), plane(5, 1)}},
                  x);
  for (int i = 0; i < lanes; ++i) {
    begin_cell(out);
    if (squares.narrow[i] == 0.0f) {
      add_cell(cell + i, out);
      continue;
    }
    Cluster cluster{{static_cast<float>(2 * (cell + i)) + 0.5f, static_cast<float>(first_y_) + 0.5f}, {}};
    for (int k = 0; k < planes; ++k) cluster.means[mean_lab + k] = squares.means[k][i];
    for (int k = 0; k < 3; ++k) cluster.variances[mean_lab + k] = squares.variances[k][i];
    append(c_, cluster, 4, out);
  }
  return lanes;
}

void RowBuilder::add_cell(int cell, CellRow& out) {
  const int x0 = std::max(cell * c_.cell, window_.x) - window_.x;
  const int x1 = std::min((cell + 1) * c_.cell, window_.x + window_.width) - window_.x;
  int count = 0;
  for (int y = 0; y < rows_; ++y) {
    const float *l = plane(0, y), *a = plane(1, y), *b = plane(2, y);
    const float *lx = plane(3, y), *ly = plane(4, y), *lz = plane(5, y);
    for (int x = x0; x < x1; ++x) {
      if (l[x] == absent) continue;
      CellPixel& pixel = pixels_[static_cast<std::size_t>(count++)];
      pixel.lab_x = Quad{l[x], a[x], b[x], static_cast<float>(x + window_.x)};
      pixel.xyz_y = Quad{lx[x], ly[x], lz[x], static_cast<float>(first_y_ + y)};
    }
  }
  if (count > 0) append_clusters(c_, pixels_.data(), count, out);
}

}  // namespace

void BuildCellRow(const Constants& c, const AcuityWindow& window, int row, CellRow& out) {
  RowBuilder(c, window, row).build(out);
}

}  // namespace scotopic::acuity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scotopic::acuity {
HWY_EXPORT(BuildCellRow);

void build_cell_row(const Constants& constants, const AcuityWindow& window, int row, CellRow& out) {
  HWY_DYNAMIC_DISPATCH(BuildCellRow)(constants, window, row, out);
}
}  // namespace scotopic::acuity
#endif
