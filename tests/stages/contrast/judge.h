// A second writing of the contrast filter, in double and straight from its definition: no vectors, no tables,
// no blocks. What the filter is judged by; and the choices that were not taken, to set beside it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "stages/contrast/filter.h"

namespace scotopic::test {

/// A linear RGB picture.
struct Picture {
  Picture(int w, int h) : width(w), height(h) {
    for (auto& p : planes) p.assign(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), 0.0f);
  }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  void grey(int x, int y, double v) {
    for (auto& p : planes) p[at(x, y)] = static_cast<float>(v);
  }
  int width, height;
  std::vector<float> planes[3];
};

/// What else might have been done.
struct JudgeChoices {
  enum class Contrast { band, picture } contrast = Contrast::band;  ///< sqrt(g*P^2), or of l - g*l
  enum class Surround { light, log } surround = Surround::light;  ///< the mean of light, or of its logarithm
  enum class Peaks { none, bright, all } peaks = Peaks::bright;   ///< G at least P/sqrt(2), or |P|/sqrt(2)
};

namespace judge {

inline double csf(double rho, double l) {
  static const double nodes[6] = {.002, .02, .2, 2, 20, 150};
  static const double p[4][6] = {{.991265, .800889, .476505, .405782, .334278, .394533},
                                 {3.74038, 3.54104, 4.37453, 4.40602, 3.79542, 2.7755},
                                 {.50722, .682505, .750315, .935314, 1.07327, 1.16577},
                                 {4.46044, 4.94958, 5.28678, 5.61425, 6.4635, 7.45665}};
  double q[4];
  for (int k = 0; k < 4; ++k) {
    q[k] = l <= nodes[0] ? p[k][0] : p[k][5];
    for (int i = 0; i < 5; ++i)
      if (l > nodes[i] && l <= nodes[i + 1])
        q[k] = p[k][i] + (p[k][i + 1] - p[k][i]) * std::log(l / nodes[i]) / std::log(nodes[i + 1] / nodes[i]);
  }
  const double optics = .42483860 * std::exp(-.028 * rho) + .57243510 * std::exp(-.37 * rho) +
                        .00016758 * std::exp(-37 * rho) + .00255872 * std::exp(-360 * rho);
  const double shape = (1 + std::pow(q[0] * rho, q[1])) / std::pow(1 - std::exp(-rho * rho / 49), q[2]);
  return q[3] * std::pow(shape, -.5) * optics * 30.162 * std::pow(std::pow(4.0627 / l, 1.6596) + 1, -.2712);
}

inline double threshold(double rho, double l) {
  const double t = 1 / std::max(8.6 * csf(rho, l), 1.0202);
  return .5 * std::log10((1 + t) / (1 - t));
}

/// Samples of a level; `there` is 1 or 0.
struct Level {
  int w = 0, h = 0;
  std::vector<double> v, there;
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
  }
};

inline Level like(int w, int h) {
  const auto n = static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
  return {w, h, std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
}

/// Weighted mean of f over what is there; tap(dx, dy) around (cx, cy).
inline double mean(const Level& l, int cx, int cy, int reach, const std::function<double(int, int)>& tap,
                   const std::function<double(double)>& f, double* total = nullptr) {
  double sum = 0, weights = 0;
  for (int y = cy - reach; y <= cy + reach; ++y)
    for (int x = cx - reach; x <= cx + reach; ++x) {
      if (x < 0 || y < 0 || x >= l.w || y >= l.h) continue;
      const double w = tap(x, y) * l.there[l.at(x, y)];
      sum += w * f(l.v[l.at(x, y)]);
      weights += w;
    }
  if (total) *total = weights;
  return weights > 0 ? sum / weights : 0;
}

inline double same(double x) { return x; }
inline double square(double x) { return x * x; }

inline double binomial(int i) {
  const double b[5] = {1, 4, 6, 4, 1};
  return i < -2 || i > 2 ? 0 : b[i + 2];
}

inline Level halved(const Level& l) {
  Level out = like((l.w + 1) / 2, (l.h + 1) / 2);
  for (int y = 0; y < out.h; ++y)
    for (int x = 0; x < out.w; ++x) {
      const auto tap = [&](int i, int j) { return binomial(i - 2 * x) * binomial(j - 2 * y); };
      double weight = 0;
      out.v[out.at(x, y)] = mean(l, 2 * x, 2 * y, 2, tap, same, &weight);
      out.there[out.at(x, y)] = weight > 0 ? 1 : 0;
    }
  return out;
}

/// The next coarser level at pixel (x, y): sample i stands at 2 i, weighs binomial(x - 2 i).
inline double enlarged(const Level& coarse, int x, int y) {
  const auto tap = [&](int i, int j) { return binomial(x - 2 * i) * binomial(y - 2 * j); };
  return mean(coarse, x / 2, y / 2, 1, tap, same);
}

inline double gaussian(int i) {
  const double taps[7] = {818, 722, 496, 265, 111, 36, 9};
  return taps[i < 0 ? -i : i];
}

inline double blurred(const Level& l, int x, int y, const std::function<double(double)>& f) {
  const auto tap = [&](int i, int j) { return gaussian(i - x) * gaussian(j - y); };
  return mean(l, x, y, 6, tap, f);
}

inline double luminance(const ContrastParameters& p, const Picture& in, std::size_t i) {
  return p.luminance[0] * static_cast<double>(in.planes[0][i]) +
         p.luminance[1] * static_cast<double>(in.planes[1][i]) +
         p.luminance[2] * static_cast<double>(in.planes[2][i]);
}

inline bool operable(const Picture& in, std::size_t i) {
  return std::all_of(std::begin(in.planes), std::end(in.planes),
                     [&](const auto& p) { return std::abs(p[i]) <= 0x1p120f; });
}

/// log10 of luminance in cd/m2, and luminance.
inline std::pair<Level, Level> read(const ContrastParameters& p, const Picture& in) {
  Level log = like(in.width, in.height), light = log;
  for (std::size_t i = 0; i < log.v.size(); ++i) {
    if (!operable(in, i)) continue;
    log.there[i] = light.there[i] = 1;
    light.v[i] = std::max(p.unit * luminance(p, in, i), 0.0) + 1e-3 * p.adaptation;
    log.v[i] = std::log10(light.v[i]);
  }
  return {log, light};
}

inline Level band_of(const Level& fine, const Level& coarse) {
  Level band = fine;
  for (int y = 0; y < band.h; ++y)
    for (int x = 0; x < band.w; ++x) band.v[band.at(x, y)] -= enlarged(coarse, x, y);
  return band;
}

inline double local_contrast(const JudgeChoices& choices, const Level& fine, const Level& band, int x,
                             int y) {
  if (choices.contrast == JudgeChoices::Contrast::band) return std::sqrt(blurred(band, x, y, square));
  const double m = blurred(fine, x, y, same);
  return std::sqrt(blurred(fine, x, y, [&](double v) { return (v - m) * (v - m); }));
}

inline double least_contrast_of(const JudgeChoices& choices, double band) {
  if (choices.peaks == JudgeChoices::Peaks::none) return 0;
  return (choices.peaks == JudgeChoices::Peaks::all ? std::abs(band) : band) / std::sqrt(2.0);
}

}  // namespace judge

/// log10 of the factor on each pixel's luminance; 0 where a pixel is not there.
inline std::vector<double> judged_change(const ContrastParameters& p, const Picture& in,
                                         const JudgeChoices& choices = {}) {
  using namespace judge;
  std::vector<Level> log, light;
  auto [l, y0] = read(p, in);
  log = {l};
  light = {y0};
  std::vector<double> rho;
  for (double r = p.pixels_per_degree / 4; r >= 2; r /= 2) {
    rho.push_back(r);
    log.push_back(halved(log.back()));
    light.push_back(halved(light.back()));
  }
  for (Level& level : light)
    for (double& v : level.v) v = v > 0 ? std::log10(v) : 0;
  Level change = like(log.back().w, log.back().h);
  change.there = log.back().there;
  for (std::size_t k = rho.size(); k-- > 0;) {
    const Level& coarse = choices.surround == JudgeChoices::Surround::light ? light[k + 1] : log[k + 1];
    const Level band = band_of(log[k], log[k + 1]);
    Level next = like(log[k].w, log[k].h);
    next.there = log[k].there;
    for (int y = 0; y < next.h; ++y)
      for (int x = 0; x < next.w; ++x) {
        const std::size_t i = next.at(x, y);
        if (next.there[i] == 0) continue;
        double g = local_contrast(choices, log[k], band, x, y);
        g = std::max(g, least_contrast_of(choices, band.v[i]));
        const double around = std::pow(10, enlarged(coarse, x, y));
        const double shown = std::min(p.display.scale * around, p.display.peak);
        const double excess =
            std::max(0.0, threshold(rho[k], p.adaptation + around) - threshold(rho[k], shown));
        const double m = g > 0 ? std::min(1.0, std::max(g - excess, .001) / g) : 1;
        next.v[i] = enlarged(change, x, y) + (m - 1) * band.v[i];
      }
    change = next;
  }
  if (rho.empty()) std::fill(change.v.begin(), change.v.end(), 0.0);
  return change.v;
}

/// The picture as the filter should give it, but in double.
inline std::vector<double> judged(const ContrastParameters& p, const Picture& in, int plane,
                                  const JudgeChoices& choices = {}) {
  std::vector<double> out = judged_change(p, in, choices);
  const double black = 1e-3 * p.adaptation / p.unit / (p.luminance[0] + p.luminance[1] + p.luminance[2]);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double v = static_cast<double>(in.planes[plane][i]);
    const double more = p.strength * (std::pow(10, out[i]) - 1);
    out[i] = more > 0 ? v + more * (std::max(v, 0.0) + black) : v * (1 + more);
  }
  return out;
}

/// Window and tile that are the whole picture.
inline AcuityWindow window_of(const Picture& p) {
  return {p.planes[0].data(),
          p.planes[1].data(),
          p.planes[2].data(),
          p.width,
          0,
          0,
          p.width,
          p.height,
          p.width,
          p.height};
}
inline AcuityTile tile_of(Picture& p) {
  return {p.planes[0].data(), p.planes[1].data(), p.planes[2].data(), p.width, 0, 0, p.width, p.height};
}
inline Picture filtered(const ContrastParameters& p, const Picture& in) {
  Picture out(in.width, in.height);
  ContrastFilter(p).filter(window_of(in), tile_of(out));
  return out;
}

}  // namespace scotopic::test
