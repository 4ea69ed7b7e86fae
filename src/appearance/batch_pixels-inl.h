// The operator on one vector of pixels; compiled once per SIMD target (see batch.cpp). The stages are those of
// stages.h, in that order, and of reference.cpp, which says the same in plain arithmetic.
// No MulAdd anywhere: fused and unfused targets would differ in the last bit.
#if defined(SCOTOPIC_BATCH_PIXELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_BATCH_PIXELS_INL_H_
#undef SCOTOPIC_BATCH_PIXELS_INL_H_
#else
#define SCOTOPIC_BATCH_PIXELS_INL_H_
#endif

#include <hwy/highway.h>

#include <type_traits>

#include "appearance/batch_constants.h"
#include "appearance/stages.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Triple {
  V x, y, z;
};

/// What one vector of pixels brings along; cones and rod are read only where the flags say so.
template <class V>
struct PixelVector {
  Triple<V> rgb;
  Triple<V> cones;
  V rod;
  bool has_cones, has_rod;
};

/// `usual`: RGB alone comes in, the stages are those of a look with every default, and the code for all else is left
/// out. The same arithmetic, hence the same bits.
template <class D, bool usual = false>
class PixelOperator {
  using T = hn::TFromD<D>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  using I = hwy::MakeSigned<T>;
  static constexpr bool needs_more_digits = std::is_same_v<T, float>;

 public:
  PixelOperator(D d, const BatchConstants<T>& k) : d_(d), k_(k) {}

  /// Changes the pixels that the operator has something to do to; says which. Of these, `doubtful` are those
  /// that need more digits: whose luminance is what is left of a cancellation, or with a negative cone signal,
  /// which the rods' may cancel under the kernel's root.
  HWY_INLINE M operator()(PixelVector<V>& p, M& doubtful) const {
    M active = operable(p);
    doubtful = hn::Lt(one(), hn::Zero(d_));
    if (!usual && k_.safko) return safko(p, active, doubtful);
    const V y = dot(k_.y_row, p.rgb);
    V local = hn::Set(d_, k_.adaptation);
    if (usual || k_.local) local = hn::Add(local, hn::Max(hn::Zero(d_), hn::Mul(y, set(k_.unit))));
    active = hn::And(active, hn::Lt(local, set(T(photopic_luminance))));
    if (hn::AllFalse(d_, active)) return active;
    Triple<V> cones = times(k_.lms_from_rgb, p.rgb);
    const Triple<V> cones_in = cones;
    if constexpr (needs_more_digits) {
      const Triple<V> magnitude = {hn::Abs(p.rgb.x), hn::Abs(p.rgb.y), hn::Abs(p.rgb.z)};
      doubtful = hn::Lt(y, hn::Mul(set(T(0.5)), dot(k_.y_magnitude, magnitude)));
      doubtful = hn::And(active, hn::Or(doubtful, below_zero(has_cones(p) ? p.cones : cones)));
    }

    const V share = rod_share(local);
    const V rod = rod_signal(p, y);
    Triple<V> rgb = p.rgb;
    if (usual || k_.do_shift) rgb = shifted(p, cones, rod, share);
    if (usual || k_.do_luminance) rgb = with_luminance(rgb, largest_cone(cones_in, cones), y, rod, share);
    if (usual || k_.do_chroma) rgb = with_chroma(rgb, local);
    p.rgb = select(active, rgb, p.rgb);
    return active;
  }

 private:
  static bool has_cones(const PixelVector<V>& p) { return !usual && p.has_cones; }
  static bool has_rod(const PixelVector<V>& p) { return !usual && p.has_rod; }
  bool gamut_is_rgb() const { return usual || k_.gamut_is_rgb; }

  V set(T x) const { return hn::Set(d_, x); }
  V one() const { return set(T(1)); }
  // Divisors of lanes whose quotient is not used must not be 0 either.
  V positive_or_one(V x) const { return hn::IfThenElse(hn::Gt(x, hn::Zero(d_)), x, one()); }

  V dot(const Vec3<T>& row, const Triple<V>& v) const {
    return hn::Add(hn::Add(hn::Mul(set(row[0]), v.x), hn::Mul(set(row[1]), v.y)), hn::Mul(set(row[2]), v.z));
  }
  Triple<V> times(const Matrix3<T>& m, const Triple<V>& v) const {
    return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
  }
  Triple<V> scaled(V s, const Triple<V>& v) const { return {hn::Mul(s, v.x), hn::Mul(s, v.y), hn::Mul(s, v.z)}; }
  Triple<V> sum(const Triple<V>& a, const Triple<V>& b) const {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
  }
  Triple<V> difference(const Triple<V>& a, const Triple<V>& b) const {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
  }
  Triple<V> select(M mask, const Triple<V>& yes, const Triple<V>& no) const {
    return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
            hn::IfThenElse(mask, yes.z, no.z)};
  }
  V smallest(const Triple<V>& v) const { return hn::Min(hn::Min(v.x, v.y), v.z); }

  M below_zero(const Triple<V>& v) const { return hn::Lt(smallest(v), hn::Zero(d_)); }

  // False for NaN, too.
  M operable(V v) const { return hn::Le(hn::Abs(v), set(T(operable_limit))); }
  M operable(const Triple<V>& v) const { return hn::And(hn::And(operable(v.x), operable(v.y)), operable(v.z)); }
  M operable(const PixelVector<V>& p) const {
    M yes = operable(p.rgb);
    if (has_cones(p)) yes = hn::And(yes, operable(p.cones));
    if (has_rod(p)) yes = hn::And(yes, operable(p.rod));
    return yes;
  }

  // log2 of positive normal x.
  V log2(V x) const {
    const hn::RebindToSigned<D> di;
    constexpr int mantissa_bits = sizeof(T) == 4 ? 23 : 52;
    constexpr I bias = sizeof(T) == 4 ? I(127) : I(1023);
    const auto bits = hn::BitCast(di, x);
    const auto fraction = hn::And(bits, hn::Set(di, (I(1) << mantissa_bits) - 1));
    V exponent = hn::ConvertTo(d_, hn::Sub(hn::ShiftRight<mantissa_bits>(bits), hn::Set(di, bias)));
    V f = hn::BitCast(d_, hn::Or(fraction, hn::Set(di, bias << mantissa_bits)));
    const M upper = hn::Gt(f, set(T(std::numbers::sqrt2)));
    f = hn::IfThenElse(upper, hn::Mul(f, set(T(0.5))), f);
    exponent = hn::IfThenElse(upper, hn::Add(exponent, one()), exponent);
    const V s = hn::Div(hn::Sub(f, one()), hn::Add(f, one()));
    return hn::Add(exponent, hn::Mul(s, polynomial(k_.log_series, hn::Mul(s, s))));
  }

  template <std::size_t N>
  V polynomial(const std::array<T, N>& c, V x) const {
    V sum = set(c[N - 1]);
    for (std::size_t k = N - 1; k-- > 0;) sum = hn::Add(hn::Mul(sum, x), set(c[k]));
    return sum;
  }

  // 1 - m.
  V rod_share(V local) const {
    const V low = set(k_.scotopic_limit);
    const V inside = hn::Max(local, low);
    const V v = hn::Mul(log2(hn::Mul(inside, set(k_.inverse_high))), set(k_.per_octave));
    V share = hn::Min(hn::Max(hn::Mul(v, polynomial(k_.mesopic, v)), hn::Zero(d_)), one());
    share = hn::IfThenZeroElse(hn::Ge(local, set(k_.photopic_limit)), share);
    return hn::IfThenElse(hn::Le(local, low), one(), share);
  }

  V rod_signal(const PixelVector<V>& p, V y) const {
    if (has_rod(p)) return hn::Max(hn::Zero(d_), p.rod);
    const V estimate = !usual && k_.quadratic_rods ? quadratic_rod(p.rgb) : dot(k_.rod_row, p.rgb);
    return hn::Max(hn::Max(estimate, hn::Mul(set(k_.rod_floor), y)), hn::Zero(d_));
  }

  V quadratic_rod(const Triple<V>& rgb) const {
    const Triple<V> xyz = times(k_.xyz_from_rgb, rgb);
    const V zero = hn::Zero(d_);
    const V big_x = hn::Max(xyz.x, zero);
    const V big_y = hn::Max(xyz.y, zero);
    const V total = hn::Add(hn::Add(big_x, big_y), hn::Max(xyz.z, zero));
    const V divisor = positive_or_one(total);
    const V x = hn::Div(big_x, divisor);
    const V y = hn::Div(big_y, divisor);
    const auto& c = k_.rod_quadratic;
    V sum = hn::Add(set(c[0]), hn::Add(hn::Mul(set(c[1]), x), hn::Mul(set(c[2]), y)));
    sum = hn::Add(sum, hn::Mul(hn::Mul(set(c[3]), x), x));
    sum = hn::Add(sum, hn::Mul(hn::Mul(set(c[4]), x), y));
    sum = hn::Add(sum, hn::Mul(hn::Mul(set(c[5]), y), y));
    const V estimate = hn::Mul(hn::Mul(set(k_.rod_sp), total), sum);
    return hn::IfThenElseZero(hn::Gt(total, zero), estimate);
  }

  // Gains of the kernel times the rod signal. In double one division serves the three roots, whose product its
  // exponents hold; in float they would not.
  Triple<V> rod_response(const Triple<V>& q, V rod) const {
    const Triple<V> root = {gain_root(q.x, rod, 0), gain_root(q.y, rod, 1), gain_root(q.z, rod, 2)};
    if constexpr (std::is_same_v<T, float>)
      return {hn::Div(rod, root.x), hn::Div(rod, root.y), hn::Div(rod, root.z)};
    const V xy = hn::Mul(root.x, root.y);
    const V over_all = hn::Div(rod, hn::Mul(xy, root.z));
    const V over_xy = hn::Mul(over_all, root.z);
    return {hn::Mul(over_xy, root.y), hn::Mul(over_xy, root.x), hn::Mul(over_all, xy)};
  }
  // The reciprocal of a gain, at least 1.
  V gain_root(V q, V rod, std::size_t i) const {
    const V signal = hn::Mul(set(k_.gain[i]), hn::Add(q, hn::Mul(set(k_.kappa[i]), rod)));
    return hn::Sqrt(hn::Add(one(), hn::Max(hn::Zero(d_), signal)));
  }

  // The shifted and projected colour; `cones`, of the colour that came in, become those of the result.
  HWY_INLINE Triple<V> shifted(const PixelVector<V>& p, Triple<V>& cones, V rod, V share) const {
    const V w = hn::Mul(set(k_.shift), share);
    const Triple<V> response = scaled(w, rod_response(has_cones(p) ? p.cones : cones, rod));
    cones = sum(cones, times(k_.lms_shift, response));
    const Triple<V> moved = sum(p.rgb, times(k_.rgb_shift, response));
    const Triple<V> rgb = usual || k_.project ? projected(moved, p.rgb, cones) : moved;
    return select(hn::Gt(w, hn::Zero(d_)), rgb, p.rgb);
  }

  HWY_INLINE Triple<V> projected(const Triple<V>& moved, const Triple<V>& in, Triple<V>& cones) const {
    const Triple<V> target = gamut_is_rgb() ? moved : times(k_.gamut_from_rgb, moved);
    const Triple<V> source = gamut_is_rgb() ? in : times(k_.gamut_from_rgb, in);
    const V zero = hn::Zero(d_);
    const Triple<V> bound = {hn::Min(zero, source.x), hn::Min(zero, source.y), hn::Min(zero, source.z)};
    const Triple<V> z = difference(target, bound);
    const M outside = below_zero(z);
    if (hn::AllFalse(d_, outside)) return moved;
    const Triple<V> nearest_inside = sum(nearest(z), bound);
    const Triple<V> inside = gamut_is_rgb() ? nearest_inside : times(k_.rgb_from_gamut, nearest_inside);
    cones = select(outside, times(k_.lms_from_rgb, inside), cones);
    return select(outside, inside, moved);
  }

  // GamutProjection::nearest for z outside; see there.
  Triple<V> nearest(const Triple<V>& z) const {
    V best_margin = set(-std::numeric_limits<T>::infinity());
    Triple<V> best = {hn::Zero(d_), hn::Zero(d_), hn::Zero(d_)};
    for (unsigned set_index = 1; set_index < k_.active.size(); ++set_index) {
      const auto& active = k_.active[set_index];
      const auto bound = [set_index](unsigned i) { return (set_index >> i & 1u) != 0; };
      const Triple<V> margins = {dot(bound(0) ? active.dual[0] : active.primal[0], z),
                                 dot(bound(1) ? active.dual[1] : active.primal[1], z),
                                 dot(bound(2) ? active.dual[2] : active.primal[2], z)};
      const V margin = smallest(margins);
      const M better = hn::Gt(margin, best_margin);
      best_margin = hn::IfThenElse(better, margin, best_margin);
      const V zero = hn::Zero(d_);
      best = select(better, {bound(0) ? zero : margins.x, bound(1) ? zero : margins.y, bound(2) ? zero : margins.z},
                    best);
    }
    const V zero = hn::Zero(d_);
    return {hn::Max(best.x, zero), hn::Max(best.y, zero), hn::Max(best.z, zero)};
  }

  V policy_luminance(V y, V rod, V share) const {
    if (!usual && !k_.mesopic_policy) return y;
    const V rods = hn::Mul(share, set(k_.rods_weight));
    const V weight = hn::Div(rods, hn::Add(hn::Sub(one(), share), rods));
    return hn::Add(y, hn::Mul(weight, hn::Sub(hn::Mul(rod, set(k_.inverse_rod_white)), y)));
  }

  // The greatest magnitude of the cone signals of two colours, white's being 1.
  V largest_cone(const Triple<V>& a, const Triple<V>& b) const {
    return hn::Max(hn::Max(largest_cone(a.x, b.x, 0), largest_cone(a.y, b.y, 1)), largest_cone(a.z, b.z, 2));
  }
  V largest_cone(V a, V b, std::size_t i) const {
    return hn::Mul(hn::Max(hn::Abs(a), hn::Abs(b)), set(k_.inverse_cone_white[i]));
  }

  // luminance_ratio() of reference.h, and what leads to it.
  Triple<V> with_luminance(const Triple<V>& rgb, V largest, V y, V rod, V share) const {
    const V from = dot(k_.y_row, rgb);
    const V goal = hn::Add(y, hn::Mul(set(k_.luminance_goal), hn::Sub(policy_luminance(y, rod, share), y)));
    const V to = hn::Add(goal, hn::Mul(set(k_.luminance_left), hn::Sub(from, goal)));
    const V zero = hn::Zero(d_);
    const V f = hn::Max(hn::Abs(from), hn::Mul(set(k_.floor), largest));
    const V divisor = positive_or_one(f);
    const V u = hn::Div(from, divisor);
    // Not u (to/f): 0 times infinity is no number.
    V ratio = hn::Add(hn::Div(hn::Mul(u, to), divisor), hn::Sub(one(), hn::Mul(u, u)));
    ratio = hn::Min(hn::Max(ratio, zero), set(T(1e18)));
    // Nothing to change is 1 to the last bit. (Black, f = 0, among it: from = to = 0, or nothing to scale.)
    ratio = hn::IfThenElse(hn::And(hn::Gt(f, zero), hn::Ne(to, from)), ratio, one());
    return scaled(ratio, rgb);
  }

  Triple<V> with_chroma(const Triple<V>& rgb, V local) const {
    const V s = hn::Mul(hn::Div(local, hn::Add(local, set(k_.chroma_half))), set(k_.chroma_at_5));
    const V keep = hn::Sub(one(), hn::Mul(set(k_.chroma), hn::Sub(one(), hn::Min(one(), s))));
    const V y = dot(k_.y_row, rgb);
    const Triple<V> grey = {y, y, y};
    const Triple<V> faded = sum(grey, scaled(keep, difference(rgb, grey)));
    return select(hn::Lt(keep, one()), faded, rgb);
  }

  HWY_INLINE M safko(PixelVector<V>& p, M active, M& doubtful) const {
    const Triple<V> q = p.has_cones ? p.cones : times(k_.lms_from_rgb, p.rgb);
    if constexpr (needs_more_digits) doubtful = hn::And(active, below_zero(q));
    const V rod = rod_signal(p, dot(k_.y_row, p.rgb));
    const Triple<V> rgb = sum(times(k_.rgb_from_lms, q), times(k_.rgb_shift, rod_response(q, rod)));
    p.rgb = select(active, rgb, p.rgb);
    return active;
  }

  D d_;
  const BatchConstants<T>& k_;
};

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
