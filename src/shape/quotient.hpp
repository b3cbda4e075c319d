// SPDX-License-Identifier: BSD-3-Clause
// Identifies vertices on opposite borders of a periodic container: they become one node.
#pragma once

#include "shape/vertex_table.hpp"
#include "trime/geometry/frame.hpp"

#include <vector>

namespace trime::shape {

/// @brief A node is a class of vertices that differ by shifts by periods. Vertices near opposite sides that are images
/// of each other to within VertexTable::merge_steps are one node, because their crossings were rounded separately.
/// Without periods every vertex is a separate node.
class Quotient {
public:
  /// @param used vertices, each at most a few steps outside the container along periodic axes
  Quotient(const VertexTable& vertices, const std::vector<LocalIndex>& used, const geometry::Frame& frame);

  LocalIndex size() const { return periodic_ ? nodes_.size() : vertices_.size(); }
  /// Returns the node of a vertex that was given as `used`.
  LocalIndex node(LocalIndex vertex) const { return periodic_ ? node_[vertex] : vertex; }
  /// Returns the place of a node, in the container or a few steps outside its lower sides.
  geometry::Vec2 point(LocalIndex node) const { return periodic_ ? nodes_.point(node) : vertices_.point(node); }
  /// Returns the multiple of the periods that leads from the place of its node to the vertex.
  geometry::Vec2 shift(LocalIndex vertex) const { return periodic_ ? shift_[vertex] : geometry::Vec2{}; }

private:
  const VertexTable& vertices_;
  bool periodic_;
  VertexTable nodes_;
  std::vector<LocalIndex> node_;
  std::vector<geometry::Vec2> shift_;
};

} // namespace trime::shape
