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

#include <initializer_list>
#include <limits>
#include <type_traits>

#include "batch/batch_constants.h"
#include "batch/lanes-inl.h"
#include "stages/table.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// As wide as the machine's vectors, but no wider than constants are laid out for.
template <typename T>
using Tag = hn::CappedTag<T, WideConstants<T>::lanes>;

template <class V>
struct Triple {
  V x, y, z;
};

/// Whether pixels bring signals of their own: none, cones and rods, or what the flags of a vector say.
enum class Receptors { absent, given, maybe };

/// What one vector of pixels brings along; cones and rod are read only where the flags say so.
template <class V>
struct PixelVector {
  Triple<V> rgb;
  Triple<V> cones;
  V rod;
  bool has_cones, has_rod;
};

/// Results for a vector of pixels. Those that are not `active` are left alone, whatever `rgb` says. Of the others,
/// `doubtful` are those that need more digits, be it to see that they are not active: whose luminance is what is left of
/// a cancellation, or with a negative cone signal, which the rods' may cancel under the kernel's root.
template <class V, class M>
struct SeenVector {
  Triple<V> rgb;
  M active, doubtful;
};

template <class M, class V>
HWY_INLINE Triple<V> select(const M& mask, const Triple<V>& yes, const Triple<V>& no) {
  return {lanes::IfThenElse(mask, yes.x, no.x), lanes::IfThenElse(mask, yes.y, no.y),
          lanes::IfThenElse(mask, yes.z, no.z)};
}

template <class V>
HWY_INLINE Triple<lanes::Pair<V>> paired(const Triple<V>& a, const Triple<V>& b) {
  return {{a.x, b.x}, {a.y, b.y}, {a.z, b.z}};
}
template <class V>
HWY_INLINE PixelVector<lanes::Pair<V>> paired(const PixelVector<V>& a, const PixelVector<V>& b) {
  return {paired(a.rgb, b.rgb), paired(a.cones, b.cones), {a.rod, b.rod}, a.has_cones, a.has_rod};
}
template <class V, class M>
HWY_INLINE SeenVector<V, M> first_of(const SeenVector<lanes::Pair<V>, lanes::Pair<M>>& s) {
  return {{s.rgb.x.a, s.rgb.y.a, s.rgb.z.a}, s.active.a, s.doubtful.a};
}
template <class V, class M>
HWY_INLINE SeenVector<V, M> second_of(const SeenVector<lanes::Pair<V>, lanes::Pair<M>>& s) {
  return {{s.rgb.x.b, s.rgb.y.b, s.rgb.z.b}, s.active.b, s.doubtful.b};
}

/// D: a Highway tag, or lanes::PairTag of one, for two vectors side by side. `stages` and `receptors` say what code is
/// compiled for; StageSet::any asks the constants. The same arithmetic, hence the same bits, any way.
template <class D, StageSet stages = StageSet::any, Receptors receptors = Receptors::maybe>
class PixelOperator {
  using T = typename lanes::Types<D>::T;
  using V = typename lanes::Types<D>::V;
  using M = typename lanes::Types<D>::M;
  using I = hwy::MakeSigned<T>;
  static constexpr bool any = stages == StageSet::any;

 public:
  static constexpr bool needs_more_digits = std::is_same_v<T, float>;
  using Pixels = PixelVector<V>;
  using Seen = SeenVector<V, M>;

  PixelOperator(D d, const WideConstants<T>& k) : d_(d), wide_(k), k_(k.numbers) {}

  /// False: none of the pixels is active, and nothing else was found out.
  HWY_INLINE bool operator()(const Pixels& p, Seen& seen) const {
    if (safko()) return see_safko(p, seen);
    const Triple<V> terms = products(k_.y_row, p.rgb);
    const V y = sum(terms);
    V local = set(k_.adaptation);
    if (!any || k_.local) local = lanes::Add(local, lanes::Max(lanes::Zero(d_), lanes::Mul(y, set(k_.unit))));
    // First what a lit picture is skipped by: its luminance, where that is no difference. NaN is not below.
    const V limit = number(T(photopic_luminance));
    seen.active = lanes::Lt(local, limit);
    seen.doubtful = none();
    if constexpr (needs_more_digits)
      if (HWY_UNLIKELY(!lanes::AllFalse(d_, below_zero(terms)))) find_cancelled(terms, y, lanes::Sub(local, limit), seen);
    if (lanes::AllFalse(d_, seen.active)) return false;
    seen.active = lanes::And(seen.active, operable(p));
    if (lanes::AllFalse(d_, seen.active)) return false;
    see(p, y, local, seen);
    return true;
  }

 private:
  static constexpr bool one_of(std::initializer_list<StageSet> sets) {
    for (const StageSet set : sets)
      if (stages == set) return true;
    return false;
  }
  bool safko() const { return any ? k_.safko : stages == StageSet::kernel; }
  bool shift() const { return any ? k_.do_shift : one_of({StageSet::all, StageSet::grey, StageSet::shift}); }
  bool project() const { return !any || k_.project; }
  bool gamut_is_rgb() const { return !any || k_.gamut_is_rgb; }
  bool luminance() const { return any ? k_.do_luminance : one_of({StageSet::all, StageSet::grey}); }
  bool mesopic_luminance() const { return any ? k_.mesopic_policy : stages != StageSet::grey; }
  bool chroma() const { return any ? k_.do_chroma : one_of({StageSet::all, StageSet::grey, StageSet::chroma}); }
  bool quadratic_rods() const { return any && k_.quadratic_rods; }

  static bool has_cones(const Pixels& p) {
    return receptors == Receptors::maybe ? p.has_cones : receptors == Receptors::given;
  }
  static bool has_rod(const Pixels& p) {
    return receptors == Receptors::maybe ? p.has_rod : receptors == Receptors::given;
  }

  // Pixels whose luminance is what is left of a cancellation; where it may be below the limit, too, they are active.
  HWY_INLINE void find_cancelled(const Triple<V>& terms, V y, V over_limit, Seen& seen) const {
    const V magnitude = sum({lanes::Abs(terms.x), lanes::Abs(terms.y), lanes::Abs(terms.z)});
    seen.doubtful = lanes::Lt(y, lanes::Mul(number(T(0.5)), magnitude));
    const V rounding = lanes::Mul(magnitude, set(k_.luminance_rounding));
    seen.active = lanes::Or(seen.active, lanes::And(seen.doubtful, lanes::Lt(over_limit, rounding)));
  }

  HWY_INLINE void see(const Pixels& p, V y, V local, Seen& seen) const {
    Triple<V> cones = times(k_.lms_from_rgb, p.rgb);
    const Triple<V> cones_in = cones;
    if constexpr (needs_more_digits)
      seen.doubtful = lanes::And(seen.active, lanes::Or(seen.doubtful, below_zero(has_cones(p) ? p.cones : cones)));
    const V share = rod_share(local);
    const V rod = rod_signal(p, y);
    seen.rgb = p.rgb;
    if (shift()) seen.rgb = shifted(p, cones, rod, share);
    if (luminance()) seen.rgb = with_luminance(seen.rgb, largest_cone(cones_in, cones), y, rod, share);
    if (chroma()) seen.rgb = with_chroma(seen.rgb, local);
  }

  // A constant of k_.
  HWY_INLINE V set(const T& x) const { return lanes::Load(d_, wide_.of(x)); }
  HWY_INLINE V number(T x) const { return lanes::Set(d_, x); }
  HWY_INLINE V one() const { return number(T(1)); }
  HWY_INLINE M none() const { return lanes::Lt(one(), lanes::Zero(d_)); }
  // Divisors of lanes whose quotient is not used must not be 0 either.
  HWY_INLINE V positive_or_one(V x) const { return lanes::IfThenElse(lanes::Gt(x, lanes::Zero(d_)), x, one()); }

  HWY_INLINE Triple<V> products(const Vec3<T>& row, const Triple<V>& v) const {
    return {lanes::Mul(set(row[0]), v.x), lanes::Mul(set(row[1]), v.y), lanes::Mul(set(row[2]), v.z)};
  }
  HWY_INLINE V sum(const Triple<V>& v) const { return lanes::Add(lanes::Add(v.x, v.y), v.z); }
  HWY_INLINE V dot(const Vec3<T>& row, const Triple<V>& v) const { return sum(products(row, v)); }
  HWY_INLINE Triple<V> times(const Matrix3<T>& m, const Triple<V>& v) const {
    return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
  }
  HWY_INLINE Triple<V> scaled(V s, const Triple<V>& v) const { return {lanes::Mul(s, v.x), lanes::Mul(s, v.y), lanes::Mul(s, v.z)}; }
  HWY_INLINE Triple<V> sum(const Triple<V>& a, const Triple<V>& b) const {
    return {lanes::Add(a.x, b.x), lanes::Add(a.y, b.y), lanes::Add(a.z, b.z)};
  }
  HWY_INLINE Triple<V> difference(const Triple<V>& a, const Triple<V>& b) const {
    return {lanes::Sub(a.x, b.x), lanes::Sub(a.y, b.y), lanes::Sub(a.z, b.z)};
  }
  HWY_INLINE V smallest(const Triple<V>& v) const { return lanes::Min(lanes::Min(v.x, v.y), v.z); }

  HWY_INLINE M below_zero(const Triple<V>& v) const { return lanes::Lt(smallest(v), lanes::Zero(d_)); }

  // False for NaN, too.
  HWY_INLINE M operable(V v) const { return lanes::Le(lanes::Abs(v), number(T(operable_limit))); }
  HWY_INLINE M operable(const Triple<V>& v) const { return lanes::And(lanes::And(operable(v.x), operable(v.y)), operable(v.z)); }
  HWY_INLINE M operable(const Pixels& p) const {
    M yes = operable(p.rgb);
    if (has_cones(p)) yes = lanes::And(yes, operable(p.cones));
    if (has_rod(p)) yes = lanes::And(yes, operable(p.rod));
    return yes;
  }

  // log2 of positive normal x.
  HWY_INLINE V log2(V x) const {
    const typename lanes::Types<D>::Signed di;
    constexpr int mantissa_bits = sizeof(T) == 4 ? 23 : 52;
    constexpr I bias = sizeof(T) == 4 ? I(127) : I(1023);
    const auto bits = lanes::BitCast(di, x);
    const auto fraction = lanes::And(bits, lanes::Set(di, (I(1) << mantissa_bits) - 1));
    V exponent = lanes::ConvertTo(d_, lanes::Sub(lanes::ShiftRight<mantissa_bits>(bits), lanes::Set(di, bias)));
    V f = lanes::BitCast(d_, lanes::Or(fraction, lanes::Set(di, bias << mantissa_bits)));
    const M upper = lanes::Gt(f, number(T(std::numbers::sqrt2)));
    f = lanes::IfThenElse(upper, lanes::Mul(f, number(T(0.5))), f);
    exponent = lanes::IfThenElse(upper, lanes::Add(exponent, one()), exponent);
    const V s = lanes::Div(lanes::Sub(f, one()), lanes::Add(f, one()));
    return lanes::Add(exponent, lanes::Mul(s, polynomial(k_.log_series, lanes::Mul(s, s))));
  }

  template <std::size_t N>
  HWY_INLINE V polynomial(const std::array<T, N>& c, V x) const {
    V sum = set(c[N - 1]);
    for (std::size_t k = N - 1; k-- > 0;) sum = lanes::Add(lanes::Mul(sum, x), set(c[k]));
    return sum;
  }

  // 1 - m.
  HWY_INLINE V rod_share(V local) const {
    const V low = set(k_.scotopic_limit);
    const V inside = lanes::Max(local, low);
    const V v = lanes::Mul(log2(lanes::Mul(inside, set(k_.inverse_high))), set(k_.per_octave));
    V share = lanes::Min(lanes::Max(lanes::Mul(v, polynomial(k_.mesopic, v)), lanes::Zero(d_)), one());
    share = lanes::IfThenZeroElse(lanes::Ge(local, set(k_.photopic_limit)), share);
    return lanes::IfThenElse(lanes::Le(local, low), one(), share);
  }

  HWY_INLINE V rod_signal(const Pixels& p, V y) const {
    if (has_rod(p)) return lanes::Max(lanes::Zero(d_), p.rod);
    const V estimate = quadratic_rods() ? quadratic_rod(p.rgb) : dot(k_.rod_row, p.rgb);
    return lanes::Max(lanes::Max(estimate, lanes::Mul(set(k_.rod_floor), y)), lanes::Zero(d_));
  }

  HWY_INLINE V quadratic_rod(const Triple<V>& rgb) const {
    const Triple<V> xyz = times(k_.xyz_from_rgb, rgb);
    const V zero = lanes::Zero(d_);
    const V big_x = lanes::Max(xyz.x, zero);
    const V big_y = lanes::Max(xyz.y, zero);
    const V total = lanes::Add(lanes::Add(big_x, big_y), lanes::Max(xyz.z, zero));
    const V divisor = positive_or_one(total);
    const V x = lanes::Div(big_x, divisor);
    const V y = lanes::Div(big_y, divisor);
    const auto& c = k_.rod_quadratic;
    V sum = lanes::Add(set(c[0]), lanes::Add(lanes::Mul(set(c[1]), x), lanes::Mul(set(c[2]), y)));
    sum = lanes::Add(sum, lanes::Mul(lanes::Mul(set(c[3]), x), x));
    sum = lanes::Add(sum, lanes::Mul(lanes::Mul(set(c[4]), x), y));
    sum = lanes::Add(sum, lanes::Mul(lanes::Mul(set(c[5]), y), y));
    const V estimate = lanes::Mul(lanes::Mul(set(k_.rod_sp), total), sum);
    return lanes::IfThenElseZero(lanes::Gt(total, zero), estimate);
  }

  // Gains of the kernel times the rod signal. In double one division serves the three roots, whose product its
  // exponents hold; in float they would not.
  HWY_INLINE Triple<V> rod_response(const Triple<V>& q, V rod) const {
    const Triple<V> root = {gain_root(q.x, rod, 0), gain_root(q.y, rod, 1), gain_root(q.z, rod, 2)};
    if constexpr (std::is_same_v<T, float>)
      return {lanes::Div(rod, root.x), lanes::Div(rod, root.y), lanes::Div(rod, root.z)};
    const V xy = lanes::Mul(root.x, root.y);
    const V over_all = lanes::Div(rod, lanes::Mul(xy, root.z));
    const V over_xy = lanes::Mul(over_all, root.z);
    return {lanes::Mul(over_xy, root.y), lanes::Mul(over_xy, root.x), lanes::Mul(over_all, xy)};
  }
  // The reciprocal of a gain, at least 1.
  HWY_INLINE V gain_root(V q, V rod, std::size_t i) const {
    const V signal = lanes::Mul(set(k_.gain[i]), lanes::Add(q, lanes::Mul(set(k_.kappa[i]), rod)));
    return lanes::Sqrt(lanes::Add(one(), lanes::Max(lanes::Zero(d_), signal)));
  }

  // The shifted and projected colour; `cones`, of the colour that came in, become those of the result.
  HWY_INLINE Triple<V> shifted(const Pixels& p, Triple<V>& cones, V rod, V share) const {
    const V w = lanes::Mul(set(k_.shift), share);
    const Triple<V> response = scaled(w, rod_response(has_cones(p) ? p.cones : cones, rod));
    cones = sum(cones, times(k_.lms_shift, response));
    const Triple<V> moved = sum(p.rgb, times(k_.rgb_shift, response));
    const Triple<V> rgb = project() ? projected(moved, p.rgb, cones) : moved;
    return select(lanes::Gt(w, lanes::Zero(d_)), rgb, p.rgb);
  }

  HWY_INLINE Triple<V> projected(const Triple<V>& moved, const Triple<V>& in, Triple<V>& cones) const {
    const Triple<V> target = gamut_is_rgb() ? moved : times(k_.gamut_from_rgb, moved);
    const Triple<V> source = gamut_is_rgb() ? in : times(k_.gamut_from_rgb, in);
    const V zero = lanes::Zero(d_);
    const Triple<V> bound = {lanes::Min(zero, source.x), lanes::Min(zero, source.y), lanes::Min(zero, source.z)};
    const Triple<V> z = difference(target, bound);
    const M outside = below_zero(z);
    if (lanes::AllFalse(d_, outside)) return moved;
    const Triple<V> nearest_inside = sum(nearest(z), bound);
    const Triple<V> inside = gamut_is_rgb() ? nearest_inside : times(k_.rgb_from_gamut, nearest_inside);
    cones = select(outside, times(k_.lms_from_rgb, inside), cones);
    return select(outside, inside, moved);
  }

  // GamutProjection::nearest for z outside; see there.
  HWY_INLINE Triple<V> nearest(const Triple<V>& z) const {
    V margin = number(-std::numeric_limits<T>::infinity());
    Triple<V> best = {lanes::Zero(d_), lanes::Zero(d_), lanes::Zero(d_)};
    try_active_set<1>(z, margin, best);
    try_active_set<2>(z, margin, best);
    try_active_set<3>(z, margin, best);
    try_active_set<4>(z, margin, best);
    try_active_set<5>(z, margin, best);
    try_active_set<6>(z, margin, best);
    try_active_set<7>(z, margin, best);
    const V zero = lanes::Zero(d_);
    return {lanes::Max(best.x, zero), lanes::Max(best.y, zero), lanes::Max(best.z, zero)};
  }

  // Takes the solution of one active set where its worst entry is greater than `margin`.
  template <unsigned bound>
  HWY_INLINE void try_active_set(const Triple<V>& z, V& margin, Triple<V>& best) const {
    const Triple<V> entries = {entry<bound, 0>(z), entry<bound, 1>(z), entry<bound, 2>(z)};
    const V worst = smallest(entries);
    const M better = lanes::Gt(worst, margin);
    margin = lanes::IfThenElse(better, worst, margin);
    best = {taken<bound, 0>(better, entries.x, best.x), taken<bound, 1>(better, entries.y, best.y),
            taken<bound, 2>(better, entries.z, best.z)};
  }
  template <unsigned bound, unsigned i>
  HWY_INLINE V taken(M better, V entry, V best) const {
    if constexpr (bound >> i & 1u) return lanes::IfThenZeroElse(better, best);
    return lanes::IfThenElse(better, entry, best);
  }
  // Entry i of the set's solution: the multiplier of a bound component, or a free one. Rows hold but the columns of
  // bound components, and 1 at a free one's own: what is 0 and 1 there is not multiplied.
  template <unsigned bound, unsigned i>
  HWY_INLINE V entry(const Triple<V>& z) const {
    constexpr bool is_bound = bound >> i & 1u;
    const Vec3<T>& row = is_bound ? k_.active[bound].dual[i] : k_.active[bound].primal[i];
    const V terms[3] = {term<bound, i, 0>(row, z.x), term<bound, i, 1>(row, z.y), term<bound, i, 2>(row, z.z)};
    constexpr auto there = [](unsigned j) { return (bound >> j & 1u) != 0 || j == i; };
    constexpr unsigned first = there(0) ? 0 : there(1) ? 1 : 2;
    V sum = terms[first];
    if constexpr (first < 1 && there(1)) sum = lanes::Add(sum, terms[1]);
    if constexpr (first < 2 && there(2)) sum = lanes::Add(sum, terms[2]);
    return sum;
  }
  template <unsigned bound, unsigned i, unsigned j>
  HWY_INLINE V term(const Vec3<T>& row, V z) const {
    if constexpr (bound >> j & 1u) return lanes::Mul(set(row[j]), z);
    return z;
  }

  HWY_INLINE V policy_luminance(V y, V rod, V share) const {
    if (!mesopic_luminance()) return y;
    const V rods = lanes::Mul(share, set(k_.rods_weight));
    const V weight = lanes::Div(rods, lanes::Add(lanes::Sub(one(), share), rods));
    return lanes::Add(y, lanes::Mul(weight, lanes::Sub(lanes::Mul(rod, set(k_.inverse_rod_white)), y)));
  }

  // The greatest magnitude of the cone signals of two colours, white's being 1.
  HWY_INLINE V largest_cone(const Triple<V>& a, const Triple<V>& b) const {
    return lanes::Max(lanes::Max(largest_cone(a.x, b.x, 0), largest_cone(a.y, b.y, 1)), largest_cone(a.z, b.z, 2));
  }
  HWY_INLINE V largest_cone(V a, V b, std::size_t i) const {
    return lanes::Mul(lanes::Max(lanes::Abs(a), lanes::Abs(b)), set(k_.inverse_cone_white[i]));
  }

  // luminance_ratio() of reference.h, and what leads to it.
  HWY_INLINE Triple<V> with_luminance(const Triple<V>& rgb, V largest, V y, V rod, V share) const {
    const V from = dot(k_.y_row, rgb);
    const V goal = lanes::Add(y, lanes::Mul(set(k_.luminance_goal), lanes::Sub(policy_luminance(y, rod, share), y)));
    const V to = lanes::Add(goal, lanes::Mul(set(k_.luminance_left), lanes::Sub(from, goal)));
    const V zero = lanes::Zero(d_);
    const V f = lanes::Max(lanes::Abs(from), lanes::Mul(set(k_.floor), largest));
    const V divisor = positive_or_one(f);
    const V u = lanes::Div(from, divisor);
    // Not u (to/f): 0 times infinity is no number.
    V ratio = lanes::Add(lanes::Div(lanes::Mul(u, to), divisor), lanes::Sub(one(), lanes::Mul(u, u)));
    ratio = lanes::Min(lanes::Max(ratio, zero), number(T(1e18)));
    // Nothing to change is 1 to the last bit. (Black, f = 0, among it: from = to = 0, or nothing to scale.)
    ratio = lanes::IfThenElse(lanes::And(lanes::Gt(f, zero), lanes::Ne(to, from)), ratio, one());
    return scaled(ratio, rgb);
  }

  HWY_INLINE Triple<V> with_chroma(const Triple<V>& rgb, V local) const {
    const V s = lanes::Mul(lanes::Div(local, lanes::Add(local, set(k_.chroma_half))), set(k_.chroma_at_5));
    const V keep = lanes::Sub(one(), lanes::Mul(set(k_.chroma), lanes::Sub(one(), lanes::Min(one(), s))));
    const V y = dot(k_.y_row, rgb);
    const Triple<V> grey = {y, y, y};
    const Triple<V> faded = sum(grey, scaled(keep, difference(rgb, grey)));
    return select(lanes::Lt(keep, one()), faded, rgb);
  }

  HWY_INLINE bool see_safko(const Pixels& p, Seen& seen) const {
    seen.active = operable(p);
    if (lanes::AllFalse(d_, seen.active)) return false;
    const Triple<V> q = has_cones(p) ? p.cones : times(k_.lms_from_rgb, p.rgb);
    if constexpr (needs_more_digits) seen.doubtful = lanes::And(seen.active, below_zero(q));
    else seen.doubtful = none();
    const V rod = rod_signal(p, dot(k_.y_row, p.rgb));
    seen.rgb = sum(times(k_.rgb_from_lms, q), times(k_.rgb_shift, rod_response(q, rod)));
    return true;
  }

  D d_;
  const WideConstants<T>& wide_;
  const BatchConstants<T>& k_;
};

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
