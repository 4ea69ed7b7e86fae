// One pixel at a time: the number type of the reference.
#if defined(SCOTOPIC_STAGES_SCALAR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_STAGES_SCALAR_INL_H_
#undef SCOTOPIC_STAGES_SCALAR_INL_H_
#else
#define SCOTOPIC_STAGES_SCALAR_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "adaptation/mesopic.h"
#include "stages/shared/stage_constants.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

/// See numbers-inl.h.
template <typename Number>
struct Scalar {
  using T = Number;
  using V = Number;
  using M = bool;

  V constant(const T& x) const { return x; }
  V number(T x) const { return x; }
  V zero() const { return 0; }
  V one() const { return 1; }
  V max(V a, V b) const { return std::max(a, b); }
  V min(V a, V b) const { return std::min(a, b); }
  V abs(V x) const { return std::abs(x); }
  V sqrt(V x) const { return std::sqrt(x); }
  M less(V a, V b) const { return a < b; }
  M less_equal(V a, V b) const { return a <= b; }
  M greater(V a, V b) const { return a > b; }
  M not_equal(V a, V b) const { return a != b; }
  M both(M a, M b) const { return a && b; }
  M either(M a, M b) const { return a || b; }
  M without(M no, M yes) const { return yes && !no; }
  M never() const { return false; }
  bool none(M m) const { return !m; }
  V select(M m, V yes, V no) const { return m ? yes : no; }
  V kept(M m, V x) const { return m ? x : 0; }
  V dropped(M m, V x) const { return m ? 0 : x; }
  V exp(V x) const { return std::exp(x); }
  /// To the last digits: MES2 itself, not its fit.
  V rod_share(V local, const WeightConstants<T>&) const {
    return static_cast<T>(1 - mesopic_coefficient(static_cast<double>(local)));
  }
};

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
