// Images made by formula, and the filter written once more, plainly and in double.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "stages/acuity/filter.h"

namespace scotopic::test {

struct Image {
  Image(int w, int h) : width(w), height(h), planes{plane(), plane(), plane()} {}
  std::vector<float> plane() const { return std::vector<float>(static_cast<std::size_t>(width * height)); }
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * width + x); }

  int width, height;
  std::vector<float> planes[3];
};

/// IEC 61966-2-1 primaries, D65.
inline Matrix3<double> xyz_from_srgb() {
  return {{{{0.41239080, 0.35758434, 0.18048079},
            {0.21263901, 0.71516868, 0.07219232},
            {0.01933082, 0.11919478, 0.95053215}}}};
}

/// Repeatable noise in [0, 1) of a place (SplitMix64's finaliser).
inline double noise(int x, int y, int salt) {
  auto z = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15u +
           static_cast<std::uint64_t>(y) * 0xBF58476D1CE4E5B9u +
           static_cast<std::uint64_t>(salt) * 0x94D049BB133111EBu;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/// A night: dark ground and a lighter sky with texture, a hard diagonal silhouette, a few lamps 1e4 brighter.
inline Image night(int width, int height, double texture = 0.2) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool sky = 2 * y < height + x / 2;
      const double level = sky ? 0.3 + 0.2 * y / height : 0.02 + 0.01 * x / width;
      const double tint[3] = {sky ? 0.6 : 1.2, 1.0, sky ? 1.6 : 0.5};
      const bool lamp = noise(x / 3, y / 3, 7) > 0.995;
      for (int k = 0; k < 3; ++k) {
        const double grain = std::exp(texture * (noise(x, y, k) + noise(x / 2, y / 2, 4 + k) - 1.0));
        image.planes[k][image.at(x, y)] = static_cast<float>(level * tint[k] * grain * (lamp ? 1e4 : 1.0));
      }
    }
  }
  return image;
}

inline AcuityParameters parameters(double sigma, double range_sigma = 15.0) {
  AcuityParameters p;
  p.sigma = sigma;
  p.range_sigma = range_sigma;
  p.white = 1.0;
  p.xyz_from_rgb = xyz_from_srgb();
  return p;
}

inline AcuityWindow window_of(const Image& image) {
  return {image.planes[0].data(),
          image.planes[1].data(),
          image.planes[2].data(),
          image.width,
          0,
          0,
          image.width,
          image.height,
          image.width,
          image.height};
}

inline AcuityTile tile_of(Image& image) {
  return {image.planes[0].data(),
          image.planes[1].data(),
          image.planes[2].data(),
          image.width,
          0,
          0,
          image.width,
          image.height};
}

inline Image filtered(const AcuityParameters& p, const Image& image,
                      const ParallelFor& parallel_for = serial_for) {
  Image out(image.width, image.height);
  AcuityFilter(p).filter(window_of(image), tile_of(out), parallel_for);
  return out;
}

/// CIE 15: CIELAB relative to a D65 white of luminance `white`.
inline Vec3<double> cielab(const AcuityParameters& p, const Vec3<double>& rgb) {
  const Vec3<double> white = p.xyz_from_rgb * Vec3<double>{p.white, p.white, p.white};
  const Vec3<double> xyz = p.xyz_from_rgb * rgb;
  Vec3<double> f;
  for (std::size_t k = 0; k < 3; ++k) {
    const double t = xyz[k] / white[k];
    f[k] = t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  }
  return {116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])};
}

inline Vec3<double> pixel(const Image& image, int x, int y) {
  const std::size_t at = image.at(x, y);
  return {image.planes[0][at], image.planes[1][at], image.planes[2][at]};
}

/// The bilateral mean at a pixel, every neighbour within 3.5 sigma counted: RGB, or CIELAB where it is
/// averaged.
inline Vec3<double> brute_force(const AcuityParameters& p, const Image& image, int x, int y) {
  const Vec3<double> own = cielab(p, pixel(image, x, y));
  const int reach = static_cast<int>(std::ceil(3.5 * p.sigma));
  Vec3<double> sum{};
  double total = 0.0;
  for (int j = std::max(0, y - reach); j <= std::min(image.height - 1, y + reach); ++j) {
    for (int i = std::max(0, x - reach); i <= std::min(image.width - 1, x + reach); ++i) {
      const double space = (i - x) * (i - x) + (j - y) * (j - y);
      if (space > 12.25 * p.sigma * p.sigma) continue;
      const Vec3<double> rgb = pixel(image, i, j), lab = cielab(p, rgb);
      double range = 0.0;
      for (std::size_t k = 0; k < 3; ++k) range += (lab[k] - own[k]) * (lab[k] - own[k]);
      const double w =
          std::exp(-space / (2.0 * p.sigma * p.sigma) - range / (2.0 * p.range_sigma * p.range_sigma));
      for (std::size_t k = 0; k < 3; ++k) sum[k] += w * (p.space == AcuitySpace::light ? rgb[k] : lab[k]);
      total += w;
    }
  }
  return {sum[0] / total, sum[1] / total, sum[2] / total};
}

/// How far from the filter in double.
struct Agreement {
  double psnr = 0.0;  // dB, of CIELAB, 100 units full scale
  double worst = 0.0;
  int x = 0, y = 0;
};

/// The filter against brute force at the pixels of a grid of `step`.
inline Agreement agreement(const AcuityParameters& p, const Image& in, int step) {
  const Image out = filtered(p, in);
  Agreement result;
  double squares = 0.0;
  int count = 0;
  for (int y = 0; y < in.height; y += step) {
    for (int x = y % step; x < in.width; x += step) {
      Vec3<double> wanted = brute_force(p, in, x, y);
      if (p.space == AcuitySpace::light) wanted = cielab(p, wanted);
      const Vec3<double> found = cielab(p, pixel(out, x, y));
      double square = 0.0;
      for (std::size_t k = 0; k < 3; ++k) square += (found[k] - wanted[k]) * (found[k] - wanted[k]);
      squares += square / 3.0;
      ++count;
      if (!(std::sqrt(square) <= result.worst)) result = {0.0, std::sqrt(square), x, y};
    }
  }
  result.psnr = 10.0 * std::log10(1e4 / (squares / count + 1e-12));
  return result;
}

}  // namespace scotopic::test
