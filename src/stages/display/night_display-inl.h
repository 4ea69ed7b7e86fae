// The formula of stage `display`; night_display.h says what it is.
#if defined(SCOTOPIC_STAGES_NIGHT_DISPLAY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_STAGES_NIGHT_DISPLAY_INL_H_
#undef SCOTOPIC_STAGES_NIGHT_DISPLAY_INL_H_
#else
#define SCOTOPIC_STAGES_NIGHT_DISPLAY_INL_H_
#endif

#include <hwy/highway.h>

#include "stages/display/night_display.h"
#include "stages/shared/numbers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

/// Light of the display, x, bent below 1. `v` = max(x).
template <class N, class V = typename N::V>
HWY_INLINE Triple<V> shouldered(const N& n, const DisplayConstants<typename N::T>& k, const Triple<V>& x,
                                V v) {
  const V start = n.constant(k.start);
  const V above = n.max(n.zero(), v - start);
  const V level =
      start + n.constant(k.room) * (n.one() - n.exp(n.zero() - above * n.constant(k.inverse_room)));
  const V over = n.max(n.zero(), v - n.one());
  const V white = over / (over + n.constant(k.whiteness));
  const V share = (level / positive_or_one(n, v)) * (n.one() - white);
  const V grey = level * white;
  return {x.x * share + grey, x.y * share + grey, x.z * share + grey};
}

/// The stage on one finite pixel. Where nothing is clipped or bent it is the scale alone.
template <class N, class V = typename N::V>
HWY_INLINE Triple<V> night_display(const N& n, const DisplayConstants<typename N::T>& k,
                                   const DisplaySwitches& on, const Triple<V>& rgb) {
  const Triple<V> plain = n.constant(k.scale) * rgb;
  const Triple<V> light = on.same_primaries ? plain : times(n, k.display_from_rgb, rgb);
  const Triple<V> x = {n.max(n.zero(), light.x), n.max(n.zero(), light.y), n.max(n.zero(), light.z)};
  const V v = largest(n, x);
  const auto bent = n.greater(v, n.constant(k.start));
  const auto changed = on.bend ? n.either(below_zero(n, light), bent) : below_zero(n, light);
  if (n.none(changed)) return plain;
  const Triple<V> out = on.bend ? select(n, bent, shouldered(n, k, x, v), x) : x;
  return select(n, changed, on.same_primaries ? out : times(n, k.rgb_from_display, out), plain);
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
