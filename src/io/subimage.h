// One image of a file, a band of its rows, and which of its channels are colour.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "color/file/colour_tags.h"
#include "io/pixels/pixel_type.h"

namespace scotopic {

/// Pixels x0 <= x < x1, y0 <= y < y1.
struct Window {
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;

  /// Columns.
  int width() const { return x1 - x0; }
  /// Rows.
  int height() const { return y1 - y0; }
  /// The same pixels.
  bool operator==(const Window&) const = default;
};

/// A channel of a file.
struct Channel {
  std::string name;
  PixelType type = PixelType::half;
};

/// Which channels hold the light. rgb: index R, G, B. lmsr: index L, M, S, rod. grey: index[0] is luminance.
/// computed: the source makes receptor signals and XYZ of channels that are not listed (spectra).
struct ColourChannels {
  /// What they are; see above.
  enum class Kind { none, rgb, lmsr, grey, computed };
  Kind kind = Kind::none;
  std::array<std::size_t, 4> index{};
  std::optional<std::size_t> alpha;
  std::string layer;      ///< prefix of the channels' names; empty for the topmost
  bool straight = false;  ///< alpha is not multiplied into them
  bool xyz = false;       ///< of Kind::rgb: they are CIE X, Y, Z

  /// How many of `index` count.
  std::size_t count() const {
    return kind == Kind::lmsr ? 4 : kind == Kind::rgb ? 3 : kind == Kind::grey ? 1 : 0;
  }
  /// Whether a channel of the file is one of them; alpha is none.
  bool is_colour(std::size_t channel) const;
};

/// Metadata that every format can hold in one way or another.
using AttributeValue = std::variant<std::string, double, int>;
/// A piece of metadata: its name, and a text or a number.
struct Attribute {
  std::string name;
  AttributeValue value;
};

/// A part of a multi-part EXR, a page of a TIFF, or one resolution of a tiled EXR.
struct Subimage {
  int part = 0;
  int level_x = 0;
  int level_y = 0;
  std::string name;                ///< of the part, if it has one
  std::string view;                ///< of a stereo subimage, if it is one of its parts
  std::vector<std::string> views;  ///< of a stereo image in one part (multiView), the default one first
  Window data;
  Window display;
  std::vector<Channel> channels;
  /// Rows that the file compresses together: bands are best multiples of it, counted from data.y0.
  int chunk_rows = 1;
  /// Bytes per pixel that a band needs besides its channels: those of computed signals.
  std::size_t computed_bytes = 0;
  /// Bytes that the library which reads keeps for itself, as far as the header tells.
  std::int64_t library_bytes = 0;
  /// The file holds its last rows first, so bands are best read so.
  bool descending = false;
  /// False for deep or subsampled pixels, which can only be copied as they are.
  bool readable = true;
  bool panorama = false;    ///< metadata of the photograph (GPano) say that it is 360 degrees wide
  double pixel_aspect = 1;  ///< width over height of a pixel
  /// Colour values are not multiplied by alpha.
  bool unassociated_alpha = false;
  ColourTags colour;
  std::optional<double> white_luminance;  ///< attribute whiteLuminance, cd/m2
  /// What reading it changes or leaves out, one sentence each.
  std::vector<std::string> notes;
  std::optional<double> lmsr_unit;  ///< attribute scotopic:lmsrUnit, cd/m2 (docs/spectra.md)

  /// Not one of the smaller resolutions of a tiled EXR.
  bool is_full_resolution() const noexcept { return level_x == 0 && level_y == 0; }
};

/// A pixel's aspect as a header states it; 1 for what is none, or beyond 0.1 to 10.
inline double usable_aspect(double stated) { return stated >= 0.1 && stated <= 10 ? stated : 1.0; }

/// One channel of a band: row r of it starts at data + r * row_stride.
struct ChannelRows {
  std::byte* data = nullptr;
  std::ptrdiff_t stride = 0;
  std::ptrdiff_t row_stride = 0;
  PixelType type = PixelType::half;

  /// Row `r` of the band.
  NativeRow row(int r) const { return {data + r * row_stride, stride, type}; }
};

/// Rows y0 <= y < y0 + rows of a subimage, all channels, in the types of the file.
struct Band {
  int y0 = 0;
  int rows = 0;
  int width = 0;
  std::vector<ChannelRows> channels;
  /// Kind::computed only: planes of rows * width floats; L, M, S, rod, X, Y, Z (luminance units; cd/m2) per
  /// unit.
  std::array<std::vector<float>, 7> signals;
  std::vector<std::byte> storage;

  /// Room for each channel as a plane of its own.
  void allocate_planar(const std::vector<Channel>& types, int first_row, int row_count, int row_width);
  /// Room for pixels that hold all channels side by side, as they come.
  void allocate_interleaved(const std::vector<Channel>& types, int first_row, int row_count, int row_width);
};

/// Rows of one band: whole chunks, about 8 MiB, at least one chunk. Depends on the width, not on the height.
int band_rows(const Subimage& subimage);

/// Bytes of one row, all channels.
std::size_t row_bytes(const Subimage& subimage);

/// Bytes that reading the subimage and writing it again plans for: three bands (read, written, and what the
/// libraries hold of them), and the library's own.
std::int64_t planned_bytes(const Subimage& subimage);

}  // namespace scotopic
