// SPDX-License-Identifier: BSD-3-Clause
// The part of a mesh file that rank 0 writes alone, before all ranks write the large arrays.
#pragma once

#include "io/file_start.hpp"
#include "trime/io/mesh_file.hpp"
#include "trime/io/metadata.hpp"
#include "trime/mesh/distributed_mesh.hpp"

namespace trime::io {

/// Returns whether the file has the group /Mesh/mesh; without any view the file is still a mesh.
bool has_plain_mesh(const MeshFileOptions& options);

/// Makes the groups of the views and of the fields, and writes all metadata. If the file has the plain mesh and the
/// group /VTKHDF, points and triangles of the latter show those of the plain mesh.
/// @param bytes_per_id bytes of a vertex of a triangle, 4 or 8
void start_mesh_file(const FileStart& start, const MeshFileOptions& options, const mesh::DistributedMesh& mesh,
                     const Metadata& metadata, int bytes_per_id);

} // namespace trime::io
