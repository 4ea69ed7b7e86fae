// Filters from the pixels themselves: every one within reach, a row of lanes at a time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/acuity/window_filter.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "stages/acuity/engines.h"
#include "stages/acuity/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scotopic::acuity::HWY_NAMESPACE {
namespace {

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;

/// As many vectors as are worked on side by side: one alone waits for its own long chain of results. Two need
/// the 32 registers of AVX-512.
#if HWY_TARGET <= HWY_AVX3
struct Wide {
  V a, b;
};
constexpr int ways = 2;
/// f of each vector of each argument in turn.
template <class F, class... W>
HWY_INLINE Wide each(F f, const W&... w) {
  return {f(w.a...), f(w.b...)};
}
/// f(i) of the place of each vector.
template <class F>
HWY_INLINE Wide from_place(F f) {
  return {f(0), f(1)};
}
#else
struct Wide {
  V a;
};
constexpr int ways = 1;
template <class F, class... W>
HWY_INLINE Wide each(F f, const W&... w) {
  return {f(w.a...)};
}
template <class F>
HWY_INLINE Wide from_place(F f) {
  return {f(0)};
}
#endif

HWY_INLINE Wide sub(Wide a, Wide b) {
  return each([](V x, V y) HWY_ATTR { return hn::Sub(x, y); }, a, b);
}
HWY_INLINE Wide add(Wide a, Wide b) {
  return each([](V x, V y) HWY_ATTR { return hn::Add(x, y); }, a, b);
}
HWY_INLINE Wide mul_add(Wide a, Wide b, Wide c) {
  return each([](V x, V y, V z) HWY_ATTR { return hn::MulAdd(x, y, z); }, a, b, c);
}
HWY_INLINE Wide less_square(Wide a, Wide c) {
  return each([](V x, V z) HWY_ATTR { return hn::NegMulAdd(x, x, z); }, a, c);
}

/// A pixel of the disc: where it lies from the middle, in floats, and what is left of u at its distance.
struct Tap {
  std::ptrdiff_t offset;
  float u;
};

std::vector<Tap> disc(const Constants& c, std::ptrdiff_t row_stride) {
  std::vector<Tap> taps;
  const double aspect = static_cast<double>(c.pixel_aspect);
  const int across = static_cast<int>(c.radius), down = static_cast<int>(c.radius * aspect);
  for (int dy = -down; dy <= down; ++dy)
    for (int dx = -across; dx <= across; ++dx) {
      const double square = dx * dx + dy * dy / (aspect * aspect);
      if (square <= c.radius * c.radius)
        taps.push_back({dy * row_stride + dx, 1.0f - c.space_scale * static_cast<float>(square)});
    }
  return taps;
}

constexpr int most_lanes = 16 * ways;

/// `at` is the lightness of the first pixel of `ways` vectors; planes follow each other at `stride`.
template <AcuitySpace space>
HWY_INLINE void filter_lanes(const Constants& c, const std::vector<Tap>& taps, const float* at,
                             std::ptrdiff_t stride, float* out, std::ptrdiff_t out_stride) {
  const D d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto load = [&](const float* from) HWY_ATTR {
    return from_place([&](int v) HWY_ATTR { return hn::LoadU(d, from + v * lanes); });
  };
  const Wide l = load(at), a = load(at + stride), b = load(at + 2 * stride);
  const Wide red = load(at + 3 * stride), green = load(at + 4 * stride), blue = load(at + 5 * stride);
  Wide x = from_place([&](int) HWY_ATTR { return hn::Zero(d); });
  Wide y = x, z = x, total = x;
  for (const Tap& tap : taps) {
    const float* there = at + tap.offset;
    const V tap_u = hn::Set(d, tap.u);
    const Wide dl = sub(load(there), l), da = sub(load(there + stride), a),
               db = sub(load(there + 2 * stride), b);
    const Wide near = each([&](V v) HWY_ATTR { return hn::NegMulAdd(v, v, tap_u); }, dl);
    const Wide u = less_square(db, less_square(da, near));
    const Wide w = each([](V v) HWY_ATTR { return weight_of(D(), v); }, u);
    total = add(total, w);
    if constexpr (space == AcuitySpace::lab) {
      x = mul_add(w, dl, x);
      y = mul_add(w, da, y);
      z = mul_add(w, db, z);
    } else {
      x = mul_add(w, sub(load(there + 3 * stride), red), x);
      y = mul_add(w, sub(load(there + 4 * stride), green), y);
      z = mul_add(w, sub(load(there + 5 * stride), blue), z);
    }
  }
  const auto finish = [&](Three<V> sums, V weight, Three<V> lab, Three<V> own, float* to) HWY_ATTR {
    const V per_weight = hn::Div(hn::Set(d, 1.0f), weight);
    const Three<V> mean{hn::Mul(sums.x, per_weight), hn::Mul(sums.y, per_weight),
                        hn::Mul(sums.z, per_weight)};
    Three<V> change = mean;
    if constexpr (space == AcuitySpace::lab) change = rgb_difference(d, c, lab, moved(lab, mean));
    const V strength = hn::Set(d, c.strength);
    hn::StoreU(hn::MulAdd(strength, change.x, own.x), d, to);
    hn::StoreU(hn::MulAdd(strength, change.y, own.y), d, to + out_stride);
    hn::StoreU(hn::MulAdd(strength, change.z, own.z), d, to + 2 * out_stride);
  };
  finish({x.a, y.a, z.a}, total.a, {l.a, a.a, b.a}, {red.a, green.a, blue.a}, out);
#if HWY_TARGET <= HWY_AVX3
  finish({x.b, y.b, z.b}, total.b, {l.b, a.b, b.b}, {red.b, green.b, blue.b}, out + lanes);
#endif
}

constexpr int span = 128;  // columns: the rows of the disc at this width stay in the nearest cache

/// Columns [begin, end) of image row y, at most `span`.
template <AcuitySpace space>
void filter_span(const Constants& c, const std::vector<Tap>& taps, const AcuityWindow& window,
                 const AcuityTile& tile, int y, int begin, int end, const float* lightness,
                 std::ptrdiff_t stride) {
  float result[3][span + most_lanes];
  bool all_present = true;
  for (int x = begin; x < end; x += ways * static_cast<int>(hn::Lanes(D())))
    filter_lanes<space>(c, taps, lightness + x, stride, result[0] + (x - begin), span + most_lanes);
  for (int x = begin; x < end; ++x) all_present &= lightness[x] != absent;
  const std::ptrdiff_t in_offset = (y - window.y) * window.stride - window.x;
  const std::ptrdiff_t out_offset = (y - tile.y) * tile.stride - tile.x;
  const float* in[3] = {window.r + in_offset, window.g + in_offset, window.b + in_offset};
  float* out[3] = {tile.r + out_offset, tile.g + out_offset, tile.b + out_offset};
  for (int k = 0; k < 3; ++k) {
    std::copy(result[k], result[k] + (end - begin), out[k] + begin);
    if (all_present) continue;
    for (int x = begin; x < end; ++x)
      if (lightness[x] == absent) out[k][x] = in[k][x];
  }
}

template <AcuitySpace space>
void filter_rows(const Constants& c, const AcuityWindow& window, const AcuityTile& tile, int y, int height,
                 const LabRows& rows, int i) {
  const std::vector<Tap> taps = disc(c, 6 * rows.stride);
  const int end = tile.x + tile.width;
  for (int x = tile.x; x < end; x += span)
    for (int j = 0; j < height; ++j)
      filter_span<space>(c, taps, window, tile, y + j, x, std::min(x + span, end),
                         rows.row(i + j) + rows.margin - window.x, rows.stride);
}

}  // namespace

void BuildLabRow(const Constants& c, const AcuityWindow& window, int y, LabRows& out, int i) {
  float* row = out.row(i);
  const bool exists = y >= window.y && y < window.y + window.height;
  const std::ptrdiff_t margin = out.margin, right = margin + window.width;
  for (int k = 0; k < 6; ++k) {
    float* plane = row + k * out.stride;
    const float outside = k == 0 ? absent : 0.0f;
    std::fill(plane, plane + (exists ? margin : out.stride), outside);
    if (exists) std::fill(plane + right, plane + out.stride, outside);
  }
  if (!exists) return;
  const std::ptrdiff_t offset = (y - window.y) * window.stride;
  row += margin;
  float* const lab[3] = {row, row + out.stride, row + 2 * out.stride};
  const float* const planes[3] = {window.r + offset, window.g + offset, window.b + offset};
  lab_of_row(c, planes, window.width, lab);
  for (int k = 0; k < 3; ++k) {
    float* light = row + (3 + k) * out.stride;
    for (int x = 0; x < window.width; ++x) light[x] = row[x] == absent ? 0.0f : planes[k][x];
  }
}

void FilterFromWindow(const Constants& c, const AcuityWindow& window, const AcuityTile& tile, int y,
                      int height, const LabRows& rows, int i) {
  if (c.space == AcuitySpace::lab)
    filter_rows<AcuitySpace::lab>(c, window, tile, y, height, rows, i);
  else
    filter_rows<AcuitySpace::light>(c, window, tile, y, height, rows, i);
}

}  // namespace scotopic::acuity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace scotopic::acuity {
HWY_EXPORT(BuildLabRow);
HWY_EXPORT(FilterFromWindow);

void build_lab_row(const Constants& constants, const AcuityWindow& window, int y, LabRows& out, int i) {
  HWY_DYNAMIC_DISPATCH(BuildLabRow)(constants, window, y, out, i);
}

void filter_from_window(const Constants& constants, const AcuityWindow& window, const AcuityTile& tile, int y,
                        int height, const LabRows& rows, int i) {
  HWY_DYNAMIC_DISPATCH(FilterFromWindow)(constants, window, tile, y, height, rows, i);
}
}  // namespace scotopic::acuity
#endif
