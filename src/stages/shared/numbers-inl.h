// What the stages' formulas are written over: a number type, and three of its values side by side. A number
// type N says
//   T               what constants are held in                V, M    a value, and a yes or no for it
//   + - * / of V    one rounding each, never fused            max min abs sqrt less less_equal greater
//   not_equal constant(x)     a member of the stages' constants          number(x), zero(), one()  a literal
//   select(m,a,b)   a where m, else b                          kept(m,a), dropped(m,a)  a, or 0
//   both either without                                        none(m)  true: m holds nowhere (false: it may)
//   rod_share(x,k)  1 - m of MES2 at x cd/m2                   exp(x), see there for its domain
// Scalar<double> (scalar-inl.h) is the reference; LaneNumbers (batch/) computes vectors of pixels.
// A formula may ask none() to save work, never to change a result.
#if defined(SCOTOPIC_STAGES_NUMBERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_STAGES_NUMBERS_INL_H_
#undef SCOTOPIC_STAGES_NUMBERS_INL_H_
#else
#define SCOTOPIC_STAGES_NUMBERS_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>

#include "kernel/matrix3.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

/// L, M, S or R, G, B.
template <class V>
struct Triple {
  V x, y, z;
};

template <class V>
HWY_INLINE Triple<V> operator+(const Triple<V>& a, const Triple<V>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
HWY_INLINE Triple<V> operator-(const Triple<V>& a, const Triple<V>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
HWY_INLINE Triple<V> operator*(V s, const Triple<V>& v) {
  return {s * v.x, s * v.y, s * v.z};
}

template <class V>
HWY_INLINE V sum(const Triple<V>& v) {
  return v.x + v.y + v.z;
}
template <class N, class V>
HWY_INLINE Triple<V> products(const N& n, const Vec3<typename N::T>& row, const Triple<V>& v) {
  return {n.constant(row[0]) * v.x, n.constant(row[1]) * v.y, n.constant(row[2]) * v.z};
}
template <class N, class V>
HWY_INLINE V dot(const N& n, const Vec3<typename N::T>& row, const Triple<V>& v) {
  return sum(products(n, row, v));
}
template <class N, class V>
HWY_INLINE Triple<V> times(const N& n, const Matrix3<typename N::T>& m, const Triple<V>& v) {
  return {dot(n, m[0], v), dot(n, m[1], v), dot(n, m[2], v)};
}
template <class N, class M, class V>
HWY_INLINE Triple<V> select(const N& n, const M& mask, const Triple<V>& yes, const Triple<V>& no) {
  return {n.select(mask, yes.x, no.x), n.select(mask, yes.y, no.y), n.select(mask, yes.z, no.z)};
}
template <class N, class V>
HWY_INLINE V smallest(const N& n, const Triple<V>& v) {
  return n.min(n.min(v.x, v.y), v.z);
}
template <class N, class V>
HWY_INLINE V largest(const N& n, const Triple<V>& v) {
  return n.max(n.max(v.x, v.y), v.z);
}
template <class N, class V>
HWY_INLINE auto below_zero(const N& n, const Triple<V>& v) {
  return n.less(smallest(n, v), n.zero());
}
/// Divisors of lanes whose quotient is not used must not be 0 either.
template <class N, class V>
HWY_INLINE V positive_or_one(const N& n, V x) {
  return n.select(n.greater(x, n.zero()), x, n.one());
}
/// By Horner's rule.
template <class N, std::size_t terms>
HWY_INLINE typename N::V polynomial(const N& n, const std::array<typename N::T, terms>& c, typename N::V x) {
  typename N::V sum = n.constant(c[terms - 1]);
  for (std::size_t k = terms - 1; k-- > 0;) sum = sum * x + n.constant(c[k]);
  return sum;
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
