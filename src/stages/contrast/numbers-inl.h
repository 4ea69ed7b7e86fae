// log2 and 2^x of vectors of floats, from additions and multiplications alone. Included once per instruction
// set.
#if defined(SCOTOPIC_CONTRAST_NUMBERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_CONTRAST_NUMBERS_INL_H_
#undef SCOTOPIC_CONTRAST_NUMBERS_INL_H_
#else
#define SCOTOPIC_CONTRAST_NUMBERS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace scotopic::contrast::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// a x + b, rounded twice.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V times_plus(D d, V a, V x, float b) {
  return hn::Add(hn::Mul(a, x), hn::Set(d, b));
}

/// log2 of a positive normal x: absolute error below 1.2e-7 max(1, |log2 x|). Of the mantissa m in
/// [sqrt(1/2), sqrt(2)) by the series of atanh((m-1)/(m+1)), five terms: the sixth is below 1e-9.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V log2_of(D d, V x) {
  const hn::RebindToSigned<D> di;
  const auto root_half = hn::Set(di, 0x3f3504f3);  // bits of sqrt(1/2)
  const auto exponent = hn::ShiftRight<23>(hn::Sub(hn::BitCast(di, x), root_half));
  const V m = hn::BitCast(d, hn::Sub(hn::BitCast(di, x), hn::ShiftLeft<23>(exponent)));
  const V one = hn::Set(d, 1.0f);
  const V s = hn::Div(hn::Sub(m, one), hn::Add(m, one));
  const V s2 = hn::Mul(s, s);
  V sum = times_plus(d, s2, hn::Set(d, 0.32059890f), 0.41219858f);  // 2/(9 ln 2), 2/(7 ln 2)
  sum = times_plus(d, sum, s2, 0.57707802f);                        // 2/(5 ln 2)
  sum = times_plus(d, sum, s2, 0.96179669f);                        // 2/(3 ln 2)
  sum = times_plus(d, sum, s2, 2.88539008f);                        // 2/ln 2
  return hn::Add(hn::ConvertTo(d, exponent), hn::Mul(s, sum));
}

/// 2^x for -126 <= x <= 126 (beyond: as there), relative error below 2e-7; exactly 1 at 0. Taylor's series of
/// degree 7 in the fraction, at most 1/2: the next term is below 1e-8.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V exp2_of(D d, V x) {
  const hn::RebindToSigned<D> di;
  x = hn::Min(hn::Max(x, hn::Set(d, -126.0f)), hn::Set(d, 126.0f));
  const auto whole = hn::NearestInt(x);
  const V f = hn::Sub(x, hn::ConvertTo(d, whole));
  V sum = times_plus(d, f, hn::Set(d, 1.5252734e-5f), 1.5403530e-4f);
  sum = times_plus(d, sum, f, 1.3333558e-3f);
  sum = times_plus(d, sum, f, 9.6181291e-3f);
  sum = times_plus(d, sum, f, 5.5504109e-2f);
  sum = times_plus(d, sum, f, 0.24022651f);
  sum = times_plus(d, sum, f, 0.69314718f);
  sum = times_plus(d, sum, f, 1.0f);
  const V power = hn::BitCast(d, hn::ShiftLeft<23>(hn::Add(whole, hn::Set(di, 127))));
  return hn::Mul(sum, power);
}

}  // namespace scotopic::contrast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
