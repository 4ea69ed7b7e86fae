// What a filter knows before it sees a picture; for the files of this room alone.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>

#include "stages/glare/filter.h"
#include "stages/glare/picture_rows.h"
#include "stages/glare/pyramid/ladder.h"

namespace scotopic::glare {

/// See above.
struct Plan {
  /// Parameters are taken to lie in their domains.
  explicit Plan(const GlareParameters& p)
      : parameters(p),
        function(p.eye),
        ladder(function, p.grid),
        threshold(static_cast<float>(p.threshold)) {}

  /// Of the picture.
  int width() const { return parameters.grid.width; }
  /// See above.
  int height() const { return parameters.grid.height; }

  GlareParameters parameters;
  GlareFunction function;
  Ladder ladder;
  float threshold;
};

/// Row y of a picture.
inline PictureRow row_of(const GlarePicture& picture, int y) {
  PictureRow out{};
  for (std::size_t k = 0; k < 3; ++k) out.rgb[k] = picture.rgb[k] + y * picture.stride;
  for (std::size_t k = 0; k < picture.light.size(); ++k) out.light[k] = picture.light[k] + y * picture.stride;
  return out;
}

/// Whether the picture knows that no pixel of row y is above the threshold.
inline bool known_below(const Plan& plan, const GlarePicture& picture, int y) {
  return picture.greatest != nullptr && picture.greatest[y] <= plan.threshold;
}

/// Whether there is a finite pixel with v > threshold.
bool any_above(const Plan& plan, const GlarePicture& picture, const ParallelFor& parallel_for);

/// Finite pixels with v > threshold.
std::ptrdiff_t count_above(const Plan& plan, const GlarePicture& picture, const ParallelFor& parallel_for);

/// Least and greatest excess of each plane, over finite pixels; least > greatest where there is none.
struct Extremes {
  Extremes();
  /// Widens them.
  void add(std::size_t plane, float least_value, float greatest_value);
  /// The value between them that is nearest to 0: what is left of a flat picture is 0.
  float constant(std::size_t plane) const;
  /// Whether no plane has two values.
  bool flat() const;
  /// Whether the constant of each of the first `planes` planes is 0 whatever else is added.
  bool hold_zero(std::size_t planes) const;

  std::array<float, most_light> least, greatest;
};

/// What is taken from each plane's excess so that a flat picture has none; nothing where no plane has two
/// values.
using Constants = std::array<float, most_light>;
std::optional<Constants> constants(const Plan& plan, const GlarePicture& picture,
                                   const ParallelFor& parallel_for);

/// Of what scatters.
Extremes extremes(const Plan& plan, const GlarePicture& picture, const ParallelFor& parallel_for);

/// Runs task(band, first row, end) over bands of `rows` rows.
void for_bands(int height, int rows, const ParallelFor& parallel_for,
               const std::function<void(int, int, int)>& task);

/// Throws std::invalid_argument unless there are 1 to 7 planes, all given.
void check_subimage(const Plan& plan, const GlarePicture& picture);

/// How the plan takes planes.
Excess excess_of(const Plan& plan, const GlarePicture& picture);

}  // namespace scotopic::glare
