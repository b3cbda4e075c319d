// SPDX-License-Identifier: BSD-3-Clause
// Makes the metadata that every mesh file should have: size, hash, quality and checks. Programs may add more.
#pragma once

#include "trime/io/metadata.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"
#include "trime/mesh/validity.hpp"

namespace trime::io {

/// Returns the group `quality`.
MetadataGroup quality_group(const mesh::QualitySummary& quality);
/// Returns the group `checks`.
MetadataGroup checks_group(const mesh::Checks& checks);
/// Returns the group `worst_triangles`, from QualitySummary::worst_triangles.
MetadataGroup bad_triangles_group(const mesh::QualitySummary& quality);

/// @brief Returns counts, hash, quality and checks for write_mesh; `complete` is 1 if all checks passed.
Metadata describe(const mesh::DistributedMesh& mesh, const mesh::QualitySummary& quality, const mesh::Checks& checks);

} // namespace trime::io
