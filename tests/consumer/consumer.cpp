// Uses the installed headers and libraries: one pixel through the operator, one colour config.
#include <cstdio>

#include "stages/reference.h"
#include "color/base_config.h"

int main() {
  scotopic::AppearanceParameters parameters;
  parameters.adaptation = 0.01;
  parameters.white_luminance = 0.01 / 0.18;
  const scotopic::Vec3<double> red_xyz = {0.4124, 0.2126, 0.0193};
  const auto seen = scotopic::AppearanceReference(parameters)({red_xyz});
  std::printf("Y %.4f -> %.4f, %d spaces\n", red_xyz[1], seen[1],
              scotopic::make_base_config()->getNumColorSpaces());
  return seen[1] < red_xyz[1] ? 0 : 1;
}
