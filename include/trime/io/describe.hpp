// SPDX-License-Identifier: BSD-3-Clause
// What any mesh file should say of its mesh: size, hash, quality and checks as metadata. Programs add what they know.
#pragma once

#include "trime/io/metadata.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"
#include "trime/mesh/validity.hpp"

namespace trime::io {

/// Group `quality`.
MetadataGroup quality_group(const mesh::QualitySummary& quality);
/// Group `checks`.
MetadataGroup checks_group(const mesh::Checks& checks);
/// QualitySummary::worst_triangles, as the group `worst_triangles`.
MetadataGroup bad_triangles_group(const mesh::QualitySummary& quality);

/// @brief Counts, hash, quality and checks, as write_mesh takes them; `complete` is 1 if all checks passed.
Metadata describe(const mesh::DistributedMesh& mesh, const mesh::QualitySummary& quality, const mesh::Checks& checks);

} // namespace trime::io
