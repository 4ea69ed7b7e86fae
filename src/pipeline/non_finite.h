// Pixels that are no light - NaN, infinities -: what happens to them, how many there are, and where.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "pipeline/apply_image.h"

namespace scotopic {

/// keep: such a pixel passes as it is. clean: its components that are not finite become 0, and the operator sees it
/// like any other; with receptor signals that are not finite it becomes black. error: the file is refused.
enum class NonFinite { keep, clean, error };

/// Counts them as rows pass, from any number of threads, and cleans them if asked to.
class NonFiniteWatch {
 public:
  /// What to do with such pixels.
  explicit NonFiniteWatch(NonFinite policy) : policy_(policy), count_(std::make_shared<std::atomic<std::uint64_t>>(0)) {}

  /// `apply`, watched; stays valid after the watch is gone. Empty, where there is nothing to apply and nothing to clean:
  /// then the file's bytes may go through, and apply_image counts.
  RowOperator watched(RowOperator apply) const;

  /// Pixels seen since.
  std::uint64_t count() const noexcept { return *count_; }

 private:
  NonFinite policy_;
  std::shared_ptr<std::atomic<std::uint64_t>> count_;
};

/// Pixels with a component, of light or receptors, that is not finite.
std::uint64_t count_non_finite(const PixelRows& rows);

/// Of all light at full resolution. x, y: of the first such pixel, in the coordinates of its picture's data window.
struct NonFinitePixels {
  std::uint64_t count = 0;
  int x = 0;
  int y = 0;
};

/// One pass over the file.
NonFinitePixels find_non_finite(PixelSource& source, const ImageLayout& layout, const ColourConfig& config);

/// "12 pixels are not finite, the first at (3, 4)"
std::string describe(const NonFinitePixels& pixels);

/// Throws Error(ExitCode::input) for a file that holds any.
void refuse_non_finite(PixelSource& source, const ImageLayout& layout, const ColourConfig& config);

}  // namespace scotopic
