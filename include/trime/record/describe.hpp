// SPDX-License-Identifier: BSD-3-Clause
// Makes the metadata of a mesh file: names and markers of the boundary, periods, loops, quality, checks and history.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/io/metadata.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/meshing/options.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace trime::shape {
class RegionShape;
}

namespace trime::record {

/// The names and markers that a mesh takes from its shape.
struct Origin {
  std::vector<std::string> part_names{};    ///< names of the parts, indexed by DistributedMesh::facet_parts
  std::vector<std::int32_t> part_markers{}; ///< marker of each part; 0: the part has no marker
  geometry::Regions regions{};              ///< names of the regions, and which of them share an interface
  geometry::Vec2 period{0, 0};              ///< sides of a periodic container; 0 in a direction that is not periodic
  std::string crs{};                        ///< reference system of the coordinates; empty: unknown
  std::vector<std::string> curve_names{};   ///< names of the curves, indexed by DistributedMesh::curve_numbers
  std::vector<std::int32_t> ring_lines{};   ///< line in a contour file of each loop of the shape; missing entries are 0
  std::vector<geometry::CurveKind> curve_kinds{}; ///< kinds of the curves, see geometry::InnerCurves::kinds
  /// Names of the open parts in files for coastal models, see formats::Names::open_boundary.
  std::optional<std::vector<std::string>> open_boundary{};
};

/// The smallest and the largest target edge length h at the points of the mesh.
struct SizeRange {
  double smallest = 0, largest = 0;
};
/// Finds the range of h over all ranks. Cost: O(points on this rank).
/// @note Collective.
SizeRange size_range(const mesh::DistributedMesh& mesh, const comm::Communicator& comm);

/// Returns the regions; a shape without named regions is one region, whose name is the expression that joins its parts.
geometry::Regions named(geometry::Regions regions, const std::string& geometry);
/// Returns the names and markers of a mesh of this shape.
Origin origin_of(const shape::RegionShape& shape);

/// @brief Returns the metadata that io::write_mesh takes. With it, the file is accepted by `trime_mpi info`, `trime_mpi
/// convert` and `trime_check`. Cost: O(points on this rank + loops + sweeps).
/// @param sizing describes the size in words; "uniform" for a uniform size, which `trime_check` checks more closely
/// @note Collective.
io::Metadata describe(const meshing::MeshResult& result, const Origin& origin, const std::string& sizing,
                      const comm::Communicator& comm);

} // namespace trime::record
