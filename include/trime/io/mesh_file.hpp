// SPDX-License-Identifier: BSD-3-Clause
// Writes and reads the mesh file NAME.h5 with its views NAME.xdmf and NAME.vtkhdf. All ranks write the file together
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

/// @brief Keeps the name of the temporary file that is being written, and whether the final mesh is written. A program
/// that handles signals makes one such object, passes its address in MeshFileOptions, and queries it in the signal
/// handler. At most one temporary file exists at a time.
class RunFiles {
public:
  /// Notes that a file is being written under this temporary name. Names longer than PATH_MAX are not noted.
  void start_writing(const std::string& temporary) noexcept;
  /// Notes that the temporary file has been renamed or removed.
  void stop_writing() noexcept { writing_ = false; }
  /// Notes that the file of the final mesh has its final name; other files of the run may follow.
  void set_final_mesh_written() noexcept { final_mesh_written_ = true; }

  /// Removes the temporary file if one is being written. May be called from a signal handler.
  void remove_temporary() const noexcept;
  /// Returns whether the file of the final mesh is written. Valid on rank 0 only. May be called from a signal handler.
  bool final_mesh_written() const noexcept { return final_mesh_written_; }

private:
  char path_[PATH_MAX]; // a plain buffer, because a signal handler reads it; valid while writing_ is set
  std::atomic<bool> writing_{false}, final_mesh_written_{false};
  static_assert(std::atomic<bool>::is_always_lock_free);
};

/// The endings of the mesh file NAME.h5, of its two views for ParaView and other readers, and of the view of its
/// labelled edges.
inline constexpr std::array<const char*, 4> mesh_file_endings{".h5", ".xdmf", ".vtkhdf", ".xmf"};

/// The names, the directory and the kinds of the files to write.
struct MeshFileOptions {
  std::string directory = "out"; ///< created if it is missing
  std::string name = "mesh";     ///< NAME: the file names without their endings
  bool overwrite = false;
  bool vtkhdf = true;    ///< writes the group /VTKHDF and the link NAME.vtkhdf
  bool xdmf = true;      ///< writes the group /Mesh/mesh (also written if vtkhdf is false) and the file NAME.xdmf
  bool is_final = false; ///< whether this is the final mesh of the run, which RunFiles notes
  /// The marker of each part, in the order of DistributedMesh::facet_parts; written as /Mesh/facets/markers if any
  /// marker is not 0.
  std::vector<std::int32_t> part_markers{};
  RunFiles* run_files = nullptr; ///< keeps the names of existing files for a signal handler; may be null

  /// Returns `directory/name` + ending.
  std::string path(const std::string& ending) const { return directory + "/" + name + ending; }
};

/// Returns the path of the HDF5 group for values at points ("PointData") or triangles ("CellData"): inside /VTKHDF, or
/// inside /Mesh if /VTKHDF is not written.
std::string field_group(const MeshFileOptions& options, const char* name);

/// The paths of the files that were written.
struct WrittenFiles {
  std::vector<std::string> paths;
  std::int64_t bytes = 0; ///< size of NAME.h5
};

/// @brief Writes the mesh, reads every array back, compares it, and renames the files. The metadata of rank 0 is
/// written. Extra memory: two slices of a few MB per rank.
/// @throws FileError on all ranks together. A file with the final name is replaced only when the new file is complete;
/// after an error it is still there, and the temporary file is removed
/// @note Collective. A rank may hold no points.
WrittenFiles write_mesh(const MeshFileOptions& options, const mesh::DistributedMesh& mesh, const Metadata& metadata,
                        const comm::Communicator& comm);

/// Returns the version of the HDF5 library, for example "1.10.8".
std::string hdf5_version();

/// @brief Returns true if HDF5 could not close a file on this rank, for example because the file reached a size limit
/// of the system. HDF5 1.10.8 would try to close it again in MPI_Finalize and crash, so the program must then end with
/// `comm::abort_job`.
bool hdf5_cannot_end();

/// @brief Reads the group /trime_mpi of a mesh file. Attributes of types that Attribute cannot hold are left out.
/// @param groups names of the groups to read if the file has them; other groups are skipped, because some are as long
/// as the number of ranks
/// @throws FileError on all ranks if this is not a mesh file
/// @note Collective. Only rank 0 reads.
Metadata read_metadata(const std::string& path, const std::vector<std::string>& groups, const comm::Communicator& comm);

/// @brief Reads the mesh of a file. Each rank gets an equal share of points, triangles and facets, however many ranks
/// wrote the file. Computes the hash of the mesh and compares it with the stored one. Memory: that of the mesh.
/// @param metadata the metadata of the same file
/// @throws FileError on all ranks if an array is missing or too short, an id is out of range, or the hash differs from
/// that in the metadata
/// @note Collective.
mesh::DistributedMesh read_mesh(const std::string& path, const Metadata& metadata, const comm::Communicator& comm);

} // namespace trime::io
