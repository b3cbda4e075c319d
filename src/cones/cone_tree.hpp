// SPDX-License-Identifier: BSD-3-Clause
// The lower envelope of cones of one slope, min over k of slope |x - apex_k| + height_k, by branch and bound. With
// slope 1 and heights 0 it finds nearest neighbours; other heights are additive weights.
#pragma once

#include "cones/box_tree.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <limits>
#include <span>
#include <vector>

namespace trime::cones {

struct Cone {
  geometry::Vec2 apex;
  double height;

  double value(geometry::Vec2 p, double slope) const { return slope * geometry::length(p - apex) + height; }
};

/// Immutable; queries are thread-safe.
class ConeTree {
public:
  ConeTree() = default;
  /// Takes O(n) time and about 60 bytes per cone.
  ConeTree(const std::vector<Cone>& cones, double slope);

  /// @brief Returns the least of `bound` and the values of all cones at p. A low bound makes it faster. O(log n) for
  /// points near a few cones.
  /// @param slack share by which the answer may be too high; it saves time where many cones are almost equally low
  double value(geometry::Vec2 p, double bound = std::numeric_limits<double>::infinity(), double slack = 0) const;

  /// Returns the index of the cone that is lowest at p, or -1 if no cone is below `bound` there.
  LocalIndex lowest(geometry::Vec2 p, double bound) const;

  /// Calls visit(index) for the cones in the order of the tree. Leaves out the cones of nodes for which skip(box,
  /// least) is true, where `box` contains their apexes and `least` is the least of their heights.
  template <class Skip, class Visit>
  void visit_unless(const Skip& skip, const Visit& visit) const {
    tree_.visit_unless(skip, [&](std::size_t k) { visit(static_cast<LocalIndex>(k)); });
  }

  /// Appends to `found` the indices of all cones whose value at p is at most `bound`, in the order of the tree.
  void collect(geometry::Vec2 p, double bound, std::vector<LocalIndex>& found) const;

  /// The cones in the order of the tree.
  std::span<const Cone> cones() const { return cones_; }
  std::size_t memory_bytes() const {
    return cones_.capacity() * sizeof(Cone) + leaves_.capacity() * sizeof(ConeLeaf) + tree_.memory_bytes();
  }

private:
  LowestCone find(geometry::Vec2 p, double bound, double slack) const;

  std::vector<Cone> cones_;      // along a Hilbert curve
  std::vector<ConeLeaf> leaves_; // all cones, eight at a time
  BoxTree tree_;                 // boxes of apexes, with heights
  double slope_ = 1;
  SearchKernel kernel_ = search_kernel(simd_level());
};

} // namespace trime::cones
