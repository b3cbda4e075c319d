// SPDX-License-Identifier: BSD-3-Clause
// The curves of a boundary as constrained edges of a triangulation, and the way back from edges to curves.
#pragma once

#include "generalise/triangulation.hpp"

#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

#include <span>
#include <vector>

namespace trime::generalise {

/// @brief A boundary, its nodes and the triangulation whose constrained edges follow it. Nodes are the ends of all
/// pieces and some places on arcs; more can be added. The shape lies left of each edge with a mark.
class CurveMap {
public:
  using HalfEdge = Triangulation::HalfEdge;

  /// @param size h @pre no periods
  CurveMap(const geometry::Boundary& boundary, const sizing::SizeField& size, const geometry::Lattice& lattice);

  /// False if the chords between nodes cross: arcs too near to others. Then nothing else may be asked.
  bool is_valid() const { return valid_; }
  const Triangulation& mesh() const { return mesh_; }
  const geometry::Boundary& boundary() const { return boundary_; }

  /// Adds a node in the middle of a constrained edge; false if the lattice is too coarse.
  bool add_node(Triangulation::HalfEdge e);

  /// h at a vertex; 0 at the corners of the box.
  double size(LocalIndex v) const { return size_[at(v)]; }
  bool is_on_curve(LocalIndex v) const { return v >= 4; }
  /// Has the user asked for this vertex?
  bool is_kept(LocalIndex v) const { return kept_[at(v)] != 0; }

  /// The neighbours of a vertex on its curve, the shape on the left. O(degree)
  LocalIndex next_on_curve(LocalIndex v) const;
  LocalIndex previous_on_curve(LocalIndex v) const;

  /// A way along one piece.
  struct Span {
    LocalIndex loop, piece;
    double from, to; ///< arc length from the start of the piece
  };
  /// Of a half-edge with a mark of its own direction.
  Span span_of(HalfEdge e) const;

  /// By triangle: does it lie in the shape? O(triangles)
  std::vector<char> inside() const;

private:
  /// The curve between two neighbouring nodes.
  struct Strand {
    LocalIndex loop, piece;
    double from, to;
    LocalIndex first, last; // vertices
  };
  void add_strands(LocalIndex loop);
  void insert_nodes();

  const geometry::Boundary& boundary_;
  const sizing::SizeField& field_;
  geometry::Lattice lattice_;
  Triangulation mesh_;
  std::vector<Strand> strands_;
  std::vector<double> size_;  // by vertex
  std::vector<char> kept_;    // by vertex
  std::vector<double> along_; // by vertex: of those that were added, on their piece
  bool valid_ = true;
};

} // namespace trime::generalise
