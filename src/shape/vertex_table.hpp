// SPDX-License-Identifier: BSD-3-Clause
// The vertices of an arrangement: points of the lattice. Points within a few steps of each other become one vertex.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <vector>

namespace trime::shape {

/// An open hash table over square cells of 2^7 steps. It is never iterated, so no result depends on its order.
class VertexTable {
public:
  static constexpr int merge_steps = 8; ///< points at most this far apart become one vertex
  static constexpr int shared = -2;     ///< the owner of a vertex that lies on several parts
  static constexpr int nobody = -1;

  /// @param expected number of vertices, for the size of the table; more are possible
  VertexTable(const geometry::Lattice& lattice, std::size_t expected);

  /// @brief Returns the vertex at p, for part `owner` or for a crossing (nobody).
  ///
  /// This is the nearest vertex within merge_steps (the lowest index of equals) or, if there is no such vertex, a new
  /// one. Vertices of one part merge with each other only if they are equal. A vertex asked for by two parts, or for a
  /// crossing, is shared.
  LocalIndex insert(geometry::Vec2 p, int owner);

  geometry::Vec2 point(LocalIndex v) const { return points_[v]; }
  bool is_shared(LocalIndex v) const { return owners_[v] == shared; }
  void set_shared(LocalIndex v) { owners_[v] = shared; }
  /// Frees the memory that is needed to insert vertices and to know which are shared. Points and size stay.
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
  std::vector<LocalIndex> heads_; // first vertex of each slot; the number of slots is a power of two
};

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
