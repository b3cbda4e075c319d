// SPDX-License-Identifier: BSD-3-Clause
#include "io/state_file.hpp"

#include "comm/agree.hpp"
#include "io/hdf5_input.hpp"
#include "io/slab_file.hpp"
#include "io/temporary_file.hpp"
#include "trime/io/mesh_file.hpp"

#include <algorithm>
#include <optional>

namespace trime::io {
namespace {

const std::string root_group = "/trime_mpi_state";

std::string inside(const std::string& path) {
  return root_group + "/" + path;
}

struct KindOfValue {
  hid_t type;
  std::size_t bytes;
};

KindOfValue of(ValueKind kind) {
  switch (kind) {
  case ValueKind::float64:
    return {H5T_NATIVE_DOUBLE, 8};
  case ValueKind::int64:
    return {H5T_NATIVE_INT64, 8};
  case ValueKind::int32:
    return {H5T_NATIVE_INT32, 4};
  case ValueKind::uint8:
    break;
  }
  return {H5T_NATIVE_UINT8, 1};
}

/// Size of the file, a little too large.
std::int64_t file_bytes(const Metadata& metadata, const std::vector<StateArray>& arrays) {
  constexpr std::int64_t headers = 64 << 10;
  std::int64_t bytes = headers;
  for (const StateArray& array : arrays)
    bytes += static_cast<std::int64_t>(of(array.kind).bytes) * std::max(1, array.columns) * array.slab.total;
  for (const Text& text : metadata.texts)
    bytes += static_cast<std::int64_t>(text.text.size());
  for (const MetadataGroup& group : metadata.groups)
    for (const Column& column : group.columns)
      bytes +=
          std::visit([](const auto& values) { return static_cast<std::int64_t>(8 * values.size()); }, column.values);
  return bytes + bytes / 16; // alignment of large arrays
}

void write_hdf5(const std::string& path, const Metadata& metadata, const std::vector<StateArray>& arrays,
                const comm::Communicator& comm) {
  SlabFile file(comm, path, file_bytes(metadata, arrays),
                [&](const FileStart& start) { start.metadata(root_group, metadata); });
  for (const StateArray& array : arrays)
    file.slab({inside(array.path), of(array.kind).type, of(array.kind).bytes, static_cast<hsize_t>(array.columns),
               array.slab, array.rows, array.fill});
  file.verify();
  file.close();
}

} // namespace

void write_state_file(const std::string& path, RunFiles* files, const Metadata& metadata,
                      const std::vector<StateArray>& arrays, const comm::Communicator& comm) {
  const Metadata of_root = broadcast(metadata, comm);
  const std::string temporary_path = comm.broadcast(temporary_name(path));
  std::optional<TemporaryFile> temporary; // rank 0 removes it if anything fails
  comm::run_agreed(comm, [&] {
    if (comm.is_root())
      temporary.emplace(temporary_path, files);
  });
  write_hdf5(temporary_path, of_root, arrays, comm);
  comm::run_agreed(comm, [&] {
    if (temporary)
      temporary->publish(path);
  });
}

Metadata read_state_metadata(const std::string& path, const std::vector<std::string>& groups,
                             const comm::Communicator& comm) {
  Metadata metadata;
  comm::run_agreed(comm, [&] {
    if (!comm.is_root())
      return;
    const Hdf5Input file(path);
    if (!file.has(root_group))
      throw FileError(
          fmt::format("{} is not a checkpoint of trime_mpi: expected the group {}, found none", path, root_group));
    metadata.attributes = file.attributes(root_group);
    metadata.texts = file.texts(root_group);
    for (const std::string& group : file.groups(root_group)) {
      metadata.groups.push_back({group, file.attributes(inside(group)), {}});
      if (std::find(groups.begin(), groups.end(), group) != groups.end())
        metadata.groups.back().columns = file.columns(inside(group));
    }
  });
  return broadcast(metadata, comm);
}

class StateFileReader::Implementation {
public:
  Hdf5Input file;
};

StateFileReader::StateFileReader(const std::string& path) : implementation_(new Implementation{Hdf5Input(path)}) {}
StateFileReader::~StateFileReader() = default;

bool StateFileReader::has(const std::string& path) const {
  return implementation_->file.has(inside(path));
}

void StateFileReader::read(const std::string& path, ValueKind kind, int columns, std::int64_t first, std::int64_t count,
                           void* out) const {
  implementation_->file.read(inside(path), of(kind).type, static_cast<hsize_t>(columns), first, count, out);
}

} // namespace trime::io
