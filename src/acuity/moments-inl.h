// Moments of clusters: collected one by one or many at once, and finished for the filter, lanes at a time.
#if defined(SCOTOPIC_ACUITY_MOMENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_ACUITY_MOMENTS_INL_H_
#undef SCOTOPIC_ACUITY_MOMENTS_INL_H_
#else
#define SCOTOPIC_ACUITY_MOMENTS_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <memory>

#include "acuity/engines.h"
#include "acuity/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::acuity::HWY_NAMESPACE {
namespace {

enum Moment {
  mean_x,
  mean_y,
  pixel_count,
  mean_lab,
  mean_light = mean_lab + 3,
  variance_lab = mean_light + 3,
  moment_count = variance_lab + 3
};

/// Scaled: under a hundredth of the range kernel's variance in L, a and b, a cluster is flat.
constexpr float flat_variance = static_cast<float>(0.01 * 0.5 / weight_end);

/// Moments of as many squares of 2x2 pixels as there are lanes.
struct Squares {
  HWY_ALIGN float values[moment_count][16];
  HWY_ALIGN float narrow[16];  // 1: all four pixels are there, and alike enough for one cluster
  HWY_ALIGN float flat[16];    // 1: so alike that it counts as flat
  bool all_flat;

  std::array<float, moment_count> moments(int i) const {
    std::array<float, moment_count> m;
    for (int f = 0; f < moment_count; ++f) m[static_cast<std::size_t>(f)] = values[f][i];
    return m;
  }

  /// `planes`: L, a, b, R, G, B of two rows, from column `column`, which is image_x in the image.
  void measure(const Constants& c, const float* const (&planes)[2][6], int column, int image_x, int image_y);
};

HWY_INLINE void Squares::measure(const Constants& c, const float* const (&planes)[2][6], int column,
                                 int image_x, int image_y) {
  const Lanes d;
  const Vector quarter = hn::Set(d, 0.25f);
  auto alike = hn::Eq(quarter, quarter), even = alike;
  for (int k = 0; k < 6; ++k) {
    Vector p0, p1, p2, p3;
    hn::LoadInterleaved2(d, planes[0][k] + column, p0, p1);
    hn::LoadInterleaved2(d, planes[1][k] + column, p2, p3);
    // No fused multiplications: the sums are those of a cell that is measured alone.
    const Vector sum = hn::Add(hn::Add(hn::Sub(p1, p0), hn::Sub(p2, p0)), hn::Sub(p3, p0));
    const Vector mean = hn::Add(p0, hn::Mul(sum, quarter));
    hn::Store(mean, d, values[mean_lab + k]);
    if (k >= 3) continue;
    const auto square = [&](Vector v) HWY_ATTR { return hn::Mul(hn::Sub(v, mean), hn::Sub(v, mean)); };
    const Vector variance =
        hn::Mul(hn::Add(hn::Add(hn::Add(square(p0), square(p1)), square(p2)), square(p3)), quarter);
    hn::Store(variance, d, values[variance_lab + k]);
    alike = hn::And(alike, hn::Le(variance, hn::Set(d, c.split_variance)));
    even = hn::And(even, hn::Le(variance, hn::Set(d, flat_variance)));
    if (k > 0) continue;
    const Vector darkest_absent = hn::Max(hn::Max(p0, p1), hn::Max(p2, p3));
    alike = hn::And(alike, hn::Lt(darkest_absent, hn::Set(d, 0.5f * absent)));
  }
  const Vector x =
      hn::MulAdd(hn::Iota(d, 0.0f), hn::Set(d, 2.0f), hn::Set(d, static_cast<float>(image_x) + 0.5f));
  hn::Store(x, d, values[mean_x]);
  hn::Store(hn::Set(d, static_cast<float>(image_y) + 0.5f), d, values[mean_y]);
  hn::Store(hn::Set(d, 4.0f), d, values[pixel_count]);
  hn::Store(hn::IfThenElseZero(alike, hn::Set(d, 1.0f)), d, narrow);
  even = hn::And(even, alike);
  hn::Store(hn::IfThenElseZero(even, hn::Set(d, 1.0f)), d, flat);
  all_flat = hn::AllTrue(d, even);
}

/// The moments of all clusters of a row, field by field.
class Moments {
 public:
  explicit Moments(int most)
      : stride_(most + 16),
        values_(std::make_unique_for_overwrite<float[]>(static_cast<std::size_t>(stride_ * moment_count))) {}

  int count() const { return count_; }

  void add(const std::array<float, moment_count>& m) {
    for (int f = 0; f < moment_count; ++f)
      values_[static_cast<std::size_t>(f * stride_ + count_)] = m[static_cast<std::size_t>(f)];
    ++count_;
  }

  void add_all(const Squares& squares) {
    const Lanes d;
    for (int f = 0; f < moment_count; ++f)
      hn::StoreU(hn::Load(d, squares.values[f]), d, values_.get() + f * stride_ + count_);
    count_ += static_cast<int>(hn::Lanes(d));
  }

  /// `flat`: as if the variances were 0.
  void finish(const Constants& c, bool flat, Clusters& out) const;

 private:
  Vector field(int f, int i) const { return hn::LoadU(Lanes(), values_.get() + f * stride_ + i); }
  void finish_lanes(const Constants& c, bool flat, int i, Clusters& out) const;

  int count_ = 0;
  std::ptrdiff_t stride_;
  std::unique_ptr<float[]> values_;
};

/// In units of the range kernel's variance, scaled: a cluster looks no wider, as pixels too far apart for one
/// cluster must not look like a little of everything between them. Measured to be near the best on HDR
/// images.
constexpr float widest_variance = static_cast<float>(4.0 * 0.5 / weight_end);

/// 3 f^2, or the straight piece's: the slope of lab_f_inverse.
HWY_INLINE Vector lab_f_inverse_slope(Vector f) {
  const Lanes d;
  const Vector curved = hn::Mul(hn::Set(d, 3.0f), hn::Mul(f, f));
  return hn::IfThenElse(hn::Gt(f, hn::Set(d, 6.0f / 29.0f)), curved, hn::Set(d, 108.0f / 841.0f));
}

HWY_INLINE void Moments::finish_lanes(const Constants& c, bool flat, int i, Clusters& out) const {
  const Lanes d;
  const auto store = [&](int f, Vector v)
                         HWY_ATTR { hn::StoreU(v, d, out.values.get() + f * out.stride + i); };
  const Vector ends = hn::Set(d, static_cast<float>(2.0 * weight_end)), one = hn::Set(d, 1.0f);
  const auto spread = [&](int k) HWY_ATTR {
    return hn::Min(field(variance_lab + k, i), hn::Set(d, flat ? 0.0f : widest_variance));
  };
  const auto root_of = [&](Vector v) HWY_ATTR { return hn::Sqrt(hn::Div(one, hn::MulAdd(ends, v, one))); };
  const Vector vl = spread(0), va = spread(1), vb = spread(2);
  const Vector rl = root_of(vl), ra = root_of(va), rb = root_of(vb);
  const Vector l = field(mean_lab, i), a = field(mean_lab + 1, i), b = field(mean_lab + 2, i);
  store(cluster_x, field(mean_x, i));
  store(cluster_y, field(mean_y, i));
  store(cluster_weight, hn::Mul(field(pixel_count, i), hn::Mul(rl, hn::Mul(ra, rb))));
  store(cluster_root, rl);
  store(cluster_root + 1, ra);
  store(cluster_root + 2, rb);
  store(cluster_lab, hn::Mul(l, rl));
  store(cluster_lab + 1, hn::Mul(a, ra));
  store(cluster_lab + 2, hn::Mul(b, rb));
  // RGB follows L, a and b as f follows them and the cube follows f.
  const float unscale = 1.0f / c.lab_scale;
  const Vector fy = hn::MulAdd(l, hn::Set(d, unscale / 116.0f), hn::Set(d, 16.0f / 116.0f));
  const Vector fx = hn::MulAdd(a, hn::Set(d, unscale / 500.0f), fy);
  const Vector fz = hn::NegMulAdd(b, hn::Set(d, unscale / 200.0f), fy);
  const Vector x = lab_f_inverse_slope(fx), y = lab_f_inverse_slope(fy), z = lab_f_inverse_slope(fz);
  const auto step = [&](float by, Vector v, Vector root) HWY_ATTR {
    return hn::Mul(hn::Set(d, -unscale / by), hn::Mul(ends, hn::Mul(v, root)));
  };
  const Vector step_l = step(116.0f, vl, rl), step_a = step(500.0f, va, ra), step_b = step(-200.0f, vb, rb);
  for (int k = 0; k < 3; ++k) {
    const Vector tx = hn::Mul(x, hn::Set(d, c.rgb_from_f3[k][0])),
                 ty = hn::Mul(y, hn::Set(d, c.rgb_from_f3[k][1])),
                 tz = hn::Mul(z, hn::Set(d, c.rgb_from_f3[k][2]));
    store(cluster_light + k, field(mean_light + k, i));
    store(cluster_slope + 3 * k, hn::Mul(step_l, hn::Add(tx, hn::Add(ty, tz))));
    store(cluster_slope + 3 * k + 1, hn::Mul(step_a, tx));
    store(cluster_slope + 3 * k + 2, hn::Mul(step_b, tz));
  }
}

HWY_INLINE void Moments::finish(const Constants& c, bool flat, Clusters& out) const {
  out.stride = count_ + 16;
  out.values = std::make_unique_for_overwrite<float[]>(static_cast<std::size_t>(out.stride * cluster_fields));
  for (int i = 0; i < count_; i += static_cast<int>(hn::Lanes(Lanes()))) finish_lanes(c, flat, i, out);
}

}  // namespace
}  // namespace scotopic::acuity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
