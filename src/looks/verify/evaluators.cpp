#include "looks/verify/evaluators.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

#include "batch/batch.h"
#include "stages/shared/colour_difference.h"
#include "stages/reference.h"
#include "stages/limits.h"
#include "looks/lut/look_chain.h"
#include "looks/chain/ocio_chain.h"
#include "base/error.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

constexpr std::size_t worst_kept = 3;

/// Whether the operator leaves a pixel alone, by the same arithmetic as it has in float.
class Untouched {
 public:
  explicit Untouched(const AppearanceParameters& p)
      : y_{static_cast<float>(p.xyz_from_rgb[1][0]), static_cast<float>(p.xyz_from_rgb[1][1]),
           static_cast<float>(p.xyz_from_rgb[1][2])},
        unit_(p.weight == Weight::local ? static_cast<float>(p.white_luminance) : 0.0f),
        adaptation_(static_cast<float>(p.adaptation)),
        never_photopic_(p.model == Model::safko2019) {}

  bool operator()(float r, float g, float b) const {
    constexpr auto limit = static_cast<float>(operable_limit);
    const bool operable = std::abs(r) <= limit && std::abs(g) <= limit && std::abs(b) <= limit;
    const float y = y_[0] * r + y_[1] * g + y_[2] * b;
    const bool dim = adaptation_ + std::max(0.0f, unit_ * y) < static_cast<float>(photopic_limit);
    return !(operable && (dim || never_photopic_));
  }

 private:
  Vec3<float> y_;
  float unit_, adaptation_;
  bool never_photopic_;
};

/// A row through OpenColorIO, in blocks that stay in the nearest cache.
class LutOperator {
 public:
  LutOperator(const AppearanceParameters& parameters, OCIO::ConstCPUProcessorRcPtr processor)
      : untouched_(parameters), processor_(std::move(processor)) {}

  void operator()(const PixelRows& rows, std::uint8_t* touched) const {
    for (std::size_t at = 0; at < rows.count; at += most)
      block(rows, at, std::min(most, rows.count - at), touched);
  }

 private:
  static constexpr std::size_t most = 1024;

  void block(const PixelRows& rows, std::size_t at, std::size_t count, std::uint8_t* touched) const {
    float out[3][most];
    float* const planes[3] = {rows.r + at, rows.g + at, rows.b + at};
    for (std::size_t c = 0; c < 3; ++c) std::copy_n(planes[c], count, out[c]);
    OCIO::PlanarImageDesc image(out[0], out[1], out[2], nullptr, static_cast<long>(count), 1);
    processor_->apply(image);
    for (std::size_t i = 0; i < count; ++i) {
      const bool keep = untouched_(planes[0][i], planes[1][i], planes[2][i]);
      if (touched) touched[at + i] = keep ? 0 : 1;
      if (keep) continue;
      for (std::size_t c = 0; c < 3; ++c) planes[c][i] = out[c][i];
    }
  }

  Untouched untouched_;
  OCIO::ConstCPUProcessorRcPtr processor_;
};

RowOperator exact_operator(const AppearanceParameters& parameters, Precision precision) {
  const auto batch = std::make_shared<AppearanceBatch>(parameters, precision);
  return [batch](const PixelRows& rows, std::uint8_t* touched) { batch->apply(rows, touched); };
}

double ulp(double exact) {
  const float near = std::abs(static_cast<float>(exact));
  return static_cast<double>(std::nextafter(near, std::numeric_limits<float>::infinity())) -
         static_cast<double>(near);
}

Vec3<double> pixel(const Colours& c, std::size_t i) { return {c.r[i], c.g[i], c.b[i]}; }

double largest(const Vec3<double>& v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }

void keep_worst(std::vector<WorstPixel>& worst, const WorstPixel& candidate) {
  const auto at = std::find_if(worst.begin(), worst.end(),
                               [&](const WorstPixel& w) { return w.error < candidate.error; });
  worst.insert(at, candidate);
  if (worst.size() > worst_kept) worst.pop_back();
}

}  // namespace

const EvaluatorKind& evaluator_named(std::string_view name) {
  for (const EvaluatorKind& kind : evaluator_kinds)
    if (kind.name == name) return kind;
  throw Error(ExitCode::internal, "", "no way of computing is called " + std::string(name));
}

PreparedEvaluator prepare_evaluator(const AppearanceParameters& parameters, const EvaluatorKind& kind) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  PreparedEvaluator out;
  if (kind.edge == 0) {
    out.apply = exact_operator(parameters, kind.name == "double" ? Precision::dual : Precision::single);
  } else {
    const Chain chain = look_chain(parameters, kind.edge);
    for (const Step& step : chain.steps) {
      if (const auto* lut = std::get_if<Lut3DStep>(&step)) out.bytes += lut->values.size() * sizeof(float);
      if (const auto* lut = std::get_if<Lut1DStep>(&step)) out.bytes += lut->values.size() * sizeof(float);
    }
    out.apply = LutOperator(parameters, cpu_processor(ocio_transform(chain), OCIO::Config::CreateRaw()));
  }
  out.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return out;
}

ErrorStatistics statistics_of(std::vector<double> values) {
  if (values.empty()) return {};
  double sum = 0;
  for (const double v : values) sum += v;
  const auto p99 = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 99 / 100);
  std::nth_element(values.begin(), p99, values.end());
  return {sum / static_cast<double>(values.size()), *p99, *std::max_element(p99, values.end())};
}

EvaluatorError error_between(const Matrix3<double>& xyz_from_rgb, const Colours& in,
                             const std::vector<Vec3<double>>& expected, const Colours& got) {
  std::vector<double> differences, pixels, components;
  EvaluatorError out;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Vec3<double> from = pixel(in, i), is = pixel(got, i), should = expected[i];
    double absolute = 0, ulps = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      absolute = std::max(absolute, std::abs(is[c] - should[c]));
      ulps = std::max(ulps, std::abs(is[c] - should[c]) / ulp(should[c]));
    }
    const double size = std::max(largest(from), largest(should));
    const double relative = size > 0 ? absolute / size : absolute;
    differences.push_back(exposed_difference(xyz_from_rgb * should, xyz_from_rgb * is));
    pixels.push_back(relative);
    components.push_back(ulps);
    if (out.worst.size() < worst_kept || relative > out.worst.back().error)
      keep_worst(out.worst, {from, should, is, relative});
  }
  out.difference = statistics_of(std::move(differences));
  out.pixel = statistics_of(std::move(pixels));
  out.component = statistics_of(std::move(components));
  return out;
}

EvaluatorError evaluator_error(const AppearanceParameters& parameters, const Colours& in,
                               const Colours& got) {
  const AppearanceReference reference(parameters);
  std::vector<Vec3<double>> expected;
  for (std::size_t i = 0; i < in.size(); ++i) expected.push_back(reference({pixel(in, i)}));
  return error_between(parameters.xyz_from_rgb, in, expected, got);
}

EvaluatorError evaluator_error(const AppearanceParameters& parameters, const RowOperator& kind,
                               const Colours& in) {
  Colours got = in;
  kind(rows_of(got), nullptr);
  return evaluator_error(parameters, in, got);
}

}  // namespace scotopic
