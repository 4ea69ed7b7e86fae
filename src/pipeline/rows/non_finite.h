// Pixels that are no light - NaN, infinities -: what happens to them, how many there are, and where.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "batch/batch.h"
#include "io/subimage.h"

namespace scotopic {

/// keep: such a pixel passes as it is. clean: its components that are not finite become 0, and the operator
/// sees it like any other; with receptor signals that are not finite it becomes black. error: the file is
/// refused.
enum class NonFinite { keep, clean, error };

/// Of all light at full resolution. x, y: of the first such pixel, in the coordinates of its subimage's data
/// window.
struct NonFinitePixels {
  std::uint64_t count = 0;
  int x = 0;
  int y = 0;

  /// Those of the next subimage.
  void add(const NonFinitePixels& next);
};

/// "12 pixels are not finite, the first at (3, 4)"
std::string describe(const NonFinitePixels& pixels);

/// Throws Error(ExitCode::input) if there are any.
void refuse(const NonFinitePixels& pixels, const std::string& file);

/// Numbers of the pixels with a component, of light or receptors, that is not finite; mostly none.
std::vector<std::size_t> non_finite_of(const PixelRows& rows);

/// Makes those pixels light; see NonFinite::clean.
void clean(const PixelRows& rows, const std::vector<std::size_t>& pixels);

/// Counts the bad pixels of one subimage as its rows pass, in any order, from any number of threads.
class NonFiniteTally {
 public:
  /// Of smaller resolutions nothing is counted.
  explicit NonFiniteTally(const Subimage& subimage) : counts_(subimage.is_full_resolution()) {}

  /// Pixels of a row that begins at (x, y), as non_finite_of() has them.
  void add(const std::vector<std::size_t>& pixels, int x, int y);
  /// What has passed.
  NonFinitePixels found() const;

 private:
  bool counts_;
  mutable std::mutex lock_;
  NonFinitePixels found_;
};

}  // namespace scotopic
