// What the two engines share: constants of a filter, in the units in which the inner loops work.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "stages/acuity/filter.h"

namespace scotopic::acuity {

/// exp(-x) is taken as ((c1 + (c2 + c3 u) u) u)^8 with u = max(0, 1 - x/weight_end): zero, not small, beyond
/// weight_end, so that nothing far away in colour leaks in. Least-squares fit; |error| <= 6.6e-5 for x >= 0.
inline constexpr double weight_end = 14.75;

/// CIELAB in units in which the range kernel is exp(-weight_end |difference|^2): one multiplication less.
struct Constants {
  float f_from_rgb[3][3] = {};   ///< rows X/Xn, Y/Yn, Z/Zn
  float rgb_from_f3[3][3] = {};  ///< its inverse
  float lab_scale = 0;           ///< scaled = lab_scale * CIELAB
  float space_scale = 0;         ///< 1/(2 sigma^2 weight_end)
  float pixel_aspect = 1;
  float strength = 1;
  float split_variance = 0;  ///< scaled variance above which a cell is divided
  float per_pitch = 0;       ///< scaled CIELAB to steps of the lattice whose colours a palette merges
  float rarity = 1;          ///< of colours that a palette drops: palette-inl.h
  int cell = 1;              ///< side of a cell, pixels
  int block_width = 8;       ///< of the blocks that have a palette; a multiple of 8
  int block_height = 8;
  int most_clusters = 1;  ///< per cell
  double radius = 0;      ///< reach, pixels; of cells from a block's middle
  AcuitySpace space = AcuitySpace::light;
};

/// Throws std::invalid_argument unless the window holds the tile and `halo` pixels around it.
void require_window(const AcuityWindow& window, const AcuityTile& tile, int halo);

/// CIELAB values farther from black than this are no colours: such pixels neither give nor take.
inline constexpr float lab_limit = 1e5f;
/// Scaled lightness that marks a pixel as absent; its weight is 0 for every pixel that is present.
inline constexpr float absent = 1e12f;

/// Means of the pixels of a cell that look alike, of what is averaged.
enum Mean {
  mean_x,  ///< place in the image, pixels
  mean_y,
  mean_lab,                  ///< 3: scaled CIELAB
  mean_light = mean_lab + 3  ///< 3: X/Xn, Y/Yn, Z/Zn
};
/// What is kept of the pixels of a cell that look alike.
struct alignas(32) Cluster {
  float means[8];
  /// Of what means has at the same place; those of L, a, b are used.
  float variances[8];
};

/// The clusters of a row of cells of the image-wide grid, left to right. Arrays of floats have room for 16
/// more than there are clusters.
struct CellRow {
  std::vector<Cluster> clusters;
  std::vector<float> x, y, count;     ///< the first two as in means; number of pixels
  std::vector<std::uint64_t> colour;  ///< the place of the mean CIELAB in the lattice
  std::vector<std::uint32_t> first;   ///< cell i of the row holds clusters first[i] ... first[i+1] - 1
};

/// Image rows with `margin` absent pixels left and right: for each row six planes of `stride` floats, scaled
/// L, a, b and linear R, G, B. One buffer, so that a place in the window is one offset.
struct LabRows {
  /// Room for `row_count` rows of `width` pixels and the margins.
  LabRows(int width, int margin_pixels, int row_count);
  /// First plane of row `i`, at its left margin.
  float* row(int i) { return values.get() + static_cast<std::ptrdiff_t>(i) * 6 * stride; }
  /// The same, to read.
  const float* row(int i) const { return values.get() + static_cast<std::ptrdiff_t>(i) * 6 * stride; }

  int margin;
  std::ptrdiff_t stride;
  std::unique_ptr<float[]> values;
};

/// Fills `out` with the cells of grid row `row`; the window's columns decide which cells there are.
void build_cell_row(const Constants& constants, const AcuityWindow& window, int row, CellRow& out);

/// Computes the part of the tile that lies in blocks begin ... end - 1, from the left of the image, of the
/// row of blocks at image row `y`, a multiple of their height; `rows[i]` is grid row first_row + i.
void filter_from_cells(const Constants& constants, const AcuityWindow& window, const AcuityTile& tile, int y,
                       int begin, int end, const CellRow* const* rows, int first_row, int row_count);

/// Fills row `i` of `out` from image row `y`, which may lie outside the image: then every pixel is absent.
void build_lab_row(const Constants& constants, const AcuityWindow& window, int y, LabRows& out, int i);

/// Computes image rows y ... y + height - 1 of the tile, which are rows i ... of `rows`.
void filter_from_window(const Constants& constants, const AcuityWindow& window, const AcuityTile& tile, int y,
                        int height, const LabRows& rows, int i);

}  // namespace scotopic::acuity
