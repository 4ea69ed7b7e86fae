// What the contrast filter costs: nanoseconds of CPU a pixel, one thread, best of 5, by resolution; and what
// of that is passing over memory, held to a copy of the picture in the same run. Usage: bench_contrast [width
// height]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "stages/contrast/filter.h"

namespace {

using scotopic::AcuityTile;
using scotopic::AcuityWindow;

/// A textured ground with lamps.
struct Night {
  Night(int w, int h) : width(w), height(h) {
    for (auto& plane : planes) plane.resize(static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const std::size_t i =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
        const double v =
            0.2 * std::exp(std::sin(0.9 * x) * std::cos(1.3 * y)) + (x % 400 < 5 && y % 300 < 5 ? 1e3 : 0);
        planes[0][i] = static_cast<float>(v);
        planes[1][i] = static_cast<float>(0.9 * v);
        planes[2][i] = static_cast<float>(0.7 * v);
      }
  }
  int width, height;
  std::vector<float> planes[3];
};

template <class F>
double best_seconds(F run) {
  double best = 1e9;
  for (int i = 0; i < 5; ++i) {
    const std::clock_t start = std::clock();
    run();
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return best;
}

double filter_seconds(const Night& in, Night& out, double pixels_per_degree) {
  scotopic::ContrastParameters p;
  p.adaptation = p.unit = 0.01;
  p.pixels_per_degree = pixels_per_degree;
  p.display = {278, 100};
  const scotopic::ContrastFilter filter(p);
  const AcuityWindow window{in.planes[0].data(),
                            in.planes[1].data(),
                            in.planes[2].data(),
                            in.width,
                            0,
                            0,
                            in.width,
                            in.height,
                            in.width,
                            in.height};
  const AcuityTile tile{out.planes[0].data(),
                        out.planes[1].data(),
                        out.planes[2].data(),
                        out.width,
                        0,
                        0,
                        out.width,
                        out.height};
  return best_seconds([&] { filter.filter(window, tile); });
}

}  // namespace

int main(int argc, char** argv) {
  const int width = argc > 2 ? std::atoi(argv[1]) : 1920, height = argc > 2 ? std::atoi(argv[2]) : 1080;
  const Night in(width, height);
  Night out = in;
  const double pixels = static_cast<double>(width) * height;
  const double copy = best_seconds([&] {
    for (int k = 0; k < 3; ++k) std::copy(in.planes[k].begin(), in.planes[k].end(), out.planes[k].begin());
  });
  std::printf("copy of three planes: %.2f ns/px\n", 1e9 * copy / pixels);
  for (double ppd : {8.0, 16.0, 20.0, 40.0, 60.0, 64.0}) {
    const double seconds = filter_seconds(in, out, ppd);
    std::printf("%2.0f pixels per degree: %.1f ns/px, %.1f copies\n", ppd, 1e9 * seconds / pixels,
                seconds / copy);
  }
}
