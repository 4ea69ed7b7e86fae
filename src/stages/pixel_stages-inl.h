// The pixel stages in their order, fused: one pixel, or a vector of them, from RGB to RGB. Over a number type
// (shared/numbers-inl.h): the reference and the batch are this code.
#if defined(SCOTOPIC_STAGES_PIXEL_STAGES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_STAGES_PIXEL_STAGES_INL_H_
#undef SCOTOPIC_STAGES_PIXEL_STAGES_INL_H_
#else
#define SCOTOPIC_STAGES_PIXEL_STAGES_INL_H_
#endif

#include <hwy/highway.h>

#include <initializer_list>
#include <type_traits>

#include "stages/chroma/chroma-inl.h"
#include "stages/luminance/luminance-inl.h"
#include "stages/shift/shift-inl.h"
#include "stages/limits.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

/// Pixels that are not `active` are left alone, whatever `rgb` says. Of the others, `doubtful` are those that
/// need more digits, be it to see that they are not active: whose luminance is what is left of a
/// cancellation, or with a negative cone signal, which the rods' may cancel under the kernel's root.
template <class V, class M>
struct SeenPixel {
  Triple<V> rgb;
  M active, doubtful;
};

/// N: a number type. `stages` and `receptors` say what code is compiled for; StageSet::any asks the switches.
/// The same arithmetic, hence the same bits, any way.
template <class N, StageSet stages = StageSet::any, Receptors receptors = Receptors::maybe>
class PixelStages {
  using T = typename N::T;
  using V = typename N::V;
  using M = typename N::M;
  static constexpr bool any = stages == StageSet::any || stages == StageSet::usual;

 public:
  static constexpr bool needs_more_digits = std::is_same_v<T, float>;
  using Pixel = PixelIn<V>;
  using Seen = SeenPixel<V, M>;

  PixelStages(const N& n, const StageConstants<T>& k, const StageSwitches& on) : n_(n), k_(k), on_(on) {}

  /// False: none of the pixels is active, and nothing else was found out.
  HWY_INLINE bool operator()(const Pixel& p, Seen& seen) const {
    if (safko()) return see_safko(p, seen);
    const Triple<V> terms = products(n_, k_.receptors.y_row, p.rgb);
    const V y = sum(terms);
    V local = n_.constant(k_.weight.adaptation);
    if (!any || on_.local) local = local + n_.max(n_.zero(), y * n_.constant(k_.weight.unit));
    // First what a lit picture is skipped by: its luminance, where that is no difference. NaN is not below.
    const V limit = n_.number(T(photopic_limit));
    seen.active = n_.less(local, limit);
    seen.doubtful = n_.never();
    if constexpr (needs_more_digits)
      if (HWY_UNLIKELY(!n_.none(below_zero(n_, terms)))) find_cancelled(terms, y, local - limit, seen);
    if (n_.none(seen.active)) return false;
    seen.active = n_.both(seen.active, operable(p));
    if (n_.none(seen.active)) return false;
    see(p, y, local, seen);
    return true;
  }

  // What stages ask, of constants or of the code compiled for them.
  bool rod_input_by_level() const { return stages == StageSet::any && on_.rod_input; }
  bool project() const { return !any || on_.project; }
  bool gamut_is_rgb() const { return !any || on_.gamut_is_rgb; }
  bool mesopic_luminance() const { return any ? on_.mesopic_policy : stages != StageSet::grey; }
  static bool has_cones(const Pixel& p) {
    return receptors == Receptors::maybe ? p.has_cones : receptors == Receptors::given;
  }
  static bool has_rod(const Pixel& p) {
    return receptors == Receptors::maybe ? p.has_rod : receptors == Receptors::given;
  }

 private:
  static constexpr bool one_of(std::initializer_list<StageSet> sets) {
    for (const StageSet set : sets)
      if (stages == set) return true;
    return false;
  }
  bool safko() const { return any ? on_.safko : stages == StageSet::kernel; }
  bool shift_on() const { return any ? on_.shift : one_of({StageSet::all, StageSet::grey, StageSet::shift}); }
  bool luminance_on() const { return any ? on_.luminance : one_of({StageSet::all, StageSet::grey}); }
  bool chroma_on() const {
    return any ? on_.chroma : one_of({StageSet::all, StageSet::grey, StageSet::chroma});
  }
  bool quadratic_rods() const { return any && on_.quadratic_rods; }

  // Pixels whose luminance is what is left of a cancellation; where it may be below the limit, too, they are
  // active.
  HWY_INLINE void find_cancelled(const Triple<V>& terms, V y, V over_limit, Seen& seen) const {
    const V magnitude = sum(Triple<V>{n_.abs(terms.x), n_.abs(terms.y), n_.abs(terms.z)});
    seen.doubtful = n_.less(y, n_.number(T(0.5)) * magnitude);
    const V rounding = magnitude * n_.constant(k_.weight.luminance_rounding);
    seen.active = n_.either(seen.active, n_.both(seen.doubtful, n_.less(over_limit, rounding)));
  }

  HWY_INLINE V rods(const Pixel& p, V y) const {
    if (has_rod(p)) return n_.max(n_.zero(), p.rod);
    return rod_signal(n_, k_.receptors, p.rgb, y, quadratic_rods());
  }

  HWY_INLINE void see(const Pixel& p, V y, V local, Seen& seen) const {
    const Triple<V> cones = times(n_, k_.receptors.lms_from_rgb, p.rgb);
    if constexpr (needs_more_digits)
      seen.doubtful =
          n_.both(seen.active, n_.either(seen.doubtful, below_zero(n_, has_cones(p) ? p.cones : cones)));
    const V share = n_.rod_share(any ? local + n_.constant(k_.weight.behind) : local, k_.weight);
    PixelState<V> s{p, p.rgb, cones, cones, y, local, rods(p, y), share};
    if (shift_on()) shift(n_, k_.shift, k_.receptors, *this, s);
    if (luminance_on()) luminance(n_, k_.luminance, k_.receptors, *this, s);
    if (chroma_on()) chroma(n_, k_.chroma, k_.receptors, s);
    seen.rgb = any && on_.mix ? p.rgb + n_.constant(k_.mix) * (s.rgb - p.rgb) : s.rgb;
  }

  // The thesis' pipeline: the kernel alone, at every luminance.
  HWY_INLINE bool see_safko(const Pixel& p, Seen& seen) const {
    seen.active = operable(p);
    if (n_.none(seen.active)) return false;
    const Triple<V> q = has_cones(p) ? p.cones : times(n_, k_.receptors.lms_from_rgb, p.rgb);
    if constexpr (needs_more_digits)
      seen.doubtful = n_.both(seen.active, below_zero(n_, q));
    else
      seen.doubtful = n_.never();
    const V rod = rods(p, dot(n_, k_.receptors.y_row, p.rgb));
    seen.rgb = times(n_, k_.shift.rgb_from_lms, q) +
               times(n_, k_.shift.rgb_shift, rod_response(n_, k_.shift, q, rod));
    return true;
  }

  // False for NaN, too.
  HWY_INLINE M operable(V v) const { return n_.less_equal(n_.abs(v), n_.number(T(operable_limit))); }
  HWY_INLINE M operable(const Triple<V>& v) const {
    return n_.both(n_.both(operable(v.x), operable(v.y)), operable(v.z));
  }
  HWY_INLINE M operable(const Pixel& p) const {
    M yes = operable(p.rgb);
    if (has_cones(p)) yes = n_.both(yes, operable(p.cones));
    if (has_rod(p)) yes = n_.both(yes, operable(p.rod));
    return yes;
  }

  const N n_;
  const StageConstants<T>& k_;
  const StageSwitches& on_;
};

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
