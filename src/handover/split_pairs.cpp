// SPDX-License-Identifier: BSD-3-Clause
#include "handover/split_pairs.hpp"

#include "comm/outbox.hpp"

#include <algorithm>

namespace trime::handover {
namespace {

/// A pair on its way to the owners of its points.
struct Pair {
  GlobalId row;
  std::array<GlobalId, 2> points;
  std::int32_t curve, path;
};

} // namespace

void share_split_pairs(const comm::Communicator& comm, const mesh::DistributedMesh& mesh, LocalMesh& made) {
  if (mesh.split_slab.total == 0)
    return;
  const std::vector<std::int64_t> firsts = comm.all_gather(mesh.point_slab.first);
  const auto owner = [&](GlobalId point) { // ranks without points start where the next one does
    return static_cast<int>(std::upper_bound(firsts.begin(), firsts.end(), point) - firsts.begin()) - 1;
  };
  comm::Outbox<Pair> away;
  for (std::size_t k = 0; k < mesh.split_pairs.size(); ++k) {
    const Pair pair{mesh.split_slab.first + static_cast<GlobalId>(k), mesh.split_pairs[k], mesh.split_curves[k],
                    mesh.split_paths[k]};
    const int left = owner(pair.points[0]), right = owner(pair.points[1]);
    away[left].push_back(pair);
    if (right != left)
      away[right].push_back(pair);
  }
  std::vector<Pair> pairs;
  for (const comm::Message& message : comm::send(comm, away)) {
    const std::vector<Pair> found = comm::from_bytes<Pair>(message.data);
    pairs.insert(pairs.end(), found.begin(), found.end());
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.row < b.row; });
  for (const Pair& pair : pairs) {
    made.split_pairs.push_back(pair.points);
    made.split_curves.push_back(pair.curve);
    made.split_paths.push_back(pair.path);
    made.split_rows.push_back(pair.row);
  }
}

} // namespace trime::handover
