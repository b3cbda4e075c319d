// SPDX-License-Identifier: BSD-3-Clause
// Vertices of an arrangement that was cut at the border of a periodic container: opposite ones become one node.
#pragma once

#include "shape/vertex_table.hpp"
#include "trime/geometry/lattice.hpp"

#include <vector>

namespace trime::shape {

/// @brief Nodes are vertices up to shifts by periods. Vertices near opposite sides that are images of each other to
/// within VertexTable::merge_steps (their crossings are rounded apart) are one node. Without periods every vertex is
/// its own node.
class Quotient {
public:
  /// @param used vertices, each at most a few steps outside of the container along periodic axes
  Quotient(const VertexTable& vertices, const std::vector<LocalIndex>& used, const geometry::Frame& frame);

  LocalIndex size() const { return periodic_ ? nodes_.size() : vertices_.size(); }
  /// Node of a vertex that was given as used.
  LocalIndex node(LocalIndex vertex) const { return periodic_ ? node_[vertex] : vertex; }
  /// Place of a node: in the container, or a few steps outside of its lower sides.
  geometry::Vec2 point(LocalIndex node) const { return periodic_ ? nodes_.point(node) : vertices_.point(node); }
  /// Multiple of the periods that leads from the place of its node to the vertex.
  geometry::Vec2 shift(LocalIndex vertex) const { return periodic_ ? shift_[vertex] : geometry::Vec2{}; }

private:
  const VertexTable& vertices_;
  bool periodic_;
  VertexTable nodes_;
  std::vector<LocalIndex> node_;
  std::vector<geometry::Vec2> shift_;
};

} // namespace trime::shape
