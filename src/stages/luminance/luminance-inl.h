// Stage `luminance`: the colour scaled, at constant chromaticity, to the luminance that the policy asks for.
#if defined(SCOTOPIC_STAGES_LUMINANCE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_STAGES_LUMINANCE_INL_H_
#undef SCOTOPIC_STAGES_LUMINANCE_INL_H_
#else
#define SCOTOPIC_STAGES_LUMINANCE_INL_H_
#endif

#include <hwy/highway.h>

#include "stages/shared/pixel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

/// MES2's own weighting, (m Y + (1-m) rho Rn C)/(m + (1-m) rho C), relative to a D65 white.
template <class N, class V = typename N::V>
HWY_INLINE V mesopic_policy_luminance(const N& n, const LuminanceConstants<typename N::T>& k, V y, V rod,
                                      V share) {
  const V rods = share * n.constant(k.rods_weight);
  const V weight = rods / ((n.one() - share) + rods);
  return y + weight * (rod * n.constant(k.inverse_rod_white) - y);
}

/// The greatest magnitude of the cone signals of two colours, white's being 1.
template <class N, class V = typename N::V>
HWY_INLINE V largest_cone(const N& n, const LuminanceConstants<typename N::T>& k, const Triple<V>& a,
                          const Triple<V>& b) {
  const auto& inverse = k.inverse_cone_white;
  const V x = n.max(n.abs(a.x), n.abs(b.x)) * n.constant(inverse[0]);
  const V y = n.max(n.abs(a.y), n.abs(b.y)) * n.constant(inverse[1]);
  const V z = n.max(n.abs(a.z), n.abs(b.z)) * n.constant(inverse[2]);
  return n.max(n.max(x, y), z);
}

/// Factor that takes a colour of luminance `from` to `to` at constant chromaticity; its contract stands at
/// luminance_ratio() in stages/reference.h. `floor_light` = luminance_floor * largest.
template <class N, class V = typename N::V>
HWY_INLINE V ratio_of_luminances(const N& n, V from, V to, V floor_light) {
  const V f = n.max(n.abs(from), floor_light);
  const V divisor = positive_or_one(n, f);
  const V u = from / divisor;
  // Not u (to/f): 0 times infinity is no number.
  V ratio = (u * to) / divisor + (n.one() - u * u);
  ratio = n.min(n.max(ratio, n.zero()), n.number(typename N::T(1e18)));
  // Nothing to change is 1 to the last bit. (Black, f = 0, among it: from = to = 0, or nothing to scale.)
  return n.select(n.both(n.greater(f, n.zero()), n.not_equal(to, from)), ratio, n.one());
}

/// The stage.
template <class N, class S, class V = typename N::V>
HWY_INLINE void luminance(const N& n, const LuminanceConstants<typename N::T>& k,
                          const ReceptorConstants<typename N::T>& receptors, const S& on, PixelState<V>& s) {
  const V floor_light = n.constant(k.floor) * largest_cone(n, k, s.cones_in, s.cones);
  const V from = dot(n, receptors.y_row, s.rgb);
  const V policy = on.mesopic_luminance() ? mesopic_policy_luminance(n, k, s.y, s.rod, s.share) : s.y;
  const V goal = s.y + (policy - s.y);
  // From the goal's side: at strength 1 this is the goal to the last digit, however far `from` is.
  const V to = goal + n.constant(k.left) * (from - goal);
  s.rgb = ratio_of_luminances(n, from, to, floor_light) * s.rgb;
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
