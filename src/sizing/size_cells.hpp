// SPDX-License-Identifier: BSD-3-Clause
// The cells of a quadtree of the size field: how they are stored, and how those of some blocks are built.
#pragma once

#include "sizing/cone_tree.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace trime::sizing {

/// Values at the corners of a cell: lower left, lower right, upper left, upper right.
using CornerValues = std::array<double, 4>;

/// What a quadtree of the size field is made from.
struct SizeSource {
  const ConeTree& cones;
  double slope;      ///< of the cones
  double cap;        ///< the field is the lower of the envelope and this
  geometry::Box box; ///< where it is defined
  double least_side; ///< smaller cells are not split
};

/// A cell: column and row among the squares of its level, each half as wide as those of the level before.
struct CellPlace {
  int level;
  std::int64_t i, j;
};

/// Squares over a rectangle, divided by halves. A point has one set of bits as corner of cells of any level.
struct CellGrid {
  geometry::Vec2 origin;
  double side; ///< of the squares of level 0, the blocks

  double side_at(int level) const {
    return level < 0 ? side * static_cast<double>(1 << -level) : side / static_cast<double>(1 << level);
  }
  /// Lower left corner.
  geometry::Vec2 corner(const CellPlace& place) const {
    return origin + side_at(place.level) * geometry::Vec2{static_cast<double>(place.i), static_cast<double>(place.j)};
  }
  geometry::Box box(const CellPlace& place) const {
    return {corner(place), corner({place.level, place.i + 1, place.j + 1})};
  }
};

/// A node of a tree is the index of its children, or the complement of a leaf.
using CellNode = std::int32_t;
/// Two levels at once, row by row; a leaf one level down stands in four places.
using CellChildren = std::array<CellNode, 16>;

/// A cell that is not split: either bilinear between its corners, or the lower envelope of a few cones.
struct CellLeaf {
  static constexpr int kinds = 16; ///< two of bilinear cells, the others of 1, 2, ... cones
  static constexpr std::size_t most_numbers = (std::size_t{1} << 31) / kinds;

  std::size_t first; ///< of its numbers: corner values, or x, y and height of each cone
  int kind;

  static CellLeaf of(CellNode node) {
    return {static_cast<std::size_t>(~node) / kinds, static_cast<int>(~node % kinds)};
  }
  static CellLeaf bilinear(std::size_t first) { return {first, 0}; }
  static CellLeaf with_cones(std::size_t first, std::size_t count) { return {first, static_cast<int>(count) + 1}; }
  CellNode node() const { return ~static_cast<CellNode>(first * kinds + static_cast<std::size_t>(kind)); }

  bool is_bilinear() const { return kind < 2; }
  /// Of a bilinear leaf: by so many levels it is larger than a child of the node that it is found at.
  int levels_up() const { return kind; }
  std::size_t cones() const { return static_cast<std::size_t>(kind) - 1; }
};

/// The value at p of the lowest of some cones, each given by x, y and height, or `cap` if that is lower.
inline double lowest_cone(const double* cones, std::size_t count, geometry::Vec2 p, double slope, double cap) {
  for (const double* cone = cones; cone != cones + 3 * count; cone += 3)
    cap = std::min(cap, slope * geometry::length({p.x - cone[0], p.y - cone[1]}) + cone[2]);
  return cap;
}

/// Where in the cell they are lowest.
geometry::Vec2 lowest_point(const double* cones, std::size_t count, const geometry::Box& cell, double slope);

/// Some blocks with the cells below them, with indices of their own.
struct CellPart {
  std::vector<CellNode> roots; ///< of the blocks, row by row
  std::vector<CellChildren> children;
  std::vector<double> numbers; ///< of the leaves
  std::int64_t leaves = 0;
  double least = std::numeric_limits<double>::infinity(), largest = 0; ///< bounds of the field
};

/// @brief Builds groups of blocks, top down. Every cell passes on to its quarters only those cones that can be the
/// lowest somewhere in them, so that lists are short and no tree of cones is asked again.
///
/// A cone a covers a cone b in a cell if it is lower everywhere in it. That shows at the corners alone: where
/// |x - b| - |x - a| >= c is convex for c >= 0 (one side of a branch of a hyperbola). For c < 0 it is asked with 0,
/// which is more.
class CellBuilder {
public:
  struct Limits {
    double tolerance; ///< largest error of a cell, as a share of the value
    int most_levels;  ///< below a block; even
    std::size_t most_cones;
    double highest; ///< what cells of cones must not exceed
  };
  CellBuilder(const SizeSource& source, const CellGrid& grid, const Limits& limits)
      : source_(source), grid_(grid), limits_(limits), levels_(static_cast<std::size_t>(limits.most_levels) + top) {}

  /// The blocks of the cell, of level <= 0. Those in columns and rows from `columns` and `rows` on are left out.
  CellPart build(const CellPlace& place, std::int64_t columns, std::int64_t rows);

private:
  static constexpr int top = 8; ///< no group is larger than a cell of level -8
  /// Points of a cell at which cones are evaluated: 3 x 3 row by row, then the centres of the quarters.
  static constexpr int points = 13, center = 4, first_quarter = 9;
  /// The cell of a level that is being built, with the cones that may be the lowest in it, as arrays side by side.
  struct Level {
    std::size_t count = 0, capacity = 0;
    std::vector<double> numbers;
    std::array<double, points> low{};         ///< values of the field
    std::array<std::size_t, points> lowest{}; ///< which cone it is

    void reserve(std::size_t cones);
    double* array(int k) { return &numbers[capacity * static_cast<std::size_t>(k)]; }
    double* x() { return array(points); }
    double* y() { return array(points + 1); }
    double* height() { return array(points + 2); }
    double* at(int point) { return array(point); } ///< values of the cones
  };
  /// Of a plain quadtree; two levels at once come later.
  using Quarters = std::array<CellNode, 4>;

  Level& level_of(const CellPlace& place) { return levels_[static_cast<std::size_t>(place.level + top)]; }
  void collect(const CellPlace& place);
  void evaluate(Level& level, int point, geometry::Vec2 p) const;
  void find_lowest(Level& level, int point) const;
  void evaluate_inside(Level& level, const CellPlace& place) const;
  void cover(Level& level, const std::array<int, 4>& corners, std::size_t by, const double* slack);
  void pass_on(Level& level, int quarter, Level& below);
  void build_blocks(const CellPlace& place);
  CellNode build_cell(const CellPlace& place);
  bool choose_cones(Level& level, const CellPlace& place, double slack);
  CellNode bilinear_leaf(const Level& level);
  CellNode cones_leaf(Level& level, const CellPlace& place);
  bool is_low(Level& level) const;
  CellNode in_pairs(CellNode node);

  const SizeSource& source_;
  CellGrid grid_;
  Limits limits_;
  std::vector<Level> levels_;
  std::vector<Quarters> quarters_;
  std::vector<std::int64_t> covered_; ///< of the cones of a cell: not 0 if another covers it
  std::vector<double> slack_;
  std::vector<LocalIndex> found_;
  std::vector<std::size_t> chosen_; ///< cones of a leaf
  CellPart part_;
  std::int64_t first_column_ = 0, first_row_ = 0, columns_ = 0, rows_ = 0; ///< of blocks
};

} // namespace trime::sizing
