// A picture in memory for filters that look around each pixel.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "stages/acuity/filter.h"
#include "support/primaries.h"

namespace scotopic::test {

struct Planes {
  Planes(int w, int h) : width(w), height(h), r(size()), g(size()), b(size()) {}
  /// Grey of value(x, y).
  Planes(int w, int h, const std::function<double(int, int)>& value) : Planes(w, h) {
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) r[at(x, y)] = g[at(x, y)] = b[at(x, y)] = static_cast<float>(value(x, y));
  }

  std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }

  int width, height;
  std::vector<float> r, g, b;
};

/// The filter over the whole picture, in tiles of `side` (0: one); each from a window that holds no more than
/// it must.
inline Planes filtered(const SpatialFilter& filter, const Planes& in, int side = 0) {
  Planes out(in.width, in.height);
  const int step_x = side ? side : in.width, step_y = side ? side : in.height;
  for (int y = 0; y < in.height; y += step_y)
    for (int x = 0; x < in.width; x += step_x) {
      const int x0 = std::max(0, x - filter.halo()), y0 = std::max(0, y - filter.halo());
      const int w = std::min(step_x, in.width - x), h = std::min(step_y, in.height - y);
      const std::size_t from = in.at(x0, y0), to = in.at(x, y);
      filter.filter({in.r.data() + from, in.g.data() + from, in.b.data() + from, in.width, x0, y0,
                     std::min(in.width, x + w + filter.halo()) - x0,
                     std::min(in.height, y + h + filter.halo()) - y0, in.width, in.height},
                    {out.r.data() + to, out.g.data() + to, out.b.data() + to, in.width, x, y, w, h});
    }
  return out;
}

}  // namespace scotopic::test
