// SPDX-License-Identifier: BSD-3-Clause
// Writes the mesh file, and reads it: NAME.h5 with its views NAME.xdmf and NAME.vtkhdf. All ranks write it together
// under a temporary name, read it back, and rename it only when it is complete. src/files.md describes the layout for
// users.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/io/metadata.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <array>
#include <atomic>
#include <climits>
#include <string>
#include <vector>

namespace trime::io {

/// @brief Knows the temporary file that is being written, and whether the final mesh is written. A program that handles
/// signals makes one object, passes its address to MeshFileOptions, and asks it in the handler. There is one temporary
/// file at a time.
class RunFiles {
public:
  /// Notes that a file is being written under this temporary name. Names longer than PATH_MAX are not noted.
  void start_writing(const std::string& temporary) noexcept;
  /// Notes that this file has its final name, or has been removed.
  void stop_writing() noexcept { writing_ = false; }
  /// Notes that the final mesh has its name; other files of the run may follow.
  void set_final_mesh_written() noexcept { final_mesh_written_ = true; }

  /// Removes the temporary file that is being written, if any. Safe in a signal handler.
  void remove_temporary() const noexcept;
  /// Returns whether the final mesh is written. Only rank 0 knows. Safe in a signal handler.
  bool final_mesh_written() const noexcept { return final_mesh_written_; }

private:
  char path_[PATH_MAX]; // for a signal handler: a plain buffer, valid while writing_ is set
  std::atomic<bool> writing_{false}, final_mesh_written_{false};
  static_assert(std::atomic<bool>::is_always_lock_free);
};

/// Endings of the mesh file and of its views: of the triangles for two kinds of readers, and of the boundary edges.
inline constexpr std::array<const char*, 4> mesh_file_endings{".h5", ".xdmf", ".vtkhdf", ".xmf"};

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

/// @brief Reads the group /trime_mpi of a mesh file. Leaves out attributes of other types than those of Attribute.
/// @param groups names of the groups to read, if the file has them: some are as long as the number of ranks
/// @throws FileError on all ranks if this is not a mesh file
/// @note Collective. Rank 0 reads.
Metadata read_metadata(const std::string& path, const std::vector<std::string>& groups, const comm::Communicator& comm);

/// @brief Reads the mesh of a file: equal slabs of points, triangles and facets for each rank, whichever ranks wrote
/// it. Computes its hash and compares it. Memory: the mesh.
/// @param metadata metadata of this file
/// @throws FileError on all ranks if an array is missing or short, an id is out of range, or the hash is not that of
/// the metadata
/// @note Collective.
mesh::DistributedMesh read_mesh(const std::string& path, const Metadata& metadata, const comm::Communicator& comm);

} // namespace trime::io
