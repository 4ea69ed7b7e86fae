#include "cli/report/non_finite_report.h"

namespace scotopic {

std::uint64_t report_non_finite(std::uint64_t met, const std::string& done, PixelSource& source, const ImageLayout& layout,
                                const ColourConfig& config, const Console& console) {
  if (met == 0) return 0;
  const NonFinitePixels pixels = find_non_finite(source, layout, config);
  // None, where only the smaller levels of a mip map have any.
  if (pixels.count > 0) console.note(source.file() + ": " + describe(pixels) + "; " + done);
  return pixels.count;
}

}  // namespace scotopic
