// A chain of the operations that CLF, CTF and OCIO all know, as plain data.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "kernel/matrix3.h"

namespace scotopic {

/// Clamps each of R, G, B; an infinite bound is none. A NaN becomes a bound.
struct RangeStep {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// matrix * (R, G, B) + offset.
struct MatrixStep {
  Matrix3<double> matrix = identity3<double>();
  Vec3<double> offset{};
};

/// log2 x, or 2^x.
enum class LogStyle { log2, antilog2 };
/// Each of R, G, B by itself; for log2 they must be positive.
struct LogStep {
  LogStyle style = LogStyle::log2;
};

/// Linear interpolation over evenly spaced inputs 0..1, each channel its own table; inputs are clamped.
struct Lut1DStep {
  std::size_t length = 0;
  std::vector<double> values;  ///< [entry][channel]
  int decimals = 6;            ///< that files hold
};

/// Tetrahedral interpolation over a cube 0..1; inputs are clamped.
struct Lut3DStep {
  std::size_t edge = 0;
  std::vector<double> values;  ///< [red][green][blue][channel]: blue fastest, as in CLF
  int decimals = 6;
};

/// Any one of them.
using Step = std::variant<RangeStep, MatrixStep, LogStep, Lut1DStep, Lut3DStep>;

/// What a LUT file says about itself.
struct Chain {
  std::string id;
  std::string name;
  std::vector<std::string> descriptions;
  std::string input;  ///< what the numbers going in are
  std::string output;
  std::vector<std::pair<std::string, std::string>> info;
  std::vector<Step> steps;
};

/// Every number of the chain as files hold it: what is measured is what is shipped.
void round_as_written(Chain& chain);

}  // namespace scotopic
