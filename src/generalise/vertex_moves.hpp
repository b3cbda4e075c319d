// SPDX-License-Identifier: BSD-3-Clause
// Moves vertices of a boundary: apart where a slit is narrower than the resolution, and together where they almost
// coincide. Because no triangle is inverted, no two curves cross.
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

/// The positions of all vertices while some of them move.
class VertexMoves {
public:
  /// @param labels 1 for each triangle that lies inside the shape; may have changed since the map was made
  /// @param bounds a box with lattice points as corners; widen() moves no vertex out of it
  VertexMoves(const CurveMap& map, const std::vector<char>& labels, const geometry::Lattice& lattice,
              const geometry::Box& bounds);

  /// @brief Moves the sides of narrow parts apart, each by half of the missing width, and by less towards the ends of a
  /// slit. A vertex that would invert a triangle is moved by less, or not at all. Parts that are almost wide enough
  /// everywhere are not changed.
  /// @return how many parts were too narrow. Cost: O(triangles) in each of a few rounds
  std::int64_t widen(std::vector<NarrowPart> parts);
  /// Joins neighbouring corners that are nearer to each other than a small share of h, for example at steps and blunt
  /// tips.
  void merge_close_corners();

  bool any() const { return any_; }
  const MovedVertices& places() const { return places_; }
  /// Returns the largest distance by which a vertex has moved, divided by h.
  double largest_share() const;

private:
  using HalfEdge = Triangulation::HalfEdge;
  double turn_at(HalfEdge e) const;
  /// Returns true if no other vertex was joined with this one.
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
      geometry::Vec2 away;   // direction away from the middle of the part: sum of normals
    };
    std::map<LocalIndex, AtVertex> vertices;
    geometry::SegmentGrid ends; // ends of slits, as points
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
  std::vector<char> is_root_;    // by vertex: whether other vertices were joined with it
  std::vector<LocalIndex> root_; // by vertex: the vertex with which it was joined, or itself
  bool any_ = false;
};

} // namespace trime::generalise
