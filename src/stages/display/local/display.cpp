#include "stages/display/local/display.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "adaptation/mesopic.h"
#include "stages/display/local/base_layer.h"
#include "stages/display/local/gamut_light.h"
#include "stages/require.h"
#include "stages/shared/mesopic_fit.h"

namespace scotopic {
namespace {

/// Share of the peak from which on the shoulder bends.
constexpr float shoulder_from = 0.8f;

// Beside what the base layer demands.
void check(const DisplayParameters& p, const DisplayRange& range) {
  require(p.strength >= 0 && p.strength <= 1, "DisplayFilter: strength must be 0 ... 1");
  require(std::isfinite(p.contrast) && p.contrast >= 1, "DisplayFilter: contrast must be >= 1");
  require(positive(p.peak), "DisplayFilter: peak must be > 0");
  require(p.night_range >= 0 && p.night_range <= 1, "DisplayFilter: night_range must be 0 ... 1");
  require(positive(p.night_exponent), "DisplayFilter: night_exponent must be > 0");
  require(std::isfinite(p.exposure), "DisplayFilter: exposure must be finite");
  require(positive(range.low) && std::isfinite(range.high) && range.low <= range.high,
          "DisplayFilter: range must be 0 < low <= high");
}

/// Identity up to shoulder_from of the peak; above, a hyperbola that ends at the peak, with the same slope
/// there.
float shouldered(float y, float peak) {
  const float from = shoulder_from * peak, room = peak - from;
  if (!(y > from)) return y;
  return peak - room * (room / (y - from + room));
}

/// Towards the grey of the same luminance, as far as it takes for no component to be above the peak.
Vec3<float> fitted(const Vec3<float>& rgb, float luminance, float peak) {
  const float most = std::max({rgb[0], rgb[1], rgb[2]});
  if (!(most > peak)) return rgb;
  const float y = std::min(luminance, peak), keep = (peak - y) / (most - y);
  Vec3<float> out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = std::clamp(y + keep * (rgb[i] - y), 0.0f, peak);
  return out;
}

}  // namespace

double night_factor(double w, double night_range, double night_exponent) noexcept {
  return std::max(1 - std::pow(w, night_exponent) * (1 - night_range), night_range);
}

struct DisplayFilter::Plan {
  Plan(const DisplayParameters& p, const DisplayRange& range);

  Vec3<float> shown(const GamutLight& light, const Vec3<float>& rgb, float base) const;
  float night(float decades) const;

  DisplayParameters parameters;
  float compression;  // c
  float high;         // decades over La that become the peak
  float top;          // log10 of the peak, in display light
  float peak;         // in display light
  float darkest;      // luminance that is told from black, image units
  MesopicFit<7> rods;
};

DisplayFilter::Plan::Plan(const DisplayParameters& p, const DisplayRange& range) : parameters(p) {
  check(p, range);
  const double span = std::log10(range.high / range.low);
  const double room = std::log10(p.contrast * std::max(1.0, p.peak / display_unit));
  compression = span > room ? static_cast<float>(room / span) : 1.0f;
  high = static_cast<float>(std::log10(range.high / p.adaptation));
  top = static_cast<float>(std::log10(p.peak / display_unit) + p.exposure * std::log10(2.0));
  peak = static_cast<float>(p.peak / display_unit);
  darkest = GamutLight(p).luminance_of(darkest_decade);
}

/// The range reduction's factor for a pixel of luminance 10^decades La.
float DisplayFilter::Plan::night(float decades) const {
  const DisplayParameters& p = parameters;
  if (p.night_range == 1 || p.strength == 0) return 1.0f;
  const double local =
      p.weight == Weight::local ? p.adaptation * (1 + std::pow(10.0, double{decades})) : p.adaptation;
  if (local >= rods.high) return 1.0f;
  const double v = std::min(1.0, std::log2(rods.high / local) / rods.octaves);
  double share = 0;
  for (std::size_t k = rods.coefficient.size(); k-- > 0;) share = share * v + rods.coefficient[k];
  return static_cast<float>(
      night_factor(p.strength * std::clamp(share * v, 0.0, 1.0), p.night_range, p.night_exponent));
}

Vec3<float> DisplayFilter::Plan::shown(const GamutLight& light, const Vec3<float>& rgb, float base) const {
  const Vec3<float> inside = light.inside(rgb);
  const float seen = light.luminance(inside), decades = light.decades(seen);
  const float mapped = std::pow(10.0f, top + compression * (base - high) + (decades - base));
  const float luminance = night(decades) * shouldered(mapped, peak);
  // Below the darkest decade the scale no longer grows: black stays black.
  const float scale = luminance / std::max(seen, darkest);
  return light.working(fitted({scale * inside[0], scale * inside[1], scale * inside[2]}, luminance, peak));
}

DisplayFilter::DisplayFilter(const DisplayParameters& parameters, const DisplayRange& range)
    : base_(parameters), plan_(std::make_unique<const Plan>(parameters, range)) {}
DisplayFilter::~DisplayFilter() = default;

int DisplayFilter::halo() const noexcept { return base_.halo(); }
double DisplayFilter::compression() const noexcept { return double{plan_->compression}; }

void DisplayFilter::filter(const AcuityWindow& window, const AcuityTile& tile,
                           const ParallelFor& parallel_for) const {
  base_.plan_->decades(window, tile, parallel_for);
  const std::ptrdiff_t first = (tile.y - window.y) * window.stride + tile.x - window.x;
  parallel_for(tile.height, [&](int y) {
    for (std::ptrdiff_t x = 0; x < tile.width; ++x) {
      const std::ptrdiff_t from = first + y * window.stride + x, to = y * tile.stride + x;
      const Vec3<float> rgb = {window.r[from], window.g[from], window.b[from]};
      const Vec3<float> out =
          GamutLight::operable(rgb) ? plan_->shown(base_.plan_->light, rgb, tile.r[to]) : rgb;
      tile.r[to] = out[0];
      tile.g[to] = out[1];
      tile.b[to] = out[2];
    }
  });
}

}  // namespace scotopic
