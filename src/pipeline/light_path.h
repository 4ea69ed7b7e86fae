// What happens to the light of a row on its way: file to working RGB and receptors, and back to a file's
// values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "batch/batch.h"
#include "color/colour_config.h"
#include "io/picture.h"

namespace scotopic {

/// One row as the operator takes it: linear working RGB, and receptor signals where the file has them.
struct LightRow {
  /// Room for `width` pixels.
  explicit LightRow(std::size_t width)
      : r(width),
        g(width),
        b(width),
        cone_l(width),
        cone_m(width),
        cone_s(width),
        rod(width),
        alpha(width),
        touched(width) {}

  /// With receptor planes only where `receptors`.
  PixelRows pixels(bool receptors);

  std::vector<float> r, g, b, cone_l, cone_m, cone_s, rod, alpha;
  std::vector<std::uint8_t> touched;
};

/// Reads rows of one picture as light. Immutable: share it between threads.
class LightReader {
 public:
  /// `space` is that of RGB and grey channels. LMSR channels and computed signals become working RGB through
  /// XYZ: signals in luminance units, 1 of them standing for the image's unit.
  LightReader(const ColourChannels& channels, const ColourConfig& config, const ColourSpace& space);

  /// Row `row` of a band; any thread.
  void read(const Band& band, int row, LightRow& out) const;
  /// Whether rows carry the cones' and rods' own signals.
  bool receptors() const noexcept;

 private:
  void set_rgb_from_xyz(const Vec3<double>& xyz, std::size_t i, LightRow& out) const;

  ColourChannels channels_;
  RowConverter to_working_;
  Matrix3<double> working_from_xyz_;
  Matrix3<double> xyz_from_lms_;
};

/// What alpha does to colour on the way from one file format to another.
enum class AlphaChange { none, associate, unassociate };

/// Writes light as rows of three colour channels.
struct LightWriter {
  RowConverter from_working;
  float gain = 1;  ///< of exposure
  AlphaChange alpha = AlphaChange::none;
  /// Pixels that the operator left alone keep the bytes of the file, channel by channel where the types
  /// agree. True only if nothing else changes the values: same space, gain 1, alpha as it was.
  bool keep_untouched = false;

  /// Changes `light`. `out`: the channels R, G, B of one row. `source`: the channels they were read from.
  void write(LightRow& light, const NativeRow (&out)[3], const NativeRow (*source)[3]) const;
};

}  // namespace scotopic
