#include "looks/lut/highlights.h"

#include <cmath>

namespace scotopic {

Chain highlight_chain(const std::string& version) {
  constexpr double lowest = -24, highest = 8;  // log2 of the values told apart; beyond 2^8 the curve is at 1
  constexpr std::size_t length = 2048;
  Lut1DStep curve{length, std::vector<double>(3 * length), 9};
  for (std::size_t i = 1; i < length; ++i) {
    const double x = std::exp2(lowest + (highest - lowest) * static_cast<double>(i) / (length - 1));
    const double y = x <= 0.5 ? x : 1 - 0.5 * std::exp(1 - 2 * x);
    curve.values[3 * i] = curve.values[3 * i + 1] = curve.values[3 * i + 2] = y;
  }
  constexpr double scale = 1 / (highest - lowest);
  Chain chain;
  chain.id = "scotopic-highlight-safe";
  chain.name = "Highlight-safe";
  chain.descriptions = {"Identity up to 0.5, then 1 - 0.5 exp(1 - 2 x); each of R, G, B"};
  chain.input = "Linear Rec.709 (sRGB), white at 1";
  chain.output = "Display-linear, 0 to 1";
  chain.info = {{"Application", "scotopic"}, {"Version", version}};
  chain.steps = {RangeStep{0, 65504}, LogStep{LogStyle::log2},
                 MatrixStep{diagonal<double>({scale, scale, scale}),
                            {-lowest * scale, -lowest * scale, -lowest * scale}},
                 std::move(curve)};
  round_as_written(chain);
  return chain;
}

}  // namespace scotopic
