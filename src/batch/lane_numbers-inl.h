// Vectors of pixels as a number type (stages/shared/numbers-inl.h). No MulAdd anywhere: fused and unfused
// targets would differ in the last bit.
#if defined(SCOTOPIC_BATCH_LANE_NUMBERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_BATCH_LANE_NUMBERS_INL_H_
#undef SCOTOPIC_BATCH_LANE_NUMBERS_INL_H_
#else
#define SCOTOPIC_BATCH_LANE_NUMBERS_INL_H_
#endif

#include <hwy/highway.h>

#include <numbers>

#include "batch/lanes-inl.h"
#include "batch/wide_constants.h"
#include "stages/pixel_stages-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

// As wide as the machine's vectors, but no wider than constants are laid out for.
template <typename T>
using Tag = hn::CappedTag<T, 64 / sizeof(T)>;

/// D: a Highway tag, or lanes::PairTag of one, for two vectors side by side. Constants: what constant() takes
/// members of.
template <class D, class Constants = StageConstants<typename lanes::Types<D>::T>>
class LaneNumbers {
 public:
  using T = typename lanes::Types<D>::T;
  using V = typename lanes::Types<D>::V;
  using M = typename lanes::Types<D>::M;

  explicit LaneNumbers(const WideNumbers<Constants>& wide) : wide_(wide) {}

  HWY_INLINE V constant(const T& x) const { return lanes::Load(D(), wide_.of(x)); }
  HWY_INLINE V number(T x) const { return lanes::Set(D(), x); }
  HWY_INLINE V zero() const { return lanes::Zero(D()); }
  HWY_INLINE V one() const { return number(T(1)); }
  HWY_INLINE V max(V a, V b) const { return lanes::Max(a, b); }
  HWY_INLINE V min(V a, V b) const { return lanes::Min(a, b); }
  HWY_INLINE V abs(V x) const { return lanes::Abs(x); }
  HWY_INLINE V sqrt(V x) const { return lanes::Sqrt(x); }
  HWY_INLINE M less(V a, V b) const { return lanes::Lt(a, b); }
  HWY_INLINE M less_equal(V a, V b) const { return lanes::Le(a, b); }
  HWY_INLINE M greater(V a, V b) const { return lanes::Gt(a, b); }
  HWY_INLINE M not_equal(V a, V b) const { return lanes::Ne(a, b); }
  HWY_INLINE M both(M a, M b) const { return lanes::And(a, b); }
  HWY_INLINE M either(M a, M b) const { return lanes::Or(a, b); }
  HWY_INLINE M without(M no, M yes) const { return lanes::AndNot(no, yes); }
  HWY_INLINE M never() const { return lanes::Lt(one(), zero()); }
  HWY_INLINE bool none(M m) const { return lanes::AllFalse(D(), m); }
  HWY_INLINE V select(M m, V yes, V no) const { return lanes::IfThenElse(m, yes, no); }
  HWY_INLINE V kept(M m, V x) const { return lanes::IfThenElseZero(m, x); }
  HWY_INLINE V dropped(M m, V x) const { return lanes::IfThenZeroElse(m, x); }

  /// e^x for x <= 0, to 2 ulp; below -20 (float) or -40 (double), where 1 - e^x is 1, e of that.
  HWY_INLINE V exp(V x) const {
    constexpr bool is_float = sizeof(T) == 4;
    const D d;
    const typename lanes::Types<D>::Signed di;
    const V bounded = max(x, number(is_float ? T(-20) : T(-40)));
    // Adding 1.5 2^mantissa rounds to a whole number, which then stands in the last bits.
    const V magic = number(is_float ? T(0x1.8p23) : T(0x1.8p52));
    const V shifted = bounded * number(T(std::numbers::log2e)) + magic;
    const V octaves = shifted - magic;
    const V r = (bounded - octaves * number(T(is_float ? 0x1.62ep-1 : 0x1.62e42fefap-1))) -
                octaves * number(T(is_float ? 0x1.0bfbe8p-15 : 0x1.cf79abc9e3b39p-40));
    V sum = number(T(1) / factorial(is_float ? 7 : 13));
    for (int k = is_float ? 6 : 12; k >= 0; --k) sum = sum * r + number(T(1) / factorial(k));
    const auto exponent = hn::ShiftLeft < is_float ? 23 : 52 > (hn::BitCast(di, shifted));
    return hn::BitCast(d, hn::Add(hn::BitCast(di, sum), exponent));
  }

  /// 1 - m, by MesopicFit.
  HWY_INLINE V rod_share(V local, const WeightConstants<T>& k) const {
    const V low = constant(k.scotopic_limit);
    const V inside = max(local, low);
    const V v = log2(inside * constant(k.inverse_high), k) * constant(k.per_octave);
    V share = min(max(v * polynomial(*this, k.mesopic, v), zero()), one());
    share = lanes::IfThenZeroElse(lanes::Ge(local, constant(k.photopic_limit)), share);
    return select(less_equal(local, low), one(), share);
  }

 private:
  static constexpr T factorial(int k) { return k <= 1 ? T(1) : T(k) * factorial(k - 1); }

  using I = hwy::MakeSigned<T>;

  // Of positive normal x.
  HWY_INLINE V log2(V x, const WeightConstants<T>& k) const {
    const D d;
    const typename lanes::Types<D>::Signed di;
    constexpr int mantissa_bits = sizeof(T) == 4 ? 23 : 52;
    constexpr I bias = sizeof(T) == 4 ? I(127) : I(1023);
    const auto bits = lanes::BitCast(di, x);
    const auto fraction = lanes::And(bits, lanes::Set(di, (I(1) << mantissa_bits) - 1));
    V exponent =
        lanes::ConvertTo(d, lanes::Sub(lanes::ShiftRight<mantissa_bits>(bits), lanes::Set(di, bias)));
    V f = lanes::BitCast(d, lanes::Or(fraction, lanes::Set(di, bias << mantissa_bits)));
    const M upper = greater(f, number(T(std::numbers::sqrt2)));
    f = select(upper, f * number(T(0.5)), f);
    exponent = select(upper, exponent + one(), exponent);
    const V s = (f - one()) / (f + one());
    return exponent + s * polynomial(*this, k.log_series, s * s);
  }

  const WideNumbers<Constants>& wide_;
};

template <class V>
HWY_INLINE Triple<lanes::Pair<V>> paired(const Triple<V>& a, const Triple<V>& b) {
  return {{a.x, b.x}, {a.y, b.y}, {a.z, b.z}};
}
template <class V>
HWY_INLINE PixelIn<lanes::Pair<V>> paired(const PixelIn<V>& a, const PixelIn<V>& b) {
  return {paired(a.rgb, b.rgb), paired(a.cones, b.cones), {a.rod, b.rod}, a.has_cones, a.has_rod};
}
template <class V, class M>
HWY_INLINE SeenPixel<V, M> first_of(const SeenPixel<lanes::Pair<V>, lanes::Pair<M>>& s) {
  return {{s.rgb.x.a, s.rgb.y.a, s.rgb.z.a}, s.active.a, s.doubtful.a};
}
template <class V, class M>
HWY_INLINE SeenPixel<V, M> second_of(const SeenPixel<lanes::Pair<V>, lanes::Pair<M>>& s) {
  return {{s.rgb.x.b, s.rgb.y.b, s.rgb.z.b}, s.active.b, s.doubtful.b};
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
