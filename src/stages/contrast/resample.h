// Rows of one level from those of another: weighted means of the samples that are there.
#pragma once

#include <array>

#include "stages/contrast/plane.h"
#include "stages/contrast/rows.h"

namespace scotopic::contrast {

/// How the rows of a result come from rows of its source.
enum class Resampling {
  halve,         ///< to the next coarser level
  double_up,     ///< to the next finer level
  blur,          ///< of the same level
  blur_squares,  ///< the same, of squares
};

/// Rows of the source, with their weights, that row y of the result is made of.
struct RowTaps {
  struct Tap {
    int y;
    float weight;
  };
  std::array<Tap, 2 * blur_reach + 1> taps{};
  int count = 0;

  /// Of a source of `size` rows; those outside it are not there.
  RowTaps(Resampling how, int y, int size);
  /// Sum of the weights: 1 but at the picture's edges. Exact.
  float weight() const;
};

/// What a row of a result is divided by where every sample of the picture is there.
class EdgeWeights {
 public:
  EdgeWeights(Resampling how, Range from, Range to);
  /// Of a row whose taps weigh `row_weight`. Where both are 1 nothing is done: x/1 is x.
  void divide(float* row, float row_weight) const;

 private:
  Plane weights_;
  int full_begin_ = 0, full_end_ = 0;  ///< columns between which the weights are 1
};

/// Rows of columns `to` from planes of columns `from`.
class Resampler {
 public:
  Resampler(Resampling how, Range from, Range to);

  /// The sum of what is there, undivided.
  void row(const Plane& source, const RowTaps& taps, float* out);
  /// After this, divide() is by the weight of what is there: `present` of the source, null where all is.
  void weigh(const Plane* present, const RowTaps& taps);
  void divide(float* out) const;
  /// Of the row last weighed, where not all was present.
  const float* weights() const { return weights_.row(0); }

 private:
  Resampling how_;
  EdgeWeights edges_;
  Plane columns_, weights_;
  float row_weight_ = 1;
  bool all_present_ = true;
};

/// The Gaussian mean of a plane's squares, over what is present.
class LocalMean {
 public:
  /// For columns x. `squares` is where squares blurred along their rows are kept.
  LocalMean(const Plane& source, const Plane* present, Range x, Plane& squares);
  /// Row y of a level of `rows` rows.
  void row(int y, int rows, float* out);

 private:
  const Plane& squares_;
  Plane weights_, weight_;  ///< of what is present, blurred along rows; of a row
  EdgeWeights edges_;
  bool all_present_;
};

}  // namespace scotopic::contrast
