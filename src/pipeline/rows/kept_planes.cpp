#include "pipeline/rows/kept_planes.h"

#include <algorithm>

#include "receptors/receptor_space.h"
#include "receptors/rods.h"

namespace scotopic {

PlaneKeeper::PlaneKeeper(const AppearanceParameters& parameters)
    : parameters_(parameters), rod_per_luminance_(rod_signal_per_scotopic_luminance()) {}

KeptPlanes PlaneKeeper::planes(const LightRow& light, bool receptors, std::vector<float>& rod,
                               std::vector<float>& local) const {
  const AppearanceParameters& p = parameters_;
  const double unit = p.weight == Weight::local ? p.white_luminance : 0.0;
  rod.resize(light.r.size());
  local.resize(light.r.size());
  for (std::size_t i = 0; i < light.r.size(); ++i) {
    const Vec3<double> xyz = p.xyz_from_rgb * Vec3<double>{light.r[i], light.g[i], light.b[i]};
    local[i] = static_cast<float>(p.adaptation + std::max(0.0, unit * xyz[1]));
    rod[i] =
        receptors
            ? light.rod[i]
            : static_cast<float>(rod_per_luminance_ * scotopic_luminance_from_xyz(xyz, p.rods, p.sp_ratio));
  }
  return {rod.data(), local.data()};
}

}  // namespace scotopic
