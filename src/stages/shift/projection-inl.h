// The nearest colour, in LMS, that the gamut holds (Kirk & O'Brien 2011, equations 14-15; shared/projection.h
// has the active sets).
#if defined(SCOTOPIC_STAGES_PROJECTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_STAGES_PROJECTION_INL_H_
#undef SCOTOPIC_STAGES_PROJECTION_INL_H_
#else
#define SCOTOPIC_STAGES_PROJECTION_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>

#include "stages/shared/numbers-inl.h"
#include "stages/shared/stage_constants.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

template <unsigned bound, unsigned j, class N, class V>
HWY_INLINE V active_term(const N& n, const Vec3<typename N::T>& row, V z) {
  if constexpr (bound >> j & 1u) return n.constant(row[j]) * z;
  return z;
}

/// Entry i of the set's solution: the multiplier of a bound component, or a free one. Rows hold but the
/// columns of bound components, and 1 at a free one's own: what is 0 and 1 there is not multiplied.
template <unsigned bound, unsigned i, class N, class V>
HWY_INLINE V active_entry(const N& n, const ShiftConstants<typename N::T>& k, const Triple<V>& z) {
  constexpr bool is_bound = bound >> i & 1u;
  const auto& row = is_bound ? k.active[bound].dual[i] : k.active[bound].primal[i];
  const V terms[3] = {active_term<bound, 0>(n, row, z.x), active_term<bound, 1>(n, row, z.y),
                      active_term<bound, 2>(n, row, z.z)};
  constexpr auto there = [](unsigned j) { return (bound >> j & 1u) != 0 || j == i; };
  constexpr unsigned first = there(0) ? 0 : there(1) ? 1 : 2;
  V sum = terms[first];
  if constexpr (first < 1 && there(1)) sum = sum + terms[1];
  if constexpr (first < 2 && there(2)) sum = sum + terms[2];
  return sum;
}

template <unsigned bound, unsigned i, class N, class M, class V>
HWY_INLINE V entry_taken(const N& n, M better, V entry, V best) {
  if constexpr (bound >> i & 1u) return n.dropped(better, best);
  return n.select(better, entry, best);
}

/// Takes the solution of one active set where its worst entry is greater than `margin`.
template <unsigned bound, class N, class V>
HWY_INLINE void try_active_set(const N& n, const ShiftConstants<typename N::T>& k, const Triple<V>& z,
                               V& margin, Triple<V>& best) {
  const Triple<V> entries = {active_entry<bound, 0>(n, k, z), active_entry<bound, 1>(n, k, z),
                             active_entry<bound, 2>(n, k, z)};
  const V worst = smallest(n, entries);
  const auto better = n.greater(worst, margin);
  margin = n.select(better, worst, margin);
  best = {entry_taken<bound, 0>(n, better, entries.x, best.x),
          entry_taken<bound, 1>(n, better, entries.y, best.y),
          entry_taken<bound, 2>(n, better, entries.z, best.z)};
}

/// GamutProjection::nearest for z outside; see there.
template <class N, class V>
HWY_INLINE Triple<V> nearest_inside(const N& n, const ShiftConstants<typename N::T>& k, const Triple<V>& z) {
  V margin = n.number(-std::numeric_limits<typename N::T>::infinity());
  Triple<V> best = {n.zero(), n.zero(), n.zero()};
  try_active_set<1>(n, k, z, margin, best);
  try_active_set<2>(n, k, z, margin, best);
  try_active_set<3>(n, k, z, margin, best);
  try_active_set<4>(n, k, z, margin, best);
  try_active_set<5>(n, k, z, margin, best);
  try_active_set<6>(n, k, z, margin, best);
  try_active_set<7>(n, k, z, margin, best);
  return {n.max(best.x, n.zero()), n.max(best.y, n.zero()), n.max(best.z, n.zero())};
}

/// `moved`, or the nearest colour inside; components of `in` below 0 may stay so. `cones` become those of the
/// result.
template <class N, class V>
HWY_INLINE Triple<V> projected(const N& n, const ShiftConstants<typename N::T>& k,
                               const ReceptorConstants<typename N::T>& receptors, bool gamut_is_rgb,
                               const Triple<V>& moved, const Triple<V>& in, Triple<V>& cones) {
  const Triple<V> target = gamut_is_rgb ? moved : times(n, k.gamut_from_rgb, moved);
  const Triple<V> source = gamut_is_rgb ? in : times(n, k.gamut_from_rgb, in);
  const Triple<V> bound = {n.min(n.zero(), source.x), n.min(n.zero(), source.y), n.min(n.zero(), source.z)};
  const Triple<V> z = target - bound;
  const auto outside = below_zero(n, z);
  if (n.none(outside)) return moved;
  const Triple<V> nearest = nearest_inside(n, k, z) + bound;
  const Triple<V> inside = gamut_is_rgb ? nearest : times(n, k.rgb_from_gamut, nearest);
  cones = select(n, outside, times(n, receptors.lms_from_rgb, inside), cones);
  return select(n, outside, inside, moved);
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
