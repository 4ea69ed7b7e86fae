#include "stages/glare/picture_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/glare/picture_rows.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace scotopic::glare::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;

HWY_INLINE int lanes() { return static_cast<int>(hn::Lanes(D())); }

using Mask = hn::Mask<D>;

/// `count` floats of a picture's row, which may have no more.
HWY_INLINE V load_some(const float* from, int count) {
  const D d;
  if (count >= lanes()) return hn::LoadU(d, from);
  HWY_ALIGN float some[HWY_MAX_BYTES / sizeof(float)] = {};
  std::copy(from, from + count, some);
  return hn::Load(d, some);
}

HWY_INLINE void store_some(V v, float* to, int count) {
  const D d;
  if (count >= lanes()) return hn::StoreU(v, d, to);
  HWY_ALIGN float some[HWY_MAX_BYTES / sizeof(float)];
  hn::Store(v, d, some);
  std::copy(some, some + count, to);
}

struct Colour {
  V r, g, b;
};

HWY_INLINE Colour load_rgb(const PictureRow& row, int x, int count) {
  return {load_some(row.rgb[0] + x, count), load_some(row.rgb[1] + x, count),
          load_some(row.rgb[2] + x, count)};
}

/// What comes so much later in a row: three planes at once are more than the processor foresees. Takes a
/// quarter off the time of excess_row.
HWY_INLINE void prefetch(const std::array<const float*, 3>& rgb, int x) {
  constexpr int line = 16, ahead = 512;
  if (x % line != 0) return;
  for (const float* const plane : rgb) hwy::Prefetch(plane + x + ahead);
}

HWY_INLINE V greatest(Colour c) { return hn::Max(c.r, hn::Max(c.g, c.b)); }

/// NaN compares false; a comparison each, as a maximum may lose one.
HWY_INLINE Mask operable(V v) { return hn::Le(hn::Abs(v), hn::Set(D(), 0x1p120f)); }
HWY_INLINE Mask operable(Colour c) { return hn::And(operable(c.r), hn::And(operable(c.g), operable(c.b))); }

}  // namespace

std::ptrdiff_t CountAbove(const PictureRow& row, float threshold, int width) {
  const V t = hn::Set(D(), threshold);
  std::size_t count = 0;
  const auto look = [&](int x, int some) HWY_ATTR {
    const Colour c = load_rgb(row, x, some);
    // Where there is a NaN, the maximum is it or one of the others: seldom, and then looked at again.
    const Mask above = hn::Or(hn::Gt(c.r, t), hn::Or(hn::Gt(c.g, t), hn::Gt(c.b, t)));
    if (hn::AllFalse(D(), above)) return;
    Mask counted = hn::And(above, operable(c));
    if (some < lanes()) counted = hn::And(counted, hn::FirstN(D(), static_cast<std::size_t>(some)));
    count += hn::CountTrue(D(), counted);
  };
  for (int x = 0; x < width; x += lanes()) look(x, width - x);
  return static_cast<std::ptrdiff_t>(count);
}

float GreatestOfRow(const std::array<const float*, 3>& rgb, int width) {
  const D d;
  V most[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  // NaN and what is too large count as 0, each for itself: the bound of a row may come from a pixel that is
  // not finite.
  const auto look = [&](int x, int some) HWY_ATTR {
    for (std::size_t k = 0; k < 3; ++k) {
      const V v = load_some(rgb[k] + x, some);
      most[k] = hn::Max(most[k], hn::IfThenElseZero(hn::Le(v, hn::Set(d, 0x1p120f)), v));
    }
  };
  for (int x = 0; x < width; x += lanes()) look(x, width - x);
  return hn::GetLane(hn::MaxOfLanes(d, hn::Max(most[0], hn::Max(most[1], most[2]))));
}

bool ExcessRow(const Excess& excess, const PictureRow& row, float* const* out, std::uint8_t* lit, int width) {
  const D d;
  const V t = hn::Set(d, excess.threshold), zero = hn::Zero(d);
  const auto planes = static_cast<std::size_t>(excess.planes);
  Mask all_fine = hn::Eq(zero, zero);
  V any = zero;
  for (int x = 0; x < width; x += lanes()) {
    if (x % lit_step == 0) any = zero;
    const int some = width - x;
    prefetch(row.rgb, x);
    const Colour c = load_rgb(row, x, some);
    Mask fine = operable(c);
    V light[most_light];
    for (std::size_t k = 0; k < planes; ++k) {
      light[k] = load_some(row.light[k] + x, some);
      fine = hn::And(fine, operable(light[k]));
    }
    all_fine = hn::And(all_fine, fine);
    V share = hn::Set(d, 1.0f);
    if (excess.share == GlareShare::above) {
      const V v = greatest(c);
      share = hn::IfThenElse(hn::Gt(v, t), hn::Div(hn::Sub(v, t), v), zero);
    }
    for (std::size_t k = 0; k < planes; ++k) {
      const V e = hn::IfThenElseZero(fine, hn::Sub(hn::Mul(share, light[k]), hn::Set(d, excess.less[k])));
      any = hn::Or(any, e);
      hn::StoreU(e, d, out[k] + x);
    }
    lit[x / lit_step] = !hn::AllTrue(d, hn::Eq(any, zero));
    hn::StoreU(hn::IfThenElseZero(fine, hn::Set(d, 1.0f)), d, out[planes] + x);
  }
  return hn::AllTrue(d, all_fine);
}

std::pair<float, float> ExtremesOfRow(const float* row, const float* mask, int width) {
  const D d;
  const float infinity = std::numeric_limits<float>::infinity();
  V least = hn::Set(d, infinity), greatest = hn::Set(d, -infinity);
  for (int x = 0; x < width; x += lanes()) {
    const V v = hn::Load(d, row + x);
    Mask counted = hn::Ne(hn::Load(d, mask + x), hn::Zero(d));
    if (width - x < lanes()) counted = hn::And(counted, hn::FirstN(d, static_cast<std::size_t>(width - x)));
    least = hn::IfThenElse(counted, hn::Min(least, v), least);
    greatest = hn::IfThenElse(counted, hn::Max(greatest, v), greatest);
  }
  return {hn::GetLane(hn::MinOfLanes(d, least)), hn::GetLane(hn::MaxOfLanes(d, greatest))};
}

void ScatterRow(const Excess& excess, const PictureRow& row, const float* const* e, const float* const* ke,
                int width) {
  const D d;
  const auto planes = static_cast<std::size_t>(excess.planes);
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  for (int x = 0; x < width; x += lanes()) {
    const int some = width - x;
    const Mask fine = hn::Ne(hn::LoadU(d, e[planes] + x), zero);
    const V stays_of_all = hn::Sub(one, hn::LoadU(d, ke[planes] + x));
    for (std::size_t k = 0; k < planes; ++k) {
      const V p = load_some(row.light[k] + x, some), own = hn::LoadU(d, e[k] + x),
              come = hn::LoadU(d, ke[k] + x);
      const float* const ring = ke[planes + 1 + k];
      const V stays = ring == nullptr ? stays_of_all : hn::Sub(stays_of_all, hn::LoadU(d, ring + x));
      const Mask touched = hn::And(fine, hn::Or(hn::Ne(own, zero), hn::Ne(come, zero)));
      const V out = hn::Add(hn::Add(hn::Sub(p, own), hn::Mul(own, stays)), come);
      store_some(hn::IfThenElse(touched, out, p), row.light[k] + x, some);
    }
  }
}

}  // namespace scotopic::glare::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scotopic::glare {
HWY_EXPORT(CountAbove);
HWY_EXPORT(GreatestOfRow);
HWY_EXPORT(ExcessRow);
HWY_EXPORT(ExtremesOfRow);
HWY_EXPORT(ScatterRow);

std::ptrdiff_t count_above(const PictureRow& row, float threshold, int width) {
  return HWY_DYNAMIC_DISPATCH(CountAbove)(row, threshold, width);
}
float greatest_of_row(const std::array<const float*, 3>& rgb, int width) {
  return HWY_DYNAMIC_DISPATCH(GreatestOfRow)(rgb, width);
}
bool excess_row(const Excess& excess, const PictureRow& row, float* const* out, std::uint8_t* lit,
                int width) {
  return HWY_DYNAMIC_DISPATCH(ExcessRow)(excess, row, out, lit, width);
}
std::pair<float, float> extremes_of_row(const float* row, const float* mask, int width) {
  return HWY_DYNAMIC_DISPATCH(ExtremesOfRow)(row, mask, width);
}
void scatter_row(const Excess& excess, const PictureRow& row, const float* const* e, const float* const* ke,
                 int width) {
  HWY_DYNAMIC_DISPATCH(ScatterRow)(excess, row, e, ke, width);
}
}  // namespace scotopic::glare
#endif
