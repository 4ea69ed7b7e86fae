// IEEE 754 binary16 to binary32 and back, a vector at a time. Compiled once per SIMD target. The same bits on
// every target: by the machine's own instructions where AVX2 promises them, else by integer arithmetic.
#if defined(SCOTOPIC_HALF_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_HALF_INL_H_
#undef SCOTOPIC_HALF_INL_H_
#else
#define SCOTOPIC_HALF_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#undef SCOTOPIC_HAS_F16C
#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86 && !defined(HWY_DISABLE_F16C)
#define SCOTOPIC_HAS_F16C 1
#else
#define SCOTOPIC_HAS_F16C 0
#endif

// F: a tag of float.
template <class F>
using HalfTag = hn::Rebind<std::uint16_t, F>;

// Exactly; infinity stays what it is. NaN stays NaN, and keeps its payload where `any_nan` (else a signalling
// one may become quiet).
template <bool any_nan, class F>
HWY_INLINE hn::Vec<F> float_from_half(F d, hn::Vec<HalfTag<F>> half) {
  const hn::RebindToUnsigned<F> u;
  const hn::RebindToSigned<F> i;
  if constexpr (SCOTOPIC_HAS_F16C && !any_nan)
    return hn::PromoteTo(d, hn::BitCast(hn::Rebind<hwy::float16_t, F>(), half));
  const auto bits = hn::PromoteTo(u, half);
  const auto magnitude = hn::And(bits, hn::Set(u, 0x7fff));
  // 13 more bits of mantissa; the exponent's bias is 127, not 15, and its largest, of NaN and infinity, 255,
  // not 31.
  const auto widened = hn::ShiftLeft<13>(magnitude);
  const auto odd = hn::IfThenElseZero(hn::Gt(magnitude, hn::Set(u, 0x7bff)), hn::Set(u, 112u << 23));
  const auto normal = hn::BitCast(d, hn::Add(hn::Add(widened, hn::Set(u, 112u << 23)), odd));
  const auto subnormal = hn::Mul(hn::ConvertTo(d, hn::BitCast(i, magnitude)), hn::Set(d, 0x1p-24f));
  const auto is_normal = hn::RebindMask(d, hn::Gt(magnitude, hn::Set(u, 0x3ff)));
  const auto sign = hn::BitCast(d, hn::ShiftLeft<16>(hn::And(bits, hn::Set(u, 0x8000))));
  return hn::Or(sign, hn::IfThenElse(is_normal, normal, subnormal));
}

// Finite values only: nearest, ties to even; beyond half's largest number, that number.
template <class F>
HWY_INLINE hn::Vec<HalfTag<F>> half_from_float(F d, hn::Vec<F> x) {
  const HalfTag<F> h;
  const hn::RebindToUnsigned<F> u;
  if constexpr (SCOTOPIC_HAS_F16C) {
    const auto within = hn::Min(hn::Max(x, hn::Set(d, -65504.0f)), hn::Set(d, 65504.0f));
    return hn::BitCast(h, hn::DemoteTo(hn::Rebind<hwy::float16_t, F>(), within));
  }
  const auto magnitude = hn::Min(hn::Abs(x), hn::Set(d, 65504.0f));
  const auto bits = hn::BitCast(u, magnitude);
  // Half of the last place kept, less one where the bit kept is even: a carry is the rounding.
  const auto even = hn::And(hn::ShiftRight<13>(bits), hn::Set(u, 1));
  const auto rounded = hn::Add(bits, hn::Add(hn::Set(u, 0xfff), even));
  const auto normal = hn::Sub(hn::ShiftRight<13>(rounded), hn::Set(u, 112u << 10));
  // 1/2 has a last place of 2^-24, half's smallest: the sum's own rounding is the one wanted.
  const auto shifted = hn::BitCast(u, hn::Add(magnitude, hn::Set(d, 0.5f)));
  const auto subnormal = hn::Sub(shifted, hn::BitCast(u, hn::Set(d, 0.5f)));
  const auto is_normal = hn::RebindMask(u, hn::Ge(magnitude, hn::Set(d, 0x1p-14f)));
  const auto sign = hn::ShiftRight<16>(hn::AndNot(hn::Set(u, 0x7fffffff), hn::BitCast(u, x)));
  return hn::DemoteTo(
      h, hn::BitCast(hn::RebindToSigned<F>(), hn::Or(sign, hn::IfThenElse(is_normal, normal, subnormal))));
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
