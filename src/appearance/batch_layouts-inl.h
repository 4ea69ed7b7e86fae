// Rows that are not planes of float: taken apart in blocks that stay in the nearest cache, and put together again.
// Compiled once per SIMD target (see batch.cpp). The same bits on every target: halves are converted by integer
// arithmetic, since not every machine has instructions for them.
#if defined(SCOTOPIC_BATCH_LAYOUTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_BATCH_LAYOUTS_INL_H_
#undef SCOTOPIC_BATCH_LAYOUTS_INL_H_
#else
#define SCOTOPIC_BATCH_LAYOUTS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "appearance/batch.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using FloatVector = hn::Vec<FloatTag>;
using HalfTag = hn::Rebind<std::uint16_t, FloatTag>;
using BitsTag = hn::RebindToUnsigned<FloatTag>;

// IEEE 754 binary16 to binary32, exactly; NaN and infinity stay what they are.
HWY_INLINE FloatVector float_from(hn::Vec<HalfTag> half) {
  const FloatTag d;
  const BitsTag u;
  const hn::RebindToSigned<FloatTag> i;
  const auto bits = hn::PromoteTo(u, half);
  const auto magnitude = hn::And(bits, hn::Set(u, 0x7fff));
  // 13 more bits of mantissa; the exponent's bias is 127, not 15, and its largest, of NaN and infinity, 255, not 31.
  const auto widened = hn::ShiftLeft<13>(magnitude);
  const auto odd = hn::IfThenElseZero(hn::Gt(magnitude, hn::Set(u, 0x7bff)), hn::Set(u, 112u << 23));
  const auto normal = hn::BitCast(d, hn::Add(hn::Add(widened, hn::Set(u, 112u << 23)), odd));
  const auto subnormal = hn::Mul(hn::ConvertTo(d, hn::BitCast(i, magnitude)), hn::Set(d, 0x1p-24f));
  const auto is_normal = hn::RebindMask(d, hn::Gt(magnitude, hn::Set(u, 0x3ff)));
  const auto sign = hn::BitCast(d, hn::ShiftLeft<16>(hn::And(bits, hn::Set(u, 0x8000))));
  return hn::Or(sign, hn::IfThenElse(is_normal, normal, subnormal));
}

// Finite values only: nearest, ties to even; beyond half's largest number, that number.
HWY_INLINE hn::Vec<HalfTag> half_from(FloatVector x) {
  const FloatTag d;
  const BitsTag u;
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
  return hn::DemoteTo(HalfTag(), hn::BitCast(hn::RebindToSigned<FloatTag>(),
                                             hn::Or(sign, hn::IfThenElse(is_normal, normal, subnormal))));
}

HWY_INLINE FloatVector read(const float* from) { return hn::LoadU(FloatTag(), from); }
HWY_INLINE FloatVector read(const std::uint16_t* from) { return float_from(hn::LoadU(HalfTag(), from)); }
HWY_INLINE void write(FloatVector v, float* to) { hn::StoreU(v, FloatTag(), to); }
HWY_INLINE void write(FloatVector v, std::uint16_t* to) { hn::StoreU(half_from(v), HalfTag(), to); }

template <typename E>
using ElementTag = std::conditional_t<std::is_same_v<E, float>, FloatTag, HalfTag>;
HWY_INLINE FloatVector decoded(FloatVector v) { return v; }
HWY_INLINE FloatVector decoded(hn::Vec<HalfTag> v) { return float_from(v); }
template <typename E>
HWY_INLINE auto encoded(FloatVector v) {
  if constexpr (std::is_same_v<E, float>) return v;
  else return half_from(v);
}

// Pixels in three planes of element E. `alpha` is for the layouts that have it.
template <typename E>
struct PlaneLayout {
  E *r, *g, *b;

  void load(std::size_t at, const PixelRows& to, E*, std::size_t i) const {
    write(read(r + at), to.r + i), write(read(g + at), to.g + i), write(read(b + at), to.b + i);
  }
  void store(const PixelRows& from, const E*, std::size_t i, std::size_t at) const {
    write(read(from.r + i), r + at), write(read(from.g + i), g + at), write(read(from.b + i), b + at);
  }
  void copy_pixel(const PlaneLayout& from, std::size_t i, std::size_t at) const {
    r[at] = from.r[i], g[at] = from.g[i], b[at] = from.b[i];
  }
};

// Pixels of R, G, B, A next to each other.
template <typename E>
struct RgbaLayout {
  E* rgba;

  void load(std::size_t at, const PixelRows& to, E* alpha, std::size_t i) const {
    const ElementTag<E> d;
    auto r = hn::Zero(d), g = r, b = r, a = r;
    hn::LoadInterleaved4(d, rgba + 4 * at, r, g, b, a);
    write(decoded(r), to.r + i), write(decoded(g), to.g + i), write(decoded(b), to.b + i);
    hn::StoreU(a, d, alpha + i);
  }
  void store(const PixelRows& from, const E* alpha, std::size_t i, std::size_t at) const {
    const ElementTag<E> d;
    hn::StoreInterleaved4(encoded<E>(read(from.r + i)), encoded<E>(read(from.g + i)), encoded<E>(read(from.b + i)),
                          hn::LoadU(d, alpha + i), d, rgba + 4 * at);
  }
  void copy_pixel(const RgbaLayout& from, std::size_t i, std::size_t at) const {
    std::copy_n(from.rgba + 4 * i, 3, rgba + 4 * at);
  }
};

// Room for a vector's worth of pixels of a layout.
template <typename E>
struct LayoutRoom {
  HWY_ALIGN E elements[4 * HWY_MAX_BYTES / sizeof(float)] = {};
  static constexpr std::size_t pixels = HWY_MAX_BYTES / sizeof(float);

  PlaneLayout<E> as(const PlaneLayout<E>&) { return {elements, elements + pixels, elements + 2 * pixels}; }
  RgbaLayout<E> as(const RgbaLayout<E>&) { return {elements}; }
};

// Some pixels as planes, and which of them the operator touched.
template <typename E>
struct Block {
  static constexpr std::size_t most = 512, room = most + HWY_MAX_BYTES / sizeof(float);
  HWY_ALIGN float planes[3][room];
  HWY_ALIGN E alpha[room];
  std::uint8_t touched[most];
  PixelRows rows;

  explicit Block(std::size_t count) {
    rows.r = planes[0], rows.g = planes[1], rows.b = planes[2];
    rows.count = count;
  }
};

// Fills a block from `at` on.
template <typename E, class Layout>
void load_block(const Layout& layout, std::size_t at, Block<E>& block) {
  const std::size_t lanes = hn::Lanes(FloatTag()), count = block.rows.count;
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) layout.load(at + i, block.rows, block.alpha, i);
  if (i == count) return;
  LayoutRoom<E> room;
  const Layout rest = room.as(layout);
  for (std::size_t k = 0; i + k < count; ++k) rest.copy_pixel(layout, at + i + k, k);
  rest.load(0, block.rows, block.alpha, i);
}

// Stores those of `count` pixels, a vector or less, that were touched.
template <typename E, class Layout>
void store_touched(const Layout& layout, const Block<E>& block, std::size_t i, std::size_t at, std::size_t count) {
  LayoutRoom<E> room;
  const Layout results = room.as(layout);
  results.store(block.rows, block.alpha, i, 0);
  for (std::size_t k = 0; k < count; ++k)
    if (block.touched[i + k]) layout.copy_pixel(results, k, at + k);
}

// Puts a block back to where it came from.
template <typename E, class Layout>
void store_block(const Layout& layout, const Block<E>& block, std::size_t at) {
  const std::size_t lanes = hn::Lanes(FloatTag()), count = block.rows.count;
  if (!std::memchr(block.touched, 1, count)) return;
  const bool all = std::memchr(block.touched, 0, count) == nullptr;
  for (std::size_t i = 0; i < count; i += lanes) {
    if (all && i + lanes <= count) layout.store(block.rows, block.alpha, i, at + i);
    else store_touched(layout, block, i, at + i, std::min(lanes, count - i));
  }
}

// Calls apply(planes, touched) for blocks of the pixels of a layout.
template <typename E, class Layout, class Apply>
void apply_in_blocks(const Layout& layout, std::size_t count, std::uint8_t* touched, const Apply& apply) {
  for (std::size_t at = 0; at < count; at += Block<E>::most) {
    Block<E> block(std::min(Block<E>::most, count - at));
    load_block(layout, at, block);
    apply(block.rows, block.touched);
    if (touched) std::copy_n(block.touched, block.rows.count, touched + at);
    store_block(layout, block, at);
  }
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
