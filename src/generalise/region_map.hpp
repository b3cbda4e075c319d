// SPDX-License-Identifier: BSD-3-Clause
// The regions of a shape as labels of the triangles between all of its curves.
#pragma once

#include "generalise/cut_wedges.hpp"
#include "generalise/triangulation.hpp"
#include "trime/geometry/boundary.hpp"

#include <vector>

namespace trime::generalise {

/// @brief A triangulation whose constrained edges follow the boundary and the curves inside, with the region of each
/// triangle. Arcs of circles are chords.
class RegionMap {
public:
  using HalfEdge = Triangulation::HalfEdge;
  static constexpr int outside = -1;

  /// A chord of a piece: from vertex `from` to vertex `to`.
  struct Strand {
    int arc;           ///< number of the arc; -1 - loop for the boundary
    std::size_t piece; ///< number of the piece
    LocalIndex from, to;
    double sweep; ///< turn of the arc of a circle that the chord stands for, positive to the left; 0 if it is straight
  };

  /// Refers to all of its arguments. @pre the container is not periodic
  /// @throws GeometryError if a size is not positive and finite
  RegionMap(const geometry::InnerCurves& curves, const geometry::Boundary& boundary, const ArcRequest& request);

  /// Returns false if curves cross or touch outside of their ends, or if they contradict each other about regions. Then
  /// no other function may be called.
  bool is_valid() const { return valid_; }
  const Triangulation& mesh() const { return mesh_; }
  /// Returns the strands in the order of the boundary and the arcs. Their numbers are the marks of the edges; a strand
  /// with further nodes is several edges.
  const std::vector<Strand>& strands() const { return strands_; }
  /// Adds nodes to straight arcs where another curve is near, so that widths can be measured there.
  void add_nodes_to_narrow_parts();
  /// Returns the target edge length h at a vertex.
  double size(LocalIndex v) const { return size_[at(v)]; }
  /// Returns whether nothing around the vertex may change.
  bool is_held(LocalIndex v) const { return held_[at(v)] != 0; }
  /// Returns whether the user asked for the vertex.
  bool is_kept(LocalIndex v) const;

  /// The region of a triangle; outside of the shape -1.
  int label(LocalIndex triangle) const { return labels_[at(triangle)]; }
  int label_beside(HalfEdge e) const {
    return mesh_.twin(e) == Triangulation::none ? outside : label(Triangulation::triangle(mesh_.twin(e)));
  }
  void set_label(LocalIndex triangle, int label) { labels_[at(triangle)] = label; }
  /// Returns whether different regions, or a region and the outside, lie on the two sides of an edge.
  bool is_wall(HalfEdge e) const { return label(Triangulation::triangle(e)) != label_beside(e); }
  /// Returns the region that a strand was given on the side of a half-edge on it.
  int given_label(HalfEdge e) const;
  /// Returns the area between a strand and the arc of a circle that it stands for; negative if the arc is on its left.
  double bulge(const Strand& strand) const;
  /// Returns the curve of the user on an edge inside the shape, as an index into InnerCurves::names; -1 if none is.
  int curve_on(HalfEdge e) const;
  double area(LocalIndex triangle) const;
  double length(HalfEdge e) const {
    return geometry::length(mesh_.point(mesh_.target(e)) - mesh_.point(mesh_.origin(e)));
  }

private:
  /// A further vertex on a straight piece.
  struct Split {
    std::size_t arc, piece;
    bool at_end; ///< near the end of the piece, not near its start
    geometry::Vec2 place;
  };
  void find_tips();
  bool wants_node(HalfEdge e) const;
  bool add_node(HalfEdge e);
  void add_strands(int arc, const std::vector<geometry::Piece>& pieces, std::vector<geometry::Vec2>& places);
  void insert_vertices(const std::vector<geometry::Vec2>& places);
  void hold_vertices();
  void set_labels();
  const geometry::Piece& piece(const Strand& strand) const;

  const geometry::InnerCurves& curves_;
  const geometry::Boundary& boundary_;
  const ArcRequest& request_;
  Triangulation mesh_;
  std::vector<Strand> strands_; // by mark
  std::vector<Split> splits_;   // in the order of the arcs
  std::vector<double> size_;    // by vertex
  std::vector<char> held_;      // by vertex
  std::vector<int> labels_;     // by triangle
  bool valid_ = true;
};

} // namespace trime::generalise
