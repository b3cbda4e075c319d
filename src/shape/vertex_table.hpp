// SPDX-License-Identifier: BSD-3-Clause
// Vertices of an arrangement: points of the lattice; those nearer than a few steps become one. At the border of a
// periodic container opposite vertices become one node.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <vector>

namespace trime::shape {

/// Open hash table over square cells of 2^7 steps. Never iterated, so that nothing depends on its order.
class VertexTable {
public:
  static constexpr int merge_steps = 8; ///< points at most so far apart become one vertex
  static constexpr int shared = -2;     ///< owner of a vertex that lies on several parts
  static constexpr int nobody = -1;

  /// @param expected number of vertices, for the size of the table; more are possible
  VertexTable(const geometry::Lattice& lattice, std::size_t expected);

  /// @brief Vertex at p, for part `owner` or for a crossing (nobody).
  ///
  /// The nearest vertex within merge_steps if there is one (lowest index on ties), else a new one. Vertices of one part
  /// merge with each other only if they are equal. A vertex asked for by two parts, or for a crossing, is shared.
  LocalIndex insert(geometry::Vec2 p, int owner);

  geometry::Vec2 point(LocalIndex v) const { return points_[v]; }
  bool is_shared(LocalIndex v) const { return owners_[v] == shared; }
  void set_shared(LocalIndex v) { owners_[v] = shared; }
  /// Frees what is needed to insert vertices and to know which are shared: points and size stay.
  void forget_search();
  LocalIndex size() const { return static_cast<LocalIndex>(points_.size()); }

private:
  struct Cell {
    std::int64_t i, j;
  };
  Cell cell_of(geometry::Vec2 p) const;
  std::size_t slot_of(Cell cell) const;
  void find_in(Cell cell, geometry::Vec2 p, int owner, struct VertexMatch& best) const;
  void grow();
  void link(LocalIndex v);

  geometry::Lattice lattice_;
  std::vector<geometry::Vec2> points_;
  std::vector<int> owners_;
  std::vector<LocalIndex> next_;  // next vertex of the same slot
  std::vector<LocalIndex> heads_; // first vertex of each slot; a power of two of them
};

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
