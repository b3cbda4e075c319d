// SPDX-License-Identifier: BSD-3-Clause
// The lower envelope of cones over a rectangle as a quadtree of bilinear cells, for fast look-up.
#pragma once

#include "sizing/cone_tree.hpp"
#include "trime/comm/communicator.hpp"

#include <array>
#include <span>

namespace trime::sizing {

/// Values at the corners of a cell: lower left, lower right, upper left, upper right.
using CornerValues = std::array<double, 4>;

/// Immutable after construction; queries are thread-safe.
class SizeQuadtree {
public:
  /// What the tree is made from.
  struct Source {
    const ConeTree& cones;
    double slope;      ///< of the cones
    double cap;        ///< the field is the lower of the envelope and this
    geometry::Box box; ///< where it is defined
    double least_side; ///< smaller cells are not split
  };
  /// Largest error of a cell at the middles of its edges and in its centre, as a share of the value.
  static constexpr double tolerance = 0.01;
  /// The longer side of the box has so many blocks, each of them a quadtree of its own.
  static constexpr int blocks_along = 64;
  static constexpr int most_levels = 20; ///< below a block

  /// @brief Blocks are dealt to the ranks and threads; every rank gets the whole tree. Collective.
  SizeQuadtree(const comm::Communicator& comm, const Source& source);

  /// Value at p, or at the nearest point of the box.
  double value(geometry::Vec2 p) const;
  double least() const { return least_; }
  double largest() const { return largest_; }
  std::size_t leaf_count() const { return leaves_.size(); }
  std::size_t memory_bytes() const;

  /// Calls visit(cell, values) for every cell that is not split.
  template <class Visit>
  void for_each_leaf(const Visit& visit) const {
    for (std::size_t k = 0; k < roots_.size(); ++k) {
      const geometry::Vec2 corner =
          box_.min + side_ * geometry::Vec2{static_cast<double>(k % nx_), static_cast<double>(k / nx_)};
      visit_leaves(roots_[k], corner, side_, visit);
    }
  }

  /// A node is the index of four children, or the complement of the index of a leaf.
  using Node = std::int32_t;
  using Children = std::array<Node, 4>; ///< in the order of CornerValues

private:
  struct Block;
  class Builder;
  void assemble(const comm::Communicator& comm, std::vector<Block> mine);

  template <class Visit>
  void visit_leaves(Node node, geometry::Vec2 corner, double side, const Visit& visit) const {
    if (node < 0)
      return visit(geometry::Box{corner, corner + geometry::Vec2{side, side}}, leaves_[~node]);
    const double half = 0.5 * side;
    for (int k = 0; k < 4; ++k)
      visit_leaves(children_[node][k], corner + half * geometry::Vec2{double(k & 1), double(k >> 1)}, half, visit);
  }

  geometry::Box box_;
  std::size_t nx_ = 1, ny_ = 1;
  double side_ = 1, inverse_side_ = 1; ///< of a block
  std::vector<Node> roots_;            ///< of the blocks, row by row
  std::vector<Children> children_;
  std::vector<CornerValues> leaves_;
  double least_ = 0, largest_ = 0;
};

} // namespace trime::sizing
