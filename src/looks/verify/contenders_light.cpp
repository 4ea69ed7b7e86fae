// Contenders beside the operator itself: spectra, and acuity.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "stages/acuity/filter.h"
#include "stages/shared/colour_difference.h"
#include "stages/reference.h"
#include "looks/verify/contenders.h"
#include "receptors/illuminant.h"
#include "receptors/receptor_space.h"
#include "receptors/spectral_integrator.h"

namespace scotopic {
namespace {

// Where rods and cones see: the range of the table of V'.
constexpr double first_nm = 380, last_nm = 780;

BandGrid grid_of(double step) {
  std::vector<double> centres;
  for (double nm = first_nm; nm <= last_nm; nm += step) centres.push_back(nm);
  return BandGrid(std::move(centres));
}

/// What an image of the spectrum holds: means over bins, or values at the centres.
std::vector<float> bands_of(const TabulatedCurve& spectrum, const BandGrid& grid, BandSampling sampling) {
  std::vector<float> out;
  for (std::size_t b = 0; b < grid.size(); ++b) {
    if (sampling == BandSampling::point) {
      out.push_back(static_cast<float>(spectrum.at(grid.centre(b))));
      continue;
    }
    constexpr int parts = 64;
    double sum = 0;
    for (int i = 0; i < parts; ++i)
      sum += spectrum.at(grid.lower_edge(b) + grid.width(b) * (i + 0.5) / parts);
    out.push_back(static_cast<float>(sum / parts));
  }
  return out;
}

using Signals = std::array<float, signal_count>;

Signals signals_of(const SpectralIntegrator& integrator, const std::vector<float>& bands) {
  Signals out{};
  SignalRows rows;
  for (std::size_t s = 0; s < signal_count; ++s) rows[s] = &out[s];
  integrator.integrate(bands.data(), 1, 1, rows);
  return out;
}

/// What is seen of light with these signals, scaled by `gain`.
Vec3<double> seen(const AppearanceReference& reference, const Signals& s, double gain) {
  const auto at = [&](Signal signal) { return gain * static_cast<double>(s[index(signal)]); };
  const Vec3<double> xyz = {at(Signal::x), at(Signal::y), at(Signal::z)};
  const Vec3<double> rgb = inverse(reference.constants().parameters.xyz_from_rgb) * xyz;
  return reference({rgb, Vec3<double>{at(Signal::l), at(Signal::m), at(Signal::s)}, at(Signal::rod)});
}

std::vector<Spectrum> built_in_spectra() {
  std::vector<Spectrum> out;
  for (const NamedIlluminant& illuminant : named_illuminants())
    if (auto spectrum = illuminant_spectrum(illuminant.name)) out.push_back(std::move(*spectrum));
  return out;
}

EvaluatorError spectral_error(const AppearanceParameters& p, const SpectralIntegrator& integrator,
                              const BandGrid& grid, BandSampling sampling) {
  const BandGrid fine = grid_of(1);
  const SpectralIntegrator truth(emissive_weights(fine, BandSampling::bin, BandUnit::per_nm),
                                 Accumulation::dual);
  const AppearanceReference reference(p);
  std::vector<double> differences, relative;
  for (const Spectrum& spectrum : built_in_spectra()) {
    const Signals should = signals_of(truth, bands_of(spectrum.curve(), fine, BandSampling::bin));
    const Signals is = signals_of(integrator, bands_of(spectrum.curve(), grid, sampling));
    double worst = 0;
    for (std::size_t s = 0; s < 4; ++s)
      worst = std::max(worst, std::abs(static_cast<double>(is[s] / should[s]) - 1));
    relative.push_back(worst);
    for (const double level : {0.25, 1.0, 4.0}) {
      const double gain =
          level * p.adaptation / p.white_luminance / static_cast<double>(should[index(Signal::y)]);
      differences.push_back(exposed_difference(p.xyz_from_rgb * seen(reference, should, gain),
                                               p.xyz_from_rgb * seen(reference, is, gain)));
    }
  }
  EvaluatorError out;
  out.difference = statistics_of(std::move(differences));
  out.pixel = statistics_of(std::move(relative));
  return out;
}

/// Bands of many pixels, and room for their signals.
struct BandRows {
  static constexpr std::size_t width = 2048, rows = 16;
  std::vector<float> bands;
  std::array<std::vector<float>, signal_count> out;

  explicit BandRows(std::size_t count) : bands(count * width * rows, 0.1f) {
    for (auto& plane : out) plane.resize(width);
  }
  void integrate(const SpectralIntegrator& integrator) {
    SignalRows targets;
    for (std::size_t s = 0; s < signal_count; ++s) targets[s] = out[s].data();
    for (std::size_t y = 0; y < rows; ++y)
      integrator.integrate(bands.data() + y * bands.size() / rows, width, width, targets);
  }
};

Contender spectral_contender(const AppearanceParameters& p, double step, BandSampling sampling) {
  const BandGrid grid = grid_of(step);
  const auto integrator = std::make_shared<SpectralIntegrator>(
      emissive_weights(grid, sampling, BandUnit::per_nm), Accumulation::dual);
  const auto rows = std::make_shared<BandRows>(grid.size());
  Contender out;
  out.row.group = "spectra";
  out.row.name = fmt::format("{:g} nm {}", step, sampling == BandSampling::bin ? "bins" : "points");
  out.row.error = spectral_error(p, *integrator, grid, sampling);
  out.run = {nullptr, [rows, integrator] { rows->integrate(*integrator); }, BandRows::width * BandRows::rows};
  return out;
}

/// A square of the picture's middle and what the filter made of it.
struct AcuityPlace {
  int side;
  Colours in, out;

  AcuityPlace(const TimedPicture& picture, int most)
      : side(std::min({most, static_cast<int>(picture.width), static_cast<int>(picture.rows())})) {
    const auto n = static_cast<std::size_t>(side);
    const std::size_t x = (picture.width - n) / 2, y = (picture.rows() - n) / 2;
    const auto crop = [&](const std::vector<float>& from, std::vector<float>& to) {
      for (std::size_t row = y; row < y + n; ++row) {
        const auto first = from.begin() + static_cast<std::ptrdiff_t>(row * picture.width + x);
        to.insert(to.end(), first, first + side);
      }
    };
    crop(picture.pixels.r, in.r);
    crop(picture.pixels.g, in.g);
    crop(picture.pixels.b, in.b);
    out = in;
  }
  void filter(const AcuityFilter& filter) {
    const AcuityWindow window = {in.r.data(), in.g.data(), in.b.data(), side, 0, 0, side, side, side, side};
    filter.filter(window, {out.r.data(), out.g.data(), out.b.data(), side, 0, 0, side, side});
  }
};

std::vector<Vec3<double>> in_double(const Colours& c) {
  std::vector<Vec3<double>> out;
  for (std::size_t i = 0; i < c.size(); ++i) out.push_back({c.r[i], c.g[i], c.b[i]});
  return out;
}

}  // namespace

std::vector<Contender> spectral_contenders(const AppearanceParameters& p) {
  std::vector<Contender> out;
  for (const double step : {1.0, 5.0, 10.0})
    for (const BandSampling sampling : {BandSampling::bin, BandSampling::point})
      out.push_back(spectral_contender(p, step, sampling));
  return out;
}

std::vector<Contender> acuity_contenders(const AppearanceParameters& p, const TimedPicture& picture) {
  const auto place = std::make_shared<AcuityPlace>(picture, 192);
  AcuityParameters q;
  q.sigma = 8;
  // The eye's white: what it is adapted to is a grey of 18 %.
  q.white = p.adaptation / 0.18 / p.white_luminance;
  q.xyz_from_rgb = p.xyz_from_rgb;
  struct Step {
    const char* name;
    AcuityEngine engine;
    AcuityQuality quality;
  };
  constexpr Step steps[] = {{"window", AcuityEngine::window, AcuityQuality::fine},
                            {"cells, fine", AcuityEngine::cells, AcuityQuality::fine},
                            {"cells, normal", AcuityEngine::cells, AcuityQuality::normal},
                            {"cells, draft", AcuityEngine::cells, AcuityQuality::draft}};
  std::vector<Contender> out;
  Colours exact;
  for (const Step& step : steps) {
    q.engine = step.engine;
    q.quality = step.quality;
    const auto filter = std::make_shared<AcuityFilter>(q);
    place->filter(*filter);
    if (step.engine == AcuityEngine::window) exact = place->out;
    Contender c;
    c.row.group = "acuity, sigma 8";
    c.row.name = step.name;
    c.row.error = error_between(p.xyz_from_rgb, exact, in_double(exact), place->out);
    c.run = {nullptr, [place, filter] { place->filter(*filter); }, place->in.size()};
    out.push_back(std::move(c));
  }
  return out;
}

}  // namespace scotopic
