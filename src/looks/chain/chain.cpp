#include "looks/chain/chain.h"

#include <cmath>

namespace scotopic {
namespace {

/// As files have it: never -0.
double rounded(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  return std::nearbyint(value * scale) / scale + 0.0;
}

struct Rounding {
  void operator()(RangeStep&) const {}
  void operator()(MatrixStep&) const {}  // written in full
  void operator()(LogStep&) const {}
  void operator()(Lut1DStep& lut) const {
    for (double& v : lut.values) v = rounded(v, lut.decimals);
  }
  void operator()(Lut3DStep& lut) const {
    for (double& v : lut.values) v = rounded(v, lut.decimals);
  }
};

}  // namespace

void round_as_written(Chain& chain) {
  for (Step& step : chain.steps) std::visit(Rounding{}, step);
}

}  // namespace scotopic
