// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_lookup.hpp"

#include <algorithm>

namespace trime::io {
namespace {

/// Rank whose slab holds a point; `firsts` are the starts of the slabs by rank, those of empty ranks included.
int owner_of(GlobalId point, const std::vector<std::int64_t>& firsts) {
  return static_cast<int>(std::upper_bound(firsts.begin(), firsts.end(), point) - firsts.begin()) - 1;
}

} // namespace

PointLookup::PointLookup(const mesh::DistributedMesh& mesh, std::vector<GlobalId> wanted,
                         const comm::Communicator& comm)
    : ids_(std::move(wanted)) {
  std::sort(ids_.begin(), ids_.end());
  ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
  std::vector<comm::Message> answers;
  for (const comm::Message& question : comm.exchange_any(questions(comm.all_gather(mesh.point_slab.first)))) {
    std::vector<MeshPoint> points;
    for (const GlobalId id : comm::from_bytes<GlobalId>(question.data)) {
      const auto k = static_cast<std::size_t>(id - mesh.point_slab.first);
      points.push_back({mesh.points.at(k), static_cast<double>(mesh.size.at(k)), mesh.depth ? mesh.depth->at(k) : 0.0});
    }
    answers.push_back({question.peer, comm::to_bytes(std::span<const MeshPoint>(points))});
  }
  for (const comm::Message& answer : comm.exchange_any(answers)) { // by peer, so in the order of the ids
    const std::vector<MeshPoint> points = comm::from_bytes<MeshPoint>(answer.data);
    points_.insert(points_.end(), points.begin(), points.end());
  }
}

const MeshPoint& PointLookup::operator[](GlobalId id) const {
  return points_.at(static_cast<std::size_t>(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin()));
}

std::vector<comm::Message> PointLookup::questions(const std::vector<std::int64_t>& firsts) const {
  std::vector<comm::Message> questions;
  for (std::size_t begin = 0; begin < ids_.size();) {
    const int owner = owner_of(ids_[begin], firsts);
    std::size_t end = begin;
    while (end < ids_.size() && owner_of(ids_[end], firsts) == owner)
      ++end;
    questions.push_back({owner, comm::to_bytes(std::span<const GlobalId>(ids_).subspan(begin, end - begin))});
    begin = end;
  }
  return questions;
}

} // namespace trime::io
