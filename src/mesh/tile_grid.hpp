// SPDX-License-Identifier: BSD-3-Clause
// Divides the container into tiles of about equal weight. Finds the tile and the bin of a point, and its position along
// the Hilbert curve. This file stores no points and does not use ranks.
#pragma once

#include "mesh/rules.hpp"
#include "mesh/tile_tree.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trime::mesh {

/// @brief Converts coordinates along one axis to fixed-point positions in the square of the Hilbert curve, which has
/// 2^32 positions along each side. The container has the positions first() to last(), a multiple of 2^unit_shift
/// positions. The position never decreases when the coordinate increases.
class FixedAxis {
public:
  FixedAxis() = default;
  /// @param start coordinate at which the container begins
  /// @param unit length of 2^unit_shift positions
  /// @param first_unit number of the unit at which the container begins
  /// @param units length of the container in units
  /// @pre unit > 0, and (first_unit + units) * 2^unit_shift is at most 2^32
  FixedAxis(double start, double unit, std::uint32_t first_unit, std::uint32_t units, int unit_shift, bool periodic)
      : start_(start), unit_(unit), scale_(std::ldexp(1.0, unit_shift) / unit),
        limit_(static_cast<std::uint32_t>((std::uint64_t{units} << unit_shift) - 1)), first_(first_unit << unit_shift),
        unit_shift_(unit_shift), periodic_(periodic) {}

  /// Returns the position of a coordinate, clamped to the container.
  std::uint32_t fixed(double at) const {
    const double v = (at - start_) * scale_;
    return first_ + (v <= 0 ? 0 : v >= static_cast<double>(limit_) ? limit_ : static_cast<std::uint32_t>(v));
  }
  /// Returns the position of a coordinate. If the axis is periodic, the result is not clamped: the periodic images of
  /// the container follow each other.
  std::int64_t unrolled(double at) const {
    return periodic_ ? std::int64_t{first_} + static_cast<std::int64_t>(std::floor((at - start_) * scale_)) : fixed(at);
  }
  /// Returns the coordinate at which a position begins.
  double coordinate(std::int64_t fixed) const {
    return start_ + std::ldexp(static_cast<double>(fixed - std::int64_t{first_}), -unit_shift_) * unit_;
  }
  std::int64_t first() const { return first_; }
  std::int64_t last() const { return std::int64_t{first_} + limit_; }
  /// Returns the number of positions of the container.
  std::int64_t length() const { return std::int64_t{limit_} + 1; }
  bool is_periodic() const { return periodic_; }

private:
  double start_ = 0, unit_ = 1, scale_ = 1;
  std::uint32_t limit_ = 0, first_ = 0;
  int unit_shift_ = 0;
  bool periodic_ = false;
};

/// Returns the shift of a periodic image along one axis, in periods (0, 1 or -1), from its number along this axis (0, 1
/// or 2).
constexpr int image_step(int number) {
  return number == 2 ? -1 : number;
}

/// The parameters of a TileGrid.
struct GridOptions {
  std::optional<int> cells_x,
      cells_y;                 ///< number of cells of the grid over the container; if empty, about 3.3 points per cell
  double point_spacing = 0.01; ///< typical edge length
  geometry::Periods periods{}; ///< the container is one period long along periodic axes
};

/// @brief The container lies in the middle of a square, which is the root of a quadtree; tiles are squares of the
/// quadtree. The tiles cover the container and are numbered 0..tile_count()-1 along the Hilbert curve; the bins of a
/// tile are numbered row by row. Every point of the container has a 32-bit fixed-point position along each axis. The
/// leading bits of the positions give the tile, the bin and the Hilbert key, so points in the order of their keys are
/// also in the order of their tiles.
///
/// At first all tiles have the same size, which suits the typical density. Once the density is known, set_tiles
/// replaces them by tiles of about equal weight. Memory: O(tiles) on every rank.
///
/// Along a periodic axis each tile has images outside of the container, one period away on either side. There are 9
/// images, with shifts of -1, 0 or 1 periods along each axis.
///
/// Each tile has 2^b x 2^b bins. b differs between tiles, so that bins hold a few sites even if the density varies by
/// orders of magnitude.
class TileGrid {
public:
  TileGrid(const geometry::Box& container, const GridOptions& options);

  const geometry::Box& container() const { return container_; }
  std::size_t memory_bytes() const { return tree_.memory_bytes(); }
  /// Returns the number of cells of the grid over the container, along each axis.
  GridPosition cells() const { return {static_cast<std::uint32_t>(cells_x_), static_cast<std::uint32_t>(cells_y_)}; }
  /// Returns the approximate number of points in the container if it had the typical density everywhere.
  double expected_points() const { return expected_points_; }

  LocalIndex tile_count() const { return tree_.size(); }
  const Tile& tile(LocalIndex tile) const { return tree_[tile]; }
  const std::vector<Tile>& tiles() const { return tree_.tiles(); }
  /// Returns the box of a tile, which may extend beyond the container.
  geometry::Box tile_box(LocalIndex tile) const { return box_of(rect_of(tree_[tile])); }
  /// Converts a box of fixed-point positions to domain units.
  geometry::Box box_of(const FixedRect& rect) const {
    return {{x_axis_.coordinate(rect.x0), y_axis_.coordinate(rect.y0)},
            {x_axis_.coordinate(rect.x1 + 1), y_axis_.coordinate(rect.y1 + 1)}};
  }
  geometry::Box box_of(const CurveSquare& square) const { return box_of(rect_of(mesh::tile_of(square, 0))); }
  /// Returns that point of the bins of a tile which is nearest to p.
  geometry::Vec2 nearest_in(LocalIndex tile, geometry::Vec2 p) const;
  /// Returns the shorter side of a tile in domain units.
  double side_of(LocalIndex tile) const;
  /// @brief Replaces the tiles. Data indexed by tiles or bins (points, subscriptions) must be built again afterwards.
  /// @param tiles squares that cover the container without overlap, in the order of the Hilbert curve; the same on all
  /// ranks
  void set_tiles(std::vector<Tile> tiles);
  /// Returns those quarters of a square that meet the container, in the order of the Hilbert curve.
  std::vector<CurveSquare> quarters(const CurveSquare& square) const;
  /// Returns the quadtree level of tiles for the typical density.
  int typical_level() const { return typical_level_; }
  /// Returns the quadtree level of the smallest squares that may lie partly outside of the container.
  int unit_level() const { return unit_level_; }

  /// Returns b, where a tile of the typical density has 2^b x 2^b bins with about 3.3 sites each.
  int typical_bin_bits() const { return typical_bin_bits_; }
  /// Return the number b of a tile, the number of its bins along one side (2^b), and the number of all its bins.
  int bin_bits(LocalIndex tile) const { return tree_[tile].bits; }
  int bins_per_side(LocalIndex tile) const { return 1 << bin_bits(tile); }
  int bins_per_tile(LocalIndex tile) const { return 1 << (2 * bin_bits(tile)); }
  /// Returns the largest allowed b of a tile.
  int most_bin_bits(LocalIndex tile) const { return std::min<int>(MeshRules::finest_bin_bits, tree_[tile].shift); }
  /// @brief Sets the number b of every tile. Data indexed by bins (points, subscriptions) must be built again
  /// afterwards.
  /// @pre `bits` is the same on all ranks; each element is at most most_bin_bits()
  void set_bin_bits(const std::vector<std::uint8_t>& bits);

  /// Return the conversions between coordinates and fixed-point positions.
  const FixedAxis& x_axis() const { return x_axis_; }
  const FixedAxis& y_axis() const { return y_axis_; }
  /// Returns the fixed-point positions of the container.
  FixedRect limits() const { return {x_axis_.first(), y_axis_.first(), x_axis_.last(), y_axis_.last()}; }
  /// Returns the square of half-width `reach` around a point, cut off at borders that are not periodic.
  FixedRect rect_around(geometry::Vec2 center, double reach) const {
    return {x_axis_.unrolled(center.x - reach), y_axis_.unrolled(center.y - reach), x_axis_.unrolled(center.x + reach),
            y_axis_.unrolled(center.y + reach)};
  }

  const geometry::Periods& periods() const { return periods_; }
  /// Returns the shift of a periodic image; exact for points of the coordinate lattice.
  geometry::Vec2 shift(int image) const {
    return {image_step(image % 3) * periods_.x, image_step(image / 3) * periods_.y};
  }
  /// Return the shift of a periodic image in fixed-point positions.
  std::int64_t fixed_shift_x(int image) const { return image_step(image % 3) * x_axis_.length(); }
  std::int64_t fixed_shift_y(int image) const { return image_step(image / 3) * y_axis_.length(); }
  /// @brief Calls visit(tile, image, part) for each tile, or periodic image of a tile, that meets the rectangle. `part`
  /// is the intersection of the rectangle with that image of the container, shifted back into the container.
  /// @pre the rectangle extends at most one period beyond the container
  template <class Visit>
  void for_each_in(const FixedRect& rect, const Visit& visit) const;

  /// The tile and the bin of a point.
  struct TileBin {
    LocalIndex tile;
    int bin;
  };
  TileBin place(geometry::Vec2 p) const {
    const std::uint32_t x = x_axis_.fixed(p.x), y = y_axis_.fixed(p.y);
    const LocalIndex tile = tree_.find(x, y);
    return {tile, bin_at(x, y, tree_[tile].bits, tree_[tile].shift)};
  }
  LocalIndex tile_at(geometry::Vec2 p) const { return tree_.find(x_axis_.fixed(p.x), y_axis_.fixed(p.y)); }
  /// Returns the tile at a fixed-point position of the container.
  LocalIndex tile_at(std::int64_t x, std::int64_t y) const {
    return tree_.find(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
  }
  /// Returns the number of the bin that contains a point, if its tile has 2^bits x 2^bits bins.
  int bin_at(geometry::Vec2 p, LocalIndex tile, int bits) const {
    return bin_at(x_axis_.fixed(p.x), y_axis_.fixed(p.y), bits, tree_[tile].shift);
  }
  /// Returns the Hilbert key of a point with 32 bits per axis. The points of the mesh are ordered by this key; points
  /// with equal keys are ordered by coordinates.
  std::uint64_t point_key(geometry::Vec2 p) const { return hilbert_key(x_axis_.fixed(p.x), y_axis_.fixed(p.y), 32); }

private:
  static int bin_at(std::uint32_t x, std::uint32_t y, int bits, int tile_shift) {
    const int shift = tile_shift - bits, mask = (1 << bits) - 1;
    return (static_cast<int>(y >> shift) & mask) << bits | (static_cast<int>(x >> shift) & mask);
  }
  void set_axes();
  void choose_typical(double spacing);
  void add_tiles(const CurveSquare& square, std::vector<Tile>& tiles) const;

  geometry::Box container_;
  geometry::Periods periods_;
  int cells_x_ = 1, cells_y_ = 1;
  double expected_points_ = 1;
  int unit_level_ = 5, typical_level_ = 1, typical_bin_bits_ = 4;
  FixedAxis x_axis_, y_axis_;
  TileTree tree_;
};

template <class Visit>
void TileGrid::for_each_in(const FixedRect& rect, const Visit& visit) const {
  const FixedRect here = limits();
  if (here.contains(rect)) {
    tree_.for_each_in(rect, [&](LocalIndex tile) { visit(tile, 0, rect); });
    return;
  }
  for (int iy = 0; iy < (y_axis_.is_periodic() ? 3 : 1); ++iy)
    for (int ix = 0; ix < (x_axis_.is_periodic() ? 3 : 1); ++ix) {
      const int image = ix + 3 * iy;
      const FixedRect part = common_part(here, rect.moved(-fixed_shift_x(image), -fixed_shift_y(image)));
      if (!part.is_empty())
        tree_.for_each_in(part, [&](LocalIndex tile) { visit(tile, image, part); });
    }
}

/// The tiles [first, last) of a grid.
struct TileRange {
  const TileGrid& grid;
  LocalIndex first, last;
};

/// Returns the largest number of sites in a tile of a mesh with this number of points.
std::int64_t most_per_tile(double points);

/// Tiles and their weights.
struct WeightedTiles {
  std::vector<Tile> tiles; ///< in the order of the Hilbert curve
  std::vector<std::int64_t> weights;
  bool divided = false; ///< true if some tiles were divided: then the caller must find the weights of their quarters
};

/// @brief Joins and divides tiles so that each becomes the largest square with a weight of at most `most`. One call
/// divides a tile only once, because the weights of its quarters are not known; after repeated calls the result does
/// not depend on the initial tiles. Cost: O(tiles).
/// @param weights the weight of each tile of the grid
WeightedTiles fit_tiles(const TileGrid& grid, std::span<const std::int64_t> weights, std::int64_t most);

} // namespace trime::mesh
