// SPDX-License-Identifier: BSD-3-Clause
// The lower envelope of cones of one slope, min over k of slope |x - apex_k| + height_k, by branch and bound: nearest
// neighbours with additive weights, and plain nearest neighbours (slope 1, heights 0).
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <limits>
#include <span>
#include <vector>

namespace trime::sizing {

struct Cone {
  geometry::Vec2 apex;
  double height;

  double value(geometry::Vec2 p, double slope) const { return slope * geometry::length(p - apex) + height; }
};

/// Immutable; queries are thread-safe.
class ConeTree {
public:
  ConeTree() = default;
  /// O(n log n), about 35 bytes per cone.
  ConeTree(std::vector<Cone> cones, double slope);

  /// @brief The least of `bound` and the values of all cones at p. A good bound makes it faster. O(log n) for points
  /// near a few cones.
  /// @param slack share by which the answer may be too high, for points that are nearly as near to many cones
  double value(geometry::Vec2 p, double bound = std::numeric_limits<double>::infinity(), double slack = 0) const;

  /// The index of the cone that is lowest at p, below `bound`; -1 if there is none.
  LocalIndex lowest(geometry::Vec2 p, double bound) const;

  /// Calls visit(index) for the cones, in the order of the tree, without those below nodes with skip(box, least): box
  /// of their apexes, least of their heights.
  template <class Skip, class Visit>
  void visit_unless(const Skip& skip, const Visit& visit) const {
    if (!cones_.empty())
      visit_unless(1, skip, visit);
  }

  /// Appends to `found` the indices of all cones whose value at p is at most `bound`, in the order of the tree.
  void collect(geometry::Vec2 p, double bound, std::vector<LocalIndex>& found) const;

  /// In the order of the tree.
  std::span<const Cone> cones() const { return cones_; }

private:
  /// What is known of all cones below a node.
  struct Node {
    geometry::Box box; ///< of the apexes
    double least = std::numeric_limits<double>::infinity();

    double lower_bound(geometry::Vec2 p, double slope) const;
  };
  template <class Skip, class Visit>
  void visit_unless(std::size_t node, const Skip& skip, const Visit& visit) const {
    if (skip(nodes_[node].box, nodes_[node].least))
      return;
    if (node < leaves_) {
      visit_unless(2 * node, skip, visit);
      visit_unless(2 * node + 1, skip, visit);
    } else {
      for (std::size_t k = first_of(node - leaves_); k < first_of(node - leaves_ + 1); ++k)
        visit(static_cast<LocalIndex>(k));
    }
  }
  struct Found {
    double value;
    std::size_t cone; ///< how many there are if none is lower
  };
  Found find(geometry::Vec2 p, double bound, double slack) const;
  std::size_t first_of(std::size_t leaf) const { return cones_.size() * leaf / leaves_; }
  void sort(std::size_t node, std::size_t first_leaf, std::size_t last_leaf);

  std::vector<Cone> cones_;
  std::vector<Node>
      nodes_; // heap order: the root is 1, the children of k are 2k and 2k+1; the last `leaves_` are leaves
  std::size_t leaves_ = 0;
  double slope_ = 1, inverse_slope_ = 1;
};

} // namespace trime::sizing
