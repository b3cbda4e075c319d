// SPDX-License-Identifier: BSD-3-Clause
// Stores the cells of a quadtree of the size field, and builds these cells.
#pragma once

#include "cones/cone_kernel.hpp"
#include "cones/cone_tree.hpp"
#include "core/lanes.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace trime::cones {

/// Values at the corners of a cell: lower left, lower right, upper left, upper right.
using CornerValues = std::array<double, 4>;

/// The cones from which a quadtree of the size field is built, and its limits.
struct SizeSource {
  const ConeTree& cones;
  double slope;      ///< slope of the cones
  double cap;        ///< upper bound of the field
  geometry::Box box; ///< the rectangle in which the field is defined
  double least_side; ///< cells with a smaller side are not split
};

/// A cell, given by its level, column and row. The cells of a level are half as wide as those of the level above.
struct CellPlace {
  int level;
  std::int64_t i, j;

  CellPlace quarter(int k) const { return {level + 1, 2 * i + (k & 1), 2 * j + (k >> 1)}; }
};

/// A grid of squares over a rectangle. The squares are halved from level to level. A point that is a corner of cells on
/// several levels has the same bits in all of them.
struct CellGrid {
  geometry::Vec2 origin;
  double side; ///< side of the squares of level 0, which are called blocks

  double side_at(int level) const {
    return level < 0 ? side * static_cast<double>(1 << -level) : side / static_cast<double>(1 << level);
  }
  /// Returns the lower left corner of a cell.
  geometry::Vec2 corner(const CellPlace& place) const {
    return origin + side_at(place.level) * geometry::Vec2{static_cast<double>(place.i), static_cast<double>(place.j)};
  }
  geometry::Box box(const CellPlace& place) const {
    return {corner(place), corner({place.level, place.i + 1, place.j + 1})};
  }
};

/// A node of the quadtree: the index of its children if it is split, or the bitwise complement of a leaf.
using CellNode = std::int32_t;
/// The 16 cells two levels below a node, row by row. A leaf one level below the node occurs four times in this list.
using CellChildren = std::array<CellNode, 16>;

/// A cell that is not split. The size in such a cell is either bilinear between its corners, or the lower envelope of a
/// few cones.
struct CellLeaf {
  static constexpr int kinds = 16; ///< kinds 0 and 1 are bilinear cells; kind k > 1 has k - 1 pairs of cones
  static constexpr std::size_t most_numbers = (std::size_t{1} << 31) / kinds;
  static constexpr int most_cones = 2 * (kinds - 2);

  std::size_t first; ///< index of its first number, where numbers are values at corners or pairs of cones
  int kind;

  static CellLeaf of(CellNode node) {
    return {static_cast<std::size_t>(~node) / kinds, static_cast<int>(~node % kinds)};
  }
  static CellLeaf bilinear(std::size_t first) { return {first, 0}; }
  static CellLeaf with_pairs(std::size_t first, std::size_t count) { return {first, static_cast<int>(count) + 1}; }
  CellNode node() const { return ~static_cast<CellNode>(first * kinds + static_cast<std::size_t>(kind)); }

  bool is_bilinear() const { return kind < 2; }
  /// Returns by how many levels a bilinear leaf is larger than the children of the node in which it is found.
  int levels_up() const { return kind; }
  std::size_t pairs() const { return static_cast<std::size_t>(kind) - 1; }
};

/// Two cones, which are evaluated together.
struct ConePair {
  using Lanes = lanes::Types<2>::Doubles;
  static constexpr std::size_t numbers = 6; ///< two x, two y, two heights

  static Lanes load(const double* from) {
    Lanes v;
    std::memcpy(&v, from, sizeof v);
    return v;
  }
  /// Returns the values of both cones, bit-identical to Cone::value.
  static Lanes values(const double* pair, Lanes x, Lanes y, double slope) {
    const Lanes dx = x - load(pair), dy = y - load(pair + 2);
    return slope * lanes::square_root(dx * dx + dy * dy) + load(pair + 4);
  }
};

/// Returns the value at p of the lowest cone in a list of pairs, or `cap` if that is lower.
inline double lowest_cone(const double* pairs, std::size_t count, geometry::Vec2 p, double slope, double cap) {
  const ConePair::Lanes x{p.x, p.x}, y{p.y, p.y};
  ConePair::Lanes low{cap, cap};
  for (const double* pair = pairs; pair != pairs + ConePair::numbers * count; pair += ConePair::numbers)
    low = lanes::smaller(ConePair::values(pair, x, y, slope), low);
  return std::min(low[0], low[1]);
}

/// Returns the point of the cell at which the lower envelope of the pairs of cones is lowest.
geometry::Vec2 lowest_point(const double* pairs, std::size_t count, const geometry::Box& cell, double slope);

/// Some blocks of the quadtree with the cells below them. Indices in a part count from 0.
struct CellPart {
  std::vector<CellNode> roots; ///< root nodes of the blocks, row by row
  std::vector<CellChildren> children;
  std::vector<double> numbers; ///< corner values or pairs of cones, for all leaves
  double least = std::numeric_limits<double>::infinity(), largest = 0; ///< smallest and largest value of the field
};

/// Builds blocks of the quadtree from the top down. Each cell passes to its quarters only the cones that can be lowest
/// somewhere in them, so the lists are short and the tree of cones is searched only once.
class CellBuilder {
public:
  struct Limits {
    double tolerance; ///< largest relative error of a bilinear cell
    int most_levels;  ///< largest number of levels below a block; must be even
    int most_cones;   ///< largest number of cones in a cell
    double highest;   ///< largest value that is allowed in cells with cones
  };
  CellBuilder(const SizeSource& source, const CellGrid& grid, const Limits& limits)
      : source_(source), grid_(grid), limits_(limits), kernel_(cone_kernel(simd_level())),
        levels_(static_cast<std::size_t>(limits.most_levels) + top + 1) {}

  /// Builds the blocks in a cell of the grid, except those whose column is at least `columns` or whose row is at least
  /// `rows`.
  /// @pre the level of the cell is at most 0
  CellPart build(const CellPlace& place, std::int64_t columns, std::int64_t rows);

private:
  static constexpr int top = 8; ///< the largest cell that build() accepts has level -8
  /// The cell that is being built on one level.
  struct Level {
    ConeList cones;
    std::vector<double> numbers; ///< memory for the arrays of `cones`

    void reserve(std::int64_t count);
  };
  /// The four children of a node, before two levels are joined into one.
  using Quarters = std::array<CellNode, 4>;

  ConeList& cones_of(const CellPlace& place, std::int64_t room = 0);
  std::array<geometry::Vec2, 4> corners_of(const CellPlace& place) const;
  CornerValues values(const ConeList& cones) const;
  void collect(const CellPlace& place);
  void evaluate_inside(ConeList& cones, const CellPlace& place) const;
  void build_blocks(const CellPlace& place);
  CellNode build_cell(const CellPlace& place);
  CellNode bilinear_leaf(const ConeList& cones);
  CellNode cones_leaf(const ConeList& cones, const CellPlace& place, int count);
  int choose_cones(const ConeList& cones, const CellPlace& place, double slack);
  void include_in_range(const CornerValues& corners);
  CellNode in_pairs(CellNode node);

  const SizeSource& source_;
  CellGrid grid_;
  Limits limits_;
  ConeKernel kernel_;
  std::vector<Level> levels_;
  std::vector<Quarters> quarters_;
  ConeChoice choice_;
  CellPart part_;
  std::int64_t first_column_ = 0, first_row_ = 0, columns_ = 0,
               rows_ = 0; ///< number of the first block, and numbers of columns and rows of blocks
};

} // namespace trime::cones
