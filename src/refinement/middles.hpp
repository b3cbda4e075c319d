// SPDX-License-Identifier: BSD-3-Clause
// Decides where the new vertices of a refined mesh lie: in the middle of an edge or, on the boundary, on the curve of
// the shape.
#pragma once

#include "refinement/children.hpp"
#include "refinement/edge_table.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/handover/local_mesh.hpp"
#include "trime/refinement/refine.hpp"

#include <array>
#include <vector>

namespace trime::refinement {

/// @brief The places of the new vertices, one for each edge of the local triangles. All ranks that know an edge have
/// the same place for it.
class Middles {
public:
  /// Places the vertices. Collective. Cost: O(edges), and O(log(pieces)) for each edge on the boundary. All ranks
  /// exchange the edges whose middle cannot lie on the curve, which are few.
  /// @param curves null: all lie in the middles of the edges @pre all arguments outlive this object
  Middles(const comm::Communicator& comm, const geometry::Frame& frame, const handover::LocalMesh& mesh,
          const EdgeTable& edges, const geometry::Boundary* curves);

  /// Returns the place of the vertex on an edge, in the container.
  geometry::Vec2 place(LocalIndex edge) const { return places_[at(edge)]; }
  /// Returns the facet of the local mesh on this edge, or -1.
  LocalIndex facet(LocalIndex edge) const { return facets_[at(edge)]; }
  /// Divides a local triangle.
  Children children(LocalIndex triangle) const;
  /// Returns the counts of all ranks. Collective.
  BoundaryMiddles counts() const;

private:
  using Ends = std::array<GlobalId, 2>;
  enum class State : char { inside, straight, on_curve, near_curve, refused };

  std::array<geometry::Vec2, 3> corners(LocalIndex triangle) const;
  geometry::Vec2 straight_place(LocalIndex edge) const;
  void place_on_curves(const geometry::Boundary& curves);
  bool has_curve(LocalIndex triangle) const;
  bool is_good(LocalIndex triangle) const;
  bool is_delaunay(LocalIndex edge) const;
  void list_curved(LocalIndex triangle, std::vector<Ends>& list) const;
  bool is_curved(LocalIndex edge) const {
    return states_[at(edge)] == State::on_curve || states_[at(edge)] == State::near_curve;
  }
  Ends ends(LocalIndex edge) const {
    return {mesh_.global_id(edges_.lower(edge)), mesh_.global_id(edges_.upper(edge))};
  }
  std::vector<Ends> failures() const;
  std::vector<Ends> crossings() const;
  void straighten(const Ends& ends);

  const comm::Communicator& comm_;
  const geometry::Frame& frame_;
  const handover::LocalMesh& mesh_;
  const EdgeTable& edges_;
  std::vector<geometry::Vec2> places_; // by edge
  std::vector<LocalIndex> facets_;     // by edge
  std::vector<State> states_;          // by edge
};

} // namespace trime::refinement
