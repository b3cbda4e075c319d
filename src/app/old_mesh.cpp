// SPDX-License-Identifier: BSD-3-Clause
#include "app/old_mesh.hpp"

#include "core/random.hpp"
#include "trime/core/error.hpp"
#include "trime/io/mesh_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <span>
#include <utility>

namespace trime::app {
namespace {

std::uint64_t hash_of_places(std::span<const geometry::Vec2> places) {
  std::uint64_t sum = 0;
  for (const geometry::Vec2 p : places)
    sum += mix_bits(mix_bits(std::bit_cast<std::uint64_t>(p.x)) ^ std::bit_cast<std::uint64_t>(p.y));
  return sum;
}

} // namespace

OldMesh read_old_mesh(const std::string& path, const comm::Communicator& comm) {
  OldMesh old;
  old.file = path;
  try { // all ranks throw together
    const io::Metadata metadata = io::read_metadata(path, {}, comm);
    mesh::DistributedMesh mesh = io::read_mesh(path, metadata, comm);
    old.periods = {io::attribute_of<double>(metadata, "period_x"), io::attribute_of<double>(metadata, "period_y")};
    old.places = std::move(mesh.points);
    old.count = mesh.point_slab.total;
  } catch (const FileError& error) {
    throw ConfigError(fmt::format("'start = {}' in [meshing]: {}; expected a mesh file NAME.h5 that trime_mpi wrote, "
                                  "relative to the config file. Leave 'start' out to make a new mesh",
                                  path, error.what()));
  }
  old.hash = static_cast<std::uint64_t>(comm.sum(static_cast<std::int64_t>(hash_of_places(old.places))));
  return old;
}

std::string hash_of(const std::optional<OldMesh>& old) {
  return old ? fmt::format("\n[hash of the old mesh]\npoints = {:016x}\n", old->hash) : "";
}

} // namespace trime::app
