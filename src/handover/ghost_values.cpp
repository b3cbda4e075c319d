// SPDX-License-Identifier: BSD-3-Clause
// Exchanges the values of ghosts with their owners.
#include "trime/core/error.hpp"
#include "trime/handover/local_mesh.hpp"

#include <algorithm>

namespace trime::handover {
namespace {

void check_length(const LocalMesh& mesh, std::span<const double> values, int components) {
  TRIME_ASSERT(components > 0 && values.size() == mesh.points.size() * static_cast<std::size_t>(components),
               "expected {} values for each of {} local points, found {}", components, mesh.points.size(),
               values.size());
}

/// The values of the ghosts of a neighbour.
std::span<double> ghosts_of(const Neighbour& neighbour, std::span<double> values, std::size_t components) {
  return values.subspan(at(neighbour.first_ghost) * components, at(neighbour.ghosts) * components);
}

/// Returns room for a message with this number of values.
comm::Message room(int peer, std::size_t count) {
  return {peer, std::vector<std::byte>(count * sizeof(double))};
}

} // namespace

void update_ghosts(const comm::Communicator& comm, const LocalMesh& mesh, std::span<double> values, int components) {
  check_length(mesh, values, components);
  const auto width = static_cast<std::size_t>(components);
  std::vector<comm::Message> outgoing, incoming;
  std::vector<double> shared;
  for (const Neighbour& neighbour : mesh.neighbours) {
    shared.clear();
    for (const LocalIndex point : neighbour.send) {
      const auto own = values.subspan(at(point) * width, width);
      shared.insert(shared.end(), own.begin(), own.end());
    }
    outgoing.push_back({neighbour.rank, comm::to_bytes(std::span<const double>(shared))});
    incoming.push_back(room(neighbour.rank, at(neighbour.ghosts) * width));
  }
  comm.exchange_known(outgoing, incoming);
  for (std::size_t k = 0; k < incoming.size(); ++k)
    std::ranges::copy(comm::from_bytes<double>(incoming[k].data), ghosts_of(mesh.neighbours[k], values, width).begin());
}

void add_to_owners(const comm::Communicator& comm, const LocalMesh& mesh, std::span<double> values, int components) {
  check_length(mesh, values, components);
  const auto width = static_cast<std::size_t>(components);
  std::vector<comm::Message> outgoing, incoming;
  for (const Neighbour& neighbour : mesh.neighbours) {
    outgoing.push_back({neighbour.rank, comm::to_bytes(std::span<const double>(ghosts_of(neighbour, values, width)))});
    incoming.push_back(room(neighbour.rank, neighbour.send.size() * width));
  }
  comm.exchange_known(outgoing, incoming);
  for (std::size_t k = 0; k < incoming.size(); ++k) {
    const std::vector<double> shared = comm::from_bytes<double>(incoming[k].data);
    const std::vector<LocalIndex>& points = mesh.neighbours[k].send;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t c = 0; c < width; ++c)
        values[at(points[i]) * width + c] += shared[i * width + c];
  }
}

} // namespace trime::handover
