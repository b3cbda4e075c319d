// SPDX-License-Identifier: BSD-3-Clause
// From certified stars to the mesh: which fans lie inside, triangles in canonical order, quality, and the certificate.
#pragma once

#include "meshing/site_state.hpp"
#include "trime/core/unset_vector.hpp"
#include "trime/decomposition/numbering.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"
#include "trime/mesh/validity.hpp"
#include "trime/meshing/boundary_sites.hpp"
#include "trime/sizing/size_field.hpp"

#include <span>
#include <vector>

namespace trime::meshing {

/// What the extraction needs to know of the run.
struct ExtractionContext {
  const SiteState& state;
  const BoundarySites& boundary;
  const sizing::SizeField& size;
  const geometry::Lattice& lattice;
  std::span<const geometry::Vec2> fixed = {}; ///< points that must be vertices, in lexicographic order
};

/// @brief The inside fan of a site: the run of ring entries whose consecutive pairs are the triangles inside the shape.
/// For an inner site the whole ring (`closed`); for a boundary site from its next to its previous boundary neighbour.
/// `complete` is false if a triangle or a boundary segment is missing.
struct Fan {
  std::span<const LocalIndex> ring;
  std::size_t first = 0, triangles = 0;
  bool closed = false, complete = false;

  /// @pre k <= triangles + 1
  LocalIndex neighbour(std::size_t k) const {
    const std::size_t at = first + k;
    return ring[at < ring.size() ? at : at - ring.size()];
  }
  /// Number of edges from the site: triangles, plus one for an open fan.
  std::size_t edges() const { return closed ? triangles : triangles + 1; }
};
Fan inside_fan(const ExtractionContext& context, LocalIndex i);

/// Owned sites whose fan is not complete, on this rank.
std::int64_t count_incomplete_fans(const ExtractionContext& context);

/// @brief The inside fan of a site as flat lists: vertex and position of its neighbours. Triangle k has the neighbours
/// k and k + 1; a closed fan ends with its first two neighbours again.
class FlatFan {
public:
  FlatFan(const ExtractionContext& context, const decomposition::Numbering& numbering)
      : context_(context), numbering_(numbering) {}

  void load(LocalIndex site);
  /// Triangles whose other vertices have higher places than `own`, by the place of the first of these.
  std::span<const std::uint32_t> triangles_above(LocalIndex own);

  bool closed = false, complete = false;
  std::size_t triangles = 0, edges = 0;    ///< edges: of complete fans, else 0
  UnsetVector<LocalIndex> vertices, place; ///< place: see Numbering
  UnsetVector<geometry::Vec2> positions;

private:
  const ExtractionContext& context_;
  const decomposition::Numbering& numbering_;
  UnsetVector<std::uint32_t> above_;
};

/// The mesh in canonical numbering, with its quality.
struct Extraction {
  mesh::DistributedMesh mesh;
  mesh::QualitySummary quality;
};
/// @pre stars of all sites are certain, bins and halo fresh. O(points); threads.
/// @throws GeometryError on all ranks together if the size at an edge is not positive and finite. Collective.
Extraction extract_mesh(const ExtractionContext& context, const decomposition::Numbering& numbering);

/// What the mesh is to be a mesh of.
struct Expectation {
  const geometry::Boundary& shape;  ///< as it was given
  const geometry::Boundary& meshed; ///< as it was laid out: with fixed points as corners
  double side;                      ///< longer side of the container
};

/// @brief The certificate: manifold, positive, Euler characteristic, area, Delaunay, boundary segments, corners, fixed
/// points, agreement of all stars with each other and with `mesh`, the arrays that will be written: exact integers
/// throughout. Then the boundary of the mesh against that of the shape, see prove_boundary. Collective.
/// O(points + pieces log(pieces))
mesh::Checks certify(const ExtractionContext& context, const decomposition::Numbering& numbering,
                     const Expectation& expectation, const mesh::DistributedMesh& mesh);

} // namespace trime::meshing
