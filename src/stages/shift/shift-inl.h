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

/// kappa of (L, M, S): the preset's, or what rods at some level have.
template <class N>
struct UsualInput {
  const N& n;
  const Vec3<typename N::T>& kappa;
  HWY_INLINE typename N::V operator[](std::size_t i) const { return n.constant(kappa[i]); }
};
template <class V>
struct InputAtLevel {
  V lm, s;
  HWY_INLINE V operator[](std::size_t i) const { return i == 2 ? s : lm; }
};

/// The reciprocal of a gain of the kernel, at least 1.
template <class N, class Input, class V = typename N::V>
HWY_INLINE V gain_root(const N& n, const ShiftConstants<typename N::T>& k, const Input& kappa, V q, V rod,
                       std::size_t i) {
  const V signal = n.constant(k.gain[i]) * (q + kappa[i] * rod);
  return n.sqrt(n.one() + n.max(n.zero(), signal));
}

/// g r of the kernel (kernel/kernel.h). In double one division serves the three roots, whose product its
/// exponents hold; in float they would not.
template <class N, class Input, class V = typename N::V>
HWY_INLINE Triple<V> rod_response(const N& n, const ShiftConstants<typename N::T>& k, const Input& kappa,
                                  const Triple<V>& q, V rod) {
  const Triple<V> root = {gain_root(n, k, kappa, q.x, rod, 0), gain_root(n, k, kappa, q.y, rod, 1),
                          gain_root(n, k, kappa, q.z, rod, 2)};
  if constexpr (sizeof(typename N::T) == sizeof(float)) return {rod / root.x, rod / root.y, rod / root.z};
  const V xy = root.x * root.y;
  const V over_all = rod / (xy * root.z);
  const V over_xy = over_all * root.z;
  return {over_xy * root.y, over_xy * root.x, over_all * xy};
}

/// The same with the preset's own kappa.
template <class N, class V = typename N::V>
HWY_INLINE Triple<V> rod_response(const N& n, const ShiftConstants<typename N::T>& k, const Triple<V>& q,
                                  V rod) {
  return rod_response(n, k, UsualInput<N>{n, k.kappa}, q, rod);
}

/// kappa of one pathway at a level, >= 0.
template <class N, class V = typename N::V>
HWY_INLINE V rod_input(const N& n, const RodInputConstants<typename N::T>& k,
                       const RodInputLines<typename N::T>& lines, V level) {
  const V steep = n.constant(lines.knee) + n.constant(lines.steep) * (n.constant(k.level[0]) - level);
  const V shallow = n.constant(lines.shallow) * (n.constant(k.level[1]) - level);
  return n.max(n.zero(), n.min(n.constant(lines.held), n.max(steep, shallow)));
}

/// g r where rod input follows the level: kappa(level) in the root, and the whole over kirk2011's kappa times
/// it.
template <class N, class V = typename N::V>
HWY_INLINE Triple<V> rod_response_by_level(const N& n, const ShiftConstants<typename N::T>& k, V local,
                                           const Triple<V>& q, V rod) {
  const V level = local + n.constant(k.input.behind);
  const InputAtLevel<V> kappa{rod_input(n, k.input, k.input.lm, level),
                              rod_input(n, k.input, k.input.s, level)};
  const Triple<V> damped = rod_response(n, k, kappa, q, rod);
  const V of_lm = kappa.lm * n.constant(k.input.lm.inverse_usual),
          of_s = kappa.s * n.constant(k.input.s.inverse_usual);
  return {of_lm * damped.x, of_lm * damped.y, of_s * damped.z};
}

/// RGB' = RGB + RGB_from_LMS (w Δq), projected where the result leaves the gamut. `w` = strength (1 - m); 0:
/// as it came.
template <class N, class S, class V = typename N::V>
HWY_INLINE void shift(const N& n, const ShiftConstants<typename N::T>& k,
                      const ReceptorConstants<typename N::T>& r, const S& on, PixelState<V>& s) {
  const V w = n.constant(k.strength) * s.share;
  const Triple<V>& q = on.has_cones(s.in) ? s.in.cones : s.cones;
  const Triple<V> response = w * (on.rod_input_by_level() ? rod_response_by_level(n, k, s.local, q, s.rod)
                                                          : rod_response(n, k, q, s.rod));
  s.cones = s.cones + times(n, k.lms_shift, response);
  const Triple<V> moved = s.in.rgb + times(n, k.rgb_shift, response);
  const Triple<V> rgb =
      on.project() ? projected(n, k, r, on.gamut_is_rgb(), moved, s.in.rgb, s.cones) : moved;
  s.rgb = select(n, n.greater(w, n.zero()), rgb, s.in.rgb);
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
