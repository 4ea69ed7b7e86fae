// The number type whose arithmetic is written down instead of done (stages/shared/numbers-inl.h says what one
// is).
#if defined(SCOTOPIC_SHADERS_RECORD_RECORDER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_SHADERS_RECORD_RECORDER_INL_H_
#undef SCOTOPIC_SHADERS_RECORD_RECORDER_INL_H_
#else
#define SCOTOPIC_SHADERS_RECORD_RECORDER_INL_H_
#endif

#include <hwy/highway.h>

#include <numbers>

#include "shaders/record/bindings.h"
#include "stages/shared/numbers-inl.h"
#include "stages/shared/stage_constants.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

/// See numbers-inl.h. T is float, as it is in shaders.
class Recorder {
 public:
  using T = float;
  using V = shaders::Recorded;
  using M = shaders::RecordedTruth;

  Recorder(shaders::Graph& graph, const shaders::Bindings& bindings) : graph_(&graph), bindings_(&bindings) {}

  /// A number, or what a slider makes of it.
  V constant(const T& x) const { return bindings_->value_of(x, *graph_); }
  V number(T x) const { return static_cast<double>(x); }
  V zero() const { return 0.0; }
  V one() const { return 1.0; }
  V max(const V& a, const V& b) const { return shaders::max(a, b); }
  V min(const V& a, const V& b) const { return shaders::min(a, b); }
  V abs(const V& x) const { return shaders::abs(x); }
  V sqrt(const V& x) const { return shaders::sqrt(x); }
  V exp(const V& x) const { return shaders::exp(x); }
  M less(const V& a, const V& b) const { return a < b; }
  M less_equal(const V& a, const V& b) const { return a <= b; }
  M greater(const V& a, const V& b) const { return a > b; }
  M not_equal(const V& a, const V& b) const { return a != b; }
  M both(const M& a, const M& b) const { return shaders::both(a, b); }
  M either(const M& a, const M& b) const { return shaders::either(a, b); }
  M without(const M& no, const M& yes) const { return shaders::without(no, yes); }
  M never() const { return false; }
  /// Nothing is known of pixels yet: all is written down, and selects decide.
  bool none(const M&) const { return false; }
  V select(const M& m, const V& yes, const V& no) const { return chosen(m, yes, no); }
  V kept(const M& m, const V& x) const { return chosen(m, x, 0.0); }
  V dropped(const M& m, const V& x) const { return chosen(m, 0.0, x); }

  /// 1 - m by MesopicFit, whose error is below float's own (2e-8), and the language's logarithm.
  V rod_share(const V& local, const WeightConstants<T>& k) const {
    const V low = constant(k.scotopic_limit);
    const V of_high = max(local, low) * constant(k.inverse_high);
    const V v = log(of_high) * (std::numbers::log2e * static_cast<double>(k.per_octave));
    const V share = min(max(v * polynomial(*this, k.mesopic, v), zero()), one());
    return select(less_equal(local, low), one(), kept(less(local, constant(k.photopic_limit)), share));
  }

 private:
  shaders::Graph* graph_;
  const shaders::Bindings* bindings_;
};

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
