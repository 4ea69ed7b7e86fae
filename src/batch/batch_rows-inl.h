// Rows of pixels as they lie in memory, and a vector of them as the operator takes it. Compiled once per SIMD
// target (see batch.cpp).
#if defined(SCOTOPIC_BATCH_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_BATCH_ROWS_INL_H_
#undef SCOTOPIC_BATCH_ROWS_INL_H_
#else
#define SCOTOPIC_BATCH_ROWS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "batch/batch.h"
#include "batch/half-inl.h"
#include "batch/lane_numbers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Pixels of R, G, B, A next to each other; E: float, or half's bits.
template <typename E>
struct RgbaRows {
  E* rgba;
  std::size_t count;
};

inline float element_of(const PixelRows&);
inline std::uint16_t element_of(const HalfRows&);
template <typename E>
E element_of(const RgbaRows<E>&);
template <class Rows>
using Element = decltype(element_of(std::declval<Rows>()));

// A vector of elements for each lane of D, which may be double.
template <class D>
using Narrow = hn::Rebind<float, D>;
template <class D, typename E>
using ElementVector = hn::Vec<hn::Rebind<E, D>>;

template <class D>
HWY_INLINE hn::Vec<D> widened(D d, hn::Vec<Narrow<D>> v) {
  if constexpr (sizeof(hn::TFromD<D>) == sizeof(float))
    return v;
  else
    return hn::PromoteTo(d, v);
}
template <class D>
HWY_INLINE hn::Vec<D> widened(D d, hn::Vec<hn::Rebind<std::uint16_t, D>> v) {
  return widened(d, float_from_half<false>(Narrow<D>(), v));
}

template <typename E, class D>
HWY_INLINE ElementVector<D, E> narrowed(D, hn::Vec<D> v) {
  if constexpr (std::is_same_v<E, std::uint16_t>)
    return half_from_float(Narrow<D>(), narrowed<float>(D(), v));
  else if constexpr (sizeof(hn::TFromD<D>) == sizeof(float))
    return v;
  else
    return hn::DemoteTo(Narrow<D>(), v);
}

template <class D, typename E>
HWY_INLINE hn::Vec<D> load(D d, const E* from) {
  return widened(d, hn::LoadU(hn::Rebind<E, D>(), from));
}
template <class D, typename E>
HWY_INLINE void store(D d, hn::Vec<D> v, E* to) {
  hn::StoreU(narrowed<E>(d, v), hn::Rebind<E, D>(), to);
}

// Loads a vector of pixels; `alpha` is for the layout that has it. With the receptors of `receptors`.
template <Receptors receptors, class D>
HWY_INLINE PixelIn<hn::Vec<D>> load_pixels(D d, const PixelRows& rows, std::size_t at,
                                           ElementVector<D, float>&) {
  const auto zero = hn::Zero(d);
  const Triple<hn::Vec<D>> rgb = {load(d, rows.r + at), load(d, rows.g + at), load(d, rows.b + at)};
  if constexpr (receptors == Receptors::absent) return {rgb, {zero, zero, zero}, zero, false, false};
  const auto given = [&](const float* plane) { return plane ? load(d, plane + at) : zero; };
  if constexpr (receptors == Receptors::maybe)
    return {rgb,
            {given(rows.cone_l), given(rows.cone_m), given(rows.cone_s)},
            given(rows.rod),
            rows.cone_l != nullptr,
            rows.rod != nullptr};
  return {rgb,
          {load(d, rows.cone_l + at), load(d, rows.cone_m + at), load(d, rows.cone_s + at)},
          load(d, rows.rod + at),
          true,
          true};
}
template <Receptors, class D>
HWY_INLINE PixelIn<hn::Vec<D>> load_pixels(D d, const HalfRows& rows, std::size_t at,
                                           ElementVector<D, std::uint16_t>&) {
  const auto zero = hn::Zero(d);
  return {{load(d, rows.r + at), load(d, rows.g + at), load(d, rows.b + at)},
          {zero, zero, zero},
          zero,
          false,
          false};
}
template <Receptors, class D, typename E>
HWY_INLINE PixelIn<hn::Vec<D>> load_pixels(D d, const RgbaRows<E>& rows, std::size_t at,
                                           ElementVector<D, E>& alpha) {
  auto r = alpha, g = alpha, b = alpha;
  hn::LoadInterleaved4(hn::Rebind<E, D>(), rows.rgba + 4 * at, r, g, b, alpha);
  const auto zero = hn::Zero(d);
  return {{widened(d, r), widened(d, g), widened(d, b)}, {zero, zero, zero}, zero, false, false};
}

template <class D, class Planes>
HWY_INLINE void store_pixels(D d, const Triple<hn::Vec<D>>& rgb, const Planes& rows, std::size_t at,
                             ElementVector<D, Element<Planes>>) {
  store(d, rgb.x, rows.r + at);
  store(d, rgb.y, rows.g + at);
  store(d, rgb.z, rows.b + at);
}
template <class D, typename E>
HWY_INLINE void store_pixels(D d, const Triple<hn::Vec<D>>& rgb, const RgbaRows<E>& rows, std::size_t at,
                             ElementVector<D, E> alpha) {
  hn::StoreInterleaved4(narrowed<E>(d, rgb.x), narrowed<E>(d, rgb.y), narrowed<E>(d, rgb.z), alpha,
                        hn::Rebind<E, D>(), rows.rgba + 4 * at);
}

// A vector's worth of results, for taking single lanes.
constexpr std::size_t most_lanes = HWY_MAX_BYTES / sizeof(float);

template <typename E>
struct Results {
  HWY_ALIGN E r[most_lanes], g[most_lanes], b[most_lanes];

  template <class D>
  HWY_INLINE void set(D d, const Triple<hn::Vec<D>>& rgb) {
    store(d, rgb.x, r), store(d, rgb.y, g), store(d, rgb.z, b);
  }
  template <class Planes>
  void copy(std::size_t lane, const Planes& rows, std::size_t to) const {
    rows.r[to] = r[lane], rows.g[to] = g[lane], rows.b[to] = b[lane];
  }
  void copy(std::size_t lane, const RgbaRows<E>& rows, std::size_t to) const {
    E* const pixel = rows.rgba + 4 * to;
    pixel[0] = r[lane], pixel[1] = g[lane], pixel[2] = b[lane];
  }
};

// Room for fewer pixels than a vector holds, padded: `in` brings them, `out` takes them back.
template <class Rows>
struct Padded;

template <>
struct Padded<PixelRows> {
  float planes[7][most_lanes] = {};
  PixelRows rows;

  void in(const PixelRows& from, std::size_t at, std::size_t count) {
    const auto fill = [&](const float* plane, float* to) -> float* {
      if (!plane) return nullptr;
      std::copy_n(plane + at, count, to);
      return to;
    };
    rows = {fill(from.r, planes[0]),      fill(from.g, planes[1]),
            fill(from.b, planes[2]),      fill(from.cone_l, planes[3]),
            fill(from.cone_m, planes[4]), fill(from.cone_s, planes[5]),
            fill(from.rod, planes[6]),    most_lanes};
  }
  void out(const PixelRows& to, std::size_t at, std::size_t count) const {
    std::copy_n(planes[0], count, to.r + at);
    std::copy_n(planes[1], count, to.g + at);
    std::copy_n(planes[2], count, to.b + at);
  }
};

template <>
struct Padded<HalfRows> {
  std::uint16_t planes[3][most_lanes] = {};
  HalfRows rows = {planes[0], planes[1], planes[2], most_lanes};

  void in(const HalfRows& from, std::size_t at, std::size_t count) {
    std::copy_n(from.r + at, count, planes[0]);
    std::copy_n(from.g + at, count, planes[1]);
    std::copy_n(from.b + at, count, planes[2]);
  }
  void out(const HalfRows& to, std::size_t at, std::size_t count) const {
    std::copy_n(planes[0], count, to.r + at);
    std::copy_n(planes[1], count, to.g + at);
    std::copy_n(planes[2], count, to.b + at);
  }
};

template <typename E>
struct Padded<RgbaRows<E>> {
  E elements[4 * most_lanes] = {};
  RgbaRows<E> rows = {elements, most_lanes};

  void in(const RgbaRows<E>& from, std::size_t at, std::size_t count) {
    std::copy_n(from.rgba + 4 * at, 4 * count, elements);
  }
  void out(const RgbaRows<E>& to, std::size_t at, std::size_t count) const {
    std::copy_n(elements, 4 * count, to.rgba + 4 * at);
  }
};

// Pixels before the first at which vectors of `lanes` elements lie aligned, in all planes at once; 0 where
// there is none. Loads and stores that straddle two cache lines cost twice; with AVX-512 each one would.
template <typename E>
std::size_t elements_before_aligned(const E* plane, std::size_t lanes) {
  const std::size_t bytes = lanes * sizeof(E);
  return (bytes - reinterpret_cast<std::uintptr_t>(plane) % bytes) % bytes / sizeof(E);
}
template <class Planes>
std::size_t before_aligned(const Planes& rows, std::size_t lanes) {
  const std::size_t r = elements_before_aligned(rows.r, lanes);
  return r == elements_before_aligned(rows.g, lanes) && r == elements_before_aligned(rows.b, lanes) ? r : 0;
}
template <typename E>
std::size_t before_aligned(const RgbaRows<E>& rows, std::size_t lanes) {
  const std::size_t elements = elements_before_aligned(rows.rgba, lanes);
  return elements % 4 == 0 ? elements / 4 : 0;
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
