// SPDX-License-Identifier: BSD-3-Clause
// A constrained Delaunay triangulation of a few points, on one thread, with which narrow parts of a boundary are found.
// The mesh itself is made by other code, in the module delaunay.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trime::generalise {

/// @brief The triangulation of points inside a box, and of the corners of the box. Some edges are constrained.
///
/// Half-edge 3 t + k of triangle t leads from its vertex k to its vertex k + 1, with the triangle on the left. Vertices
/// 0 to 3 are the corners of the box. Every edge without constraint is locally Delaunay (Lawson 1977; Sloan 1993 for
/// constraints). All decisions are exact, so the result depends only on the points, the order of insertion and the
/// constraints.
class Triangulation {
public:
  using HalfEdge = LocalIndex;
  static constexpr LocalIndex none = -1;

  /// @param box its corners are points of the coordinate lattice; all points lie strictly inside
  Triangulation(const geometry::Box& box, const geometry::Lattice& lattice);

  void reserve(std::size_t points);
  /// @brief Returns the vertex at p; makes a new vertex if none lies there. Cost: O(steps of the walk from the last
  /// point), so points should come in the order of a space-filling curve.
  LocalIndex insert(geometry::Vec2 p);
  /// @brief Makes the edge from a to b a constraint with the mark `mark`, which is not negative; from b to a the mark
  /// is -1 - mark.
  /// @return false, without a new constraint, if another vertex or a constraint lies between a and b
  bool constrain(LocalIndex a, LocalIndex b, std::int32_t mark);
  /// @brief Makes a new vertex near the constrained edge e. The edge becomes two edges with the same mark.
  /// @return the vertex; `none` if p is too near to other vertices for the coordinate lattice
  LocalIndex split(HalfEdge e, geometry::Vec2 p);

  LocalIndex vertex_count() const { return static_cast<LocalIndex>(points_.size()); }
  LocalIndex triangle_count() const { return static_cast<LocalIndex>(origin_.size() / 3); }
  geometry::Vec2 point(LocalIndex v) const { return points_[at(v)]; }

  static LocalIndex triangle(HalfEdge e) { return e / 3; }
  static HalfEdge next(HalfEdge e) { return e % 3 == 2 ? e - 2 : e + 1; }
  static HalfEdge previous(HalfEdge e) { return e % 3 == 0 ? e + 2 : e - 1; }
  LocalIndex origin(HalfEdge e) const { return origin_[at(e)]; }
  LocalIndex target(HalfEdge e) const { return origin_[at(next(e))]; }
  /// Returns the opposite half-edge; `none` on the border of the box.
  HalfEdge twin(HalfEdge e) const { return twin_[at(e)]; }
  bool is_constrained(HalfEdge e) const { return mark_[at(e)] != no_mark; }
  /// Returns the mark of an edge if its constraint has this direction, otherwise a negative number.
  std::int32_t mark(HalfEdge e) const { return mark_[at(e)] == no_mark ? -1 : mark_[at(e)]; }
  /// Returns the mark of the constraint on which e lies, in either direction.
  /// @pre is_constrained(e)
  std::int32_t mark_of_edge(HalfEdge e) const { return mark_[at(e)] >= 0 ? mark_[at(e)] : -1 - mark_[at(e)]; }
  /// Returns the half-edge from a to b; `none` if they are not neighbours. Cost: O(degree of a).
  HalfEdge find_edge(LocalIndex a, LocalIndex b) const;
  /// Returns a triangle that contains p, inside or on its edges. Cost: O(steps of the walk from the last point).
  /// @pre p lies in the box
  LocalIndex triangle_at(geometry::Vec2 p) const { return triangle(locate(p).edge); }
  /// Returns a half-edge that begins at v.
  HalfEdge leaving(LocalIndex v) const { return leaving_[at(v)]; }
  /// Returns the next half-edge, counter-clockwise, that begins at the same vertex; `none` beyond the border of the
  /// box.
  HalfEdge around(HalfEdge e) const { return twin(previous(e)); }

private:
  static constexpr std::int32_t no_mark = INT32_MIN;

  /// The location of a point: in the triangle left of `edge`, on that edge, or at its origin.
  struct Location {
    HalfEdge edge;
    enum { inside, on_edge, at_origin } kind;
  };
  Location locate(geometry::Vec2 p) const;
  LocalIndex add_point(geometry::Vec2 p);
  void set_triangle(LocalIndex t, std::array<LocalIndex, 3> vertices, std::array<HalfEdge, 3> twins,
                    std::array<std::int32_t, 3> marks);
  LocalIndex add_triangle();
  void link(HalfEdge e, HalfEdge f);
  LocalIndex split_triangle(LocalIndex t, geometry::Vec2 p);
  LocalIndex split_edge(HalfEdge e, geometry::Vec2 p);
  void legalize();
  bool is_illegal(HalfEdge e) const;
  bool is_strictly_convex(HalfEdge e) const;
  void flip(HalfEdge e);
  bool find_crossed(LocalIndex a, LocalIndex b, std::vector<HalfEdge>& crossed) const;
  /// Flips edges until a and b share an edge; the edges that it makes become doubtful.
  /// @return the edge from a to b, or `none`
  HalfEdge flip_to_edge(LocalIndex a, LocalIndex b);
  int side(LocalIndex a, LocalIndex b, LocalIndex c) const;

  geometry::Lattice lattice_;
  std::vector<geometry::Vec2> points_;
  std::vector<HalfEdge> leaving_;  // by vertex
  std::vector<LocalIndex> origin_; // by half-edge
  std::vector<HalfEdge> twin_;     // by half-edge
  std::vector<std::int32_t> mark_; // by half-edge
  std::vector<HalfEdge> doubtful_; // edges that legalize must examine
  mutable HalfEdge last_ = 0;      // triangle edge at which the last search ended
};

} // namespace trime::generalise
