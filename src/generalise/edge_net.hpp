// SPDX-License-Identifier: BSD-3-Clause
// The curves and interfaces inside a shape as a net of edges between vertices, to change them one edge at a time.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/vec2.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace trime::generalise {

/// @brief Holds the pieces of all arcs as edges, and knows which edges meet at a vertex.
///
/// An edge is divided at a vertex into two parts, or two edges with the same ends become one. Edges that were divided
/// or joined stay in the list, but are no longer alive.
class EdgeNet {
public:
  struct Edge {
    LocalIndex a, b; ///< vertices
    geometry::Piece piece;
    int left, right;                       ///< regions
    double lost = 0;                       ///< area that was taken from the region on the left
    double moved = 0;                      ///< largest distance by which the edge has moved
    std::size_t arc = 0;                   ///< from which it comes
    std::array<LocalIndex, 2> parts{0, 0}; ///< what it was divided into; both 0 if it was not divided
    bool alive = true;

    /// Returns whether this is an interface; a curve may lie on it.
    bool is_interface() const { return left != right; }
    /// Returns whether it has the name of a curve.
    bool has_name() const { return piece.part >= 0; }
    /// Returns whether this is a curve inside a region.
    bool is_curve() const { return has_name() && !is_interface(); }
  };

  /// @param boundary of the shape, in whose vertices arcs end
  EdgeNet(const std::vector<geometry::InnerArc>& arcs, const geometry::Boundary& boundary);

  LocalIndex vertex_count() const { return static_cast<LocalIndex>(places_.size()); }
  geometry::Vec2 place(LocalIndex vertex) const { return places_[at(vertex)]; }
  LocalIndex edge_count() const { return static_cast<LocalIndex>(edges_.size()); }
  const Edge& edge(LocalIndex e) const { return edges_[at(e)]; }
  /// Returns the living edges at a vertex, in no special order.
  const std::vector<LocalIndex>& around(LocalIndex vertex) const { return around_[at(vertex)]; }
  /// Returns the living edge between two vertices; -1 if no edge leads there.
  LocalIndex between(LocalIndex a, LocalIndex b) const;
  /// Returns whether two edges with the same ends may become one edge: one of them is a curve inside a region, and the
  /// other one is an interface of this region or another curve in it.
  bool may_join(LocalIndex e, LocalIndex f) const;
  /// @brief Leads an edge through a vertex. Parts with the same ends as another edge become one with it.
  /// @pre may_join holds for such edges
  void divide(LocalIndex edge, LocalIndex vertex, double distance);
  /// Returns the arcs that the living edges make, in the order of the arcs from which they come. Arcs without changed
  /// edges and vertices stay as they are.
  std::vector<geometry::InnerArc> arcs(const std::vector<geometry::InnerArc>& given) const;

private:
  void kill(LocalIndex e);
  void add(Edge edge);
  void join(Edge& part, const Edge& other) const;
  LocalIndex beside(LocalIndex e, bool at_end) const;
  geometry::InnerArc arc_of(const std::vector<LocalIndex>& run, bool closed) const;

  std::vector<geometry::Vec2> places_;
  std::vector<Edge> edges_;
  LocalIndex given_edges_ = 0; // the edges below this number are pieces as they were given
  std::vector<std::vector<LocalIndex>> around_;
  std::vector<char> is_node_;    // by vertex: an end of an open arc
  std::vector<char> is_changed_; // by vertex: edges there were divided or joined
  std::vector<char> is_on_rim_;  // by vertex: it lies on the boundary
};

} // namespace trime::generalise
