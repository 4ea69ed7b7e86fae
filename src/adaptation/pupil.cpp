#include "adaptation/pupil.h"

#include "adaptation/closed_forms.h"

namespace scotopic {

double pupil_diameter_mm(double adaptation) noexcept { return closed_forms::pupil_diameter_mm(adaptation); }

double trolands_per_luminance(double adaptation) noexcept {
  return closed_forms::trolands_per_luminance(adaptation);
}

}  // namespace scotopic
