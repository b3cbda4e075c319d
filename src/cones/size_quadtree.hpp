// SPDX-License-Identifier: BSD-3-Clause
// Stores the lower envelope of cones over a rectangle in a quadtree for fast look-up. Cells with a few cones are exact;
// where many cones form a smooth field, it is interpolated bilinearly.
#pragma once

#include "cones/size_cells.hpp"
#include "trime/comm/communicator.hpp"

#include <vector>

namespace trime::cones {

/// The size field as a quadtree. Immutable after construction; queries are thread-safe.
class SizeQuadtree {
public:
  using Source = SizeSource;
  /// Largest relative error of a bilinear cell, measured at its centre and at the middles of its edges and quarters.
  static constexpr double tolerance = 0.01;
  /// Number of blocks along the longer side of the box; each block is a separate quadtree.
  static constexpr int blocks_along = 64;
  static constexpr int most_levels = 20; ///< largest number of levels below a block
  static constexpr int most_cones = 12;  ///< a cell with more cones is split

  /// @brief Builds the quadtree. Groups of blocks are distributed over the ranks and threads; every rank gets the whole
  /// quadtree. Collective.
  SizeQuadtree(const comm::Communicator& comm, const Source& source);

  /// Returns the value at p; for p outside of the box, the value at the nearest point of the box.
  double value(geometry::Vec2 p) const;
  double least() const { return least_; }
  double largest() const { return largest_; }
  std::size_t memory_bytes() const;

  /// @brief Calls visit(cell, values) for every cell that is not split, with the values at its corners. For a cell with
  /// cones, it also calls visit for the lowest point, as a cell without extent.
  template <class Visit>
  void for_each_leaf(const Visit& visit) const {
    for (std::size_t k = 0; k < roots_.size(); ++k)
      visit_leaves(roots_[k], {0, static_cast<std::int64_t>(k % nx_), static_cast<std::int64_t>(k / nx_)}, visit);
  }

private:
  /// Level of the cells that form a group; all blocks in such a cell are built together.
  static constexpr int group_level = -2;
  void assemble(const comm::Communicator& comm, std::vector<CellPart> mine);
  std::vector<CellPart> gather_parts(const comm::Communicator& comm, std::vector<CellPart> mine) const;
  CellPlace group_place(std::size_t group) const;
  double highest_corner(const Source& source) const;
  double cones_value(CellLeaf leaf, geometry::Vec2 p) const {
    return lowest_cone(&numbers_[leaf.first], leaf.pairs(), p, slope_, cap_);
  }

  template <class Visit>
  void visit_leaves(CellNode node, const CellPlace& place, const Visit& visit) const;

  geometry::Box box_;
  CellGrid grid_;
  double inverse_side_ = 1; ///< 1 / side of a block
  double slope_, cap_;
  std::size_t nx_ = 1, ny_ = 1, groups_x_ = 1, groups_y_ = 1;
  std::vector<CellNode> roots_; ///< root nodes of the blocks, row by row
  std::vector<CellChildren> children_;
  std::vector<double> numbers_; ///< corner values or pairs of cones, for all leaves
  double least_ = std::numeric_limits<double>::infinity(), largest_ = 0;
};

template <class Visit>
void SizeQuadtree::visit_leaves(CellNode node, const CellPlace& place, const Visit& visit) const {
  if (node >= 0) {
    const CellChildren& children = children_[node];
    for (int k = 0; k < 4; ++k) {
      const int first = 2 * (k & 1) + 8 * (k >> 1); // index of the first child in this quarter
      const CellPlace quarter{place.level + 1, 2 * place.i + (k & 1), 2 * place.j + (k >> 1)};
      if (children[first] < 0 && children[first] == children[first + 1])
        visit_leaves(children[first], quarter, visit);
      else
        for (int m = 0; m < 4; ++m)
          visit_leaves(children[first + (m & 1) + 4 * (m >> 1)],
                       {place.level + 2, 2 * quarter.i + (m & 1), 2 * quarter.j + (m >> 1)}, visit);
    }
    return;
  }
  const CellLeaf leaf = CellLeaf::of(node);
  const geometry::Box cell = grid_.box(place);
  const double* const numbers = &numbers_[leaf.first];
  if (leaf.is_bilinear())
    return visit(cell, CornerValues{numbers[0], numbers[1], numbers[2], numbers[3]});
  visit(cell, CornerValues{cones_value(leaf, cell.min), cones_value(leaf, {cell.max.x, cell.min.y}),
                           cones_value(leaf, {cell.min.x, cell.max.y}), cones_value(leaf, cell.max)});
  const geometry::Vec2 point = lowest_point(numbers, leaf.pairs(), cell, slope_);
  const double low = cones_value(leaf, point);
  visit(geometry::Box{point, point}, CornerValues{low, low, low, low});
}

} // namespace trime::cones
