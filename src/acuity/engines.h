// What the two engines share: constants of a filter, in the units in which the inner loops work.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "acuity/filter.h"

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
  float strength = 1;
  float split_variance = 0;  ///< scaled variance above which a cell is divided
  int cell = 1;              ///< side of a cell, pixels
  int block_height = 4;      ///< of the blocks 8 wide that share a list of clusters: 4 or 8
  int most_clusters = 1;     ///< per cell
  double radius = 0;         ///< reach, pixels
  AcuitySpace space = AcuitySpace::light;
};

/// Throws std::invalid_argument unless the window holds the tile and `halo` pixels around it.
void require_window(const AcuityWindow& window, const AcuityTile& tile, int halo);

/// CIELAB values farther from black than this are no colours: such pixels neither give nor take.
inline constexpr float lab_limit = 1e5f;
/// Scaled lightness that marks a pixel as absent; its weight is 0 for every pixel that is present.
inline constexpr float absent = 1e12f;

/// What is kept of a cluster, the pixels of a cell that look alike. A gain is that of the range kernel
/// widened by the cluster's own variance v: sigma_r^2/(sigma_r^2 + v).
enum ClusterField {
  cluster_x,  ///< centroid in the image, pixels
  cluster_y,
  cluster_weight,                   ///< count * sqrt(gain_l gain_a gain_b)
  cluster_lab,                      ///< 3: mean scaled CIELAB times sqrt(gain)
  cluster_light = cluster_lab + 3,  ///< 3: mean RGB
  flat_cluster_fields = cluster_light + 3,
  cluster_root = flat_cluster_fields,  ///< 3: sqrt(gain) of L, a, b
  cluster_slope =
      cluster_root + 3,  ///< 3x3: change of RGB with L, a, b times -2 weight_end variance sqrt(gain)
  cluster_fields = cluster_slope + 9,
};

/// Clusters that a block may see at most; Constants::most_clusters is chosen so that it suffices.
inline constexpr int list_capacity = 16384;

/// Clusters of a row of cells, left to right. Field f of cluster i is values[f * stride + i]; 16 floats
/// beyond a field's end may be read.
struct Clusters {
  std::ptrdiff_t stride = 0;
  std::unique_ptr<float[]> values;
  std::vector<std::uint32_t> first;  ///< cell i of the row holds clusters first[i] ... first[i+1] - 1
};

/// The cells of one row of the image-wide grid that a window touches. Most clusters are so alike that their
/// roots count as 1 and their slopes as 0: apart from the others they cost less.
struct CellRow {
  Clusters flat, spread;
};

/// Image rows with `margin` absent pixels left and right: for each row six planes of `stride` floats, scaled
/// L, a, b and linear R, G, B. One buffer, so that a place in the window is one offset.
struct LabRows {
  LabRows(int width, int margin_pixels, int row_count);
  float* row(int i) { return values.get() + static_cast<std::ptrdiff_t>(i) * 6 * stride; }
  const float* row(int i) const { return values.get() + static_cast<std::ptrdiff_t>(i) * 6 * stride; }

  int margin;
  std::ptrdiff_t stride;
  std::unique_ptr<float[]> values;
};

/// Fills `out` with the cells of grid row `row`; the window's columns decide which cells there are.
void build_cell_row(const Constants& constants, const AcuityWindow& window, int row, CellRow& out);

/// Computes rows of the tile in the block row of constants.block_height at image row `y` (a multiple of it);
/// `rows[i]` is grid row first_row + i, absent rows (outside the image) are null.
void filter_from_cells(const Constants& constants, const AcuityWindow& window, const AcuityTile& tile, int y,
                       const CellRow* const* rows, int first_row, int row_count);

/// Fills row `i` of `out` from image row `y`, which may lie outside the image: then every pixel is absent.
void build_lab_row(const Constants& constants, const AcuityWindow& window, int y, LabRows& out, int i);

/// Computes image rows y ... y + height - 1 of the tile, which are rows i ... of `rows`.
void filter_from_window(const Constants& constants, const AcuityWindow& window, const AcuityTile& tile, int y,
                        int height, const LabRows& rows, int i);

}  // namespace scotopic::acuity
