#include "stages/contrast/ranges.h"

#include <algorithm>
#include <cstddef>

namespace scotopic::contrast {
namespace {

/// Cut off at the picture's ends; the first sample even, as samples are doubled two at a time.
Range inside(Range r, int size) { return {std::max(r.begin, 0) & ~1, std::min(r.end, size)}; }

Range hull(Range a, Range b) { return {std::min(a.begin, b.begin), std::max(a.end, b.end)}; }

/// Samples of the next coarser level from which r is interpolated.
Range coarse_of(Range r) { return {(r.begin >> 1) - 1, ((r.end - 1) >> 1) + 2}; }

/// Samples of the next finer level of which r are means.
Range fine_of(Range r) { return {2 * r.begin - 2, 2 * (r.end - 1) + 3}; }

}  // namespace

AxisRanges axis_ranges(Range tile, int length, int bands) {
  AxisRanges a;
  const auto count = static_cast<std::size_t>(bands);
  a.size = {length};
  a.change = {inside(tile, length)};
  for (std::size_t k = 0; k < count; ++k) {
    a.size.push_back((a.size[k] + 1) / 2);
    a.band.push_back(inside({a.change[k].begin - blur_reach, a.change[k].end + blur_reach}, a.size[k]));
    a.change.push_back(inside(coarse_of(a.change[k]), a.size[k + 1]));
  }
  a.source.resize(count + 1, a.change[0]);
  for (std::size_t k = count; k < a.source.size(); --k) {
    Range r = a.change[k];
    if (k < count) r = hull(a.band[k], fine_of(a.source[k + 1]));
    if (k > 0) r = hull(r, coarse_of(a.band[k - 1]));
    a.source[k] = inside(r, a.size[k]);
  }
  return a;
}

int pyramid_halo(int bands) {
  // Far from both ends; how far it reaches depends on how the tile lies to pairs of the coarsest samples.
  const int step = 2 << bands, middle = 64 * step;
  int halo = 0;
  for (int x = middle; x < middle + step; ++x) {
    const Range source = axis_ranges({x, x + 1}, 2 * middle, bands).source[0];
    halo = std::max({halo, x - source.begin, source.end - (x + 1)});
  }
  return halo;
}

}  // namespace scotopic::contrast
