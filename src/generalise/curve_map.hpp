// SPDX-License-Identifier: BSD-3-Clause
// Represents the curves of a boundary as constrained edges of a triangulation, and finds the curve that an edge
// represents.
#pragma once

#include "generalise/triangulation.hpp"

#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

#include <span>
#include <vector>

namespace trime::generalise {

/// @brief A boundary, its nodes, and the triangulation whose constrained edges follow the boundary. Nodes are the ends
/// of all pieces and some points of arcs; more can be added. The shape lies on the left of each edge with a mark.
class CurveMap {
public:
  using HalfEdge = Triangulation::HalfEdge;

  /// @param size size field with the target edge length h
  /// @param inside lattice points inside the shape and off the curves, which become vertices too
  /// @pre the container is not periodic
  /// @throws GeometryError if a size is not positive and finite
  CurveMap(const geometry::Boundary& boundary, const sizing::SizeField& size, const geometry::Lattice& lattice,
           std::span<const geometry::Vec2> inside = {});

  /// Returns false if edges between nodes cross, because arcs are too near to other curves, or if a point of `inside`
  /// does not lie inside. Then no other function may be called.
  bool is_valid() const { return valid_; }
  const Triangulation& mesh() const { return mesh_; }
  const geometry::Boundary& boundary() const { return boundary_; }

  /// Adds a node in the middle of a constrained edge. Returns false if the coordinate lattice is too coarse for it.
  bool add_node(Triangulation::HalfEdge e);

  /// Returns the target edge length h at a vertex; 0 at the corners of the box.
  double size(LocalIndex v) const { return size_[at(v)]; }
  bool is_on_curve(LocalIndex v) const { return v >= 4 && !is_held(v); }
  /// Returns whether the vertex is a point of `inside`, which must stay inside.
  bool is_held(LocalIndex v) const { return held_[at(v)] != 0; }
  /// Returns whether the user asked for this vertex, on the curve or inside.
  bool is_kept(LocalIndex v) const { return kept_[at(v)] != 0; }

  /// Return the neighbours of a vertex along its curve, with the shape on the left. Cost: O(degree).
  LocalIndex next_on_curve(LocalIndex v) const;
  LocalIndex previous_on_curve(LocalIndex v) const;

  /// A part of one piece of the boundary.
  struct Span {
    LocalIndex loop, piece;
    double from, to; ///< arc length from the start of the piece
  };
  /// Returns the part of a piece that a half-edge represents.
  /// @pre the half-edge has a mark for its direction
  Span span_of(HalfEdge e) const;

  /// Returns for each triangle whether it lies in the shape. Cost: O(triangles).
  std::vector<char> inside() const;
  /// Returns the points that lie inside the shape, but not on a curve. Cost: O(triangles + the walks from each point to
  /// the next).
  std::vector<geometry::Vec2> those_inside(std::span<const geometry::Vec2> points) const;

private:
  /// The curve between two neighbouring nodes.
  struct Strand {
    LocalIndex loop, piece;
    double from, to;
    LocalIndex first, last; // vertices
  };
  void add_strands(LocalIndex loop);
  void insert_vertices(std::span<const geometry::Vec2> held);
  bool insert_one(geometry::Vec2 p, Strand* strand);
  bool holds_points() const;

  const geometry::Boundary& boundary_;
  const sizing::SizeField& field_;
  geometry::Lattice lattice_;
  Triangulation mesh_;
  std::vector<Strand> strands_;
  std::vector<double> size_;  // by vertex
  std::vector<char> kept_;    // by vertex
  std::vector<char> held_;    // by vertex
  std::vector<double> along_; // by vertex: position along its piece, for added vertices
  bool valid_ = true;
};

} // namespace trime::generalise
