#include "stages/contrast/resample.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace scotopic::contrast {

namespace {

/// Along columns alone: `out` holds the columns of the source.
void sum_columns(const RowTaps& taps, const Plane& source, float* out) {
  std::array<WeightedRow, 2 * blur_reach + 1> rows{};
  const auto count = static_cast<std::size_t>(taps.count);
  for (std::size_t i = 0; i < count; ++i) rows[i] = {source.row(taps.taps[i].y), taps.taps[i].weight};
  sum_rows({rows.data(), count}, out, source.width());
}

/// Along a row alone, from a row with source columns `from` to columns `to`.
void resample_row(Resampling how, const float* in, Range from, Range to, float* out) {
  switch (how) {
    case Resampling::halve:
      return halve_row(in + (2 * to.begin - from.begin), out, to.size());
    case Resampling::double_up:
      return double_row(in + (to.begin / 2 - from.begin), out, to.size());
    case Resampling::blur:
      return blur_row(BlurOf::values, in + (to.begin - from.begin), out, to.size());
    case Resampling::blur_squares:
      return blur_row(BlurOf::squares, in + (to.begin - from.begin), out, to.size());
  }
}

void blur_along(Resampling how, const Plane& source, Plane& out) {
  for (int y = out.y().begin; y < out.y().end; ++y)
    resample_row(how, source.row(y), source.x(), out.x(), out.row(y));
}

}  // namespace

RowTaps::RowTaps(Resampling how, int y, int size) {
  const auto add = [&](int at, float weight) {
    if (at >= 0 && at < size) taps[static_cast<std::size_t>(count++)] = {at, weight};
  };
  if (how == Resampling::halve) {
    constexpr float binomial[] = {0.0625f, 0.25f, 0.375f, 0.25f, 0.0625f};
    for (int i = 0; i < 5; ++i) add(2 * y + i - 2, binomial[i]);
  } else if (how == Resampling::double_up && y % 2 == 0) {
    add(y / 2 - 1, 0.125f);
    add(y / 2, 0.75f);
    add(y / 2 + 1, 0.125f);
  } else if (how == Resampling::double_up) {
    add(y / 2, 0.5f);
    add(y / 2 + 1, 0.5f);
  } else {
    for (int i = -blur_reach; i <= blur_reach; ++i) add(y + i, blur_taps[std::abs(i)]);
  }
}

float RowTaps::weight() const {
  float sum = 0;
  for (int i = 0; i < count; ++i) sum += taps[static_cast<std::size_t>(i)].weight;
  return sum;
}

EdgeWeights::EdgeWeights(Resampling how, Range from, Range to) : weights_(to, {0, 1}) {
  Plane ones(from, {0, 1});
  ones.fill(1.0f);
  resample_row(how, ones.row(0), from, to, weights_.row(0));
  const float* const w = weights_.row(0);
  full_end_ = to.size();
  while (full_begin_ < full_end_ && w[full_begin_] != 1.0f) ++full_begin_;
  while (full_end_ > full_begin_ && w[full_end_ - 1] != 1.0f) --full_end_;
}

void EdgeWeights::divide(float* row, float row_weight) const {
  const float* const w = weights_.row(0);
  const int width = weights_.width();
  if (row_weight != 1.0f) return divide_row(row, w, row_weight, width);
  for (int x = 0; x < full_begin_; ++x) row[x] = w[x] > 0.0f ? row[x] / w[x] : 0.0f;
  for (int x = full_end_; x < width; ++x) row[x] = w[x] > 0.0f ? row[x] / w[x] : 0.0f;
}

Resampler::Resampler(Resampling how, Range from, Range to)
    : how_(how), edges_(how, from, to), columns_(from, {0, 1}), weights_(to, {0, 1}) {}

void Resampler::row(const Plane& source, const RowTaps& taps, float* out) {
  sum_columns(taps, source, columns_.row(0));
  resample_row(how_, columns_.row(0), source.x(), weights_.x(), out);
}

void Resampler::weigh(const Plane* present, const RowTaps& taps) {
  all_present_ = present == nullptr;
  row_weight_ = taps.weight();
  if (present) row(*present, taps, weights_.row(0));
}

void Resampler::divide(float* out) const {
  if (all_present_) return edges_.divide(out, row_weight_);
  divide_row(out, weights_.row(0), 1.0f, weights_.width());
}

LocalMean::LocalMean(const Plane& source, const Plane* present, Range x, Plane& squares)
    : squares_(squares), edges_(Resampling::blur, source.x(), x), all_present_(present == nullptr) {
  squares.reshape(x, source.y());
  blur_along(Resampling::blur_squares, source, squares);
  if (all_present_) return;
  weight_ = Plane(x, {0, 1});
  weights_.reshape(x, source.y());
  blur_along(Resampling::blur, *present, weights_);
}

void LocalMean::row(int y, int rows, float* out) {
  const RowTaps taps(Resampling::blur, y, rows);
  sum_columns(taps, squares_, out);
  if (all_present_) return edges_.divide(out, taps.weight());
  sum_columns(taps, weights_, weight_.row(0));
  divide_row(out, weight_.row(0), 1.0f, weight_.width());
}

}  // namespace scotopic::contrast
