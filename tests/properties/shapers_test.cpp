// The functions of one variable of a look: OpenColorIO's logarithms as a look uses them, and the axes of its
// LUT.
#include <OpenColorIO/OpenColorIO.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "looks/lut/axes.h"
#include "looks/chain/ocio_chain.h"
#include "properties/one_variable.h"

namespace scotopic::test {
namespace {

namespace OCIO = OCIO_NAMESPACE;
using std::exp, std::exp2, std::log2;

// One step of a look on OpenColorIO's CPU processor.
double by_ocio(LogStyle style, float x) {
  const auto made = [](LogStyle log) {
    Chain chain;
    chain.steps = {LogStep{log}};
    return cpu_processor(ocio_transform(chain), OCIO::Config::CreateRaw());
  };
  static const OCIO::ConstCPUProcessorRcPtr forward = made(LogStyle::log2),
                                            inverse = made(LogStyle::antilog2);
  float rgb[3] = {x, x, x};
  (style == LogStyle::log2 ? forward : inverse)->applyRGB(rgb);
  return rgb[1];
}

template <typename Real>
Real exact_log2(const Real& x) {
  return log2(x);
}
template <typename Real>
Real exact_exp2(const Real& x) {
  return exp2(x);
}

Extended ulp_of_float_at_1(Extended x) { return spacing(std::max(1.0L, std::abs(x)), 24, -126); }

// Of levels, which begin at -80.
Extended ulp_of_80(Extended) { return 0x1p-46L; }

// An axis as bake/axes.h has it: the integral of a density by midpoints, 2^14 - 1 steps, straight between
// them.
template <typename Real>
class ExactAxis {
 public:
  template <typename Density>
  ExactAxis(double low, double high, Density density)
      : low_(low), step_((Real(high) - Real(low)) / Real(steps)) {
    table_.emplace_back(0);
    for (int i = 0; i < steps; ++i)
      table_.push_back(table_.back() + density(Real(low_ + step_ * (Real(i) + Real(0.5)))));
    const Real total = table_.back();
    for (auto& t : table_) t = t / total;
  }
  Real position(const Real& x) const {
    const Real at = (x - low_) / step_;
    if (!(at > Real(0))) return Real(0);
    if (at >= Real(steps)) return Real(1);
    const auto i = static_cast<std::size_t>(static_cast<double>(at));
    return table_[i] + (at - Real(static_cast<double>(i))) * (table_[i + 1] - table_[i]);
  }
  Real inverse(const Real& t) const {
    std::size_t i = 0, above = steps;
    while (above - i > 1) {
      const std::size_t middle = (i + above) / 2;
      (table_[middle] > t ? above : i) = middle;
    }
    return low_ + step_ * (Real(static_cast<double>(i)) + (t - table_[i]) / (table_[i + 1] - table_[i]));
  }

 private:
  static constexpr int steps = (1 << 14) - 1;
  Real low_, step_;
  std::vector<Real> table_;
};

// Nodes per stop: a root of 5.4 below 2^-8, even, a root of 2.5 above 2^6, a bump at 2^5.2, a floor of a
// tenth.
template <typename Real>
Real level_density(const Real& x) {
  static const Real dark_root = decimal<Real>("5.4"), bright_root = decimal<Real>("2.5"),
                    bend = decimal<Real>("5.2"), width = decimal<Real>("0.7"), height = decimal<Real>("1.5"),
                    tenth = decimal<Real>("0.1");
  const Real one(1), root = exp2(Real((x + Real(8)) / dark_root)), off = (x - bend) / width;
  const Real even = one / (one / root + one + exp2(Real((x - Real(6)) / bright_root)));
  return even * (one + height * exp(Real(-(off * off) / Real(2)))) + tenth * (root < one ? root : one);
}
template <typename Real>
Real share_density(const Real& u) {
  static const Real reach = decimal<Real>("0.05");
  const Real one(1);
  return one + reach / (u + reach) + reach / (one - u + reach);
}

constexpr double brightest = 24;
template <typename Real>
const ExactAxis<Real>& level_axis() {
  static const ExactAxis<Real> axis(-80, brightest, level_density<Real>);
  return axis;
}
template <typename Real>
const ExactAxis<Real>& share_axis() {
  static const ExactAxis<Real> axis(0, 1, share_density<Real>);
  return axis;
}
template <typename Real>
Real exact_level_position(const Real& x) {
  return level_axis<Real>().position(x);
}
template <typename Real>
Real exact_level(const Real& t) {
  return level_axis<Real>().inverse(t);
}
template <typename Real>
Real exact_share_position(const Real& u) {
  return share_axis<Real>().position(u);
}
template <typename Real>
Real exact_share(const Real& t) {
  return share_axis<Real>().inverse(t);
}

const LevelAxis level(brightest);
const ShareAxis share;

const Function functions[] = {
    {"look_log2", 0x1p-126f, 3.4e38f, 1, [](float x) { return by_ocio(LogStyle::log2, x); },
     exact_log2<Extended>, exact_log2<Mp>, ulp_of_float_at_1},
    {"look_antilog2", -80, 24, 1, [](float x) { return by_ocio(LogStyle::antilog2, x); },
     exact_exp2<Extended>, exact_exp2<Mp>, ulp_of_float},
    {"level_position", -80, 24, 64, [](float x) { return level.position(static_cast<double>(x)); },
     exact_level_position<Extended>, exact_level_position<Mp>, ulp_at_1},
    {"level_of_position", 0, 1, 64, [](float t) { return level.log2_level(static_cast<double>(t)); },
     exact_level<Extended>, exact_level<Mp>, ulp_of_80},
    {"share_position", 0, 1, 32, [](float u) { return share.position(static_cast<double>(u)); },
     exact_share_position<Extended>, exact_share_position<Mp>, ulp_at_1},
    {"share_of_position", 0, 1, 32, [](float t) { return share.share(static_cast<double>(t)); },
     exact_share<Extended>, exact_share<Mp>, ulp_at_1},
};

TEST_P(OneVariable, every_float_is_within_its_function_s_bound) { expect_within_bound(GetParam()); }

TEST_P(OneVariable, its_judge_agrees_with_256_bits_to_a_hundredth_of_an_ulp) {
  expect_sound_judge(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Look, OneVariable, testing::ValuesIn(functions),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace scotopic::test
