// A pixel on its way through the stages, and what its receptors signal.
#if defined(SCOTOPIC_STAGES_PIXEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_STAGES_PIXEL_INL_H_
#undef SCOTOPIC_STAGES_PIXEL_INL_H_
#else
#define SCOTOPIC_STAGES_PIXEL_INL_H_
#endif

#include <hwy/highway.h>

#include "stages/shared/numbers-inl.h"
#include "stages/shared/stage_constants.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

/// Whether pixels bring signals of their own: none, cones and rods, or what the flags of each say.
enum class Receptors { absent, given, maybe };

/// What a pixel brings along; cones and rod are read only where the flags say so.
template <class V>
struct PixelIn {
  Triple<V> rgb;
  Triple<V> cones;
  V rod;
  bool has_cones, has_rod;
};

/// What stages see of a pixel, and change: `rgb` always, `cones` as far as they follow `rgb`.
template <class V>
struct PixelState {
  const PixelIn<V>& in;
  Triple<V> rgb;       ///< of the stage before
  Triple<V> cones_in;  ///< of in.rgb
  Triple<V> cones;     ///< of rgb
  V y;                 ///< luminance of in.rgb, image units
  V local;             ///< Lloc, cd/m2
  V rod;               ///< luminance units per image unit, >= 0
  V share;             ///< 1 - m(Lloc)
};

/// r = k/1700.06 Y', by the quadratic estimate of Y' from X, Y, Z (receptors/rods.h).
template <class N, class V = typename N::V>
HWY_INLINE V quadratic_rod(const N& n, const ReceptorConstants<typename N::T>& k, const Triple<V>& rgb) {
  const Triple<V> xyz = times(n, k.xyz_from_rgb, rgb);
  const V big_x = n.max(xyz.x, n.zero());
  const V big_y = n.max(xyz.y, n.zero());
  const V total = (big_x + big_y) + n.max(xyz.z, n.zero());
  const V divisor = positive_or_one(n, total);
  const V x = big_x / divisor;
  const V y = big_y / divisor;
  const auto& c = k.rod_quadratic;
  V sum = n.constant(c[0]) + (n.constant(c[1]) * x + n.constant(c[2]) * y);
  sum = sum + (n.constant(c[3]) * x) * x;
  sum = sum + (n.constant(c[4]) * x) * y;
  sum = sum + (n.constant(c[5]) * y) * y;
  return n.kept(n.greater(total, n.zero()), (n.constant(k.rod_sp) * total) * sum);
}

/// r from colour, floored at the S/P of 650 nm light; never negative.
template <class N, class V = typename N::V>
HWY_INLINE V rod_signal(const N& n, const ReceptorConstants<typename N::T>& k, const Triple<V>& rgb, V y,
                        bool quadratic) {
  const V estimate = quadratic ? quadratic_rod(n, k, rgb) : dot(n, k.rod_row, rgb);
  return n.max(n.max(estimate, n.constant(k.rod_floor) * y), n.zero());
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
