#include "looks/lut/look_chain.h"

#include <algorithm>
#include <cmath>

#include "batch/batch.h"
#include "batch/display_batch.h"
#include "looks/lut/axes.h"

namespace scotopic {
namespace {

constexpr std::size_t table_length = 4096;
constexpr double lowest_share = -24;  // log2 of the smallest share told from 0
constexpr double black_level = -200;  // log2 that antilog2 makes an exact 0 in float
constexpr double share_of_next = 4;   // log2: how far below its second entry a table's first, a 0, lies

struct Axes {
  LevelAxis level;
  ShareAxis share;

  // White of the largest component has a level of 2 * 65504 (see LookCoordinates).
  explicit Axes(const AppearanceParameters& p, std::optional<double> peak = std::nullopt)
      : level(std::max(24.0, std::log2(2 * look_limit * p.white_luminance)), peak) {}

  Vec3<double> positions(const Vec3<double>& abc) const {
    const double ab = abc[0] + abc[1], sum = ab + abc[2];
    return {share.position(ab > 0 ? abc[0] / ab : 0.5), share.position(sum > 0 ? ab / sum : 0.5),
            sum > 0 ? level.position(std::log2(sum)) : 0.0};
  }
  Vec3<double> colour(const Vec3<double>& t) const {
    const double sum = t[2] > 0 ? std::exp2(level.log2_level(t[2])) : 0.0;
    const double ab = sum * share.share(t[1]), a = ab * share.share(t[0]);
    return {a, ab - a, sum - ab};
  }
};

/// Planar rows of all nodes, through the operator and back as triplets.
class Nodes {
 public:
  explicit Nodes(std::size_t edge) : edge_(edge), r_(edge * edge * edge), g_(r_), b_(r_) {}

  double coordinate(std::size_t i) const { return static_cast<double>(i) / static_cast<double>(edge_ - 1); }

  template <typename Colour>
  void fill(Colour colour) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < edge_; ++i)
      for (std::size_t j = 0; j < edge_; ++j)
        for (std::size_t k = 0; k < edge_; ++k, ++n) {
          const Vec3<double> rgb = colour(Vec3<double>{coordinate(i), coordinate(j), coordinate(k)});
          r_[n] = static_cast<float>(rgb[0]);
          g_[n] = static_cast<float>(rgb[1]);
          b_[n] = static_cast<float>(rgb[2]);
        }
  }
  void see_under(const Lamp& lamp, const AppearanceParameters& parameters) {
    const LampOnRgb seen(lamp, parameters);
    for (std::size_t n = 0; n < size(); ++n) {
      const Vec3<double> rgb = seen((*this)[n]);
      r_[n] = static_cast<float>(rgb[0]);
      g_[n] = static_cast<float>(rgb[1]);
      b_[n] = static_cast<float>(rgb[2]);
    }
  }
  void apply(const AppearanceParameters& parameters) {
    PixelRows rows;
    rows.r = r_.data(), rows.g = g_.data(), rows.b = b_.data(), rows.count = r_.size();
    AppearanceBatch(parameters, Precision::dual).apply(rows);
  }
  // Display light per `scale`, so that what the display shows as it is stays as it was.
  void show(const NightDisplayParameters& display) {
    PixelRows rows;
    rows.r = r_.data(), rows.g = g_.data(), rows.b = b_.data(), rows.count = r_.size();
    DisplayBatch(display, Precision::dual).apply(rows);
    const double scale = display_scale(display);
    for (std::vector<float>* plane : {&r_, &g_, &b_})
      for (float& x : *plane) x = static_cast<float>(x / scale);
  }
  Vec3<double> operator[](std::size_t n) const { return {r_[n], g_[n], b_[n]}; }
  std::size_t size() const { return r_.size(); }

 private:
  std::size_t edge_;
  std::vector<float> r_, g_, b_;
};

/// Shares of nothing are undefined, but between nodes they count: those of the next node that has some.
void fill_undefined(Lut3DStep& lut) {
  const std::size_t n = lut.edge, row = 3 * n;
  for (std::size_t at = 0; at < lut.values.size();
       at += row)  // black: the shares of the lowest level above it
    for (std::size_t c = 0; c < 2; ++c) lut.values[at + c] = lut.values[at + 3 + c];
  constexpr double none = 1e-5;
  for (std::size_t i = 0; i < n; ++i)  // pure green stays pure green: no blue and red to share
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t at = 3 * (i * n * n + k);
      if (lut.values[at + 1] < none) lut.values[at] = lut.values[at + row];
    }
}

/// Its nodes hold positions on the same axes as its input does: where the operator changes nothing, neither
/// does it.
Lut3DStep core(const AppearanceParameters& p, const Axes& axes, const Matrix3<double>& abc_from_rgb,
               std::size_t edge, const std::optional<Lamp>& lamp, const NightDisplayParameters* display) {
  const Matrix3<double> rgb_from_abc = inverse(abc_from_rgb);
  Nodes nodes(edge);
  nodes.fill([&](const Vec3<double>& t) { return rgb_from_abc * axes.colour(t); });
  if (lamp) nodes.see_under(*lamp, p);
  nodes.apply(p);
  if (display) nodes.show(*display);
  Lut3DStep lut{edge, std::vector<double>(3 * nodes.size()), display ? 5 : 6};
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    Vec3<double> abc = abc_from_rgb * nodes[n];
    for (double& x : abc) x = std::max(0.0, x);
    const Vec3<double> t = axes.positions(abc);
    std::copy(t.begin(), t.end(), lut.values.begin() + static_cast<std::ptrdiff_t>(3 * n));
  }
  fill_undefined(lut);
  return lut;
}

/// Normalised log2 of shares and level -> positions.
Lut1DStep positions_table(const Axes& axes) {
  Lut1DStep lut{table_length, std::vector<double>(3 * table_length), 7};
  for (std::size_t i = 0; i < table_length; ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(table_length - 1);
    const double share = axes.share.position(std::exp2(lowest_share * (1 - s)));
    lut.values[3 * i] = lut.values[3 * i + 1] = share;
    lut.values[3 * i + 2] =
        axes.level.position(axes.level.lowest() + s * (axes.level.highest() - axes.level.lowest()));
  }
  return lut;
}

/// Positions -> log2 of shares and level.
Lut1DStep logarithms_table(const Axes& axes) {
  Lut1DStep lut{table_length, std::vector<double>(3 * table_length), 6};
  for (std::size_t i = 1; i < table_length; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(table_length - 1);
    lut.values[3 * i] = lut.values[3 * i + 1] = std::log2(axes.share.share(t));
    lut.values[3 * i + 2] = axes.level.log2_level(t);
  }
  lut.values[0] = lut.values[1] = lut.values[3] - share_of_next;
  lut.values[2] = black_level;
  return lut;
}

/// log2 of (a, a+b, a+b+c) -> log2 of the shares and the level, each scaled to 0..1.
MatrixStep normalised_differences(const Axes& axes) {
  const double s = 1 / -lowest_share;
  const double l = 1 / (axes.level.highest() - axes.level.lowest());
  return {{{{{s, -s, 0}, {0, s, -s}, {0, 0, l}}}}, {1, 1, -l * axes.level.lowest()}};
}

/// The chain around a core; `gain`: of what comes out.
Chain chain_of(const AppearanceParameters& p, const Axes& axes, std::size_t edge,
               const std::optional<Lamp>& lamp, const NightDisplayParameters* display, double gain) {
  const Matrix3<double> abc_from_rgb = p.white_luminance * (LookCoordinates::from_xyz() * p.xyz_from_rgb);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  // log2 a = log2 a/(a+b) + log2 (a+b)/(a+b+c) + log2 (a+b+c), and so on.
  constexpr Matrix3<double> sums_of_logarithms{{{{1, 1, 1}, {0, 1, 1}, {0, 0, 1}}}};

  Chain chain;
  chain.steps = {RangeStep{-look_limit, look_limit},
                 MatrixStep{abc_from_rgb, {}},
                 RangeStep{0, infinity},
                 MatrixStep{LookCoordinates::cumulative, {}},
                 LogStep{LogStyle::log2},
                 normalised_differences(axes),
                 positions_table(axes),
                 core(p, axes, abc_from_rgb, edge, lamp, display),
                 logarithms_table(axes),
                 MatrixStep{sums_of_logarithms, {}},
                 LogStep{LogStyle::antilog2},
                 MatrixStep{gain * (inverse(abc_from_rgb) * LookCoordinates::differences), {}}};
  round_as_written(chain);
  return chain;
}

}  // namespace

Chain look_chain(const AppearanceParameters& p, std::size_t edge, const std::optional<Lamp>& lamp) {
  return chain_of(p, Axes(p), edge, lamp, nullptr, 1);
}

NightDisplayParameters of_scene(const AppearanceParameters& p, NightDisplayParameters display) noexcept {
  display.adaptation = p.adaptation;
  display.white_luminance = p.white_luminance;
  display.xyz_from_rgb = p.xyz_from_rgb;
  return display;
}

Chain night_chain(const AppearanceParameters& p, const NightDisplayParameters& display, std::size_t edge,
                  const std::optional<Lamp>& lamp) {
  const NightDisplayParameters shown = of_scene(p, display);
  const double scale = display_scale(shown);
  // White of luminance L has a level of 2 L (see LookCoordinates).
  const Axes axes(p, std::log2(2 * p.white_luminance / scale));
  return chain_of(p, axes, edge, lamp, &shown, scale * shown.peak / display_white);
}

}  // namespace scotopic
