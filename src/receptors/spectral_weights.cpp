#include "receptors/spectral_weights.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "receptors/receptor_space.h"
#include "receptors/tables.h"

namespace scotopic {
namespace {

constexpr double one_everywhere_value[] = {1.0, 1.0};
constexpr TabulatedCurve equal_energy{0.0, 1e5, one_everywhere_value};

// Simpson's rule: exact on an interval where both curves are straight lines.
long double straight_piece(const TabulatedCurve& a, const TabulatedCurve& b, double low, double high) {
  const double middle = 0.5 * (low + high);
  const long double sum = static_cast<long double>(a.at(low)) * b.at(low) +
                          4.0L * static_cast<long double>(a.at(middle)) * b.at(middle) +
                          static_cast<long double>(a.at(high)) * b.at(high);
  return sum * (static_cast<long double>(high) - low) / 6.0L;
}

// Curves bend at whole nanometres only (all tables are sampled there), so that is where pieces end.
double integral_between(const TabulatedCurve& a, const TabulatedCurve& b, double low, double high) {
  low = std::max({low, a.first_nm, b.first_nm});
  high = std::min({high, a.last_nm(), b.last_nm()});
  long double sum = 0.0L;
  while (low < high) {
    const double next = std::min(high, std::floor(low) + 1.0);
    sum += straight_piece(a, b, low, next);
    low = next;
  }
  return static_cast<double>(sum);
}

double band_weight(const BandGrid& grid, std::size_t band, BandSampling sampling, const TabulatedCurve& curve,
                   const TabulatedCurve& illuminant) {
  if (sampling == BandSampling::bin)
    return integral_between(curve, illuminant, grid.lower_edge(band), grid.upper_edge(band));
  return curve.at(grid.centre(band)) * illuminant.at(grid.centre(band)) * grid.width(band);
}

SpectralWeights weights(const BandGrid& grid, BandSampling sampling, const TabulatedCurve& illuminant) {
  SpectralWeights result;
  for (const Signal signal : all_signals) {
    const TabulatedCurve& curve = sensitivity(signal);
    std::vector<double>& of = result.of[index(signal)];
    for (std::size_t band = 0; band < grid.size(); ++band)
      of.push_back(signal_per_watt(signal) * band_weight(grid, band, sampling, curve, illuminant));
    const double inside =
        integral_between(curve, illuminant, grid.lower_edge(0), grid.upper_edge(grid.size() - 1));
    const double whole = integral_between(curve, illuminant, curve.first_nm, curve.last_nm());
    result.outside[index(signal)] = 1.0 - inside / whole;
  }
  return result;
}

}  // namespace

const TabulatedCurve& sensitivity(Signal signal) {
  switch (signal) {
    case Signal::l:
      return tables::cones_stockman_sharpe_2000_2deg_l;
    case Signal::m:
      return tables::cones_stockman_sharpe_2000_2deg_m;
    case Signal::s:
      return tables::cones_stockman_sharpe_2000_2deg_s;
    case Signal::rod:
      return tables::scotopic_cie_1951_v_prime;
    case Signal::x:
      return tables::xyz_cie_1931_2deg_x;
    case Signal::y:
      return tables::xyz_cie_1931_2deg_y;
    case Signal::z:
      break;
  }
  return tables::xyz_cie_1931_2deg_z;
}

double signal_per_watt(Signal signal) {
  return signal <= Signal::rod ? luminance_units_per_watt() : photopic_efficacy;
}

BandGrid::BandGrid(std::vector<double> centres_nm) : centres_(std::move(centres_nm)) {
  const std::size_t last = centres_.size() - 1;
  edges_.push_back(1.5 * centres_[0] - 0.5 * centres_[1]);
  for (std::size_t band = 0; band < last; ++band)
    edges_.push_back(0.5 * (centres_[band] + centres_[band + 1]));
  edges_.push_back(1.5 * centres_[last] - 0.5 * centres_[last - 1]);
}

SpectralWeights emissive_weights(const BandGrid& grid, BandSampling sampling, BandUnit unit) {
  SpectralWeights result = weights(grid, sampling, equal_energy);
  if (unit == BandUnit::per_band)
    for (std::vector<double>& of : result.of)
      for (std::size_t band = 0; band < grid.size(); ++band) of[band] /= grid.width(band);
  return result;
}

SpectralWeights reflective_weights(const BandGrid& grid, BandSampling sampling,
                                   const TabulatedCurve& illuminant) {
  SpectralWeights result = weights(grid, sampling, illuminant);
  const TabulatedCurve& v = sensitivity(Signal::y);
  const double white = photopic_efficacy * integral_between(v, illuminant, v.first_nm, v.last_nm());
  for (std::vector<double>& of : result.of)
    for (double& weight : of) weight /= white;
  return result;
}

}  // namespace scotopic
