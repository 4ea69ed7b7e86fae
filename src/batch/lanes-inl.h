// Vector operations by name, on one vector or on two side by side. Two independent chains of operations keep
// a processor busy where one waits for its own results. Compiled once per SIMD target.
#if defined(SCOTOPIC_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_LANES_INL_H_
#undef SCOTOPIC_LANES_INL_H_
#else
#define SCOTOPIC_LANES_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

namespace lanes {

/// Two vectors, or two masks.
template <class V>
struct Pair {
  V a, b;
};
/// The tag of pairs of D's vectors.
template <class D>
struct PairTag {};

template <class D>
struct Types {
  using T = hn::TFromD<D>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  using Signed = hn::RebindToSigned<D>;
};
template <class D>
struct Types<PairTag<D>> {
  using T = hn::TFromD<D>;
  using V = Pair<hn::Vec<D>>;
  using M = Pair<hn::Mask<D>>;
  using Signed = PairTag<hn::RebindToSigned<D>>;
};

#define SCOTOPIC_ONE(name)                                              \
  using hn::name;                                                       \
  template <class V>                                                    \
  HWY_INLINE auto name(const Pair<V>& x) {                              \
    return Pair<decltype(hn::name(x.a))>{hn::name(x.a), hn::name(x.b)}; \
  }
#define SCOTOPIC_TWO(name)                                                             \
  using hn::name;                                                                      \
  template <class V>                                                                   \
  HWY_INLINE auto name(const Pair<V>& x, const Pair<V>& y) {                           \
    return Pair<decltype(hn::name(x.a, y.a))>{hn::name(x.a, y.a), hn::name(x.b, y.b)}; \
  }
SCOTOPIC_ONE(Abs)
SCOTOPIC_ONE(Sqrt)
SCOTOPIC_TWO(Add)
SCOTOPIC_TWO(Sub)
SCOTOPIC_TWO(Mul)
SCOTOPIC_TWO(Div)
SCOTOPIC_TWO(Min)
SCOTOPIC_TWO(Max)
SCOTOPIC_TWO(And)
SCOTOPIC_TWO(AndNot)
SCOTOPIC_TWO(Or)
SCOTOPIC_TWO(Lt)
SCOTOPIC_TWO(Le)
SCOTOPIC_TWO(Gt)
SCOTOPIC_TWO(Ge)
SCOTOPIC_TWO(Ne)
#define SCOTOPIC_OPERATOR(symbol, name)                                    \
  template <class V>                                                       \
  HWY_INLINE Pair<V> operator symbol(const Pair<V>& x, const Pair<V>& y) { \
    return {hn::name(x.a, y.a), hn::name(x.b, y.b)};                       \
  }
SCOTOPIC_OPERATOR(+, Add)
SCOTOPIC_OPERATOR(-, Sub)
SCOTOPIC_OPERATOR(*, Mul)
SCOTOPIC_OPERATOR(/, Div)
#undef SCOTOPIC_OPERATOR
#undef SCOTOPIC_ONE
#undef SCOTOPIC_TWO

using hn::AllFalse;
using hn::BitCast;
using hn::ConvertTo;
using hn::IfThenElse;
using hn::IfThenElseZero;
using hn::IfThenZeroElse;
using hn::Load;
using hn::Set;
using hn::ShiftRight;
using hn::Zero;

template <class M, class V>
HWY_INLINE Pair<V> IfThenElse(const Pair<M>& m, const Pair<V>& yes, const Pair<V>& no) {
  return {hn::IfThenElse(m.a, yes.a, no.a), hn::IfThenElse(m.b, yes.b, no.b)};
}
template <class M, class V>
HWY_INLINE Pair<V> IfThenElseZero(const Pair<M>& m, const Pair<V>& yes) {
  return {hn::IfThenElseZero(m.a, yes.a), hn::IfThenElseZero(m.b, yes.b)};
}
template <class M, class V>
HWY_INLINE Pair<V> IfThenZeroElse(const Pair<M>& m, const Pair<V>& no) {
  return {hn::IfThenZeroElse(m.a, no.a), hn::IfThenZeroElse(m.b, no.b)};
}
template <int bits, class V>
HWY_INLINE Pair<V> ShiftRight(const Pair<V>& v) {
  return {hn::ShiftRight<bits>(v.a), hn::ShiftRight<bits>(v.b)};
}
template <class D, class V>
HWY_INLINE Pair<hn::Vec<D>> BitCast(PairTag<D>, const Pair<V>& v) {
  return {hn::BitCast(D(), v.a), hn::BitCast(D(), v.b)};
}
template <class D, class V>
HWY_INLINE Pair<hn::Vec<D>> ConvertTo(PairTag<D>, const Pair<V>& v) {
  return {hn::ConvertTo(D(), v.a), hn::ConvertTo(D(), v.b)};
}
template <class D>
HWY_INLINE Pair<hn::Vec<D>> Load(PairTag<D>, const hn::TFromD<D>* at) {
  const auto v = hn::Load(D(), at);
  return {v, v};
}
template <class D>
HWY_INLINE Pair<hn::Vec<D>> Set(PairTag<D>, hn::TFromD<D> x) {
  const auto v = hn::Set(D(), x);
  return {v, v};
}
template <class D>
HWY_INLINE Pair<hn::Vec<D>> Zero(PairTag<D>) {
  return {hn::Zero(D()), hn::Zero(D())};
}
template <class D, class M>
HWY_INLINE bool AllFalse(PairTag<D>, const Pair<M>& m) {
  return hn::AllFalse(D(), hn::Or(m.a, m.b));
}

}  // namespace lanes
}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
