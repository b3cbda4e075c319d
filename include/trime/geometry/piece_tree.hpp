// SPDX-License-Identifier: BSD-3-Clause
// A search tree for the nearest piece of a boundary.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstddef>
#include <vector>

namespace trime::geometry {

/// Finds the nearest piece of a boundary: a binary tree of boxes around runs of consecutive pieces.
class PieceTree {
public:
  PieceTree() = default;
  /// Builds the tree in O(M) time for M pieces. Memory: about 50 bytes per segment and more per arc.
  explicit PieceTree(const Boundary& boundary);
  /// @brief Returns the distance from p to the nearest piece or periodic image of a piece; infinity if there are no
  /// pieces. Cost: O(log M) for curves. Thread-safe.
  double distance(Vec2 p) const { return nearest(p).distance; }

  /// The nearest piece and its distance.
  struct Nearest {
    double distance;
    std::size_t piece; ///< number of the piece, counted through all loops in their order
  };
  /// Returns the nearest piece; if several are equally near, one of them. Cost: O(log M) for curves. Thread-safe.
  Nearest nearest(Vec2 p) const;
  /// Returns the pieces within `distance` of p or of a periodic image of p, ascending. Pieces are counted through all
  /// loops in their order.
  std::vector<std::size_t> within(Vec2 p, double distance) const;

private:
  static constexpr std::size_t run_length = 4;
  struct Ends {
    Vec2 a, b;
  };
  double squared_distance_of(std::size_t piece, Vec2 p) const;
  void look_at_run(std::size_t run, Vec2 p, Nearest& best) const;
  void search(Vec2 p, Nearest& best) const;
  template <class Visit>
  void for_each_image(Vec2 p, const Visit& visit) const;

  Periods periods_;
  std::vector<Ends> ends_;
  std::vector<LocalIndex> arc_of_; // by piece: index into arcs_, or -1 for a segment; empty without arcs
  std::vector<Piece> arcs_;
  std::vector<Box>
      boxes_; // in the order of a heap: the root is 1, the children of k are 2k and 2k+1, the leaves are the runs
};

} // namespace trime::geometry
