// All that `scotopic time` sets against each other.
#pragma once

#include <memory>
#include <vector>

#include "looks/verify/evaluator_table.h"

namespace scotopic {

/// The image that evaluators are timed on: planar linear RGB, row after row.
struct TimedPicture {
  Colours pixels;
  std::size_t width = 0;

  /// Whole rows.
  std::size_t rows() const { return width > 0 ? pixels.size() / width : 0; }
};

/// A night by formula: dim ground of all hues, with lamps in it that stay photopic. In units of the white.
TimedPicture night_picture(std::size_t width, std::size_t height, const AppearanceParameters& parameters);

/// The same pixels from the start again, until there are as many rows as it takes for `pixels`.
TimedPicture repeated(const TimedPicture& picture, std::size_t pixels);

/// The picture, which must outlive it, and a copy that each run spoils and the next restores.
class Workplace {
 public:
  explicit Workplace(const TimedPicture& picture) : picture_(picture), work_(picture.pixels) {}
  std::size_t rows() const { return picture_.rows(); }
  /// The first rows; returns their pixels.
  std::size_t restore(std::size_t rows);
  PixelRows row(std::size_t y);

 private:
  const TimedPicture& picture_;
  Colours work_;
};

/// An evaluator with its error over `colours`, to be timed on all rows, or on a sixteenth of them where it is
/// a LUT.
Contender evaluator_contender(const AppearanceParameters& parameters, const EvaluatorKind& kind,
                              const std::shared_ptr<Workplace>& place, const Colours& colours);

/// The operator: scalar double, which is the reference; double and float in vectors, and on `threads`
/// threads, where more than one; LUTs through OpenColorIO; float with linear and with quadratic rods, each
/// against its own reference; on halves and on RGBA. Errors are over `colours`. The picture must outlive the
/// contenders.
std::vector<Contender> operator_contenders(const AppearanceParameters& parameters,
                                           const TimedPicture& picture, const Colours& colours, int threads);

/// Spectral bands to receptors: 1, 5 and 10 nm as bins and as points. Errors are those of what is seen of the
/// built-in illuminants at 1/4, 1 and 4 times the adaptation luminance, against 1 nm.
std::vector<Contender> spectral_contenders(const AppearanceParameters& parameters);

/// Acuity at sigma 8 pixels: cells of each quality against the exact window, on the picture's middle.
std::vector<Contender> acuity_contenders(const AppearanceParameters& parameters, const TimedPicture& picture);

}  // namespace scotopic
