// SPDX-License-Identifier: BSD-3-Clause
// Numbers the vertices of the Voronoi cells over all ranks, so that cells share vertices by their numbers. The vertices
// are, in this order: the circumcentres, with the numbers of their triangles; the middles of boundary edges; the sites
// on the boundary; the middles of edges between regions; sites inside at which regions meet. Whole cells need the first
// three groups only, the parts of cells in each region all of them.
#pragma once

#include "dual/site_cell.hpp"

#include <array>
#include <vector>

namespace trime::dual {

/// A corner of a cell.
struct CellCorner {
  GlobalId vertex;
  geometry::Vec2 place; ///< relative to the site
  bool is_image;        ///< the vertex itself lies a period away
};

class CellVertices {
public:
  /// The groups behind the circumcentres.
  enum Group : std::size_t { facet_middles, boundary_sites, interface_middles, interface_sites };

  /// Numbers the vertices. The numbers do not depend on the number of ranks.
  /// @pre cells outlive this object
  /// @note Collective.
  CellVertices(const Cells& cells, const comm::Communicator& comm);

  /// Return the number of vertices of whole cells, and of parts of cells.
  GlobalId whole_count() const { return first_[interface_middles]; }
  GlobalId count() const { return first_.back(); }
  GlobalId count(Group group) const { return first_[group + 1] - first_[group]; }
  /// Returns the number of this rank's first vertex of a group.
  GlobalId first(Group group) const { return rank_first_[group]; }
  /// Returns this rank's vertices of a group, in the order of their numbers.
  const std::vector<geometry::Vec2>& places(Group group) const { return places_[group]; }

  /// Returns the corners of a part of a cell, counter-clockwise.
  std::vector<CellCorner> corners(const Surroundings& around, LocalIndex site, const CellPart& part) const;

private:
  /// A spoke at whose middle the cell is divided.
  struct Divided {
    LocalIndex site, end;
    std::int32_t spoke;
    bool is_facet;
    GlobalId vertex;
  };
  /// A site that is a vertex.
  struct SiteVertex {
    LocalIndex site;
    GlobalId vertex;
  };
  struct Collector;

  void find();
  void number(const comm::Communicator& comm);
  void fetch_others(const comm::Communicator& comm);
  GlobalId middle_at(LocalIndex site, LocalIndex end) const;
  bool is_displaced(LocalIndex site, LocalIndex from) const;

  const Cells& cells_;
  std::vector<Divided> divided_;          // by site, then by spoke
  std::vector<SiteVertex> site_vertices_; // by site
  std::array<std::vector<geometry::Vec2>, 4> places_;
  std::array<GlobalId, 4> rank_first_{};
  std::array<GlobalId, 5> first_{}; // number of the first vertex of each group over all ranks
};

} // namespace trime::dual
