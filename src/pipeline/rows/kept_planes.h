// Rods and local luminance of a row, for stages that come after the operator.
#pragma once

#include <vector>

#include "pipeline/rows/light_path.h"
#include "pipeline/rows/stages.h"
#include "stages/shared/parameters.h"

namespace scotopic {

/// Works them out of the light that the operator saw, in double, rounded once. Immutable.
class PlaneKeeper {
 public:
  explicit PlaneKeeper(const AppearanceParameters& parameters);

  /// Of `light`, whose rods are taken where `receptors`. What is returned points into `rod` and `local`.
  KeptPlanes planes(const LightRow& light, bool receptors, std::vector<float>& rod,
                    std::vector<float>& local) const;

 private:
  AppearanceParameters parameters_;
  double rod_per_luminance_;
};

}  // namespace scotopic
