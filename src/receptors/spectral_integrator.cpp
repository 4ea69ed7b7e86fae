#include "receptors/spectral_integrator.h"

#include <algorithm>
#include <cmath>
#include <cstring>

// Compiled once per instruction set: Highway includes this file again for each, and picks one at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "receptors/spectral_integrator.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// Bands summed in registers before the sums go to memory: few enough streams for the prefetcher, and in
// single precision short sums, which round less than one long one.
constexpr std::size_t group_bands = 8;
// Pixels whose sums (at most 112 KiB, on the stack) stay in the second-level cache while the bands go by.
// Longer runs of one band please the prefetcher: 256 pixels cost 1.6 times as much, 512 1.3 times.
constexpr std::size_t block_pixels = 2048;

template <class D>
hn::Vec<D> load(D d, const float* from) {
  if constexpr (sizeof(hn::TFromD<D>) == sizeof(float)) {
    return hn::LoadU(d, from);
  } else {
    return hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, D>(), from));
  }
}

// binary16 to binary32, exact. Highway's own conversion for targets without an instruction for it takes Inf
// and NaN for numbers. Scaling by 2^112 moves the exponent's bias; subnormals come out right by themselves.
template <class DF>
hn::Vec<DF> float_from_half(DF df, const hwy::float16_t* from) {
#if HWY_TARGET <= HWY_AVX2
  return hn::PromoteTo(df, hn::LoadU(hn::Rebind<hwy::float16_t, DF>(), from));
#else
  const hn::RebindToUnsigned<DF> du;
  const hn::Rebind<std::uint16_t, DF> dh;
  const auto bits = hn::PromoteTo(du, hn::LoadU(dh, reinterpret_cast<const std::uint16_t*>(from)));
  const auto magnitude = hn::And(bits, hn::Set(du, 0x7fffu));
  const auto scaled = hn::Mul(hn::BitCast(df, hn::ShiftLeft<13>(magnitude)), hn::Set(df, 0x1p112f));
  const auto broken = hn::Gt(magnitude, hn::Set(du, 0x7bffu));
  const auto exponent = hn::IfThenElseZero(broken, hn::Set(du, 0x7f800000u));
  const auto sign = hn::ShiftLeft<16>(hn::AndNot(hn::Set(du, 0x7fffu), bits));
  return hn::BitCast(df, hn::Or(hn::BitCast(du, scaled), hn::Or(exponent, sign)));
#endif
}

template <class D>
hn::Vec<D> load(D d, const hwy::float16_t* from) {
  const hn::Rebind<float, D> df;
  const auto value = float_from_half(df, from);
  if constexpr (sizeof(hn::TFromD<D>) == sizeof(float)) {
    return value;
  } else {
    return hn::PromoteTo(d, value);
  }
}

// float: unfused, the same on every machine. double: the product is exact, so fusing changes nothing.
template <class V>
V multiply_add(V a, V b, V sum) {
  if constexpr (sizeof(hn::TFromV<V>) == sizeof(float)) {
    return hn::Add(hn::Mul(a, b), sum);
  } else {
    return hn::MulAdd(a, b, sum);
  }
}

template <class D, std::size_t kSignals>
class Block {
  using T = hn::TFromD<D>;
  using V = hn::Vec<D>;

 public:
  // Adds `kBands` bands to the sums of `count` pixels, a multiple of the vector's length.
  template <std::size_t kBands, typename Value>
  void add(const Value* HWY_RESTRICT bands, std::size_t stride, std::size_t count,
           const T* HWY_RESTRICT weights) {
    for (std::size_t i = 0; i < count; i += hn::Lanes(d_)) {
      V partial[kSignals];
      const V first = load(d_, bands + i);
      for (std::size_t s = 0; s < kSignals; ++s) partial[s] = hn::Mul(first, hn::Set(d_, weights[s]));
      for (std::size_t b = 1; b < kBands; ++b) {
        const V value = load(d_, bands + b * stride + i);
        for (std::size_t s = 0; s < kSignals; ++s)
          partial[s] = multiply_add(value, hn::Set(d_, weights[b * signal_count + s]), partial[s]);
      }
      for (std::size_t s = 0; s < kSignals; ++s) {
        T* const sum = sums_ + s * block_pixels + i;
        hn::Store(hn::Add(hn::Load(d_, sum), partial[s]), d_, sum);
      }
    }
  }

  void clear() { std::fill_n(sums_, kSignals * block_pixels, T(0)); }

  void write(std::size_t first, std::size_t count, const SignalRows& out) const {
    for (std::size_t s = 0; s < kSignals; ++s)
      for (std::size_t i = 0; i < count; ++i)
        out[s][first + i] = static_cast<float>(sums_[s * block_pixels + i]);
  }

 private:
  D d_;
  HWY_ALIGN T sums_[kSignals * block_pixels];
};

template <class D, std::size_t kSignals, typename Value>
class Row {
  using T = hn::TFromD<D>;

 public:
  Row(const T* weights, std::size_t bands, const Value* values, std::size_t stride, const SignalRows& out)
      : weights_(weights), bands_(bands), values_(values), stride_(stride), out_(out) {}

  void run(std::size_t count) {
    const std::size_t lanes = hn::Lanes(D());
    const std::size_t whole = count - count % lanes;
    for (std::size_t first = 0; first < whole; first += block_pixels) {
      const std::size_t pixels = std::min(block_pixels, whole - first);
      sum_up(pixels, [&](std::size_t band, std::size_t) {
        return Source{values_ + band * stride_ + first, stride_};
      });
      block_.write(first, pixels, out_);
    }
    if (whole < count) run_tail(whole, count - whole);
  }

 private:
  struct Source {
    const Value* values;
    std::size_t stride;
  };

  // The last few pixels, copied out so that no load passes the end of the caller's rows.
  void run_tail(std::size_t first, std::size_t count) {
    HWY_ALIGN Value copy[group_bands * hn::MaxLanes(D())] = {};
    const std::size_t lanes = hn::Lanes(D());
    sum_up(lanes, [&](std::size_t band, std::size_t bands) {
      for (std::size_t b = 0; b < bands; ++b)
        std::copy_n(values_ + (band + b) * stride_ + first, count, copy + b * lanes);
      return Source{copy, lanes};
    });
    block_.write(first, count, out_);
  }

  template <typename SourceOf>
  void sum_up(std::size_t pixels, const SourceOf& source_of) {
    block_.clear();
    std::size_t band = 0;
    for (; band + group_bands <= bands_; band += group_bands) add<group_bands>(band, pixels, source_of);
    for (; band < bands_; ++band) add<1>(band, pixels, source_of);
  }

  template <std::size_t kBands, typename SourceOf>
  void add(std::size_t band, std::size_t pixels, const SourceOf& source_of) {
    const Source source = source_of(band, kBands);
    block_.template add<kBands>(source.values, source.stride, pixels, weights_ + band * signal_count);
  }

  const T* weights_;
  std::size_t bands_;
  const Value* values_;
  std::size_t stride_;
  const SignalRows& out_;
  Block<D, kSignals> block_;
};

template <typename T, typename Value>
void run(const T* weights, std::size_t bands, const Value* values, std::size_t stride, std::size_t count,
         const SignalRows& out) {
  using D = hn::ScalableTag<T>;
  if (out[index(Signal::x)] == nullptr) {
    Row<D, index(Signal::x), Value>(weights, bands, values, stride, out).run(count);
  } else {
    Row<D, signal_count, Value>(weights, bands, values, stride, out).run(count);
  }
}

template <typename Value>
void run(const SpectralIntegrator::Weights& w, const Value* values, std::size_t stride, std::size_t count,
         const SignalRows& out) {
  if (w.accumulation == Accumulation::single) {
    run(w.single.data(), w.bands, values, stride, count, out);
  } else {
    run(w.dual.data(), w.bands, values, stride, count, out);
  }
}

}  // namespace

void IntegrateFloat(const SpectralIntegrator::Weights& w, const float* values, std::size_t stride,
                    std::size_t count, const SignalRows& out) {
  run(w, values, stride, count, out);
}

void IntegrateHalf(const SpectralIntegrator::Weights& w, const std::uint16_t* values, std::size_t stride,
                   std::size_t count, const SignalRows& out) {
  run(w, reinterpret_cast<const hwy::float16_t*>(values), stride, count, out);
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scotopic {
namespace {

HWY_EXPORT(IntegrateFloat);
HWY_EXPORT(IntegrateHalf);

double rounded_to_29_bits(double value) {
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(fraction, 29)), exponent - 29);
}

}  // namespace

SpectralIntegrator::SpectralIntegrator(const SpectralWeights& weights, Accumulation accumulation) {
  weights_.bands = weights.of[0].size();
  weights_.accumulation = accumulation;
  for (std::size_t band = 0; band < weights_.bands; ++band)
    for (const Signal signal : all_signals) {
      const double weight = weights.of[index(signal)][band];
      weights_.single.push_back(static_cast<float>(weight));
      weights_.dual.push_back(rounded_to_29_bits(weight));
    }
}

void SpectralIntegrator::integrate(const float* bands, std::size_t stride, std::size_t count,
                                   const SignalRows& out) const noexcept {
  HWY_DYNAMIC_DISPATCH(IntegrateFloat)(weights_, bands, stride, count, out);
}

void SpectralIntegrator::integrate_half(const std::uint16_t* bands, std::size_t stride, std::size_t count,
                                        const SignalRows& out) const noexcept {
  HWY_DYNAMIC_DISPATCH(IntegrateHalf)(weights_, bands, stride, count, out);
}

std::vector<bool> weighed_bands(const SpectralWeights& weights) {
  std::vector<bool> weighed(weights.of[0].size(), false);
  for (const std::vector<double>& of : weights.of)
    for (std::size_t band = 0; band < of.size(); ++band)
      if (of[band] != 0.0) weighed[band] = true;
  return weighed;
}

}  // namespace scotopic
#endif  // HWY_ONCE
