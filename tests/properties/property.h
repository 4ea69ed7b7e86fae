// RapidCheck under GoogleTest: a fixed number of checks, a fixed seed, and coverage that is asserted, not
// hoped for.
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "properties/regimes.h"

namespace scotopic::test {

/// A setting and a pixel; shrinks towards the default setting, and to fewer and rounder components.
struct Case {
  AppearanceParameters parameters;
  Planes planes = Planes::rgb;
  Regime regime = Regime::ordinary;
  Sample sample;
};

inline std::ostream& operator<<(std::ostream& out, const Case& c) {
  char text[300];
  std::snprintf(text, sizeof text,
                "%s, planes %d, rgb (%.9g, %.9g, %.9g) cones (%.9g, %.9g, %.9g) rod %.9g, setting ",
                name(c.regime), static_cast<int>(c.planes), c.sample.rgb[0], c.sample.rgb[1], c.sample.rgb[2],
                c.sample.cones[0], c.sample.cones[1], c.sample.cones[2], c.sample.rod);
  return out << text << to_text(c.parameters);
}

/// Counts the checks that were of a kind. A check has a kind once, however often it says so, and only when it
/// has ended: a draw that the property does not apply to (RC_PRE) is no check.
class Coverage {
 public:
  void operator()(const std::string& kind, bool yes = true) {
    if (yes) now_.insert(kind);
  }
  void begin() { now_.clear(); }
  void end() {
    ++checks_;
    for (const auto& kind : now_) ++hits_[kind];
  }
  int checks() const { return checks_; }
  int hits(const std::string& kind) const {
    const auto found = hits_.find(kind);
    return found == hits_.end() ? 0 : found->second;
  }

 private:
  std::set<std::string> now_;
  std::map<std::string, int> hits_;
  int checks_ = 0;
};

/// Kinds that must make up at least these shares of the checks.
using Shares = std::vector<std::pair<std::string, double>>;

inline std::vector<Case> simpler(const Case& c) {
  std::vector<Case> out;
  const auto with = [&](auto change) {
    Case next = c;
    change(next);
    if (to_text(next.parameters) != to_text(c.parameters) || next.planes != c.planes ||
        next.sample.rgb != c.sample.rgb || next.sample.rod != c.sample.rod)
      out.push_back(next);
  };
  const AppearanceParameters plain;
  with([](Case& x) { x.planes = Planes::rgb; });
  with([&](Case& x) { x.parameters.strength = plain.strength; });
  with([&](Case& x) { x.parameters.rods = plain.rods, x.parameters.sp_ratio = plain.sp_ratio; });
  with([&](Case& x) { x.parameters.weight = plain.weight; });
  with([&](Case& x) { x.parameters.xyz_from_gamut.reset(); });
  for (std::size_t i = 0; i < 3; ++i) {
    with([&](Case& x) { x.sample.rgb[i] = 0; });
    with([&](Case& x) {
      char text[20];
      std::snprintf(text, sizeof text, "%.1e", static_cast<double>(x.sample.rgb[i]));
      x.sample.rgb[i] = std::strtof(text, nullptr);
    });
  }
  return out;
}

/// Cases of all regimes but those left out.
inline rc::Gen<Case> cases(std::vector<Regime> without = {}) {
  return [without](const rc::Random& random, int) {
    Random draws(rc::Random(random).next());
    Case c;
    c.parameters = draw_parameters(draws);
    c.planes = draw_planes(draws);
    do c.regime = static_cast<Regime>(draws.below(regime_count));
    while (std::find(without.begin(), without.end(), c.regime) != without.end());
    c.sample = draw(c.regime, OperatorConstants(c.parameters), draws);
    return rc::shrinkable::shrinkRecur(c, [](const Case& x) { return rc::seq::fromContainer(simpler(x)); });
  };
}

/// A stream of numbers of its own for each draw; for properties of something other than a pixel.
inline rc::Gen<std::uint64_t> seeds() {
  return [](const rc::Random& random, int) { return rc::shrinkable::just(rc::Random(random).next()); };
}

inline constexpr int usual_checks = 10000;

/// Checks property(value, coverage) on values of `gen` until `checks` of them have been checked to the end;
/// what RC_PRE refuses is drawn again, at most 10 times as often as checked. Fails with the simplest
/// counterexample found, if too few values apply, or if fewer checks than required were of a kind.
/// SCOTOPIC_SEED draws others.
template <typename T, typename Property>
void for_all(const rc::Gen<T>& gen, Property property, const Shares& required, int checks = usual_checks) {
  Coverage coverage;
  rc::detail::TestParams params;
  const char* seed = std::getenv("SCOTOPIC_SEED");
  params.seed = seed ? std::strtoull(seed, nullptr, 10) : 8;
  params.maxSuccess = checks;
  params.maxDiscardRatio = 10;
  rc::detail::TestMetadata metadata;
  metadata.id = testing::UnitTest::GetInstance()->current_test_info()->name();
  const auto check = [&] {
    coverage.begin();
    property(*gen, coverage);
    coverage.end();
  };
  const auto result = rc::detail::checkTestable(check, metadata, params);
  if (!result.template is<rc::detail::SuccessResult>()) {
    std::ostringstream text;
    rc::detail::printResultMessage(result, text);
    FAIL() << text.str();
  }
  EXPECT_GE(checks, usual_checks);
  EXPECT_EQ(coverage.checks(), checks) << "a draw that was not checked to the end was counted";
  for (const auto& [kind, share] : required)
    EXPECT_GE(coverage.hits(kind), share * checks) << "too few checks were: " << kind;
}

/// Each regime but those left out in at least `share` of the checks; add what else must be covered.
inline Shares all_regimes(std::vector<Regime> without = {}, Shares more = {}, double share = 0.02) {
  for (int i = 0; i < regime_count; ++i)
    if (std::find(without.begin(), without.end(), static_cast<Regime>(i)) == without.end())
      more.emplace_back(name(static_cast<Regime>(i)), share);
  return more;
}

/// The operator by one way on one pixel.
inline std::array<float, 3> applied(const AppearanceBatch& batch, const Case& c,
                                    std::uint8_t* touched = nullptr) {
  Rows rows({c.sample});
  batch.apply(rows.view(c.planes), touched);
  return rows.rgb(0);
}

}  // namespace scotopic::test
