// SIMD pieces of both engines: CIELAB from RGB, and the weight. Included once per instruction set.
#if defined(SCOTOPIC_ACUITY_SIMD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_ACUITY_SIMD_INL_H_
#undef SCOTOPIC_ACUITY_SIMD_INL_H_
#else
#define SCOTOPIC_ACUITY_SIMD_INL_H_
#endif

#include <hwy/highway.h>

#include "acuity/engines.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::acuity::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// x^(1/3) for 1e-3 <= x <= 1e10, relative error < 5e-7: x^(-1/3) from the exponent bits (error < 4.2 %), three
/// Newton steps without a division (each squares the error), times x^(2/3).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V cube_root(D d, V x) {
  const hn::RebindToSigned<D> di;
  const V bits = hn::ConvertTo(d, hn::BitCast(di, x));
  // 4/3 of the bits of 1.0f, less what makes the error's two extremes equal.
  const V guess_bits = hn::NegMulAdd(bits, hn::Set(d, 1.0f / 3.0f), hn::Set(d, 1.42e9f));
  V y = hn::BitCast(d, hn::ConvertTo(di, guess_bits));
  const V third = hn::Mul(x, hn::Set(d, 1.0f / 3.0f));
  for (int step = 0; step < 3; ++step) {
    const V cube = hn::Mul(hn::Mul(y, y), y);
    y = hn::Mul(y, hn::NegMulAdd(third, cube, hn::Set(d, 4.0f / 3.0f)));
  }
  return hn::Mul(hn::Mul(y, y), x);
}

/// CIE 15 f(t), with its straight piece below (6/29)^3 carried on to any negative t.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V lab_f(D d, V t) {
  const V knee = hn::Set(d, 216.0f / 24389.0f);
  const V straight = hn::MulAdd(t, hn::Set(d, 841.0f / 108.0f), hn::Set(d, 4.0f / 29.0f));
  const V curved = cube_root(d, hn::Min(hn::Max(t, knee), hn::Set(d, 1e10f)));
  return hn::IfThenElse(hn::Gt(t, knee), curved, straight);
}

/// The inverse of lab_f: the cube, and the straight piece.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V lab_f_inverse(D d, V f) {
  const V straight = hn::Mul(hn::Sub(f, hn::Set(d, 4.0f / 29.0f)), hn::Set(d, 108.0f / 841.0f));
  return hn::IfThenElse(hn::Gt(f, hn::Set(d, 6.0f / 29.0f)), hn::Mul(hn::Mul(f, f), f), straight);
}

template <class V>
struct Three {
  V x, y, z;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE Three<V> transform(D d, const float (&m)[3][3], Three<V> v) {
  const auto row = [&](const float(&a)[3]) HWY_ATTR {
    return hn::MulAdd(hn::Set(d, a[2]), v.z,
                      hn::MulAdd(hn::Set(d, a[1]), v.y, hn::Mul(hn::Set(d, a[0]), v.x)));
  };
  return {row(m[0]), row(m[1]), row(m[2])};
}

/// Scaled CIELAB of linear RGB; lightness `absent` where the pixel is not finite or beyond lab_limit.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Three<V> scaled_lab(D d, const Constants& c, Three<V> rgb) {
  const Three<V> t = transform(d, c.f_from_rgb, rgb);
  const V fx = lab_f(d, t.x), fy = lab_f(d, t.y), fz = lab_f(d, t.z);
  const V scale = hn::Set(d, c.lab_scale);
  const V l = hn::Mul(scale, hn::MulSub(hn::Set(d, 116.0f), fy, hn::Set(d, 16.0f)));
  const V a = hn::Mul(hn::Mul(scale, hn::Set(d, 500.0f)), hn::Sub(fx, fy));
  const V b = hn::Mul(hn::Mul(scale, hn::Set(d, 200.0f)), hn::Sub(fy, fz));
  const V farthest = hn::Max(hn::Abs(l), hn::Max(hn::Abs(a), hn::Abs(b)));
  // A maximum may lose a NaN; a sum does not, and NaN compares false.
  const V sum = hn::Add(hn::Add(hn::Abs(l), hn::Abs(a)), hn::Abs(b));
  const V limit = hn::Set(d, lab_limit * c.lab_scale);
  const auto present = hn::And(hn::Le(farthest, limit), hn::Le(sum, hn::Mul(limit, hn::Set(d, 3.0f))));
  return {hn::IfThenElse(present, l, hn::Set(d, absent)), hn::IfThenElseZero(present, a),
          hn::IfThenElseZero(present, b)};
}

/// Scaled CIELAB of `count` pixels of a row.
HWY_INLINE void lab_of_row(const Constants& c, const float* r, const float* g, const float* b, int count,
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

/// RGB of scaled CIELAB `to` less that of `from`: exactly 0 where they are equal.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Three<V> rgb_difference(D d, const Constants& c, Three<V> from, Three<V> to) {
  const V unscale = hn::Set(d, 1.0f / c.lab_scale);
  const auto cubes = [&](Three<V> lab) HWY_ATTR {
    const V fy = hn::MulAdd(hn::Mul(lab.x, unscale), hn::Set(d, 1.0f / 116.0f), hn::Set(d, 16.0f / 116.0f));
    const V fx = hn::MulAdd(hn::Mul(lab.y, unscale), hn::Set(d, 1.0f / 500.0f), fy);
    const V fz = hn::NegMulAdd(hn::Mul(lab.z, unscale), hn::Set(d, 1.0f / 200.0f), fy);
    return Three<V>{lab_f_inverse(d, fx), lab_f_inverse(d, fy), lab_f_inverse(d, fz)};
  };
  const Three<V> a = cubes(from), b = cubes(to);
  return transform(d, c.rgb_from_f3, Three<V>{hn::Sub(b.x, a.x), hn::Sub(b.y, a.y), hn::Sub(b.z, a.z)});
}

using Lanes = hn::CappedTag<float, 16>;
using Vector = hn::Vec<Lanes>;

/// As many vectors as are worked on side by side: one alone waits for its own long chain of results. Two need
/// the 32 registers of AVX-512.
#if HWY_TARGET <= HWY_AVX3
struct Wide {
  Vector a, b;
};
constexpr int ways = 2;
/// f of each vector of each argument in turn.
template <class F, class... W>
HWY_INLINE Wide each(F f, const W&... w) {
  return {f(w.a...), f(w.b...)};
}
/// f(i) of the place of each vector.
template <class F>
HWY_INLINE Wide from_place(F f) {
  return {f(0), f(1)};
}
template <class F>
HWY_INLINE void to_place(F f, const Wide& w) {
  f(0, w.a);
  f(1, w.b);
}
#else
struct Wide {
  Vector a;
};
constexpr int ways = 1;
template <class F, class... W>
HWY_INLINE Wide each(F f, const W&... w) {
  return {f(w.a...)};
}
template <class F>
HWY_INLINE Wide from_place(F f) {
  return {f(0)};
}
template <class F>
HWY_INLINE void to_place(F f, const Wide& w) {
  f(0, w.a);
}
#endif

HWY_INLINE Wide sub_from(Wide a, Vector x) {
  return each([&](Vector v) HWY_ATTR { return hn::Sub(x, v); }, a);
}
HWY_INLINE Wide sub(Wide a, Wide b) {
  return each([](Vector x, Vector y) HWY_ATTR { return hn::Sub(x, y); }, a, b);
}
HWY_INLINE Wide add(Wide a, Wide b) {
  return each([](Vector x, Vector y) HWY_ATTR { return hn::Add(x, y); }, a, b);
}
HWY_INLINE Wide mul(Wide a, Wide b) {
  return each([](Vector x, Vector y) HWY_ATTR { return hn::Mul(x, y); }, a, b);
}
HWY_INLINE Wide scaled(Wide a, Vector x) {
  return each([&](Vector v) HWY_ATTR { return hn::Mul(v, x); }, a);
}
HWY_INLINE Wide mul_add(Wide a, Wide b, Wide c) {
  return each([](Vector x, Vector y, Vector z) HWY_ATTR { return hn::MulAdd(x, y, z); }, a, b, c);
}
HWY_INLINE Wide scaled_add(Wide a, Vector x, Wide c) {
  return each([&](Vector y, Vector z) HWY_ATTR { return hn::MulAdd(y, x, z); }, a, c);
}
HWY_INLINE Wide less_square(Wide a, Wide c) {
  return each([](Vector x, Vector z) HWY_ATTR { return hn::NegMulAdd(x, x, z); }, a, c);
}

/// exp(-weight_end (1 - u)), 0 for u <= 0; see weight_end.
HWY_INLINE Wide weights(Wide u) {
  const Lanes d;
  const Vector zero = hn::Zero(d);
  const Vector c1 = hn::Set(d, 0.98458979f), c2 = hn::Set(d, -0.81163085f), c3 = hn::Set(d, 0.82703292f);
  u = each([&](Vector x) HWY_ATTR { return hn::Max(x, zero); }, u);
  Wide w = each([&](Vector x) HWY_ATTR { return hn::MulAdd(x, c3, c2); }, u);
  w = each([&](Vector x, Vector y) HWY_ATTR { return hn::MulAdd(x, y, c1); }, u, w);
  w = mul(u, w);
  w = mul(w, w);
  w = mul(w, w);
  return mul(w, w);
}

/// What a weighted mean changes a pixel by, of three sums, and where there was any weight.
template <AcuitySpace space>
HWY_INLINE Three<Vector> mean_change(const Constants& c, Three<Vector> sums, Vector total,
                                     Three<Vector> lab) {
  const Lanes d;
  const Vector per_weight = hn::Div(hn::Set(d, 1.0f), total);
  const Three<Vector> mean{hn::Mul(sums.x, per_weight), hn::Mul(sums.y, per_weight),
                           hn::Mul(sums.z, per_weight)};
  if constexpr (space == AcuitySpace::light) return mean;
  return rgb_difference(
      d, c, lab, Three<Vector>{hn::Add(lab.x, mean.x), hn::Add(lab.y, mean.y), hn::Add(lab.z, mean.z)});
}

}  // namespace scotopic::acuity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
