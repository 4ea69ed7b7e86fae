// Rows of halves: taken apart in blocks of float planes that stay in the nearest cache, and put together
// again. Compiled once per SIMD target (see batch.cpp). The same bits on every target: halves are converted
// by integer arithmetic, since not every machine has instructions for them.
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

HWY_INLINE FloatVector load_half(const std::uint16_t* from) { return float_from(hn::LoadU(HalfTag(), from)); }
HWY_INLINE void store_half(const float* from, std::uint16_t* to) {
  hn::StoreU(half_from(hn::LoadU(FloatTag(), from)), HalfTag(), to);
}

// Pixels in three planes. `alpha` is for the layout that has it.
struct HalfPlanes {
  std::uint16_t *r, *g, *b;

  void load(std::size_t at, const PixelRows& to, std::uint16_t*, std::size_t i) const {
    const FloatTag d;
    hn::StoreU(load_half(r + at), d, to.r + i);
    hn::StoreU(load_half(g + at), d, to.g + i);
    hn::StoreU(load_half(b + at), d, to.b + i);
  }
  void store(const PixelRows& from, const std::uint16_t*, std::size_t i, std::size_t at) const {
    store_half(from.r + i, r + at), store_half(from.g + i, g + at), store_half(from.b + i, b + at);
  }
  void copy_pixel(const HalfPlanes& from, std::size_t i, std::size_t at) const {
    r[at] = from.r[i], g[at] = from.g[i], b[at] = from.b[i];
  }
};

// Pixels of R, G, B, A next to each other.
struct HalfRgba {
  std::uint16_t* rgba;

  void load(std::size_t at, const PixelRows& to, std::uint16_t* alpha, std::size_t i) const {
    const HalfTag h;
    const FloatTag d;
    auto r = hn::Zero(h), g = r, b = r, a = r;
    hn::LoadInterleaved4(h, rgba + 4 * at, r, g, b, a);
    hn::StoreU(float_from(r), d, to.r + i);
    hn::StoreU(float_from(g), d, to.g + i);
    hn::StoreU(float_from(b), d, to.b + i);
    hn::StoreU(a, h, alpha + i);
  }
  void store(const PixelRows& from, const std::uint16_t* alpha, std::size_t i, std::size_t at) const {
    const HalfTag h;
    const auto half = [&](const float* plane) { return half_from(hn::LoadU(FloatTag(), plane + i)); };
    hn::StoreInterleaved4(half(from.r), half(from.g), half(from.b), hn::LoadU(h, alpha + i), h,
                          rgba + 4 * at);
  }
  void copy_pixel(const HalfRgba& from, std::size_t i, std::size_t at) const {
    std::copy_n(from.rgba + 4 * i, 3, rgba + 4 * at);
  }
};

// Room for a vector's worth of pixels of a layout.
struct LayoutRoom {
  static constexpr std::size_t pixels = HWY_MAX_BYTES / sizeof(float);
  HWY_ALIGN std::uint16_t elements[4 * pixels] = {};

  HalfPlanes as(const HalfPlanes&) { return {elements, elements + pixels, elements + 2 * pixels}; }
  HalfRgba as(const HalfRgba&) { return {elements}; }
};

// Some pixels as planes, and which of them the operator touched.
struct Block {
  static constexpr std::size_t most = 512, room = most + HWY_MAX_BYTES / sizeof(float);
  HWY_ALIGN float planes[3][room];
  HWY_ALIGN std::uint16_t alpha[room];
  std::uint8_t touched[most];
  PixelRows rows;

  explicit Block(std::size_t count) {
    rows.r = planes[0], rows.g = planes[1], rows.b = planes[2];
    rows.count = count;
  }
};

// Fills a block from `at` on.
template <class Layout>
void load_block(const Layout& layout, std::size_t at, Block& block) {
  const std::size_t lanes = hn::Lanes(FloatTag()), count = block.rows.count;
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) layout.load(at + i, block.rows, block.alpha, i);
  if (i == count) return;
  LayoutRoom room;
  const Layout rest = room.as(layout);
  for (std::size_t k = 0; i + k < count; ++k) rest.copy_pixel(layout, at + i + k, k);
  rest.load(0, block.rows, block.alpha, i);
}

// Stores those of `count` pixels, a vector or less, that were touched.
template <class Layout>
void store_touched(const Layout& layout, const Block& block, std::size_t i, std::size_t at,
                   std::size_t count) {
  LayoutRoom room;
  const Layout results = room.as(layout);
  results.store(block.rows, block.alpha, i, 0);
  for (std::size_t k = 0; k < count; ++k)
    if (block.touched[i + k]) layout.copy_pixel(results, k, at + k);
}

// Puts a block back to where it came from.
template <class Layout>
void store_block(const Layout& layout, const Block& block, std::size_t at) {
  const std::size_t lanes = hn::Lanes(FloatTag()), count = block.rows.count;
  if (!std::memchr(block.touched, 1, count)) return;
  const bool all = std::memchr(block.touched, 0, count) == nullptr;
  for (std::size_t i = 0; i < count; i += lanes) {
    if (all && i + lanes <= count)
      layout.store(block.rows, block.alpha, i, at + i);
    else
      store_touched(layout, block, i, at + i, std::min(lanes, count - i));
  }
}

// Calls apply(planes, touched) for blocks of the pixels of a layout.
template <class Layout, class Apply>
void apply_in_blocks(const Layout& layout, std::size_t count, std::uint8_t* touched, const Apply& apply) {
  for (std::size_t at = 0; at < count; at += Block::most) {
    Block block(std::min(Block::most, count - at));
    load_block(layout, at, block);
    apply(block.rows, block.touched);
    if (touched) std::copy_n(block.touched, block.rows.count, touched + at);
    store_block(layout, block, at);
  }
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
