// Acuity that differs over the picture: around a lamp the eye is adapted to more light, and sees more detail.
#pragma once

#include <memory>
#include <vector>

#include "stages/acuity/filter.h"

namespace scotopic {

/// What a filter with a sigma of its own for each pixel is told.
struct LocalAcuityParameters {
  /// Everything but sigma and white, which follow from what is below.
  AcuityParameters filter;
  double adaptation = 0.1;              ///< La, cd/m2; > 0
  double white_luminance = 0.1 / 0.18;  ///< cd/m2 of image value 1; > 0
  double pixels_per_degree = 60.0;      ///< > 0
};

/// The acuity filter with the sigma of each pixel's own adaptation luminance, La plus the luminance around
/// it: Gaussian mean of width 1 degree at half height, which is about the fovea (Ward Larson et al. 1997 pool
/// over one degree). Each result is mixed from those of two filters, of the next larger and smaller sigma in
/// steps of sqrt(2). Where there is no light around it equals that of AcuityFilter at La bit for bit.
/// Luminance above 1e4 times the scene's white counts as that.
class LocalAcuityFilter : public SpatialFilter {
 public:
  /// Throws std::invalid_argument where a parameter is outside its stated domain.
  explicit LocalAcuityFilter(const LocalAcuityParameters& parameters);
  ~LocalAcuityFilter() override;
  /// What is moved from can only be destroyed.
  LocalAcuityFilter(LocalAcuityFilter&&) noexcept;
  /// See above.
  LocalAcuityFilter& operator=(LocalAcuityFilter&&) noexcept;

  int halo() const noexcept override;
  void filter(const AcuityWindow& window, const AcuityTile& tile,
              const ParallelFor& parallel_for = serial_for) const override;

 private:
  class Surround;
  struct Plan;
  std::unique_ptr<const Plan> plan_;
};

}  // namespace scotopic
