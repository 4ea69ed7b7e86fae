#include "stages/glare/pyramid/rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/glare/pyramid/rows.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <algorithm>
#include <cstdlib>
#include <new>

HWY_BEFORE_NAMESPACE();
namespace scotopic::glare::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;

HWY_INLINE int lanes() { return static_cast<int>(hn::Lanes(D())); }

/// weight (a + b) + sum
HWY_INLINE V add_pair(V sum, V weight, V a, V b) { return hn::Add(sum, hn::Mul(weight, hn::Add(a, b))); }

/// ([1 4 6 4 1] of what stands from left to right)/16
HWY_INLINE V binomial(V a, V b, V c, V d, V e) {
  const D f;
  const V sum =
      add_pair(add_pair(hn::Mul(hn::Set(f, 6.0f), c), hn::Set(f, 4.0f), b, d), hn::Set(f, 1.0f), a, e);
  return hn::Mul(sum, hn::Set(f, 1.0f / 16));
}

HWY_INLINE V doubled_even(V a, V b, V c) {
  const D f;
  return hn::Mul(hn::Add(hn::Mul(hn::Set(f, 6.0f), b), hn::Add(a, c)), hn::Set(f, 0.125f));
}
HWY_INLINE V doubled_odd(V b, V c) { return hn::Mul(hn::Add(b, c), hn::Set(D(), 0.5f)); }

}  // namespace

void HalveColumns(const float* const (&rows)[5], float* HWY_RESTRICT out, int width) {
  const D d;
  const int end = static_cast<int>(row_floats(width)) - before;
  for (int x = -before; x < end; x += lanes()) {
    V v[5];
    for (int i = 0; i < 5; ++i) v[i] = hn::Load(d, rows[i] + x);
    hn::Store(binomial(v[0], v[1], v[2], v[3], v[4]), d, out + x);
  }
}

void HalveRow(const float* HWY_RESTRICT in, float* HWY_RESTRICT out, int begin, int end) {
  const D d;
  for (int k = begin; k < end; k += lanes()) {
    V even[3], odd[3];  // samples 2k - 2, 2k - 1; 2k, 2k + 1; 2k + 2, ...
    for (int i = 0; i < 3; ++i) hn::LoadInterleaved2(d, in + 2 * (k + i - 1), even[i], odd[i]);
    hn::StoreU(binomial(even[0], odd[0], even[1], odd[1], even[2]), d, out + k);
  }
}

void DoubleColumns(const float* const (&rows)[3], bool odd, float* HWY_RESTRICT out, int width) {
  const D d;
  const int end = static_cast<int>(row_floats(width)) - before;
  for (int x = -before; x < end; x += lanes()) {
    const V a = hn::Load(d, rows[0] + x), b = hn::Load(d, rows[1] + x);
    hn::Store(odd ? doubled_odd(a, b) : doubled_even(a, b, hn::Load(d, rows[2] + x)), d, out + x);
  }
}

void DoubleRow(const float* HWY_RESTRICT in, float* HWY_RESTRICT out, int begin, int end) {
  const D d;
  for (int k = begin >> 1; 2 * k < end; k += lanes()) {
    const V a = hn::LoadU(d, in + k - 1), b = hn::LoadU(d, in + k), c = hn::LoadU(d, in + k + 1);
    hn::StoreInterleaved2(doubled_even(a, b, c), doubled_odd(b, c), d, out + 2 * k);
  }
}

namespace {

constexpr int wide = 2;  // vectors side by side: one alone waits for its own sums

/// The pairs from `pair` on of the `rungs` widest rungs, then of those narrower left out: `taps[r][pair]`.
template <int rungs>
HWY_INLINE void add_column_pairs(const float* const* rows, int reach, const float* const (&taps)[most_rungs],
                                 const int (&reaches)[most_rungs], int& pair, int x,
                                 V (&sums)[most_rungs][wide]) {
  const D d;
  // Pairs from the outermost inwards: a narrower rung joins where its reach begins.
  for (; pair > (rungs < most_rungs ? reaches[rungs] : 0); --pair) {
    V both[wide];
    for (int i = 0; i < wide; ++i)
      both[i] = hn::Add(hn::Load(d, rows[reach - pair] + x + i * lanes()),
                        hn::Load(d, rows[reach + pair] + x + i * lanes()));
    for (int r = 0; r < rungs; ++r) {
      const V tap = hn::Set(d, taps[r][pair]);
      for (int i = 0; i < wide; ++i) sums[r][i] = hn::Add(sums[r][i], hn::Mul(tap, both[i]));
    }
  }
}

template <int rungs>
void blur_columns_of(const Level& level, const float* const* rows, float* const* out, int begin, int end) {
  const D d;
  const float* taps[most_rungs] = {};
  int reaches[most_rungs] = {};
  for (std::size_t r = 0; r < rungs; ++r) {
    taps[r] = level.rungs[r].y.data();
    reaches[r] = static_cast<int>(level.rungs[r].y.size()) - 1;
  }
  const int reach = reaches[0];
  for (int x = begin; x < end; x += wide * lanes()) {
    V sums[most_rungs][wide];
    for (int r = 0; r < rungs; ++r)
      for (int i = 0; i < wide; ++i)
        sums[r][i] = hn::Mul(hn::Set(d, taps[r][0]), hn::Load(d, rows[reach] + x + i * lanes()));
    int pair = reach;
    add_column_pairs<1>(rows, reach, taps, reaches, pair, x, sums);
    if constexpr (rungs > 1) add_column_pairs<2>(rows, reach, taps, reaches, pair, x, sums);
    if constexpr (rungs > 2) add_column_pairs<3>(rows, reach, taps, reaches, pair, x, sums);
    if constexpr (rungs > 3) add_column_pairs<4>(rows, reach, taps, reaches, pair, x, sums);
    if constexpr (rungs > 4) add_column_pairs<5>(rows, reach, taps, reaches, pair, x, sums);
    for (int r = 0; r < rungs; ++r)
      for (int i = 0; i < wide; ++i) hn::Store(sums[r][i], d, out[r] + x + i * lanes());
  }
}

/// `many` vectors from x on.
template <int many>
HWY_INLINE void blur_row_add_at(const Level& level, const float* const* in, float* out, int x) {
  const D d;
  V sums[many];
  for (int i = 0; i < many; ++i) sums[i] = hn::LoadU(d, out + x + i * lanes());
  for (std::size_t r = 0; r < level.rungs.size(); ++r) {
    const HalfTaps& taps = level.rungs[r].x;
    const V middle = hn::Set(d, taps[0]);
    for (int i = 0; i < many; ++i)
      sums[i] = hn::Add(sums[i], hn::Mul(middle, hn::LoadU(d, in[r] + x + i * lanes())));
    for (int pair = 1; pair < static_cast<int>(taps.size()); ++pair) {
      const V tap = hn::Set(d, taps[static_cast<std::size_t>(pair)]);
      for (int i = 0; i < many; ++i) {
        const float* const at = in[r] + x + i * lanes();
        sums[i] = add_pair(sums[i], tap, hn::LoadU(d, at - pair), hn::LoadU(d, at + pair));
      }
    }
  }
  for (int i = 0; i < many; ++i) hn::StoreU(sums[i], d, out + x + i * lanes());
}

}  // namespace

void BlurColumns(const Level& level, const float* const* rows, float* const* out, int begin, int end) {
  switch (level.rungs.size()) {
    case 1:
      return blur_columns_of<1>(level, rows, out, begin, end);
    case 4:
      return blur_columns_of<4>(level, rows, out, begin, end);
    default:
      return blur_columns_of<5>(level, rows, out, begin, end);
  }
}

void BlurRowAdd(const Level& level, const float* const* in, float* out, int begin, int end) {
  constexpr int many = 4;
  int x = begin;
  for (; x + many * lanes() <= end; x += many * lanes()) blur_row_add_at<many>(level, in, out, x);
  for (; x < end; x += lanes()) blur_row_add_at<1>(level, in, out, x);
}

namespace {

/// `many` vectors from x on.
template <int many>
HWY_INLINE void correlate_add_at(const float* in, const std::vector<float>& weights, float* out, int x) {
  const D d;
  V sums[many];
  for (int i = 0; i < many; ++i) sums[i] = hn::LoadU(d, out + x + i * lanes());
  const float* at = in + x;
  for (const float weight : weights) {
    const V w = hn::Set(d, weight);
    for (int i = 0; i < many; ++i) sums[i] = hn::Add(sums[i], hn::Mul(w, hn::LoadU(d, at + i * lanes())));
    ++at;
  }
  for (int i = 0; i < many; ++i) hn::StoreU(sums[i], d, out + x + i * lanes());
}

}  // namespace

void CorrelateAdd(const float* in, const std::vector<float>& weights, float* out, int begin, int end) {
  constexpr int many = 4;
  int x = begin;
  for (; x + many * lanes() <= end; x += many * lanes()) correlate_add_at<many>(in, weights, out, x);
  for (; x < end; x += lanes()) correlate_add_at<1>(in, weights, out, x);
}

void AddScaled(const float* row, float weight, float* out, int width) {
  const D d;
  const V w = hn::Set(d, weight);
  for (int x = 0; x < width; x += lanes())
    hn::Store(hn::Add(hn::Load(d, out + x), hn::Mul(w, hn::Load(d, row + x))), d, out + x);
}

}  // namespace scotopic::glare::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scotopic::glare {
HWY_EXPORT(HalveColumns);
HWY_EXPORT(HalveRow);
HWY_EXPORT(DoubleColumns);
HWY_EXPORT(DoubleRow);
HWY_EXPORT(BlurColumns);
HWY_EXPORT(BlurRowAdd);
HWY_EXPORT(CorrelateAdd);
HWY_EXPORT(AddScaled);

namespace {

constexpr std::size_t huge_page = std::size_t{1} << 21;

/// Pages of 2 MiB where there is room for some: faults on small ones would take a fifth of the time.
float* allocated(std::size_t bytes) {
  const std::size_t unit = bytes >= 2 * huge_page ? huge_page : 64;
  void* const memory = std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit);
  if (memory == nullptr) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  if (unit == huge_page)
    madvise(memory, (bytes + unit - 1) / unit * unit, MADV_HUGEPAGE);  // a hint: may fail
#endif
  return static_cast<float*>(memory);
}

}  // namespace

void Rows::Free::operator()(float* floats) const { std::free(floats); }

Rows::Rows(int width, std::ptrdiff_t count) : stride_(row_floats(width)) {
  floats_.reset(allocated(static_cast<std::size_t>(stride_ * count) * sizeof(float)));
  std::fill_n(floats_.get(), stride_, 0.0f);
}

void finish_row(float* row, int width, int begin, int end, GlareSides sides) {
  float* const last = row - before + row_floats(width);
  if (sides == GlareSides::end) {
    std::fill(row - before, row + begin, 0.0f);
    std::fill(row + end, last, 0.0f);
    return;
  }
  for (int i = 1; i <= before; ++i) row[-i] = row[(width - i % width) % width];
  for (float* at = row + width; at < last; ++at) *at = at[-width];
}

void halve_columns(const float* const (&rows)[5], float* out, int width) {
  HWY_DYNAMIC_DISPATCH(HalveColumns)(rows, out, width);
}
void halve_row(const float* in, float* out, int begin, int end) {
  HWY_DYNAMIC_DISPATCH(HalveRow)(in, out, begin, end);
}
void double_columns(const float* const (&rows)[3], bool odd, float* out, int width) {
  HWY_DYNAMIC_DISPATCH(DoubleColumns)(rows, odd, out, width);
}
void double_row(const float* in, float* out, int begin, int end) {
  HWY_DYNAMIC_DISPATCH(DoubleRow)(in, out, begin, end);
}
void blur_columns(const Level& level, const float* const* rows, float* const* out, int begin, int end) {
  HWY_DYNAMIC_DISPATCH(BlurColumns)(level, rows, out, begin, end);
}
void blur_row_add(const Level& level, const float* const* in, float* out, int begin, int end) {
  HWY_DYNAMIC_DISPATCH(BlurRowAdd)(level, in, out, begin, end);
}
void correlate_add(const float* in, const std::vector<float>& weights, float* out, int begin, int end) {
  HWY_DYNAMIC_DISPATCH(CorrelateAdd)(in, weights, out, begin, end);
}
void add_scaled(const float* row, float weight, float* out, int width) {
  HWY_DYNAMIC_DISPATCH(AddScaled)(row, weight, out, width);
}
}  // namespace scotopic::glare
#endif
