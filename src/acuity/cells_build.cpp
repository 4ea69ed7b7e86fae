// Builds cells: divides the pixels of each small square into clusters of like colour.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "acuity/cells_build.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "acuity/engines.h"
#include "acuity/moments-inl.h"
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

/// Pixels [begin, end) of a cell, with their moments.
struct Part {
  int begin, end;
  Quad lab_x, rgb_y;  // means
  Quad variance;      // of lab_x
  float urgency;      // of dividing it: count times variance up to urgent_variance; 0: narrow enough
  int widest_channel;
};

/// In units of the range kernel's variance, scaled: a wider part is no more urgent to divide.
constexpr float urgent_variance = static_cast<float>(10.0 * 0.5 / weight_end);

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

constexpr int clusters_at_most = 32;

/// Divides the part that most needs it at its mean until all are narrow, and appends the clusters.
HWY_INLINE void append_clusters(const Constants& c, CellPixel* pixels, int count, Moments& flat,
                                Moments& spread) {
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
    const Quad &lab = part.lab_x, &rgb = part.rgb_y, &v = part.variance;
    const bool even = std::max({v[0], v[1], v[2]}) <= flat_variance;
    (even ? flat : spread)
        .add({lab[3], rgb[3], static_cast<float>(part.end - part.begin), lab[0], lab[1], lab[2], rgb[0],
              rgb[1], rgb[2], v[0], v[1], v[2]});
  }
}

/// One row of cells being built.
class RowBuilder {
 public:
  RowBuilder(const Constants& c, const AcuityWindow& window, int row);
  void build(CellRow& out);

 private:
  float* plane(int channel, int y) {
    return planes_.get() + (static_cast<std::ptrdiff_t>(y) * 3 + channel) * window_.width;
  }
  const float* light(const float* of, int y) const {
    return of + (first_y_ + y - window_.y) * window_.stride;
  }
  void begin_cell(CellRow& out, int flat_more);
  int add_pairs(int cell, CellRow& out);
  void add_cell(int cell);

  const Constants& c_;
  const AcuityWindow& window_;
  int first_y_, rows_, first_cell_, last_cell_;
  std::unique_ptr<float[]> planes_;  // scaled CIELAB, row by row
  std::vector<CellPixel> pixels_;
  Moments flat_, spread_;
};

RowBuilder::RowBuilder(const Constants& c, const AcuityWindow& window, int row)
    : c_(c),
      window_(window),
      first_y_(std::max(row * c.cell, window.y)),
      rows_(std::min((row + 1) * c.cell, window.y + window.height) - first_y_),
      first_cell_(window.x / c.cell),
      last_cell_((window.x + window.width - 1) / c.cell),
      planes_(std::make_unique_for_overwrite<float[]>(3 * static_cast<std::size_t>(window.width) *
                                                      static_cast<std::size_t>(rows_))),
      pixels_(static_cast<std::size_t>(c.cell * c.cell)),
      flat_((last_cell_ - first_cell_ + 1) * std::min(c.most_clusters, c.cell * c.cell)),
      spread_((last_cell_ - first_cell_ + 1) * std::min(c.most_clusters, c.cell * c.cell)) {
  for (int y = 0; y < rows_; ++y) {
    float* lab[3] = {plane(0, y), plane(1, y), plane(2, y)};
    lab_of_row(c, light(window.r, y), light(window.g, y), light(window.b, y), window.width, lab);
  }
}

void RowBuilder::build(CellRow& out) {
  for (int cell = first_cell_; cell <= last_cell_;) {
    const int done = add_pairs(cell, out);
    cell += done;
    if (done > 0) continue;
    begin_cell(out, 0);
    add_cell(cell++);
  }
  begin_cell(out, 0);
  flat_.finish(c_, true, out.flat);
  spread_.finish(c_, false, out.spread);
}

/// The next cell begins behind the clusters there are, and `flat_more` flat ones.
void RowBuilder::begin_cell(CellRow& out, int flat_more) {
  out.flat.first.push_back(static_cast<std::uint32_t>(flat_.count() + flat_more));
  out.spread.first.push_back(static_cast<std::uint32_t>(spread_.count()));
}

/// Cells of 2x2 pixels, as many as there are lanes at once: most need no division. Returns how many were
/// added. The same sums in the same order as for any other cell: which way a cell goes does not show.
int RowBuilder::add_pairs(int cell, CellRow& out) {
  const Lanes d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const int x = 2 * cell - window_.x;
  if (c_.cell != 2 || rows_ != 2 || x < 0 || x + 2 * lanes > window_.width) return 0;
  Squares squares;
  const float* const planes[2][6] = {
      {plane(0, 0), plane(1, 0), plane(2, 0), light(window_.r, 0), light(window_.g, 0), light(window_.b, 0)},
      {plane(0, 1), plane(1, 1), plane(2, 1), light(window_.r, 1), light(window_.g, 1), light(window_.b, 1)}};
  squares.measure(c_, planes, x, 2 * cell, first_y_);
  for (int i = 0; i < lanes; ++i) {
    begin_cell(out, squares.all_flat ? i : 0);
    if (squares.all_flat) continue;
    if (squares.narrow[i] != 0.0f)
      (squares.flat[i] != 0.0f ? flat_ : spread_).add(squares.moments(i));
    else
      add_cell(cell + i);
  }
  if (squares.all_flat) flat_.add_all(squares);
  return lanes;
}

void RowBuilder::add_cell(int cell) {
  const int x0 = std::max(cell * c_.cell, window_.x) - window_.x;
  const int x1 = std::min((cell + 1) * c_.cell, window_.x + window_.width) - window_.x;
  int count = 0;
  for (int y = 0; y < rows_; ++y) {
    const float *l = plane(0, y), *a = plane(1, y), *b = plane(2, y);
    const float *red = light(window_.r, y), *green = light(window_.g, y), *blue = light(window_.b, y);
    for (int x = x0; x < x1; ++x) {
      if (l[x] == absent) continue;
      CellPixel& pixel = pixels_[static_cast<std::size_t>(count++)];
      pixel.lab_x = Quad{l[x], a[x], b[x], static_cast<float>(x + window_.x)};
      pixel.rgb_y = Quad{red[x], green[x], blue[x], static_cast<float>(first_y_ + y)};
    }
  }
  if (count > 0) append_clusters(c_, pixels_.data(), count, flat_, spread_);
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
