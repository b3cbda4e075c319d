// SPDX-License-Identifier: BSD-3-Clause
// In place of mesh_file.cpp in programs for a simulated cluster (TRIME_SIMULATE): they write no meshes, since HDF5 is
// built for one MPI library, and the simulated one is another.
#include "comm/agree.hpp"
#include "trime/io/mesh_file.hpp"

namespace trime::io {

std::string field_group(const MeshFileOptions&, const char* name) {
  return name;
}

WrittenFiles write_mesh(const MeshFileOptions& options, const mesh::DistributedMesh&, const Metadata&,
                        const comm::Communicator& comm) {
  comm::agree(comm, FileError(fmt::format("{} is not written: this program is built for a simulated cluster "
                                          "(TRIME_SIMULATE) and has no HDF5; set output.interval = 0",
                                          options.path(".h5"))));
  return {};
}

std::string hdf5_version() {
  return "none";
}

} // namespace trime::io
