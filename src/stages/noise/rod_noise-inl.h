// The formula of stage `noise`; rod_noise.h says what it is.
#if defined(SCOTOPIC_STAGES_ROD_NOISE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SCOTOPIC_STAGES_ROD_NOISE_INL_H_
#undef SCOTOPIC_STAGES_ROD_NOISE_INL_H_
#else
#define SCOTOPIC_STAGES_ROD_NOISE_INL_H_
#endif

#include <hwy/highway.h>

#include "stages/noise/rod_noise.h"
#include "stages/shared/numbers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

/// v, where it is above 0.
template <class N, class V = typename N::V>
HWY_INLINE V rod_variance(const N& n, const RodNoiseConstants<typename N::T>& k, V scotopic) {
  const V mean = scotopic + n.constant(k.dark);
  const V seen = n.max(scotopic, n.constant(k.adapted)) + n.constant(k.dark);
  return mean * n.constant(k.quantum) - (n.constant(k.hidden_square) * seen) * seen;
}

/// S' - S for v > 0: b (n^2 - 1) + 2 n sqrt(b (mu - b)), which cancels nothing.
template <class N, class V = typename N::V>
HWY_INLINE V rod_fluctuation(const N& n, const RodNoiseConstants<typename N::T>& k, V scotopic, V variance,
                             V field) {
  const V mean = scotopic + n.constant(k.dark);
  const V square = mean * mean;
  const V half = n.min(variance * n.number(typename N::T(0.5)), square);
  const V b = half / (mean + n.sqrt(square - half));
  const V root = n.sqrt(b);
  const V carrier = n.sqrt(mean - b);
  const V change = root * (((carrier + carrier) * field) + root * (field * field - n.one()));
  return n.max(change, n.zero() - scotopic);
}

/// Light of the pixel by dY: added as white, taken away at constant chromaticity.
template <class N, class V = typename N::V>
HWY_INLINE Triple<V> relit(const N& n, const Triple<V>& rgb, V y, V change) {
  const V factor = n.max(n.zero(), n.one() + change / positive_or_one(n, y));
  const Triple<V> darker = select(n, n.greater(y, n.zero()), factor * rgb, rgb);
  const Triple<V> lighter = {rgb.x + change, rgb.y + change, rgb.z + change};
  return select(n, n.less(change, n.zero()), darker, lighter);
}

/// The stage on one finite pixel.
template <class N, class V = typename N::V>
HWY_INLINE Triple<V> rod_noise_on(const N& n, const RodNoiseConstants<typename N::T>& k, const Triple<V>& rgb,
                                  V rod, V local, V field) {
  const V scotopic = n.max(n.zero(), rod) * n.constant(k.scotopic_per_rod);
  const V variance = rod_variance(n, k, scotopic);
  const auto noisy =
      n.both(n.greater(variance, n.zero()), n.less(local, n.constant(k.weight.photopic_limit)));
  if (n.none(noisy)) return rgb;
  const V share = n.rod_share(local, k.weight);
  const V weight = share / ((n.one() - share) + share * n.constant(k.rods_weight));
  const V change = n.constant(k.change) * (weight * rod_fluctuation(n, k, scotopic, variance, field));
  return select(n, noisy, relit(n, rgb, dot(n, k.receptors.y_row, rgb), change), rgb);
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
