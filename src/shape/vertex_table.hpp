// SPDX-License-Identifier: BSD-3-Clause
// The vertices of an arrangement: points of the coordinate lattice, where points within a few steps of each other
// become one vertex.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <vector>

namespace trime::shape {

/// A hash table of vertices by square cells of 2^7 lattice steps. No loop runs over the table, so no result depends on
/// the order of its entries.
class VertexTable {
public:
  static constexpr int merge_steps = 8; ///< points that are at most this many steps apart become one vertex
  static constexpr int shared = -2;     ///< owner of a vertex that lies on several parts
  static constexpr int nobody = -1;

  /// @param expected number of vertices, for the size of the table; more are possible
  VertexTable(const geometry::Lattice& lattice, std::size_t expected);

  /// @brief Returns the vertex at p, for the part `owner` or for a crossing (owner: nobody).
  ///
  /// The result is the nearest vertex within merge_steps (of equally near ones, that with the lowest index), or a new
  /// vertex if there is no such one. Vertices of the same part become one vertex only if they are equal. A vertex that
  /// is requested for two parts, or for a crossing, is marked as shared.
  LocalIndex insert(geometry::Vec2 p, int owner);

  geometry::Vec2 point(LocalIndex v) const { return points_[v]; }
  bool is_shared(LocalIndex v) const { return owners_[v] == shared; }
  void set_shared(LocalIndex v) { owners_[v] = shared; }
  /// Frees the memory that is needed only to insert vertices and to know which are shared. Points and size stay.
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
  std::vector<LocalIndex> next_;  // next vertex in the same slot of the hash table
  std::vector<LocalIndex> heads_; // first vertex in each slot; the number of slots is a power of two
};

/// @brief Joins vertices that are periodic images of each other to nodes. Vertices near opposite sides of the container
/// may differ from exact images by up to VertexTable::merge_steps, because their crossings were rounded separately.
/// Without periods every vertex is a separate node.
class Quotient {
public:
  /// @param used the vertices to join; each is at most a few steps outside of the container along periodic axes
  Quotient(const VertexTable& vertices, const std::vector<LocalIndex>& used, const geometry::Frame& frame);

  LocalIndex size() const { return periodic_ ? nodes_.size() : vertices_.size(); }
  /// Returns the node of a vertex of `used`.
  LocalIndex node(LocalIndex vertex) const { return periodic_ ? node_[vertex] : vertex; }
  /// Returns the position of a node, in the container or a few steps outside of its lower sides.
  geometry::Vec2 point(LocalIndex node) const { return periodic_ ? nodes_.point(node) : vertices_.point(node); }
  /// Returns the multiple of the periods that leads from the position of its node to the vertex.
  geometry::Vec2 shift(LocalIndex vertex) const { return periodic_ ? shift_[vertex] : geometry::Vec2{}; }

private:
  const VertexTable& vertices_;
  bool periodic_;
  VertexTable nodes_;
  std::vector<LocalIndex> node_;
  std::vector<geometry::Vec2> shift_;
};

} // namespace trime::shape
