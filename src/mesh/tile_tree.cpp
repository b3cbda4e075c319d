// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/tile_tree.hpp"

#include "trime/core/error.hpp"

#include <limits>

namespace trime::mesh {
namespace {

/// Value for a square beyond the limits: nobody asks for it.
constexpr std::int32_t nothing = std::numeric_limits<std::int32_t>::max();
/// Largest number of cells of the directory for each tile, about.
constexpr std::size_t cells_per_tile = 2;

} // namespace

TileTree::TileTree(const FixedRect& limits, std::vector<Tile> tiles) : tiles_(std::move(tiles)) {
  TRIME_ASSERT(!tiles_.empty());
  choose_cells(limits);
  directory_.assign(columns_ * rows_, nothing);
  for (LocalIndex number = 0; number < size(); ++number)
    enter(number);
}

/// The smallest that are not too many.
void TileTree::choose_cells(const FixedRect& limits) {
  for (int shift = 31; shift >= 0; --shift) {
    const auto first_column = static_cast<std::uint32_t>(limits.x0 >> shift),
               first_row = static_cast<std::uint32_t>(limits.y0 >> shift);
    const std::size_t columns = static_cast<std::size_t>(limits.x1 >> shift) - first_column + 1,
                      rows = static_cast<std::size_t>(limits.y1 >> shift) - first_row + 1;
    if (shift < 31 && columns * rows > cells_per_tile * tiles_.size())
      return;
    cell_shift_ = shift;
    first_column_ = first_column;
    first_row_ = first_row;
    columns_ = columns;
    rows_ = rows;
  }
}

/// Where the look-up finds a tile: in all cells that it covers, or below the cell that holds it.
void TileTree::enter(LocalIndex number) {
  const Tile& tile = (*this)[number];
  const std::uint32_t column = tile.x >> cell_shift_, row = tile.y >> cell_shift_;
  if (tile.shift >= cell_shift_) {
    const std::uint32_t cells = std::uint32_t{1} << (tile.shift - cell_shift_);
    const auto last_row = static_cast<std::uint32_t>(std::min<std::size_t>(row + cells, first_row_ + rows_)),
               last_column =
                   static_cast<std::uint32_t>(std::min<std::size_t>(column + cells, first_column_ + columns_));
    for (std::uint32_t r = std::max(row, first_row_); r < last_row; ++r)
      for (std::uint32_t c = std::max(column, first_column_); c < last_column; ++c)
        directory_[cell(c, r)] = number;
    return;
  }
  std::int32_t entry = directory_[cell(column, row)];
  if (entry == nothing) {
    entry = directory_[cell(column, row)] = ~static_cast<std::int32_t>(children_.size() / 4);
    children_.insert(children_.end(), 4, nothing);
  }
  for (int shift = cell_shift_ - 1;; --shift) {
    const std::size_t next = child(entry, tile.x >> shift & 1, tile.y >> shift & 1);
    if (shift == tile.shift) {
      children_[next] = number;
      return;
    }
    if (children_[next] == nothing) {
      children_[next] = ~static_cast<std::int32_t>(children_.size() / 4);
      children_.insert(children_.end(), 4, nothing);
    }
    entry = children_[next];
  }
}

} // namespace trime::mesh
