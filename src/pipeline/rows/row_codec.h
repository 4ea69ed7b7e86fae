// What happens to the light of a row on its way: file to working RGB and receptors, and back to a file's
// values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "batch/batch.h"
#include "color/colour_config.h"
#include "io/subimage.h"
#include "pipeline/rows/stages.h"

namespace scotopic {

/// Whether a subimage's channels are, or become, signals of cones and rods.
inline bool has_receptors(const ColourChannels& channels) noexcept {
  return channels.kind == ColourChannels::Kind::lmsr || channels.kind == ColourChannels::Kind::computed;
}

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
  std::vector<std::uint8_t> changed;  ///< where frame stages have changed light; empty: there were none
};

/// Light as matrices have it, and light.changed says which pixels; those that are not finite, or beyond
/// 2^120, pass.
void apply_matrices(const LightMatrices& matrices, bool receptors, LightRow& light);

/// Divides colour by alpha where that is a number above 0.
void divide_by_alpha(LightRow& row);

/// Reads rows of one subimage as light. Immutable: share it between threads.
class LightReader {
 public:
  /// `space` is that of RGB and grey channels. LMSR channels and computed signals become working RGB through
  /// XYZ: signals in luminance units, 1 of them standing for the image's unit. Straight alpha
  /// (`channels.straight`) is multiplied into light; what alpha was multiplied into after a curve is divided
  /// by it before that is undone.
  LightReader(const ColourChannels& channels, const ColourConfig& config, const ColourSpace& space);

  /// Row `row` of a band; any thread.
  void read(const Band& band, int row, LightRow& out) const;
  /// Whether rows carry the cones' and rods' own signals.
  bool receptors() const noexcept;

 private:
  void set_rgb_from_xyz(const Vec3<double>& xyz, std::size_t i, LightRow& out) const;

  ColourChannels channels_;
  RowConverter to_working_;
  bool encoded_ = false;
  Matrix3<double> working_from_xyz_;
  Matrix3<double> xyz_from_lms_;
};

/// Pixels of values that whole numbers from 0 to 1 do not hold; 0 for other types.
std::uint64_t clipped_pixels(const LightRow& light, PixelType type) noexcept;
/// Pixels of light where alpha is 0, which straight colour does not show; linear, times `gain` at least
/// sRGB's first code of 255.
std::uint64_t pixels_behind_alpha(const LightRow& light, float gain) noexcept;

/// Writes light as rows of three colour channels.
struct LightWriter {
  RowConverter from_working;
  float gain = 1;  ///< of exposure
  /// Light is what alpha has been multiplied into: straight values are divided by it, encoded ones before the
  /// curve.
  bool divide_by_alpha = false;
  bool multiply_by_alpha = false;  ///< encoded values, after the curve
  /// Pixels that the operator left alone keep the bytes of the file, channel by channel where the types
  /// agree. True only if nothing else changes the values: same space, gain 1, alpha as it was.
  bool keep_untouched = false;
  /// Of 8 bits: computed pixels are rounded up or down by their place; see dither_of().
  bool dither = false;

  /// Changes `light` to what is written; false: it was not needed, all of the file's bytes were kept. `out`:
  /// the channels R, G, B of one row, whose first pixel is (x, y). `source`: the channels they were read
  /// from.
  bool write(LightRow& light, const NativeRow (&out)[3], const NativeRow (*source)[3], int x, int y) const;
};

}  // namespace scotopic
