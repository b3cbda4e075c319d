// SPDX-License-Identifier: BSD-3-Clause
// The container and its tiles: where a point lies, in which tile and bin, and when the Hilbert curve comes there.
// Geometry only: it holds no points and knows nothing of ranks.
#pragma once

#include "mesh/fixed_axis.hpp"
#include "mesh/rules.hpp"
#include "mesh/tile_tree.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace trime::mesh {

/// The step along one axis, in periods, to an image with the number 0, 1 or 2 along it: 0, 1 or -1.
constexpr int image_step(int number) {
  return number == 2 ? -1 : number;
}

/// The parameters of a grid.
struct GridOptions {
  std::optional<int> cells_x, cells_y; ///< container grid; empty: about 3.3 points a cell
  double point_spacing = 0.01;         ///< typical edge length
  geometry::Periods periods{};         ///< of the container, which is one period long along periodic axes
};

/// @brief A square with the container in its middle is divided into quarters, these again, and so on; tiles are squares
/// of that quadtree. They cover the container and are numbered 0..tile_count()-1 along the Hilbert curve; bins of one
/// tile row by row. Every point of the container has a 32-bit fixed-point position per axis. Tile, bin and Hilbert key
/// are its leading bits, so the numbering of tiles is a prefix of the order of points.
///
/// At first all tiles are equally large, for the typical density. Where more is known, set_tiles gives tiles of about
/// equal weight. O(tiles) memory, replicated on every rank.
///
/// Along a periodic axis each tile has images outside of the container, one period away on either side. An image is one
/// of 9 shifts by (-1, 0, 1) periods along each axis.
///
/// Each tile has 2^b x 2^b bins, with a different b in each tile, so that bins hold a few sites also where the density
/// varies by orders of magnitude.
class TileGrid {
public:
  TileGrid(const geometry::Box& container, const GridOptions& options);

  const geometry::Box& container() const { return container_; }
  std::size_t memory_bytes() const { return tree_.memory_bytes(); }
  /// Cells of the container grid along each axis.
  GridPosition cells() const { return {static_cast<std::uint32_t>(cells_x_), static_cast<std::uint32_t>(cells_y_)}; }
  /// Number of points that are expected, about, at the typical density all over the container.
  double expected_points() const { return expected_points_; }

  LocalIndex tile_count() const { return tree_.size(); }
  const Tile& tile(LocalIndex tile) const { return tree_[tile]; }
  const std::vector<Tile>& tiles() const { return tree_.tiles(); }
  /// Box of a tile; it may reach beyond the container.
  geometry::Box tile_box(LocalIndex tile) const { return box_of(rect_of(tree_[tile])); }
  /// Where positions lie.
  geometry::Box box_of(const FixedRect& rect) const {
    return {{x_axis_.coordinate(rect.x0), y_axis_.coordinate(rect.y0)},
            {x_axis_.coordinate(rect.x1 + 1), y_axis_.coordinate(rect.y1 + 1)}};
  }
  geometry::Box box_of(const CurveSquare& square) const { return box_of(rect_of(mesh::tile_of(square, 0))); }
  /// A place in a tile, in that of its bins which is nearest to p.
  geometry::Vec2 nearest_in(LocalIndex tile, geometry::Vec2 p) const;
  /// The shorter side of a tile, domain units.
  double side_of(LocalIndex tile) const;
  /// @brief Replaces the tiles. Data indexed by tiles or bins (points, subscriptions) must be built again.
  /// @param tiles cover the container, without overlap, in the order of the curve; the same on all ranks
  void set_tiles(std::vector<Tile> tiles);
  /// Returns the quarters of a square that meet the container, in the order of the curve.
  std::vector<CurveSquare> quarters(const CurveSquare& square) const;
  /// The level of tiles that suit the typical density.
  int typical_level() const { return typical_level_; }
  /// The level of the smallest squares that may lie half in the container.
  int unit_level() const { return unit_level_; }

  /// The b of a tile of the typical density: 2^b x 2^b bins with about 3.3 sites each.
  int typical_bin_bits() const { return typical_bin_bits_; }
  /// The b of a tile, its bins along one side, and all of them.
  int bin_bits(LocalIndex tile) const { return tree_[tile].bits; }
  int bins_per_side(LocalIndex tile) const { return 1 << bin_bits(tile); }
  int bins_per_tile(LocalIndex tile) const { return 1 << (2 * bin_bits(tile)); }
  /// Largest b possible in a tile.
  int most_bin_bits(LocalIndex tile) const { return std::min<int>(MeshRules::finest_bin_bits, tree_[tile].shift); }
  /// @brief Sets the b of every tile. Data indexed by bins (points, subscriptions) must be built again.
  /// @pre the same on all ranks; each at most most_bin_bits()
  void set_bin_bits(const std::vector<std::uint8_t>& bits);

  /// From coordinates to fixed-point positions.
  const FixedAxis& x_axis() const { return x_axis_; }
  const FixedAxis& y_axis() const { return y_axis_; }
  /// The positions of the container.
  FixedRect limits() const { return {x_axis_.first(), y_axis_.first(), x_axis_.last(), y_axis_.last()}; }
  /// The square of half-width `reach` around a point; without what lies beyond borders that are not periodic.
  FixedRect rect_around(geometry::Vec2 center, double reach) const {
    return {x_axis_.unrolled(center.x - reach), y_axis_.unrolled(center.y - reach), x_axis_.unrolled(center.x + reach),
            y_axis_.unrolled(center.y + reach)};
  }

  const geometry::Periods& periods() const { return periods_; }
  /// By how much an image is moved; exact for lattice points.
  geometry::Vec2 shift(int image) const {
    return {image_step(image % 3) * periods_.x, image_step(image / 3) * periods_.y};
  }
  /// Does the same in fixed-point positions.
  std::int64_t fixed_shift_x(int image) const { return image_step(image % 3) * x_axis_.length(); }
  std::int64_t fixed_shift_y(int image) const { return image_step(image / 3) * y_axis_.length(); }
  /// @brief Calls visit(tile, image, part) for each tile, or image of one, that meets a rectangle, at most one period
  /// out of the container; `part` is what the rectangle has in the container that the image repeats, before its shift.
  template <class Visit>
  void for_each_in(const FixedRect& rect, const Visit& visit) const;

  /// Tile and bin of a point.
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
  /// The tile at a fixed-point position of the container.
  LocalIndex tile_at(std::int64_t x, std::int64_t y) const {
    return tree_.find(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
  }
  /// The bin of a point in its tile, for a tile of 2^bits x 2^bits bins.
  int bin_at(geometry::Vec2 p, LocalIndex tile, int bits) const {
    return bin_at(x_axis_.fixed(p.x), y_axis_.fixed(p.y), bits, tree_[tile].shift);
  }
  /// Hilbert key of a point to 32 bits per axis: the canonical order of the mesh, ties lexicographic.
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

} // namespace trime::mesh
