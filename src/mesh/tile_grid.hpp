// SPDX-License-Identifier: BSD-3-Clause
// The container and its tiles: where a point lies, in which tile and bin, when the Hilbert curve comes there, and
// tiles of about equal weight. Geometry only: it holds no points and knows nothing of ranks.
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

/// @brief Fixed-point positions along one axis of the square of the Hilbert curve, which has 2^32 positions a side. The
/// container has the positions first() to last(), a multiple of 2^unit_shift positions. A larger coordinate never has a
/// smaller position.
class FixedAxis {
public:
  FixedAxis() = default;
  /// @param start coordinate where the container begins @param unit length of 2^unit_shift positions
  /// @param first_unit, units where the container begins, and its length, in units @pre unit > 0, (first_unit + units)
  /// * 2^unit_shift at most 2^32
  FixedAxis(double start, double unit, std::uint32_t first_unit, std::uint32_t units, int unit_shift, bool periodic)
      : start_(start), unit_(unit), scale_(std::ldexp(1.0, unit_shift) / unit),
        limit_(static_cast<std::uint32_t>((std::uint64_t{units} << unit_shift) - 1)), first_(first_unit << unit_shift),
        unit_shift_(unit_shift), periodic_(periodic) {}

  /// Returns the position of a coordinate, clamped to the container.
  std::uint32_t fixed(double at) const {
    const double v = (at - start_) * scale_;
    return first_ + (v <= 0 ? 0 : v >= static_cast<double>(limit_) ? limit_ : static_cast<std::uint32_t>(v));
  }
  /// Returns the position of a coordinate. It is not clamped if the axis is periodic, where images of the container
  /// follow each other.
  std::int64_t unrolled(double at) const {
    return periodic_ ? std::int64_t{first_} + static_cast<std::int64_t>(std::floor((at - start_) * scale_)) : fixed(at);
  }
  /// Returns the coordinate where a position begins.
  double coordinate(std::int64_t fixed) const {
    return start_ + std::ldexp(static_cast<double>(fixed - std::int64_t{first_}), -unit_shift_) * unit_;
  }
  std::int64_t first() const { return first_; }
  std::int64_t last() const { return std::int64_t{first_} + limit_; }
  /// Number of positions of the container.
  std::int64_t length() const { return std::int64_t{limit_} + 1; }
  bool is_periodic() const { return periodic_; }

private:
  double start_ = 0, unit_ = 1, scale_ = 1;
  std::uint32_t limit_ = 0, first_ = 0;
  int unit_shift_ = 0;
  bool periodic_ = false;
};

/// Returns the shift in periods along one axis, 0, 1 or -1, of an image with the number 0, 1 or 2 along this axis.
constexpr int image_step(int number) {
  return number == 2 ? -1 : number;
}

/// The parameters of a grid.
struct GridOptions {
  std::optional<int> cells_x, cells_y; ///< cells of the container grid; if empty, about 3.3 points per cell
  double point_spacing = 0.01;         ///< typical edge length
  geometry::Periods periods{};         ///< periods of the container, which is one period long along periodic axes
};

/// @brief A square with the container in its middle is the root of a quadtree, and tiles are squares of that quadtree.
/// They cover the container and are numbered 0..tile_count()-1 along the Hilbert curve; the bins of one tile are
/// numbered row by row. Every point of the container has a 32-bit fixed-point position per axis. Tile, bin and Hilbert
/// key are its leading bits, so the numbering of tiles is a prefix of the order of points.
///
/// At first all tiles are equally large and suit the typical density. Once the density is known, set_tiles replaces
/// them by tiles of about equal weight. O(tiles) memory, replicated on every rank.
///
/// Along a periodic axis each tile has images outside the container, one period away on either side. There are 9
/// images, with shifts of -1, 0 or 1 periods along each axis.
///
/// Each tile has 2^b x 2^b bins. b differs between tiles, so bins hold a few sites even if the density varies by orders
/// of magnitude.
class TileGrid {
public:
  TileGrid(const geometry::Box& container, const GridOptions& options);

  const geometry::Box& container() const { return container_; }
  std::size_t memory_bytes() const { return tree_.memory_bytes(); }
  /// Returns the number of cells of the container grid along each axis.
  GridPosition cells() const { return {static_cast<std::uint32_t>(cells_x_), static_cast<std::uint32_t>(cells_y_)}; }
  /// Returns about how many points the container holds at the typical density.
  double expected_points() const { return expected_points_; }

  LocalIndex tile_count() const { return tree_.size(); }
  const Tile& tile(LocalIndex tile) const { return tree_[tile]; }
  const std::vector<Tile>& tiles() const { return tree_.tiles(); }
  /// Returns the box of a tile, which may reach beyond the container.
  geometry::Box tile_box(LocalIndex tile) const { return box_of(rect_of(tree_[tile])); }
  /// Returns the box of fixed-point positions in domain units.
  geometry::Box box_of(const FixedRect& rect) const {
    return {{x_axis_.coordinate(rect.x0), y_axis_.coordinate(rect.y0)},
            {x_axis_.coordinate(rect.x1 + 1), y_axis_.coordinate(rect.y1 + 1)}};
  }
  geometry::Box box_of(const CurveSquare& square) const { return box_of(rect_of(mesh::tile_of(square, 0))); }
  /// Returns a place in the bin of the tile that is nearest to p.
  geometry::Vec2 nearest_in(LocalIndex tile, geometry::Vec2 p) const;
  /// Returns the shorter side of a tile in domain units.
  double side_of(LocalIndex tile) const;
  /// @brief Replaces the tiles. Data indexed by tiles or bins (points, subscriptions) must be built again.
  /// @param tiles cover the container, without overlap, in the order of the curve; the same on all ranks
  void set_tiles(std::vector<Tile> tiles);
  /// Returns the quarters of a square that meet the container, in the order of the curve.
  std::vector<CurveSquare> quarters(const CurveSquare& square) const;
  /// Level of tiles that suit the typical density.
  int typical_level() const { return typical_level_; }
  /// Level of the smallest squares that may lie partly outside the container.
  int unit_level() const { return unit_level_; }

  /// A tile of the typical density has 2^b x 2^b bins with about 3.3 sites each; this is b.
  int typical_bin_bits() const { return typical_bin_bits_; }
  /// Bins of a tile: b, their number along one side (2^b), and their number.
  int bin_bits(LocalIndex tile) const { return tree_[tile].bits; }
  int bins_per_side(LocalIndex tile) const { return 1 << bin_bits(tile); }
  int bins_per_tile(LocalIndex tile) const { return 1 << (2 * bin_bits(tile)); }
  /// Returns the largest possible b of a tile.
  int most_bin_bits(LocalIndex tile) const { return std::min<int>(MeshRules::finest_bin_bits, tree_[tile].shift); }
  /// @brief Sets the b of every tile. Data indexed by bins (points, subscriptions) must be built again.
  /// @pre `bits` is the same on all ranks; each is at most most_bin_bits()
  void set_bin_bits(const std::vector<std::uint8_t>& bits);

  /// Convert coordinates to fixed-point positions.
  const FixedAxis& x_axis() const { return x_axis_; }
  const FixedAxis& y_axis() const { return y_axis_; }
  /// Returns the positions of the container.
  FixedRect limits() const { return {x_axis_.first(), y_axis_.first(), x_axis_.last(), y_axis_.last()}; }
  /// Returns the square of half-width `reach` around a point, cut at borders that are not periodic.
  FixedRect rect_around(geometry::Vec2 center, double reach) const {
    return {x_axis_.unrolled(center.x - reach), y_axis_.unrolled(center.y - reach), x_axis_.unrolled(center.x + reach),
            y_axis_.unrolled(center.y + reach)};
  }

  const geometry::Periods& periods() const { return periods_; }
  /// Returns by how much an image is shifted; exact for lattice points.
  geometry::Vec2 shift(int image) const {
    return {image_step(image % 3) * periods_.x, image_step(image / 3) * periods_.y};
  }
  /// Return the shift of an image in fixed-point positions.
  std::int64_t fixed_shift_x(int image) const { return image_step(image % 3) * x_axis_.length(); }
  std::int64_t fixed_shift_y(int image) const { return image_step(image / 3) * y_axis_.length(); }
  /// @brief Calls visit(tile, image, part) for each tile, or image of a tile, that meets the rectangle. `part` is the
  /// intersection of the rectangle with the image of the container, shifted back into the container. @pre the rectangle
  /// reaches at most one period beyond the container
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
  /// Returns the bin of a point in its tile, which has 2^bits x 2^bits bins.
  int bin_at(geometry::Vec2 p, LocalIndex tile, int bits) const {
    return bin_at(x_axis_.fixed(p.x), y_axis_.fixed(p.y), bits, tree_[tile].shift);
  }
  /// Returns the Hilbert key of a point with 32 bits per axis. The mesh orders points by this key, and equal keys by
  /// coordinates.
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

/// Returns the largest number of sites in a tile, if the mesh has `points` points.
std::int64_t most_per_tile(double points);

/// Tiles and their weights.
struct WeightedTiles {
  std::vector<Tile> tiles; ///< in the order of the curve
  std::vector<std::int64_t> weights;
  bool divided = false; ///< some tiles were divided: the caller must find the weights of their quarters
};

/// @brief Joins and divides tiles so that each becomes the largest square that weighs at most `most`. One call divides
/// a tile only once, because the weights of its quarters are not known; repeated calls give a result that does not
/// depend on the first tiles. O(tiles).
/// @param weight of each tile of the grid
WeightedTiles fit_tiles(const TileGrid& grid, std::span<const std::int64_t> weights, std::int64_t most);

} // namespace trime::mesh
