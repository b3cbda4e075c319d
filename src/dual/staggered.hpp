// SPDX-License-Identifier: BSD-3-Clause
// Numbers the cells, edges and vertices of a staggered grid (Arakawa's C-grid) on the Voronoi cells over all ranks: it
// has scalars at sites, normal velocities on the edges of the mesh, and vorticities in the triangles. A cell is a site,
// or a site inside of the mesh if only whole cells are wanted; edges and vertices are the edges and the triangles with
// a cell at one of their ends. Each belongs to the cell with the lowest number at its ends, so that ranks write them
// site by site.
#pragma once

#include "dual/site_cell.hpp"

#include <array>
#include <vector>

namespace trime::dual {

/// Holds what a cell knows of the edge along one of its spokes, for sums around the cell.
struct RingEdge {
  GlobalId edge;
  double dual_length;
  /// Share of the cell that lies in the triangle on the left of the spoke; 0 outside of the mesh.
  double kite_share;
  bool is_first; ///< this cell is the first one of the edge, so the normal of the edge points away from it
};

/// The numbers of cells, edges and vertices, and the rings of edges around cells, on the ranks of the Voronoi cells.
class StaggeredGrid {
public:
  /// Numbers all parts of the grid. The numbers do not depend on the number of ranks.
  /// @param only_whole leaves out the cells on the boundary, and what no cell touches
  /// @pre cells outlive this object
  /// @note Collective; a few sparse exchanges. Memory: 90 bytes per point.
  StaggeredGrid(const Cells& cells, bool only_whole, const comm::Communicator& comm);

  GlobalId cell_count() const { return totals_[cell]; }
  GlobalId edge_count() const { return totals_[edge]; }
  GlobalId vertex_count() const { return totals_[vertex]; }
  GlobalId inner_edge_count() const { return inner_edges_; } ///< edges between two cells
  std::int64_t most_edges() const { return most_edges_; }    ///< largest number of edges of a cell
  bool is_cell(LocalIndex point) const { return numbers_[at(point)] >= 0; }

  /// Return the numbers of the cell of a point (see Cells::points), of the edge from corner k to the next corner of a
  /// triangle (see Cells::triangles), of the edge along a spoke, and of a triangle. They are -1 if the grid has no such
  /// thing.
  GlobalId cell_at(LocalIndex point) const { return numbers_[at(point)]; }
  GlobalId edge_at(LocalIndex triangle, std::size_t k) const { return sides_[at(triangle)][k]; }
  GlobalId edge_of_spoke(LocalIndex site, std::size_t spoke) const;
  GlobalId vertex_at(LocalIndex triangle) const { return vertices_[at(triangle)]; }

  /// Return how many edges and vertices belong to a site.
  std::int64_t edges_of(LocalIndex site) const { return before_[edge][at(site) + 1] - before_[edge][at(site)]; }
  std::int64_t vertices_of(LocalIndex site) const { return before_[vertex][at(site) + 1] - before_[vertex][at(site)]; }
  /// Return whether an edge or a vertex belongs to the cell of a site.
  bool owns_edge(LocalIndex site, LocalIndex end) const { return owner_of(site, end) == site; }
  bool owns_vertex(LocalIndex site, LocalIndex triangle) const;

  /// Returns the edges around the cell of a site, or of a second cell of an edge that belongs to a site of this rank,
  /// counter-clockwise.
  std::vector<RingEdge> ring(LocalIndex point) const;
  /// Returns only the numbers of these edges.
  std::vector<GlobalId> ring_numbers(LocalIndex point) const;

private:
  enum Kind : std::size_t { cell, edge, vertex };
  /// The number of an edge or a vertex of another rank. An edge has its ends as key, that of its owner first; a vertex
  /// has its owner and the number of its triangle.
  struct Foreign {
    GlobalId owner, other, number;
  };
  struct ForeignRing {
    LocalIndex point;
    std::vector<RingEdge> edges;
  };

  LocalIndex owner_of(LocalIndex a, LocalIndex b) const;
  LocalIndex owner_of(LocalIndex triangle) const;
  LocalIndex spoke_end(LocalIndex site, std::size_t spoke) const;
  std::size_t spokes_of(LocalIndex site) const;
  GlobalId own_edge(LocalIndex site, LocalIndex end) const;
  GlobalId own_vertex(LocalIndex site, GlobalId triangle) const;
  GlobalId find_edge(LocalIndex a, LocalIndex b) const;
  GlobalId find_vertex(LocalIndex triangle) const;
  static GlobalId number_in(const std::vector<Foreign>& table, GlobalId owner, GlobalId other);

  void number_cells(bool only_whole, const comm::Communicator& comm);
  void count_parts(const comm::Communicator& comm);
  void find_foreign();
  void fetch_numbers(std::vector<Foreign>& table, Kind kind, const comm::Communicator& comm);
  void number_triangles();
  const ForeignRing& foreign_ring(LocalIndex point) const;
  void fetch_rings(const comm::Communicator& comm);

  const Cells& cells_;
  std::vector<GlobalId> numbers_;                   // [points], of cells
  std::array<std::vector<std::int64_t>, 3> before_; // by kind: [sites + 1], counts on this rank; none for cells
  std::vector<std::array<GlobalId, 3>> sides_;      // by triangle: edges from each corner to the next one
  std::vector<GlobalId> vertices_;                  // by triangle
  std::array<GlobalId, 3> first_{}, totals_{};      // by kind: on the ranks before this one, on all
  GlobalId inner_edges_ = 0;
  std::int64_t most_edges_ = 0;
  std::vector<Foreign> foreign_edges_, foreign_vertices_; // ascending by owner, then by the other number
  std::vector<ForeignRing> foreign_rings_;                // by point
};

} // namespace trime::dual
