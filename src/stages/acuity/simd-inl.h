// SIMD pieces of both engines: CIELAB from RGB, and the weight. Included once per instruction set.
#if defined(SCOTOPIC_ACUITY_SIMD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_ACUITY_SIMD_INL_H_
#undef SCOTOPIC_ACUITY_SIMD_INL_H_
#else
#define SCOTOPIC_ACUITY_SIMD_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "stages/acuity/engines.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::acuity::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// x^(1/3) for 1e-3 <= x <= 1e10, relative error < 5e-7: x^(-1/3) from the exponent bits (error < 4.2 %),
/// three Newton steps without a division (each squares the error), times x^(2/3).
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

/// CIE 15 f(t), with its straight piece below (6/29)^3 carried on to any negative t. To 9 ulp up to 1e10.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V lab_f(D d, V t) {
  const V knee = hn::Set(d, 216.0f / 24389.0f);
  const V straight = hn::MulAdd(t, hn::Set(d, 841.0f / 108.0f), hn::Set(d, 4.0f / 29.0f));
  const V curved = cube_root(d, hn::Min(hn::Max(t, knee), hn::Set(d, 1e10f)));
  return hn::IfThenElse(hn::Gt(t, knee), curved, straight);
}

/// The inverse of lab_f: the cube, and the straight piece. To 2 ulp above .21.
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

/// X/Xn, Y/Yn, Z/Zn of linear RGB.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Three<V> relative_xyz(D d, const Constants& c, Three<V> rgb) {
  return transform(d, c.f_from_rgb, rgb);
}

/// Scaled CIELAB of X/Xn, Y/Yn, Z/Zn; lightness `absent` where the pixel is not finite or beyond lab_limit.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Three<V> scaled_lab(D d, const Constants& c, Three<V> xyz) {
  const V fx = lab_f(d, xyz.x), fy = lab_f(d, xyz.y), fz = lab_f(d, xyz.z);
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

/// Planes of `count` pixels of a row: scaled L, a, b and, where there are six, X/Xn, Y/Yn, Z/Zn.
template <int planes>
HWY_INLINE void lab_of_row(const Constants& c, const float* const (&rgb)[3], int count,
                           float* const (&out)[planes]) {
  const hn::ScalableTag<float> d;
  using V = hn::Vec<decltype(d)>;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto convert = [&](const float* r, const float* g, const float* b, int at,
                           float* const(&to)[planes]) HWY_ATTR {
    const Three<V> xyz = relative_xyz(d, c, Three<V>{hn::LoadU(d, r), hn::LoadU(d, g), hn::LoadU(d, b)});
    const Three<V> lab = scaled_lab(d, c, xyz);
    const V all[6] = {lab.x, lab.y, lab.z, xyz.x, xyz.y, xyz.z};
    for (int k = 0; k < planes; ++k) hn::StoreU(all[k], d, to[k] + at);
  };
  int i = 0;
  for (; i + lanes <= count; i += lanes) convert(rgb[0] + i, rgb[1] + i, rgb[2] + i, i, out);
  if (i >= count) return;
  constexpr int most = HWY_MAX_BYTES / sizeof(float);
  HWY_ALIGN float in[3][most] = {};
  HWY_ALIGN float rest[planes][most] = {};
  float* to[planes];
  for (int k = 0; k < planes; ++k) to[k] = rest[k];
  for (int k = 0; k < 3; ++k) std::copy(rgb[k] + i, rgb[k] + count, in[k]);
  convert(in[0], in[1], in[2], 0, to);
  for (int k = 0; k < planes; ++k) std::copy_n(rest[k], count - i, out[k] + i);
}

template <class V>
HWY_INLINE Three<V> moved(Three<V> from, Three<V> by) {
  return {hn::Add(from.x, by.x), hn::Add(from.y, by.y), hn::Add(from.z, by.z)};
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

/// exp(-weight_end (1 - u)), 0 for u <= 0; see weight_end.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V weight_of(D d, V u) {
  u = hn::Max(u, hn::Zero(d));
  V w = hn::MulAdd(u, hn::Set(d, 0.82703292f), hn::Set(d, -0.81163085f));
  w = hn::Mul(u, hn::MulAdd(u, w, hn::Set(d, 0.98458979f)));
  w = hn::Mul(w, w);
  w = hn::Mul(w, w);
  return hn::Mul(w, w);
}

}  // namespace scotopic::acuity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
