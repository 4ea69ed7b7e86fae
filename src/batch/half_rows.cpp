#include "batch/half_rows.h"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/half_rows.cpp"
#include <hwy/foreach_target.h>
// foreach_target first: it includes this file once per target.
#include <hwy/highway.h>

#include "batch/half-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

using Floats = hn::ScalableTag<float>;
constexpr std::size_t most_lanes_of_float = HWY_MAX_BYTES / sizeof(float);

// Infinity or NaN.
inline std::uint16_t half_from_odd(std::uint32_t bits) {
  const std::uint32_t payload = bits & 0x7fffff, kept = payload >> 13;
  const std::uint32_t nan = payload == 0 ? 0u : std::max(1u, kept);
  return static_cast<std::uint16_t>((bits >> 16 & 0x8000) | 0x7c00 | nan);
}

HWY_INLINE void floats_from_vector(const std::uint16_t* halves, float* out) {
  const Floats d;
  const HalfTag<Floats> h;
  const auto bits = hn::LoadU(h, halves);
  const auto nan = hn::Gt(hn::And(bits, hn::Set(h, 0x7fff)), hn::Set(h, 0x7c00));
  const auto value =
      HWY_UNLIKELY(!hn::AllFalse(h, nan)) ? float_from_half<true>(d, bits) : float_from_half<false>(d, bits);
  hn::StoreU(value, d, out);
}

HWY_INLINE void halves_from_vector(const float* values, std::uint16_t* out) {
  const Floats d;
  const auto value = hn::LoadU(d, values);
  hn::StoreU(half_from_float(d, value), HalfTag<Floats>(), out);
  // False for NaN, too.
  if (HWY_LIKELY(hn::AllTrue(d, hn::Lt(hn::Abs(value), hn::Inf(d))))) return;
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
    const auto bits = std::bit_cast<std::uint32_t>(values[i]);
    if ((bits & 0x7f800000) == 0x7f800000) out[i] = half_from_odd(bits);
  }
}

// The last ones, fewer than a vector, go through a padded copy.
template <typename From, typename To, class Convert>
HWY_INLINE void in_vectors(const From* from, std::size_t count, To* to, Convert convert) {
  const std::size_t lanes = hn::Lanes(Floats());
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) convert(from + i, to + i);
  if (i == count) return;
  From some[most_lanes_of_float] = {};
  To converted[most_lanes_of_float];
  std::copy(from + i, from + count, some);
  convert(some, converted);
  std::copy_n(converted, count - i, to + i);
}

void floats_from(const std::uint16_t* halves, std::size_t count, float* out) {
  in_vectors(halves, count, out, [](const std::uint16_t* from, float* to) { floats_from_vector(from, to); });
}
void halves_from(const float* values, std::size_t count, std::uint16_t* out) {
  in_vectors(values, count, out, [](const float* from, std::uint16_t* to) { halves_from_vector(from, to); });
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scotopic {

HWY_EXPORT(floats_from);
HWY_EXPORT(halves_from);

void floats_from_halves(const std::uint16_t* halves, std::size_t count, float* out) noexcept {
  HWY_DYNAMIC_DISPATCH(floats_from)(halves, count, out);
}

void halves_from_floats(const float* values, std::size_t count, std::uint16_t* out) noexcept {
  HWY_DYNAMIC_DISPATCH(halves_from)(values, count, out);
}

}  // namespace scotopic
#endif  // HWY_ONCE
