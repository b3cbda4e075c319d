// SPDX-License-Identifier: BSD-3-Clause
// The container grid: cells, tiles (the size of blocks of cells) numbered along a Hilbert curve, bins inside a tile.
// Geometry only: it holds no points and knows nothing of ranks.
#pragma once

#include "core/hilbert.hpp"
#include "mesh/fixed_axis.hpp"
#include "mesh/rules.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/periods.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace trime::mesh {

/// The step along one axis, in periods, to an image with the number 0, 1 or 2 along it: 0, 1 or -1.
constexpr int image_step(int number) {
  return number == 2 ? -1 : number;
}

/// What the grid is made of.
struct GridOptions {
  std::optional<int> cells_x, cells_y; ///< container grid; empty: about 3.3 points a cell
  double point_spacing = 0.01;         ///< typical edge length, for the sizes that are not given
  bool graded = false; ///< the density varies: more and smaller tiles, so that a dense one is no large share of all
  geometry::Periods periods{}; ///< of the container, which is one period long along periodic axes
};

/// @brief Tiles are numbered 0..tile_count()-1 in Hilbert order; bins of one tile row by row. Every point of the
/// container has a 32-bit fixed-point position per axis. Tile, bin and Hilbert key are its leading bits, so the
/// numbering of tiles is a prefix of the order of points. O(tiles) memory, replicated on every rank.
///
/// Equally large tiles divide the container. Along a periodic axis each tile has images beside the container, one
/// period away on either side: an image is one of 9 shifts by (-1, 0, 1) periods along each axis, 0 being none.
///
/// Each tile has 2^b x 2^b bins with a b of its own, so that bins hold a few sites where the density varies by orders
/// of magnitude. Only b ever changes, by set_bin_bits.
class TileGrid {
public:
  TileGrid(const geometry::Box& container, const GridOptions& options);

  const geometry::Box& container() const { return container_; }
  LocalIndex tile_count() const { return static_cast<LocalIndex>(tile_position_.size()); }
  std::size_t memory_bytes() const {
    return tile_number_.capacity() * sizeof(LocalIndex) + tile_position_.capacity() * sizeof(GridPosition) +
           bin_bits_.capacity();
  }
  int tiles_x() const { return tiles_x_; }
  int tiles_y() const { return tiles_y_; }
  /// Cells of the container grid along each axis.
  GridPosition cells() const { return {static_cast<std::uint32_t>(cells_x_), static_cast<std::uint32_t>(cells_y_)}; }
  /// Tile number at column x, row y of the tile grid.
  LocalIndex tile_at(int x, int y) const { return tile_number_[static_cast<std::size_t>(y) * tiles_x_ + x]; }
  GridPosition tile_position(LocalIndex tile) const { return tile_position_[at(tile)]; }
  /// @brief The tile in the square of the Hilbert curve. Along each axis the grid lies in the middle of its own power
  /// of two. So halves and quarters of a square's curve are halves and quarters of the container. A slender container
  /// is not cut along its length.
  GridPosition curve_position(LocalIndex tile) const {
    const GridPosition at = tile_position(tile);
    return {at.x + curve_offset_.x, at.y + curve_offset_.y};
  }
  geometry::Box tile_box(LocalIndex tile) const;

  /// The b of a tile of the typical density: 2^b x 2^b bins with about 3.3 sites each.
  int typical_bin_bits() const { return typical_bin_bits_; }
  /// The b of a tile, its bins along one side, and all of them.
  int bin_bits(LocalIndex tile) const { return bin_bits_[at(tile)]; }
  int bins_per_side(LocalIndex tile) const { return 1 << bin_bits(tile); }
  int bins_per_tile(LocalIndex tile) const { return 1 << (2 * bin_bits(tile)); }
  /// Largest b possible.
  int most_bin_bits() const { return std::min(MeshRules::finest_bin_bits, tile_shift_); }
  /// @brief Sets the b of every tile. Whatever counts in bins (points, subscriptions) must be built anew.
  /// @pre the same on all ranks; each at most most_bin_bits()
  void set_bin_bits(std::vector<std::uint8_t> bits);

  /// From coordinates to fixed-point positions.
  const FixedAxis& x_axis() const { return x_axis_; }
  const FixedAxis& y_axis() const { return y_axis_; }
  /// Column (or row) in the tile grid of a fixed-point position.
  int tile_of(std::int64_t position) const { return static_cast<int>(position >> tile_shift_); }
  /// Column (or row) of the bin inside its tile, for a tile of 2^bits x 2^bits bins.
  int bin_of(std::int64_t position, int bits) const {
    return static_cast<int>(position >> (tile_shift_ - bits)) & ((1 << bits) - 1);
  }
  /// The side of a tile is 2^tile_shift() in fixed-point positions.
  int tile_shift() const { return tile_shift_; }

  const geometry::Periods& periods() const { return periods_; }
  /// Images of a tile that may be told apart: 9, or 1 in a container without periods.
  int images() const { return periods_.any() ? 9 : 1; }
  /// By how much an image is moved; exact for lattice points.
  geometry::Vec2 shift(int image) const {
    return {image_step(image % 3) * periods_.x, image_step(image / 3) * periods_.y};
  }
  /// Tile at an unrolled column and row, at most one period out of the container, and the image of it that lies there.
  struct TileImage {
    LocalIndex tile;
    std::int32_t image;
  };
  TileImage tile_image_at(int x, int y) const {
    const int ix = x < 0 ? 2 : x >= tiles_x_ ? 1 : 0, iy = y < 0 ? 2 : y >= tiles_y_ ? 1 : 0;
    return {tile_at(x - image_step(ix) * tiles_x_, y - image_step(iy) * tiles_y_), ix + 3 * iy};
  }

  /// Tile and bin of a point.
  struct TileBin {
    LocalIndex tile;
    int bin;
  };
  TileBin place(geometry::Vec2 p) const {
    const LocalIndex tile = tile_at(p);
    return {tile, bin_at(p, bin_bits(tile))};
  }
  LocalIndex tile_at(geometry::Vec2 p) const {
    return tile_at(tile_of(x_axis_.fixed(p.x)), tile_of(y_axis_.fixed(p.y)));
  }
  /// The bin of a point in its tile, for a tile of 2^bits x 2^bits bins.
  int bin_at(geometry::Vec2 p, int bits) const {
    return (bin_of(y_axis_.fixed(p.y), bits) << bits) | bin_of(x_axis_.fixed(p.x), bits);
  }
  /// Hilbert key of a point to 32 bits per axis: the canonical order of the mesh, ties lexicographic.
  std::uint64_t point_key(geometry::Vec2 p) const {
    return hilbert_key(x_axis_.fixed(p.x) + (curve_offset_.x << tile_shift_),
                       y_axis_.fixed(p.y) + (curve_offset_.y << tile_shift_), 32);
  }

private:
  void choose_tiles(const GridOptions& options);
  void set_fixed_point();

  geometry::Box container_;
  geometry::Periods periods_;
  int cells_x_ = 1, cells_y_ = 1, tiles_x_ = 1, tiles_y_ = 1;
  int typical_bin_bits_ = 4, curve_level_ = 1, tile_shift_ = 32;
  FixedAxis x_axis_, y_axis_;
  double tile_width_ = 1, tile_height_ = 1;
  GridPosition curve_offset_{};             // of the first tile in the square of the curve
  std::vector<LocalIndex> tile_number_;     // by row and column
  std::vector<GridPosition> tile_position_; // by tile number
  std::vector<std::uint8_t> bin_bits_;      // by tile number
};

} // namespace trime::mesh
