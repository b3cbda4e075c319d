// SPDX-License-Identifier: BSD-3-Clause
#include "splitting/sectors.hpp"

#include "comm/agree.hpp"
#include "comm/outbox.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <tuple>

namespace trime::splitting {

Sectors::Sectors(const comm::Communicator& comm, const mesh::DistributedMesh& mesh, const SplitEdges& edges)
    : comm_(comm), mesh_(mesh), edges_(edges), firsts_(comm.all_gather(mesh.point_slab.first)) {
  for (const SplitEdge& edge : edges_.all)
    cuts_.insert(cuts_.end(), {edge.ends, {edge.ends[1], edge.ends[0]}});
  std::sort(cuts_.begin(), cuts_.end());
  find_corners();
  for (std::size_t begin = 0, end = 0; begin < corners_.size(); begin = end) {
    while (end < corners_.size() && corners_[end].point == corners_[begin].point)
      ++end;
    number_sectors(std::span(corners_).subspan(begin, end - begin));
  }
  list_points();
}

int Sectors::owner(GlobalId point) const { // ranks without points start where the next one does
  return static_cast<int>(std::upper_bound(firsts_.begin(), firsts_.end(), point) - firsts_.begin()) - 1;
}

/// Sends each triangle at a split point to the rank that holds the point.
void Sectors::find_corners() {
  const std::vector<char> is_split = split_vertices(mesh_, edges_);
  comm::Outbox<Corner> away;
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (const LocalIndex vertex = mesh_.triangles[t][k]; is_split[static_cast<std::size_t>(vertex)] != 0) {
        const std::array<GlobalId, 3> ids = mesh_.triangle_ids(t);
        const Corner corner{ids[k], ids[(k + 1) % 3], ids[(k + 2) % 3]};
        if (static_cast<std::size_t>(vertex) < mesh_.points.size())
          corners_.push_back(corner);
        else
          away[owner(corner.point)].push_back(corner);
      }
  for (const comm::Message& message : comm::send(comm_, away)) {
    const std::vector<Corner> corners = comm::from_bytes<Corner>(message.data);
    corners_.insert(corners_.end(), corners.begin(), corners.end());
  }
  std::sort(corners_.begin(), corners_.end(),
            [](const Corner& a, const Corner& b) { return std::tie(a.point, a.next) < std::tie(b.point, b.next); });
}

/// A sector begins at a triangle without a neighbour across its first side: the side is split, or on the boundary. It
/// goes on counter-clockwise up to the next such side. At least one edge at the point is split.
/// @param around all triangles at a point, ascending by `next`
void Sectors::number_sectors(std::span<Corner> around) {
  const auto with_next = [&](GlobalId id) {
    const auto found = std::lower_bound(around.begin(), around.end(), id,
                                        [](const Corner& corner, GlobalId next) { return corner.next < next; });
    return found != around.end() && found->next == id ? found : around.end();
  };
  const auto is_cut = [&](GlobalId neighbour) {
    return std::binary_search(cuts_.begin(), cuts_.end(), std::array{around[0].point, neighbour});
  };
  std::vector<GlobalId> entered; // across the sides from which a triangle on their right leads here
  for (const Corner& corner : around)
    if (!is_cut(corner.last))
      entered.push_back(corner.last);
  std::sort(entered.begin(), entered.end());
  std::vector<GlobalId> starts;
  for (const Corner& corner : around)
    if (!std::binary_search(entered.begin(), entered.end(), corner.next))
      starts.push_back(corner.next);
  for (std::size_t k = 0; k < starts.size(); ++k)
    for (auto at = with_next(starts[k]); at != around.end() && at->copy < 0;) {
      at->copy = static_cast<std::int32_t>(k);
      at = is_cut(at->last) ? around.end() : with_next(at->last);
    }
}

void Sectors::list_points() {
  std::vector<SplitPoint> here;
  for (const Corner& corner : corners_) {
    if (here.empty() || here.back().id != corner.point)
      here.push_back(
          {corner.point, 0, 0, mesh_.points[static_cast<std::size_t>(corner.point - mesh_.point_slab.first)]});
    here.back().copies = std::max<std::int64_t>(here.back().copies, corner.copy + 1);
  }
  points_ = comm::gather_everywhere(comm_, std::move(here));
  std::int64_t before = 0;
  for (SplitPoint& point : points_) {
    point.before = before;
    before += point.copies - 1;
  }
}

GlobalId Sectors::new_id(GlobalId old, std::int32_t copy) const {
  const auto after = std::upper_bound(points_.begin(), points_.end(), old,
                                      [](GlobalId id, const SplitPoint& point) { return id < point.id; });
  if (after == points_.begin())
    return old;
  const SplitPoint& point = *(after - 1);
  return point.id == old ? old + point.before + copy : old + point.before + point.copies - 1;
}

std::int64_t Sectors::additional() const {
  return points_.empty() ? 0 : points_.back().before + points_.back().copies - 1;
}

std::int32_t Sectors::copy_at(const Question& question) const {
  const auto begin = std::lower_bound(corners_.begin(), corners_.end(), question.point,
                                      [](const Corner& corner, GlobalId point) { return corner.point < point; });
  for (auto at = begin; at != corners_.end() && at->point == question.point; ++at)
    if ((question.right != 0 ? at->last : at->next) == question.neighbour)
      return at->copy;
  return -1;
}

std::vector<std::int32_t> Sectors::answer(const std::vector<Question>& questions) const {
  std::vector<std::int32_t> copies(questions.size());
  comm::Outbox<Question> asked;
  std::map<int, std::vector<std::size_t>> rows; // of the questions to each rank
  for (std::size_t k = 0; k < questions.size(); ++k)
    if (const int home = owner(questions[k].point); home == comm_.rank()) {
      copies[k] = copy_at(questions[k]);
    } else {
      asked[home].push_back(questions[k]);
      rows[home].push_back(k);
    }
  comm::Outbox<std::int32_t> answers;
  for (const comm::Message& message : comm::send(comm_, asked))
    for (const Question& question : comm::from_bytes<Question>(message.data))
      answers[message.peer].push_back(copy_at(question));
  for (const comm::Message& message : comm::send(comm_, answers)) {
    const std::vector<std::int32_t> values = comm::from_bytes<std::int32_t>(message.data);
    const std::vector<std::size_t>& of_rank = rows.at(message.peer);
    for (std::size_t k = 0; k < values.size(); ++k)
      copies[of_rank[k]] = values[k];
  }
  comm::run_agreed(comm_, [&] {
    for (std::size_t k = 0; k < copies.size(); ++k)
      if (copies[k] < 0)
        throw InternalError(fmt::format("the edge between the points {} and {} has no triangle on its {}, but a curve "
                                        "that is split passes there",
                                        questions[k].point, questions[k].neighbour,
                                        questions[k].right != 0 ? "right" : "left"));
  });
  return copies;
}

} // namespace trime::splitting
