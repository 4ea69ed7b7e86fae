#include "stages/contrast/rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/contrast/rows.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#include <algorithm>

#include "stages/contrast/numbers-inl.h"
#include "stages/contrast/plane.h"
#include "stages/contrast/sensitivity.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::contrast::HWY_NAMESPACE {
namespace {

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;

HWY_INLINE int lanes() { return static_cast<int>(hn::Lanes(D())); }
HWY_INLINE V set(float x) { return hn::Set(D(), x); }

/// `count` floats of a caller's row, which may end there; the rest 0.
HWY_INLINE V load_some(const float* from, int count) {
  if (count >= lanes()) return hn::LoadU(D(), from);
  HWY_ALIGN float padded[16] = {};
  std::copy_n(from, count, padded);
  return hn::Load(D(), padded);
}
HWY_INLINE void store_some(V v, float* to, int count) {
  if (count >= lanes()) return hn::StoreU(v, D(), to);
  HWY_ALIGN float padded[16];
  hn::Store(v, D(), padded);
  std::copy_n(padded, count, to);
}

/// All of |r|, |g|, |b| <= 2^120; false for NaN.
HWY_INLINE hn::Mask<D> operable(V r, V g, V b) {
  const V limit = set(0x1p120f);
  return hn::And(hn::Le(hn::Abs(r), limit), hn::And(hn::Le(hn::Abs(g), limit), hn::Le(hn::Abs(b), limit)));
}

/// Linear between the nodes around x.
HWY_INLINE V look_up(const ExcessTable& table, V x) {
  const D d;
  const hn::RebindToSigned<D> di;
  const float last = static_cast<float>(table.values.size() - 1);
  V at = hn::Mul(hn::Sub(x, set(table.first)), set(table.per_octave));
  at = hn::Min(hn::Max(at, set(0.0f)), set(last));
  const V cell = hn::Min(hn::Floor(at), set(last - 1.0f));
  const auto index = hn::ConvertTo(di, cell);
  const V low = hn::GatherIndex(d, table.values.data(), index);
  const V high = hn::GatherIndex(d, table.values.data() + 1, index);
  return hn::Add(low, hn::Mul(hn::Sub(at, cell), hn::Sub(high, low)));
}

/// Four vectors side by side: one alone waits for its own sum.
template <int many>
HWY_INLINE void sum_at(std::span<const WeightedRow> rows, float* out, int x) {
  V sums[many];
  for (V& sum : sums) sum = set(0.0f);
  for (const WeightedRow& r : rows) {
    const V weight = set(r.weight);
    for (int i = 0; i < many; ++i)
      sums[i] = hn::Add(sums[i], hn::Mul(weight, hn::LoadU(D(), r.row + x + i * lanes())));
  }
  for (int i = 0; i < many; ++i) hn::StoreU(sums[i], D(), out + x + i * lanes());
}

template <BlurOf what>
HWY_INLINE V blur_at(const float* in) {
  const D d;
  const auto value = [&](int i) HWY_ATTR {
    const V v = hn::LoadU(d, in + i);
    return what == BlurOf::squares ? hn::Mul(v, v) : v;
  };
  V sum = hn::Mul(set(blur_taps[0]), value(0));
  for (int i = 1; i <= blur_reach; ++i)
    sum = hn::Add(sum, hn::Mul(set(blur_taps[i]), hn::Add(value(-i), value(i))));
  return sum;
}

}  // namespace

bool FillLight(const LightWeights& w, const RgbRow& in, int width, const LightRow& out) {
  const D d;
  bool all = true;
  for (int x = 0; x < width; x += lanes()) {
    const int count = width - x;
    const V r = load_some(in.r + x, count), g = load_some(in.g + x, count), b = load_some(in.b + x, count);
    const auto present = operable(r, g, b);
    const V sum = hn::Add(hn::Add(hn::Mul(set(w.r), r), hn::Mul(set(w.g), g)), hn::Mul(set(w.b), b));
    // Light of 2^100 times the adaptation luminance is bright enough.
    const V light = hn::Min(hn::Add(hn::Max(sum, set(0.0f)), set(darkest)), set(0x1p100f));
    hn::StoreU(hn::IfThenElseZero(present, light), d, out.light + x);
    hn::StoreU(hn::IfThenElseZero(present, log2_of(d, light)), d, out.log + x);
    hn::StoreU(hn::IfThenElseZero(present, set(1.0f)), d, out.present + x);
    all &= hn::AllTrue(d, present);
  }
  return all;
}

void Log(float* row, int width) {
  const D d;
  for (int x = 0; x < width; x += lanes()) {
    const V v = hn::LoadU(d, row + x);
    hn::StoreU(hn::IfThenElseZero(hn::Gt(v, set(0.0f)), log2_of(d, hn::Max(v, set(1e-30f)))), d, row + x);
  }
}

void SumRows(std::span<const WeightedRow> rows, float* HWY_RESTRICT out, int width) {
  constexpr int many = 4;
  int x = 0;
  for (; x + many * lanes() <= width; x += many * lanes()) sum_at<many>(rows, out, x);
  for (; x < width; x += lanes()) sum_at<1>(rows, out, x);
}

void Halve(const float* HWY_RESTRICT in, float* HWY_RESTRICT out, int width) {
  const D d;
  for (int x = 0; x < width; x += lanes()) {
    V even[3], odd[3];  // samples 2x - 2, 2x - 1; 2x, 2x + 1; 2x + 2, ...
    for (int i = 0; i < 3; ++i) hn::LoadInterleaved2(d, in + 2 * (x + i - 1), even[i], odd[i]);
    V sum = hn::Mul(set(6.0f), even[1]);
    sum = hn::Add(sum, hn::Mul(set(4.0f), hn::Add(odd[0], odd[1])));
    sum = hn::Add(sum, hn::Add(even[0], even[2]));
    hn::StoreU(hn::Mul(sum, set(1.0f / 16)), d, out + x);
  }
}

void Double(const float* HWY_RESTRICT in, float* HWY_RESTRICT out, int width) {
  const D d;
  for (int i = 0; 2 * i < width; i += lanes()) {
    const V a = hn::LoadU(d, in + i - 1), b = hn::LoadU(d, in + i), c = hn::LoadU(d, in + i + 1);
    const V even = hn::Mul(hn::Add(hn::Mul(set(6.0f), b), hn::Add(a, c)), set(0.125f));
    hn::StoreInterleaved2(even, hn::Mul(hn::Add(b, c), set(0.5f)), d, out + 2 * i);
  }
}

void Blur(BlurOf what, const float* HWY_RESTRICT in, float* HWY_RESTRICT out, int width) {
  for (int x = 0; x < width; x += lanes()) {
    const V sum =
        what == BlurOf::squares ? blur_at<BlurOf::squares>(in + x) : blur_at<BlurOf::values>(in + x);
    hn::StoreU(sum, D(), out + x);
  }
}

void Divide(float* HWY_RESTRICT row, const float* HWY_RESTRICT weight, float scale, int width) {
  const D d;
  for (int x = 0; x < width; x += lanes()) {
    const V by = hn::Mul(hn::LoadU(d, weight + x), set(scale));
    const auto some = hn::Gt(by, set(0.0f));
    const V ratio = hn::Div(hn::LoadU(d, row + x), hn::IfThenElse(some, by, set(1.0f)));
    hn::StoreU(hn::IfThenElseZero(some, ratio), d, row + x);
  }
}

void Mark(const float* weight, float* out, int width) {
  const D d;
  for (int x = 0; x < width; x += lanes())
    hn::StoreU(hn::IfThenElseZero(hn::Gt(hn::LoadU(d, weight + x), set(0.0f)), set(1.0f)), d, out + x);
}

void Subtract(const float* a, const float* b, float* out, int width) {
  const D d;
  for (int x = 0; x < width; x += lanes())
    hn::StoreU(hn::Sub(hn::LoadU(d, a + x), hn::LoadU(d, b + x)), d, out + x);
}

void Multiply(float* row, const float* by, int width) {
  const D d;
  for (int x = 0; x < width; x += lanes())
    hn::StoreU(hn::Mul(hn::LoadU(d, row + x), hn::LoadU(d, by + x)), d, row + x);
}

void Fade(const ExcessTable& excess, const FadeRow& row, int width) {
  const D d;
  const float least = static_cast<float>(least_contrast * log2_of_10);
  for (int x = 0; x < width; x += lanes()) {
    const V band = hn::LoadU(d, row.band + x);
    const V local = hn::Sqrt(hn::LoadU(d, row.variance + x));
    const V contrast = hn::Max(local, hn::Mul(band, set(0.70710678f)));
    const V room = hn::Max(hn::Sub(contrast, set(least)), set(0.0f));
    const V lost = hn::Min(look_up(excess, hn::LoadU(d, row.surround + x)), room);
    const V fade = hn::Div(hn::Mul(band, lost), hn::Max(contrast, set(least)));
    hn::StoreU(hn::Sub(hn::LoadU(d, row.change + x), fade), d, row.change + x);
  }
}

void Apply(const Applied& applied, const float* change, const float* present, const RgbRow& in,
           const RgbOut& out, int width) {
  const D d;
  const V one = set(1.0f);
  for (int x = 0; x < width; x += lanes()) {
    const V c = hn::LoadU(d, change + x);
    auto changed = hn::Ne(c, set(0.0f));
    if (present) changed = hn::And(changed, hn::Gt(hn::LoadU(d, present + x), set(0.0f)));
    const V more = hn::Mul(set(applied.strength), hn::Sub(exp2_of(d, c), one));
    const auto brighter = hn::Gt(more, set(0.0f));
    const auto scale = [&](const float* from, float* to) HWY_ATTR {
      const V v = load_some(from + x, width - x);
      const V light = hn::Add(hn::Max(v, set(0.0f)), set(applied.black));
      const V to_add = hn::Mul(more, hn::IfThenElse(brighter, light, v));
      store_some(hn::IfThenElse(changed, hn::Add(v, to_add), v), to + x, width - x);
    };
    scale(in.r, out.r);
    scale(in.g, out.g);
    scale(in.b, out.b);
  }
}

}  // namespace scotopic::contrast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scotopic::contrast {
HWY_EXPORT(FillLight);
HWY_EXPORT(Log);
HWY_EXPORT(SumRows);
HWY_EXPORT(Halve);
HWY_EXPORT(Double);
HWY_EXPORT(Blur);
HWY_EXPORT(Divide);
HWY_EXPORT(Mark);
HWY_EXPORT(Subtract);
HWY_EXPORT(Multiply);
HWY_EXPORT(Fade);
HWY_EXPORT(Apply);

void end_row(float* row, int width) { std::fill_n(row + width, 32, 0.0f); }

bool light_row(const LightWeights& weights, const RgbRow& in, int width, const LightRow& out) {
  const bool all = HWY_DYNAMIC_DISPATCH(FillLight)(weights, in, width, out);
  for (float* row : {out.light, out.log, out.present}) end_row(row, width);
  return all;
}
void log_row(float* row, int width) { HWY_DYNAMIC_DISPATCH(Log)(row, width); }
void sum_rows(std::span<const WeightedRow> rows, float* out, int width) {
  HWY_DYNAMIC_DISPATCH(SumRows)(rows, out, width);
  end_row(out, width);
}
void halve_row(const float* in, float* out, int width) {
  HWY_DYNAMIC_DISPATCH(Halve)(in, out, width);
  end_row(out, width);
}
void double_row(const float* in, float* out, int width) {
  HWY_DYNAMIC_DISPATCH(Double)(in, out, width);
  end_row(out, width);
}
void blur_row(BlurOf what, const float* in, float* out, int width) {
  HWY_DYNAMIC_DISPATCH(Blur)(what, in, out, width);
  end_row(out, width);
}
void divide_row(float* row, const float* weight, float scale, int width) {
  HWY_DYNAMIC_DISPATCH(Divide)(row, weight, scale, width);
}
void mark_row(const float* weight, float* out, int width) {
  HWY_DYNAMIC_DISPATCH(Mark)(weight, out, width);
  end_row(out, width);
}
void subtract_row(const float* a, const float* b, float* out, int width) {
  HWY_DYNAMIC_DISPATCH(Subtract)(a, b, out, width);
  end_row(out, width);
}
void multiply_row(float* row, const float* by, int width) { HWY_DYNAMIC_DISPATCH(Multiply)(row, by, width); }
void fade_row(const ExcessTable& excess, const FadeRow& row, int width) {
  HWY_DYNAMIC_DISPATCH(Fade)(excess, row, width);
  end_row(row.change, width);
}
void apply_row(const Applied& applied, const float* change, const float* present, const RgbRow& in,
               const RgbOut& out, int width) {
  HWY_DYNAMIC_DISPATCH(Apply)(applied, change, present, in, out, width);
}

}  // namespace scotopic::contrast
#endif
