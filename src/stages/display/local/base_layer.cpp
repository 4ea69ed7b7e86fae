#include "stages/display/local/base_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace scotopic {
namespace {

// The acuity filter is bilateral in CIELAB. Of a grey only the lightness is left, and that is linear in the
// cube root of its luminance: a grey whose luminance is the cube of u(log10 Y), u linear, is filtered in log
// luminance. u stays on the cube root's side of CIELAB's straight piece (6/29) for all decades.
constexpr float decades_per_root = 20.0f;
constexpr float root_of_adaptation = 0.6f;
constexpr double lightness_per_decade = 116.0 / double{decades_per_root};
static_assert(root_of_adaptation + darkest_decade / decades_per_root > 6.0f / 29.0f);

float cube_of_log(float decades) {
  const float u = root_of_adaptation + decades / decades_per_root;
  return u * u * u;
}

float log_of_cube(float cube) { return (std::cbrt(cube) - root_of_adaptation) * decades_per_root; }

const DisplayParameters& checked(const DisplayParameters& p) {
  for (const double x : {p.adaptation, p.white_luminance})
    if (!(std::isfinite(x) && x > 0))
      throw std::invalid_argument("BaseLayer: adaptation and white_luminance must be > 0");
  return p;
}

AcuityParameters filter_parameters(const DisplayParameters& p) {
  AcuityParameters out;
  out.sigma = p.sigma;
  out.range_sigma = p.range_sigma * lightness_per_decade;
  out.space = AcuitySpace::lab;
  return out;
}

}  // namespace

BaseLayer::Plan::Plan(const DisplayParameters& p) : light(p), filter(filter_parameters(p)) {}

BaseLayer::BaseLayer(const DisplayParameters& parameters)
    : plan_(std::make_unique<const Plan>(checked(parameters))) {}
BaseLayer::~BaseLayer() = default;

int BaseLayer::halo() const noexcept { return plan_->filter.halo(); }

void BaseLayer::Plan::decades(const AcuityWindow& window, const AcuityTile& tile,
                              const ParallelFor& parallel_for) const {
  const auto width = static_cast<std::size_t>(window.width);
  std::vector<float> cubes(width * static_cast<std::size_t>(window.height));
  parallel_for(window.height, [&](int y) {
    const std::ptrdiff_t from = y * window.stride;
    float* const to = cubes.data() + width * static_cast<std::size_t>(y);
    for (std::ptrdiff_t x = 0; x < window.width; ++x) {
      const Vec3<float> rgb = {window.r[from + x], window.g[from + x], window.b[from + x]};
      const bool fine = GamutLight::operable(rgb);
      to[x] = fine ? cube_of_log(light.decades(light.luminance(light.inside(rgb))))
                   : std::numeric_limits<float>::quiet_NaN();
    }
  });
  AcuityWindow grey = window;
  grey.r = grey.g = grey.b = cubes.data();
  grey.stride = window.width;
  filter.filter(grey, tile, parallel_for);
  parallel_for(tile.height, [&](int y) {
    float* const row = tile.r + y * tile.stride;
    for (int x = 0; x < tile.width; ++x) row[x] = log_of_cube(row[x]);
  });
}

void BaseLayer::filter(const AcuityWindow& window, const AcuityTile& tile,
                       const ParallelFor& parallel_for) const {
  plan_->decades(window, tile, parallel_for);
  const std::ptrdiff_t first = (tile.y - window.y) * window.stride + tile.x - window.x;
  parallel_for(tile.height, [&](int y) {
    for (std::ptrdiff_t x = 0; x < tile.width; ++x) {
      const std::ptrdiff_t from = first + y * window.stride + x, to = y * tile.stride + x;
      const Vec3<float> rgb = {window.r[from], window.g[from], window.b[from]};
      const bool lit =
          GamutLight::operable(rgb) &&
          plan_->light.decades(plan_->light.luminance(plan_->light.inside(rgb))) > darkest_decade;
      const float base = lit ? plan_->light.luminance_of(tile.r[to]) : 0.0f;
      tile.r[to] = tile.g[to] = tile.b[to] = base;
    }
  });
}

DisplayRange range_of(const LuminanceHistogram& base, const DisplayParameters& p) noexcept {
  if (base.count() == 0) return {p.adaptation, p.adaptation};
  return {base.quantile(range_below) * p.white_luminance, base.quantile(range_up_to) * p.white_luminance};
}

double display_sigma(int width, int height) noexcept { return 0.02 * std::max(width, height); }

}  // namespace scotopic
