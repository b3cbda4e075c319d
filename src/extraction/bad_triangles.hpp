// SPDX-License-Identifier: BSD-3-Clause
// The worst triangles of a mesh, and whether a sharp corner of the shape excuses them.
#pragma once

#include "polygon/polygon.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/periods.hpp"
#include "trime/mesh/quality.hpp"

#include <vector>

namespace trime::extraction {

/// The corners of the boundary that are sharper than 60 degrees on the inside. Replicated, immutable.
class SharpCorners {
public:
  SharpCorners(const polygon::BoundarySites& boundary, const geometry::Periods& periods);

  /// A corner and its angle; none: 0 degrees.
  struct Corner {
    geometry::Vec2 place;
    double degrees = 0;
  };
  /// @brief The nearest corner within 3 longest edges of a triangle, by its vertices; the first in lexicographic order
  /// of equally near ones. O(corners in a strip of this width).
  Corner near(geometry::Vec2 p, geometry::Vec2 q, geometry::Vec2 r) const;

private:
  const geometry::Periods& periods_;
  std::vector<Corner> corners_; // in lexicographic order
};

/// Mergeable in any order: the list is that of the worst, by alpha and then by place.
class BadTriangles {
public:
  /// @pre alpha is above ExtractionRules::listed_alpha
  void add(const mesh::BadTriangle& triangle);
  void merge(const BadTriangles& other);
  /// The triangles of this rank so far.
  std::int64_t count() const { return count_; }
  /// @brief Returns the list over all ranks, the same on every rank; each rank sends only its list. @param count over
  /// all ranks, which send nothing if it is 0. Collective.
  void gather(const comm::Communicator& comm, std::int64_t count);
  /// Writes count, list, and the worst away from corners into the summary.
  void tell(mesh::QualitySummary& quality) const;

private:
  std::int64_t count_ = 0;
  std::vector<mesh::BadTriangle> worst_; ///< sorted, at most ExtractionRules::most_listed
  mesh::BadTriangle away_;               ///< the worst that no corner excuses
};

} // namespace trime::extraction
