// Stage `shift`: what the rods add to the cones' signals, and the nearest colour that the gamut holds.
#if defined(SCOTOPIC_STAGES_SHIFT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_STAGES_SHIFT_INL_H_
#undef SCOTOPIC_STAGES_SHIFT_INL_H_
#else
#define SCOTOPIC_STAGES_SHIFT_INL_H_
#endif

#include <hwy/highway.h>

#include "stages/shared/pixel-inl.h"
#include "stages/shift/projection-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

/// The reciprocal of a gain of the kernel, at least 1.
template <class N, class V = typename N::V>
HWY_INLINE V gain_root(const N& n, const ShiftConstants<typename N::T>& k, V q, V rod, std::size_t i) {
  const V signal = n.constant(k.gain[i]) * (q + n.constant(k.kappa[i]) * rod);
  return n.sqrt(n.one() + n.max(n.zero(), signal));
}

/// g r of the kernel (kernel/kernel.h). In double one division serves the three roots, whose product its
/// exponents hold; in float they would not.
template <class N, class V = typename N::V>
HWY_INLINE Triple<V> rod_response(const N& n, const ShiftConstants<typename N::T>& k, const Triple<V>& q,
                                  V rod) {
  const Triple<V> root = {gain_root(n, k, q.x, rod, 0), gain_root(n, k, q.y, rod, 1),
                          gain_root(n, k, q.z, rod, 2)};
  if constexpr (sizeof(typename N::T) == sizeof(float)) return {rod / root.x, rod / root.y, rod / root.z};
  const V xy = root.x * root.y;
  const V over_all = rod / (xy * root.z);
  const V over_xy = over_all * root.z;
  return {over_xy * root.y, over_xy * root.x, over_all * xy};
}

/// RGB' = RGB + RGB_from_LMS (w Δq), projected where the result leaves the gamut. `w` = strength (1 - m); 0:
/// as it came.
template <class N, class S, class V = typename N::V>
HWY_INLINE void shift(const N& n, const ShiftConstants<typename N::T>& k,
                      const ReceptorConstants<typename N::T>& r, const S& on, PixelState<V>& s) {
  const V w = n.constant(k.strength) * s.share;
  const Triple<V> response = w * rod_response(n, k, on.has_cones(s.in) ? s.in.cones : s.cones, s.rod);
  s.cones = s.cones + times(n, k.lms_shift, response);
  const Triple<V> moved = s.in.rgb + times(n, k.rgb_shift, response);
  const Triple<V> rgb =
      on.project() ? projected(n, k, r, on.gamut_is_rgb(), moved, s.in.rgb, s.cones) : moved;
  s.rgb = select(n, n.greater(w, n.zero()), rgb, s.in.rgb);
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
