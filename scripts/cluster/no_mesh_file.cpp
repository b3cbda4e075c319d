// SPDX-License-Identifier: BSD-3-Clause
// In place of mesh_file.cpp in programs for a simulated cluster (TRIME_SIMULATE): they write no meshes, since HDF5 is
// built for one MPI library, and the simulated one is another.
#include "comm/agree.hpp"
#include "io/state_file.hpp"
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

Metadata read_metadata(const std::string& path, const std::vector<std::string>&, const comm::Communicator&) {
  throw FileError(fmt::format("{} is not read: this program is built for a simulated cluster and has no HDF5", path));
}

mesh::DistributedMesh read_mesh(const std::string& path, const Metadata&, const comm::Communicator& comm) {
  read_metadata(path, {}, comm);
  return {};
}

void write_state_file(const std::string& path, RunFiles*, const Metadata&, const std::vector<StateArray>&,
                      const comm::Communicator& comm) {
  comm::agree(comm, FileError(fmt::format("{} is not written: this program is built for a simulated cluster and has no "
                                          "HDF5; leave checkpoint.interval = 0",
                                          path)));
}

Metadata read_state_metadata(const std::string& path, const std::vector<std::string>&, const comm::Communicator& comm) {
  return read_metadata(path, {}, comm);
}

class StateFileReader::Implementation {};

StateFileReader::StateFileReader(const std::string& path) {
  throw FileError(fmt::format("{} is not read: this program has no HDF5", path));
}
StateFileReader::~StateFileReader() = default;

bool StateFileReader::has(const std::string&) const {
  return false;
}

void StateFileReader::read(const std::string&, ValueKind, int, std::int64_t, std::int64_t, void*) const {}

bool hdf5_cannot_end() {
  return false;
}

std::string hdf5_version() {
  return "none";
}

} // namespace trime::io
