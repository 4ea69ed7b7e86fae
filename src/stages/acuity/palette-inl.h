// A block's palette: the clusters around it, merged by colour. Included once per instruction set.
//
// Seen from the block's middle a cluster weighs n exp(-|t|^2/2s^2), t being where it lies and s sigma; seen
// from a place d away from the middle, exp(d.t/s^2) times that (and a factor of d alone, which the mean
// loses). Of all clusters of one colour, W = sum of the weights; the mean of t, m; its covariance C; the mean
// colour q and the covariance of t and q, K, are kept. From d they weigh W exp(d.m/s^2 + d'Cd/2s^4) and have
// the mean q + K d/s^2: the logarithm of the sum to its second order, the mean to its first.
#if defined(SCOTOPIC_ACUITY_PALETTE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_ACUITY_PALETTE_INL_H_
#undef SCOTOPIC_ACUITY_PALETTE_INL_H_
#else
#define SCOTOPIC_ACUITY_PALETTE_INL_H_
#endif

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <vector>

#include "stages/acuity/engines.h"
#include "stages/acuity/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::acuity::HWY_NAMESPACE {
namespace {

/// Blocks are as narrow as 8 pixels: wider vectors would find nothing to do.
using Lanes8 = hn::CappedTag<float, 8>;
using Vector8 = hn::Vec<Lanes8>;

/// Where Colour has what; lanes as Cluster::means, x and y from the block's middle.
enum Sum {
  sum_first = 0,                ///< the first of the clusters
  sum_t = sum_first + 8,        ///< differences from it
  sum_x = sum_t + 8,            ///< x times them
  sum_y = sum_x + 8,            ///< y times them
  sum_square = sum_y + 8,       ///< their squares, and the clusters' own variances
  sum_weight = sum_square + 8,  ///< in Palette alone
  sum_fields
};

/// What the clusters of one colour sum up to, under their weights. Differences from the first of them: equal
/// colours have exactly their own mean.
struct alignas(32) Colour {
  float values[40];
  std::uint64_t place;
  std::uint32_t slot;  // of the table that finds colours
  float weight;
};

/// Fields of a finished palette, an array of all colours each. u is what weight_of takes.
enum PaletteField {
  colour_weight,
  colour_u,                        ///< 6: u of a pixel of the same colour: 1, x, y, x^2, xy, y^2
  colour_lab = colour_u + 6,       ///< 3, times sqrt(gain); then per x, per y
  colour_light = colour_lab + 9,   ///< 3; then per x, per y
  colour_root = colour_light + 9,  ///< 3: sqrt(gain) of L, a, b
  /// How the range kernel moves X, Y, Z towards the pixel: X with l, a; Y with l; Z with l, b.
  colour_slope = colour_root + 3,
  palette_fields = colour_slope + 5
};
/// The same in one row of pixels, y being known.
enum RowField { row_u, row_u_x, row_lab, row_light = row_lab + 3, row_fields = row_light + 3 };

class Palette {
 public:
  explicit Palette(const Constants& c) : c_(c) {}

  /// No more than `most` clusters will be added.
  void clear(std::size_t most);
  /// Clusters begin ... end - 1 of a row, seen from (x, y).
  void add(const CellRow& row, std::uint32_t begin, std::uint32_t end, float x, float y);
  /// When all are added.
  void finish();
  /// Pixels are at `y` from the block's middle from now on.
  void set_row(float y);

  int count() const { return count_; }
  /// Of colour i; the next field lies stride() floats on.
  const float* fields(int i) const { return fields_.data() + i; }
  const float* in_row(int i) const { return row_.data() + i; }
  std::ptrdiff_t stride() const { return stride_; }

 private:
  Colour& colour_at(std::uint64_t place, const Cluster& cluster, float x, float y);
  void drop_rare();
  void accumulate(const Cluster& cluster, float weight, Colour& to);
  void gather();
  void finish_lanes(int i);

  const Constants& c_;
  int count_ = 0;
  std::vector<std::uint32_t> table_;
  std::vector<Colour> colours_;
  std::vector<float> weights_, sums_, fields_, row_;
  std::ptrdiff_t stride_ = 0;
};

void Palette::clear(std::size_t most) {
  count_ = 0;
  if (colours_.size() >= most) return;
  colours_.resize(2 * most);
  weights_.resize(2 * most + 16);
  table_.assign(std::bit_ceil(4 * most), 0);
}

HWY_INLINE Colour& Palette::colour_at(std::uint64_t place, const Cluster& cluster, float x, float y) {
  const auto mask = static_cast<std::uint32_t>(table_.size() - 1);
  std::uint32_t slot = static_cast<std::uint32_t>(place * 0x9E3779B97F4A7C15u >> 40) & mask;
  for (;; slot = (slot + 1) & mask) {
    const std::uint32_t index = table_[slot];
    // What the table holds of blocks before this one names colours that there are not, or that lie elsewhere.
    if (index >= static_cast<std::uint32_t>(count_) || colours_[index].slot != slot) break;
    if (colours_[index].place == place) return colours_[index];
  }
  table_[slot] = static_cast<std::uint32_t>(count_);
  Colour& fresh = colours_[static_cast<std::size_t>(count_++)];
  fresh = Colour{};
  std::memcpy(fresh.values, cluster.means, sizeof cluster.means);
  fresh.values[mean_x] = x;
  fresh.values[mean_y] = y;
  fresh.place = place;
  fresh.slot = slot;
  return fresh;
}

HWY_INLINE void Palette::accumulate(const Cluster& cluster, float weight, Colour& to) {
  const Lanes8 d;
  to.weight += weight;
  const Vector8 x = hn::Set(d, cluster.means[mean_x] - to.values[mean_x]),
                y = hn::Set(d, cluster.means[mean_y] - to.values[mean_y]), w = hn::Set(d, weight);
  for (std::size_t k = 0; k < 8; k += hn::Lanes(d)) {
    float* const sums = to.values + k;
    const Vector8 t = hn::Sub(hn::Load(d, cluster.means + k), hn::Load(d, sums));
    const Vector8 weighed = hn::Mul(w, t);
    hn::Store(hn::Add(hn::Load(d, sums + sum_t), weighed), d, sums + sum_t);
    hn::Store(hn::MulAdd(x, weighed, hn::Load(d, sums + sum_x)), d, sums + sum_x);
    hn::Store(hn::MulAdd(y, weighed, hn::Load(d, sums + sum_y)), d, sums + sum_y);
    const Vector8 squares = hn::MulAdd(weighed, t, hn::Load(d, sums + sum_square));
    hn::Store(hn::MulAdd(w, hn::Load(d, cluster.variances + k), squares), d, sums + sum_square);
  }
}

/// A cluster that weighs less than this part of a pixel is not seen.
constexpr float least_weight = 1e-5f;

HWY_INLINE void Palette::add(const CellRow& row, std::uint32_t begin, std::uint32_t end, float x, float y) {
  const Lanes8 d;
  const Vector8 one = hn::Set(d, 1.0f), scale = hn::Set(d, c_.space_scale), vx = hn::Set(d, x),
                vy = hn::Set(d, y);
  for (std::uint32_t i = begin; i < end; i += static_cast<std::uint32_t>(hn::Lanes(d))) {
    const Vector8 dx = hn::Sub(hn::LoadU(d, row.x.data() + i), vx),
                  dy = hn::Sub(hn::LoadU(d, row.y.data() + i), vy);
    const Vector8 u = hn::NegMulAdd(scale, hn::MulAdd(dx, dx, hn::Mul(dy, dy)), one);
    hn::StoreU(hn::Mul(hn::LoadU(d, row.count.data() + i), weight_of(d, u)), d,
               weights_.data() + (i - begin));
  }
  for (std::uint32_t i = begin; i < end; ++i) {
    const float weight = weights_[i - begin];
    if (weight < least_weight) continue;
    const Cluster& cluster = row.clusters[i];
    accumulate(cluster, weight, colour_at(row.colour[i], cluster, x, y));
  }
}

/// Colours are dropped that weigh less than this part of all, or than so many pixels, whichever is less; and
/// fewer where they would together be more than rarest_together: in noise every colour is rare.
constexpr float rarest = 3e-4f, rarest_pixels = 4.0f, rarest_together = 1e-2f;

/// A pixel whose colour was dropped is as good as alone in the block: it stays what it is, but for its like.
HWY_INLINE void Palette::drop_rare() {
  const auto end = colours_.begin() + count_;
  const auto weight_under = [&](float most) {
    float sum = 0.0f;
    for (auto c = colours_.begin(); c != end; ++c)
      if (c->weight < most) sum += c->weight;
    return sum;
  };
  const float all = weight_under(std::numeric_limits<float>::infinity());
  float least = std::min(rarest * c_.rarity * all, rarest_pixels);
  while (weight_under(least) > rarest_together * all) least *= 0.5f;
  count_ = static_cast<int>(
      std::remove_if(colours_.begin(), end, [=](const Colour& c) { return c.weight < least; }) -
      colours_.begin());
}

/// From colour by colour to field by field.
HWY_INLINE void Palette::gather() {
  stride_ = (count_ + 15) / 16 * 16;
  const auto stride = static_cast<std::size_t>(stride_);
  if (sums_.size() < stride * sum_fields) {
    sums_.resize(stride * sum_fields);
    fields_.resize(stride * palette_fields);
    row_.resize(stride * row_fields);
  }
  for (int i = 0; i < count_; ++i) {
    const Colour& from = colours_[static_cast<std::size_t>(i)];
    for (std::ptrdiff_t f = 0; f < sum_weight; ++f)
      sums_[static_cast<std::size_t>(f * stride_ + i)] = from.values[f];
    sums_[static_cast<std::size_t>(sum_weight * stride_ + i)] = from.weight;
  }
  for (std::ptrdiff_t i = count_; i < stride_; ++i)
    sums_[static_cast<std::size_t>(sum_weight * stride_ + i)] = 1.0f;
}

HWY_INLINE void Palette::finish() {
  drop_rare();
  gather();
  for (int i = 0; i < count_; i += static_cast<int>(hn::Lanes(Lanes8()))) finish_lanes(i);
}

/// 3 f^2, or the straight piece's: the slope of lab_f_inverse.
HWY_INLINE Vector8 lab_f_inverse_slope(Vector8 f) {
  const Lanes8 d;
  const Vector8 curved = hn::Mul(hn::Set(d, 3.0f), hn::Mul(f, f));
  return hn::IfThenElse(hn::Gt(f, hn::Set(d, 6.0f / 29.0f)), curved, hn::Set(d, 108.0f / 841.0f));
}

HWY_INLINE void Palette::finish_lanes(int i) {
  const Lanes8 d;
  using V = Vector8;
  const auto sum = [&](int f, int lane)
                       HWY_ATTR { return hn::LoadU(d, sums_.data() + (f + lane) * stride_ + i); };
  const auto store = [&](int f, V v) HWY_ATTR { hn::StoreU(v, d, fields_.data() + f * stride_ + i); };
  const auto number = [&](double v) HWY_ATTR { return hn::Set(d, static_cast<float>(v)); };
  const V one = number(1.0), weight = sum(sum_weight, 0), per_weight = hn::Div(one, weight);
  const auto mean = [&](int f, int lane) HWY_ATTR { return hn::Mul(sum(f, lane), per_weight); };
  const double per_variance = 2.0 * weight_end * static_cast<double>(c_.space_scale);  // 1/sigma^2
  const V mx = mean(sum_t, mean_x), my = mean(sum_t, mean_y);

  // u = 1 - top/weight_end + (x mx + y my)/(s^2 weight_end) + ...; the weight is multiplied by exp(top),
  // where top is the exponent's greatest value in the block: u stays under 1, where the polynomial is good.
  const V first = number(per_variance), half = number(0.5 * per_variance * per_variance);
  const V ux = hn::Mul(first, mx), uy = hn::Mul(first, my);
  const V uxx = hn::Mul(half, hn::NegMulAdd(mx, mx, mean(sum_x, mean_x)));
  const V uxy = hn::Mul(hn::Add(half, half), hn::NegMulAdd(mx, my, mean(sum_x, mean_y)));
  const V uyy = hn::Mul(half, hn::NegMulAdd(my, my, mean(sum_y, mean_y)));
  const V half_width = number(0.5 * c_.block_width), half_height = number(0.5 * c_.block_height);
  const auto most = [&](V by_x, V by_xx, V by_y, V by_yy) HWY_ATTR {
    return hn::MulAdd(half_width, hn::MulAdd(half_width, by_xx, hn::Abs(by_x)),
                      hn::Mul(half_height, hn::MulAdd(half_height, by_yy, hn::Abs(by_y))));
  };
  V top = hn::MulAdd(hn::Mul(half_width, half_height), hn::Abs(uxy), most(ux, uxx, uy, uyy));
  top = hn::Min(hn::Max(top, hn::Zero(d)), number(0.8 * weight_end));
  const V per_end = number(1.0 / weight_end);
  store(colour_u, hn::NegMulAdd(top, per_end, one));
  const V terms[5] = {ux, uy, uxx, uxy, uyy};
  for (int k = 0; k < 5; ++k) store(colour_u + 1 + k, hn::Mul(terms[k], per_end));

  const V ends = number(2.0 * weight_end);
  V product = hn::Mul(weight, hn::Exp(d, top)), lab[3], moved_by[3];
  for (int k = 0; k < 3; ++k) {
    const int field = mean_lab + k;
    const V m = mean(sum_t, field);
    const V variance = hn::Max(hn::Zero(d), hn::NegMulAdd(m, m, mean(sum_square, field)));
    const V root = hn::Sqrt(hn::Div(one, hn::MulAdd(ends, variance, one)));
    product = hn::Mul(product, root);
    lab[k] = hn::Add(sum(sum_first, field), m);
    moved_by[k] = hn::Mul(ends, hn::Mul(variance, root));
    store(colour_root + k, root);
    store(colour_lab + k, hn::Mul(lab[k], root));
    const V step = hn::Mul(first, root);
    store(colour_lab + 3 + k, hn::Mul(step, hn::NegMulAdd(mx, m, mean(sum_x, field))));
    store(colour_lab + 6 + k, hn::Mul(step, hn::NegMulAdd(my, m, mean(sum_y, field))));
  }
  store(colour_weight, product);
  for (int k = 0; k < 3; ++k) {
    const int field = mean_light + k;
    const V m = mean(sum_t, field);
    store(colour_light + k, hn::Add(sum(sum_first, field), m));
    store(colour_light + 3 + k, hn::Mul(first, hn::NegMulAdd(mx, m, mean(sum_x, field))));
    store(colour_light + 6 + k, hn::Mul(first, hn::NegMulAdd(my, m, mean(sum_y, field))));
  }

  // X, Y, Z follow L, a and b as f follows them and the cube follows f.
  const double unscale = 1.0 / static_cast<double>(c_.lab_scale);
  const V fy = hn::MulAdd(lab[0], number(unscale / 116.0), number(16.0 / 116.0));
  const V fx = hn::MulAdd(lab[1], number(unscale / 500.0), fy);
  const V fz = hn::NegMulAdd(lab[2], number(unscale / 200.0), fy);
  const V x = lab_f_inverse_slope(fx), y = lab_f_inverse_slope(fy), z = lab_f_inverse_slope(fz);
  const V by_l = hn::Mul(number(-unscale / 116.0), moved_by[0]),
          by_a = hn::Mul(number(-unscale / 500.0), moved_by[1]),
          by_b = hn::Mul(number(unscale / 200.0), moved_by[2]);
  store(colour_slope, hn::Mul(by_l, x));
  store(colour_slope + 1, hn::Mul(by_a, x));
  store(colour_slope + 2, hn::Mul(by_l, y));
  store(colour_slope + 3, hn::Mul(by_l, z));
  store(colour_slope + 4, hn::Mul(by_b, z));
}

HWY_INLINE void Palette::set_row(float at) {
  const Lanes8 d;
  const Vector8 y = hn::Set(d, at);
  for (int i = 0; i < count_; i += static_cast<int>(hn::Lanes(d))) {
    const auto get = [&](int f) HWY_ATTR { return hn::LoadU(d, fields_.data() + f * stride_ + i); };
    const auto store = [&](int f, Vector8 v) HWY_ATTR { hn::StoreU(v, d, row_.data() + f * stride_ + i); };
    store(row_u, hn::MulAdd(y, hn::MulAdd(y, get(colour_u + 5), get(colour_u + 2)), get(colour_u)));
    store(row_u_x, hn::MulAdd(y, get(colour_u + 4), get(colour_u + 1)));
    for (int k = 0; k < 3; ++k) {
      store(row_lab + k, hn::MulAdd(y, get(colour_lab + 6 + k), get(colour_lab + k)));
      store(row_light + k, hn::MulAdd(y, get(colour_light + 6 + k), get(colour_light + k)));
    }
  }
}

}  // namespace
}  // namespace scotopic::acuity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
