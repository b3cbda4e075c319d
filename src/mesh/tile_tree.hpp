// SPDX-License-Identifier: BSD-3-Clause
// Finds the tile at a point of the container. Tiles are squares of a quadtree, numbered along a Hilbert curve.
#pragma once

#include "core/hilbert.hpp"
#include "trime/core/types.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace trime::mesh {

/// A square of the quadtree with its bins. The place and the size of a tile are fixed-point numbers in a square with
/// 2^32 positions along each side.
struct Tile {
  std::uint32_t x, y; ///< lowest positions of the tile, multiples of its side
  std::uint8_t shift; ///< the side of the tile is 2^shift positions, at most 2^31
  std::uint8_t bits;  ///< the tile has 2^bits x 2^bits bins

  std::int64_t side() const { return std::int64_t{1} << shift; }
  int level() const { return 32 - shift; }
  /// Returns the base-2 logarithm of the side of a bin.
  int bin_shift() const { return shift - bits; }
  int bins() const { return 1 << (2 * bits); }
  /// Return the first and the last column of bins that meet the positions x0 .. x1, and the first and the last row for
  /// y0 .. y1.
  int first_column(std::int64_t x0) const { return static_cast<int>(std::max<std::int64_t>(0, x0 - x) >> bin_shift()); }
  int last_column(std::int64_t x1) const { return static_cast<int>(std::min(side() - 1, x1 - x) >> bin_shift()); }
  int first_row(std::int64_t y0) const { return static_cast<int>(std::max<std::int64_t>(0, y0 - y) >> bin_shift()); }
  int last_row(std::int64_t y1) const { return static_cast<int>(std::min(side() - 1, y1 - y) >> bin_shift()); }
  CurveSquare on_curve() const { return curve_square(x >> shift, y >> shift, level()); }
};

inline Tile tile_of(const CurveSquare& square, int bits) {
  const int shift = 32 - square.level;
  return {square.x << shift, square.y << shift, static_cast<std::uint8_t>(shift), static_cast<std::uint8_t>(bits)};
}

/// A rectangle of the positions x0 .. x1 and y0 .. y1, with both ends included.
struct FixedRect {
  std::int64_t x0, y0, x1, y1;

  bool is_empty() const { return x0 > x1 || y0 > y1; }
  bool contains(const FixedRect& r) const { return x0 <= r.x0 && y0 <= r.y0 && r.x1 <= x1 && r.y1 <= y1; }
  bool meets(const FixedRect& r) const { return x0 <= r.x1 && r.x0 <= x1 && y0 <= r.y1 && r.y0 <= y1; }
  FixedRect grown(std::int64_t by) const { return {x0 - by, y0 - by, x1 + by, y1 + by}; }
  FixedRect moved(std::int64_t x, std::int64_t y) const { return {x0 + x, y0 + y, x1 + x, y1 + y}; }
};

inline FixedRect common_part(const FixedRect& a, const FixedRect& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}
inline FixedRect rect_of(const Tile& tile) {
  return {tile.x, tile.y, tile.x + tile.side() - 1, tile.y + tile.side() - 1};
}

/// @brief Finds the tile at a position. Tiles are squares that cover a rectangle without overlap, in the order of the
/// Hilbert curve. A table of equal cells leads to a tile, or to a tree if the tiles there are smaller than a cell.
/// Memory: 12 bytes for each tile, and 4 to 16 bytes in the table.
class TileTree {
public:
  TileTree() = default;
  /// @param limits the rectangle that the tiles cover; each tile meets it
  /// @param tiles in the order of the Hilbert curve
  TileTree(const FixedRect& limits, std::vector<Tile> tiles);

  std::size_t memory_bytes() const {
    return tiles_.capacity() * sizeof(Tile) + (directory_.capacity() + children_.capacity()) * sizeof(std::int32_t);
  }
  LocalIndex size() const { return static_cast<LocalIndex>(tiles_.size()); }
  const std::vector<Tile>& tiles() const { return tiles_; }
  const Tile& operator[](LocalIndex tile) const { return tiles_[static_cast<std::size_t>(tile)]; }
  void set_bits(LocalIndex tile, std::uint8_t bits) { tiles_[static_cast<std::size_t>(tile)].bits = bits; }

  /// Returns the tile at a position.
  /// @pre the position lies within the limits
  LocalIndex find(std::uint32_t x, std::uint32_t y) const {
    std::int32_t entry = directory_[cell(x >> cell_shift_, y >> cell_shift_)];
    for (int shift = cell_shift_ - 1; entry < 0; --shift)
      entry = children_[child(entry, x >> shift & 1, y >> shift & 1)];
    return entry;
  }
  /// Calls visit(tile) once for each tile that meets a rectangle.
  /// @pre the rectangle is within the limits
  template <class Visit>
  void for_each_in(const FixedRect& rect, const Visit& visit) const;

private:
  std::size_t cell(std::uint32_t column, std::uint32_t row) const {
    return static_cast<std::size_t>(row - first_row_) * columns_ + (column - first_column_);
  }
  static std::size_t child(std::int32_t entry, std::uint32_t right, std::uint32_t upper) {
    return 4 * static_cast<std::size_t>(~entry) + 2 * upper + right;
  }
  template <class Visit>
  void visit_children(std::int32_t entry, std::int64_t x, std::int64_t y, int shift, const FixedRect& rect,
                      const Visit& visit) const;
  void choose_cells(const FixedRect& limits);
  void enter(LocalIndex number);

  std::vector<Tile> tiles_;
  int cell_shift_ = 31;
  std::uint32_t first_column_ = 0, first_row_ = 0;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<std::int32_t> directory_; // for each cell, a tile, or the bitwise complement of an index into children_
  std::vector<std::int32_t> children_;  // entries as in directory_; four for each square that is divided
};

template <class Visit>
void TileTree::for_each_in(const FixedRect& rect, const Visit& visit) const {
  const auto column_of = [&](std::int64_t x) { return static_cast<std::uint32_t>(x >> cell_shift_); };
  for (std::uint32_t row = column_of(rect.y0); row <= column_of(rect.y1); ++row)
    for (std::uint32_t column = column_of(rect.x0); column <= column_of(rect.x1); ++column) {
      const std::int32_t entry = directory_[cell(column, row)];
      if (entry < 0) {
        visit_children(entry, std::int64_t{column} << cell_shift_, std::int64_t{row} << cell_shift_, cell_shift_ - 1,
                       rect, visit);
        continue;
      }
      const Tile& tile =
          tiles_[static_cast<std::size_t>(entry)]; // a tile is visited only from its first cell in the rectangle
      if (column == column_of(std::max<std::int64_t>(rect.x0, tile.x)) &&
          row == column_of(std::max<std::int64_t>(rect.y0, tile.y)))
        visit(entry);
    }
}

template <class Visit>
void TileTree::visit_children(std::int32_t entry, std::int64_t x, std::int64_t y, int shift, const FixedRect& rect,
                              const Visit& visit) const {
  const std::int64_t side = std::int64_t{1} << shift;
  for (std::uint32_t upper = 0; upper < 2; ++upper)
    for (std::uint32_t right = 0; right < 2; ++right) {
      const std::int64_t x0 = x + right * side, y0 = y + upper * side;
      if (x0 > rect.x1 || x0 + side <= rect.x0 || y0 > rect.y1 || y0 + side <= rect.y0)
        continue;
      const std::int32_t next = children_[child(entry, right, upper)];
      if (next < 0)
        visit_children(next, x0, y0, shift - 1, rect, visit);
      else
        visit(next);
    }
}

} // namespace trime::mesh
