// SPDX-License-Identifier: BSD-3-Clause
// Moves vertices of a boundary: apart where a slit is narrower than the resolution, and together where they almost
// coincide. No triangle is inverted, so no two curves cross.
#pragma once

#include "generalise/loop_builder.hpp"
#include "generalise/narrow_parts.hpp"
#include "generalise/rim.hpp"

#include "trime/geometry/segment_grid.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace trime::generalise {

/// The places of all vertices while some of them move.
class VertexMoves {
public:
  /// @param labels 1 for each triangle that is inside; may have changed since the map was made
  /// @param bounds box whose corners are lattice points; widen() moves no vertex out of it
  VertexMoves(const CurveMap& map, const std::vector<char>& labels, const geometry::Lattice& lattice,
              const geometry::Box& bounds);

  /// @brief Moves the sides of narrow parts apart, each by half of the missing width, and less towards the ends of a
  /// slit. A vertex that would invert a triangle is moved less, or not at all. Parts that are almost wide enough
  /// everywhere are not changed.
  /// @return how many parts were too narrow. O(triangles) in each of a few rounds
  std::int64_t widen(std::vector<NarrowPart> parts);
  /// Joins neighbouring corners that are nearer to each other than a small share of h, such as those of steps and blunt
  /// tips.
  void merge_close_corners();

  bool any() const { return any_; }
  const MovedVertices& places() const { return places_; }
  /// Returns the largest distance over h that a vertex has moved.
  double largest_share() const;

private:
  using HalfEdge = Triangulation::HalfEdge;
  double turn_at(HalfEdge e) const;
  /// Returns true if no other vertex was moved to it.
  bool is_alone(LocalIndex v) const { return is_root_[at(v)] == 0; }
  bool leaves_a_loop(HalfEdge e) const;
  /// Returns true if the sides of the edge differ.
  bool is_wall(HalfEdge e) const { return rim_.is_inside(e) != rim_.is_inside(mesh_.twin(e)); }
  void merge(LocalIndex u, LocalIndex v);
  bool turns_over(LocalIndex t) const;
  /// The vertices that move, and the triangles that they belong to.
  struct Moving {
    std::vector<LocalIndex> vertices, triangles;
  };
  Moving those_moving(const std::vector<geometry::Vec2>& shifts) const;
  /// Moves the vertices by their shifts, onto the lattice and into the bounds.
  void place(const Moving& moving, const std::vector<geometry::Vec2>& shifts);
  /// Makes shifts smaller until no triangle turns over, and places the vertices.
  void shorten(std::vector<geometry::Vec2>& shifts);
  /// Returns the roots of the vertices of those triangles that turn over, sorted.
  std::vector<LocalIndex> turned_over(std::span<const LocalIndex> triangles) const;
  /// The sides of a narrow part, and the ends of its slits.
  struct Sides {
    struct AtVertex {
      double gap = INFINITY; // distance to the other side
      geometry::Vec2 away;   // from the middle of the part: sum of normals
    };
    std::map<LocalIndex, AtVertex> vertices;
    geometry::SegmentGrid ends; // points
  };
  Sides sides_of(const NarrowPart& part) const;
  double missing_way(const NarrowPart& part, const Sides& sides, LocalIndex v) const;
  bool is_too_narrow(const NarrowPart& part) const;
  void widen_one(const NarrowPart& part, std::vector<geometry::Vec2>& shifts) const;

  void calm(std::vector<geometry::Vec2>& shifts) const;
  void thin(std::span<const NarrowPart> parts);
  void forget();
  LocalIndex root(LocalIndex v) const { return root_[at(v)]; }

  const CurveMap& map_;
  const Triangulation& mesh_;
  const Rim rim_;
  geometry::Lattice lattice_;
  geometry::Box bounds_;
  MovedVertices places_;
  std::vector<char> is_root_;    // by vertex: of others
  std::vector<LocalIndex> root_; // by vertex: the one to which it was moved, or itself
  bool any_ = false;
};

} // namespace trime::generalise
