// SPDX-License-Identifier: BSD-3-Clause
// Makes the groups of the metadata of a mesh file, for the function describe() and for the program.
#pragma once

#include "trime/boundary/features.hpp"
#include "trime/io/metadata.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"
#include "trime/meshing/options.hpp"
#include "trime/polygon/loop_summary.hpp"
#include "trime/record/describe.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace trime::record {

using Attributes = std::vector<io::Attribute>;

/// Returns a metadata column with one value for each element.
template <class T, class Element, class Value>
io::Column column(const std::string& name, const std::vector<Element>& elements, const Value& value) {
  std::vector<T> values;
  for (const Element& element : elements)
    values.push_back(static_cast<T>(std::invoke(value, element)));
  return {name, std::move(values)};
}

/// Returns the attributes with name and version of the file format.
Attributes format_attributes();
/// Returns the attributes with the reference system of the coordinates and the periods.
Attributes place_attributes(const Origin& origin);
/// Returns the attribute with the names of the open boundary; none if the user has not chosen it.
Attributes open_attributes(const Origin& origin);
/// Returns the names of the open boundary in the metadata of a file, see open_attributes().
std::optional<std::vector<std::string>> open_boundary_of(const io::Metadata& metadata);
/// Returns the attributes with counts and hash of the mesh.
/// @param retriangulation number of the triangulation, from 1
Attributes mesh_attributes(const mesh::DistributedMesh& mesh, int retriangulation);
/// Returns the attributes that say how the run went, and how the features of the shape were meshed.
Attributes result_attributes(const meshing::MeshResult& result);

io::MetadataGroup history_group(const std::vector<sweep::SweepRecord>& history);
io::MetadataGroup quality_group(const mesh::QualitySummary& quality);
io::MetadataGroup checks_group(const mesh::Checks& checks);
/// Returns the checks in the metadata of a file; none if it has no group with them.
mesh::Checks checks_of(const io::Metadata& metadata);
/// Returns the table of the worst triangles, QualitySummary::worst_triangles.
io::MetadataGroup bad_triangles_group(const mesh::QualitySummary& quality);
/// Returns the tables that explain the numbers in /Mesh/facets: the array `values` contains edge_id, the array `parts`
/// part_id.
io::MetadataGroup tags_group(const Origin& origin, const std::vector<polygon::LoopSummary>& loops);
/// Adds the tables that explain the numbers in /Mesh/curves and /Mesh/interfaces, if there are curves and regions: the
/// arrays `values` contain curve_id and pair_id.
io::Metadata with_inner_edges(io::Metadata metadata, const Origin& origin);
/// Does the same, and adds the table of the regions of a finished mesh, and that of their losses if there are any.
io::Metadata with_regions(io::Metadata metadata, const Origin& origin, const meshing::MeshResult& result);
/// Returns the kinds of the curves from the metadata of a file; none if no curve is split.
std::vector<geometry::CurveKind> curve_kinds(const io::Metadata& metadata);
/// Returns the table of corners at which small angles cannot be avoided.
io::MetadataGroup sharp_corners_group(const std::vector<boundary::SharpCorner>& corners);
/// Returns the table of the loops of the given shape.
io::MetadataGroup rings_group(const Origin& origin, const std::vector<boundary::LoopFate>& loops);

} // namespace trime::record
