// SPDX-License-Identifier: BSD-3-Clause
// Writes the mesh file: NAME.h5 with its views NAME.xdmf and NAME.vtkhdf. All ranks write it together under a temporary
// name, read it back, and rename it only when it is complete. src/files.md describes the layout for users.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/io/metadata.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <string>
#include <vector>

namespace trime::io {

class RunFiles;

/// Names, place and kinds of the files to write.
struct MeshFileOptions {
  std::string directory = "out"; ///< created if it is missing
  std::string name = "mesh";     ///< stem of the file names
  bool overwrite = false;
  bool vtkhdf = true;    ///< group /VTKHDF and the link NAME.vtkhdf
  bool xdmf = true;      ///< group /Mesh/mesh (always written without vtkhdf) and the file NAME.xdmf
  bool is_final = false; ///< the final mesh of the run: RunFiles notes it
  /// Marker of the edges of each part, indexed by DistributedMesh::facet_parts; written as /Mesh/facets/markers if any
  /// is not 0.
  std::vector<std::int32_t> part_markers{};
  RunFiles* run_files = nullptr; ///< notes which files exist, for a signal handler; may be null

  /// Returns `directory/name` + ending.
  std::string path(const std::string& ending) const { return directory + "/" + name + ending; }
};

/// Returns the group for the fields of points ("PointData") or triangles ("CellData"): inside /VTKHDF, or next to the
/// plain mesh if that view is not written.
std::string field_group(const MeshFileOptions& options, const char* name);

/// @brief Creates the directory if it is missing, and checks that the files can be written. Call it before long work
/// whose result would be lost.
/// @return warnings, for example about files that a killed run has left; on rank 0 only
/// @throws FileError on all ranks if the directory cannot be made or written, or a file exists and may not be
/// overwritten
/// @note Collective.
std::vector<std::string> check_output(const MeshFileOptions& options, const comm::Communicator& comm);

/// The files that were written.
struct WrittenFiles {
  std::vector<std::string> paths;
  std::int64_t bytes = 0; ///< size of NAME.h5
};

/// @brief Writes the mesh, reads every array back and compares it, and renames the files. Writes the metadata of rank
/// 0. Extra memory: two slices of a few MB per rank.
/// @throws FileError on all ranks together. An older file of this name stays until the new one is complete. The
/// temporary file is removed
/// @note Collective. Ranks may hold no points.
WrittenFiles write_mesh(const MeshFileOptions& options, const mesh::DistributedMesh& mesh, const Metadata& metadata,
                        const comm::Communicator& comm);

/// Returns the version of the HDF5 library, for example "1.10.8".
std::string hdf5_version();

/// @brief Returns true if HDF5 could not close a file on this rank, for example a file beyond a limit of the system.
/// HDF5 would try again in MPI_Finalize and crash there (1.10.8), so the program must then end with `comm::abort_job`.
bool hdf5_cannot_end();

} // namespace trime::io
