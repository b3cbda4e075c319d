// SPDX-License-Identifier: BSD-3-Clause
// The mesh file: NAME.h5 with its views NAME.xdmf and NAME.vtkhdf, written by all ranks together under a temporary
// name, read back, and renamed only when it is whole. The layout is a contract with users, see src/files.md.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/io/metadata.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <string>
#include <vector>

namespace trime::io {

class RunFiles;

/// Which files, and where.
struct MeshFileOptions {
  std::string directory = "out"; ///< made if it is missing
  std::string name = "mesh";     ///< stem of the file names
  bool overwrite = false;
  bool vtkhdf = true;    ///< group /VTKHDF and the link NAME.vtkhdf
  bool xdmf = true;      ///< group /Mesh/mesh (there in any case without vtkhdf) and the file NAME.xdmf
  bool is_final = false; ///< the mesh that the run is for: RunFiles will be told
  /// Marker of the edges of each part, by DistributedMesh::facet_parts; /Mesh/facets/markers if any is not 0.
  std::vector<std::int32_t> part_markers{};
  RunFiles* run_files = nullptr; ///< told which files exist, for a signal handler; null: nobody asks

  /// `directory/name` + ending.
  std::string path(const std::string& ending) const { return directory + "/" + name + ending; }
};

/// Group of the fields of points ("PointData") or triangles ("CellData"): inside /VTKHDF, or beside the plain mesh when
/// that view is not wanted.
std::string field_group(const MeshFileOptions& options, const char* name);

/// @brief Makes the directory if it is missing and sees that the files can be written. To be called before work starts
/// that would be lost.
/// @return warnings, e.g. of files that a killed run has left; on rank 0 only
/// @throws FileError on all ranks if the directory cannot be made or written, or a file exists and may not be
/// overwritten
/// @note Collective.
std::vector<std::string> check_output(const MeshFileOptions& options, const comm::Communicator& comm);

/// What was written.
struct WrittenFiles {
  std::vector<std::string> paths;
  std::int64_t bytes = 0; ///< size of NAME.h5
};

/// @brief Writes the mesh, reads every array back and compares it, and gives the files their names.
/// The metadata of rank 0 are written. Extra memory: two slices of a few MB per rank.
/// @throws FileError on all ranks together; no file under the final name is touched before the new one is whole, and
/// the temporary file is removed
/// @note Collective. Ranks may hold nothing.
WrittenFiles write_mesh(const MeshFileOptions& options, const mesh::DistributedMesh& mesh, const Metadata& metadata,
                        const comm::Communicator& comm);

/// Version of the HDF5 library, e.g. "1.10.8".
std::string hdf5_version();

/// @brief Whether HDF5 could not close a file on this rank, say one beyond a limit of the system. HDF5 tries again in
/// MPI_Finalize and crashes there (1.10.8), so such a program must end by `comm::abort_job`.
bool hdf5_cannot_end();

} // namespace trime::io
