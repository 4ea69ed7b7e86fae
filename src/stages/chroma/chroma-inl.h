// Stage `chroma`: towards the white of the same Y, by s(Lloc)/s(5), s(L) = L/(L + .108) (Wanat & Mantiuk
// 2014).
#if defined(SCOTOPIC_STAGES_CHROMA_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_STAGES_CHROMA_INL_H_
#undef SCOTOPIC_STAGES_CHROMA_INL_H_
#else
#define SCOTOPIC_STAGES_CHROMA_INL_H_
#endif

#include <hwy/highway.h>

#include "stages/shared/pixel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

/// The stage.
template <class N, class V = typename N::V>
HWY_INLINE void chroma(const N& n, const ChromaConstants<typename N::T>& k,
                       const ReceptorConstants<typename N::T>& receptors, PixelState<V>& s) {
  const V factor = (s.local / (s.local + n.constant(k.half))) * n.constant(k.at_5);
  const V keep = n.one() - n.constant(k.strength) * (n.one() - n.min(n.one(), factor));
  const V y = dot(n, receptors.y_row, s.rgb);
  const Triple<V> grey = {y, y, y};
  const Triple<V> faded = grey + keep * (s.rgb - grey);
  s.rgb = select(n, n.less(keep, n.one()), faded, s.rgb);
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
