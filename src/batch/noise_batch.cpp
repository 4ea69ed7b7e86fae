#include "batch/noise_batch.h"

#include <algorithm>
#include <limits>
#include <optional>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/noise_batch.cpp"
#include <hwy/foreach_target.h>
// foreach_target first: it includes this file once per target.
#include <hwy/highway.h>

#include "batch/batch_rows-inl.h"
#include "stages/noise/rod_noise-inl.h"

#ifndef SCOTOPIC_BATCH_NOISE_BATCH_CPP_
#define SCOTOPIC_BATCH_NOISE_BATCH_CPP_
namespace scotopic {

// What of the formulas is on.
struct NoiseSwitches {
  bool local, quadratic_rods;
};

// Pixels are taken so many at a time; their n, rounded to the number type, lie here meanwhile.
constexpr std::size_t pixels_at_once = 256;

}  // namespace scotopic
#endif

HWY_BEFORE_NAMESPACE();
namespace scotopic::HWY_NAMESPACE {

template <class D>
using NoiseLanes = LaneNumbers<D, RodNoiseConstants<hn::TFromD<D>>>;

template <class N, class V = typename N::V>
HWY_INLINE auto operable(const N& n, const Triple<V>& v) {
  const auto inside = [&](V x) HWY_ATTR {
    return n.less_equal(n.abs(x), n.number(typename N::T(operable_limit)));
  };
  return n.both(n.both(inside(v.x), inside(v.y)), inside(v.z));
}

template <class D>
HWY_INLINE Triple<hn::Vec<D>> load_rgb(D d, const PixelRows& rows, std::size_t at) {
  return {load(d, rows.r + at), load(d, rows.g + at), load(d, rows.b + at)};
}

template <class D>
HWY_INLINE void receive_vector(D d, const WideNumbers<RodNoiseConstants<hn::TFromD<D>>>& k,
                               const NoiseSwitches& on, const PixelRows& rows, const ReceivedRow& to,
                               std::size_t at) {
  using T = hn::TFromD<D>;
  const NoiseLanes<D> n(k);
  const auto rgb = load_rgb(d, rows, at);
  const auto y = dot(n, k.numbers.receptors.y_row, rgb);
  const auto rod = rows.rod ? n.max(n.zero(), load(d, rows.rod + at))
                            : rod_signal(n, k.numbers.receptors, rgb, y, on.quadratic_rods);
  auto local = n.constant(k.numbers.weight.adaptation);
  if (on.local) local = local + n.max(n.zero(), y * n.constant(k.numbers.weight.unit));
  const auto seen = n.both(operable(n, rgb), n.less_equal(n.abs(rod), n.number(T(operable_limit))));
  store(d, n.kept(seen, rod), to.rod + at);
  store(d, n.select(seen, local, n.number(std::numeric_limits<T>::infinity())), to.local + at);
}

template <typename T>
void receive_rows(const WideNumbers<RodNoiseConstants<T>>& k, const NoiseSwitches& on, const PixelRows& rows,
                  const ReceivedRow& to) {
  const Tag<T> d;
  std::size_t at = 0;
  for (; at + hn::Lanes(d) <= rows.count; at += hn::Lanes(d)) receive_vector(d, k, on, rows, to, at);
  if (at == rows.count) return;
  Padded<PixelRows> padded;
  padded.in(rows, at, rows.count - at);
  float rod[most_lanes], local[most_lanes];
  receive_vector(d, k, on, padded.rows, {rod, local}, 0);
  std::copy_n(rod, rows.count - at, to.rod + at);
  std::copy_n(local, rows.count - at, to.local + at);
}

// Stores what becomes of the pixels at `at`; says of each whether it changed. `field` begins there.
template <class D>
HWY_INLINE void noise_vector(D d, const WideNumbers<RodNoiseConstants<hn::TFromD<D>>>& k,
                             const PixelRows& rows, const ReceivedRow& from, const hn::TFromD<D>* field,
                             std::size_t at, std::uint8_t* touched) {
  const NoiseLanes<D> n(k);
  const auto in = load_rgb(d, rows, at);
  const auto noisy =
      rod_noise_on(n, k.numbers, in, load(d, from.rod + at), load(d, from.local + at), hn::LoadU(d, field));
  const auto seen = operable(n, in);
  const auto out = select(n, seen, noisy, in);
  store(d, out.x, rows.r + at);
  store(d, out.y, rows.g + at);
  store(d, out.z, rows.b + at);
  if (!touched) return;
  const auto differs =
      n.either(n.either(n.not_equal(out.x, in.x), n.not_equal(out.y, in.y)), n.not_equal(out.z, in.z));
  const auto changed = n.both(differs, seen);
  if (n.none(changed)) return;
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, changed, bits);
  for (std::size_t i = 0; i < hn::Lanes(d); ++i)
    touched[at + i] = static_cast<std::uint8_t>(touched[at + i] | (bits[i / 8] >> (i % 8) & 1u));
}

template <typename T>
void noise_rest(const WideNumbers<RodNoiseConstants<T>>& k, const PixelRows& rows, const ReceivedRow& from,
                const T* field, std::size_t at, std::uint8_t* touched) {
  const std::size_t count = rows.count - at;
  Padded<PixelRows> padded;
  padded.in(rows, at, count);
  float rod[most_lanes] = {}, local[most_lanes] = {};
  T n[most_lanes] = {};
  std::copy_n(from.rod + at, count, rod);
  std::copy_n(from.local + at, count, local);
  std::copy_n(field, count, n);
  std::uint8_t changed[most_lanes] = {};
  noise_vector(Tag<T>(), k, padded.rows, {rod, local}, n, 0, changed);
  padded.out(rows, at, count);
  if (touched)
    for (std::size_t i = 0; i < count; ++i)
      touched[at + i] = static_cast<std::uint8_t>(touched[at + i] | changed[i]);
}

template <typename T>
void noise_rows(const WideNumbers<RodNoiseConstants<T>>& k, const PixelRows& rows, const ReceivedRow& from,
                const double* field, std::uint8_t* touched) {
  const Tag<T> d;
  HWY_ALIGN T n[pixels_at_once];
  for (std::size_t begin = 0; begin < rows.count; begin += pixels_at_once) {
    const std::size_t end = std::min(begin + pixels_at_once, rows.count);
    for (std::size_t i = begin; i < end; ++i) n[i - begin] = static_cast<T>(field[i]);
    std::size_t at = begin;
    for (; at + hn::Lanes(d) <= end; at += hn::Lanes(d))
      noise_vector(d, k, rows, from, n + (at - begin), at, touched);
    if (at < end) noise_rest(k, rows, from, n + (at - begin), at, touched);
  }
}

void receive_single(const WideNumbers<RodNoiseConstants<float>>& k, const NoiseSwitches& on,
                    const PixelRows& rows, const ReceivedRow& to) {
  receive_rows(k, on, rows, to);
}
void receive_dual(const WideNumbers<RodNoiseConstants<double>>& k, const NoiseSwitches& on,
                  const PixelRows& rows, const ReceivedRow& to) {
  receive_rows(k, on, rows, to);
}
void noise_single(const WideNumbers<RodNoiseConstants<float>>& k, const PixelRows& rows,
                  const ReceivedRow& from, const double* field, std::uint8_t* touched) {
  noise_rows(k, rows, from, field, touched);
}
void noise_dual(const WideNumbers<RodNoiseConstants<double>>& k, const PixelRows& rows,
                const ReceivedRow& from, const double* field, std::uint8_t* touched) {
  noise_rows(k, rows, from, field, touched);
}

}  // namespace scotopic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scotopic {

HWY_EXPORT(receive_single);
HWY_EXPORT(receive_dual);
HWY_EXPORT(noise_single);
HWY_EXPORT(noise_dual);

struct NoiseBatch::Constants {
  Constants(const RodNoiseParameters& p, Precision precision)
      : on{p.eye.weight == Weight::local, p.eye.rods == RodEstimate::quadratic} {
    if (precision == Precision::single)
      single.emplace(RodNoiseConstants<float>(p));
    else
      dual.emplace(RodNoiseConstants<double>(p));
  }

  NoiseSwitches on;
  std::optional<WideNumbers<RodNoiseConstants<float>>> single;
  std::optional<WideNumbers<RodNoiseConstants<double>>> dual;
};

NoiseBatch::NoiseBatch(const RodNoiseParameters& parameters, Precision precision)
    : constants_(std::make_unique<const Constants>(parameters, precision)) {}
NoiseBatch::~NoiseBatch() = default;

void NoiseBatch::receive(const PixelRows& rows, const ReceivedRow& received) const noexcept {
  const Constants& c = *constants_;
  if (c.single)
    HWY_DYNAMIC_DISPATCH(receive_single)(*c.single, c.on, rows, received);
  else
    HWY_DYNAMIC_DISPATCH(receive_dual)(*c.dual, c.on, rows, received);
}

void NoiseBatch::apply(const PixelRows& rows, const ReceivedRow& received, const double* field,
                       std::uint8_t* touched) const noexcept {
  const Constants& c = *constants_;
  if (c.single)
    HWY_DYNAMIC_DISPATCH(noise_single)(*c.single, rows, received, field, touched);
  else
    HWY_DYNAMIC_DISPATCH(noise_dual)(*c.dual, rows, received, field, touched);
}

}  // namespace scotopic
#endif  // HWY_ONCE
