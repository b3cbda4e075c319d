// SPDX-License-Identifier: BSD-3-Clause
#include "formats/edge_sides.hpp"

#include "comm/agree.hpp"
#include "comm/outbox.hpp"

#include <algorithm>
#include <map>

namespace trime::formats {
namespace {

using Ends = std::array<GlobalId, 2>;

/// A side on its way to the rank on which edges and sides meet.
struct Side {
  Ends ends;
  EdgeSide side;
};

/// Returns the rank on which everything about a point meets. All ranks get equally long ranges of points, so no rank
/// needs a list of ranges.
int meeting_rank(GlobalId point, const ExchangeMesh& mesh) {
  return static_cast<int>(((point + 1) * mesh.comm().size() - 1) / mesh.points());
}

/// All sides of the triangles of this rank that may be labelled edges: neither end is known to have no label. The
/// labels of points of other ranks are not known here.
comm::Outbox<Side> possible_sides(const ExchangeMesh& mesh, const std::function<GlobalId(std::int64_t)>& element) {
  const mesh::DistributedMesh& part = mesh.mesh();
  const auto may_have_label = [&](LocalIndex vertex) {
    return static_cast<std::size_t>(vertex) >= part.points.size() || mesh.point_label(vertex) != 0;
  };
  comm::Outbox<Side> sides;
  for (std::size_t row = 0; row < part.triangles.size(); ++row) {
    const std::array<LocalIndex, 3>& corners = part.triangles[row];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if (!may_have_label(corners[k]) || !may_have_label(corners[next]))
        continue;
      const Ends ends{part.global_id(corners[k]), part.global_id(corners[next])};
      sides[meeting_rank(ends[0], mesh)].push_back(
          {ends, {element(static_cast<std::int64_t>(row)), static_cast<std::int64_t>(k) + 1}});
    }
  }
  return sides;
}

std::vector<Side> meeting_sides(const ExchangeMesh& mesh, const std::function<GlobalId(std::int64_t)>& element) {
  std::vector<Side> known;
  for (const comm::Message& message : comm::send(mesh.comm(), possible_sides(mesh, element))) {
    const std::vector<Side> sides = comm::from_bytes<Side>(message.data);
    known.insert(known.end(), sides.begin(), sides.end());
  }
  std::sort(known.begin(), known.end(), [](const Side& a, const Side& b) { return a.ends < b.ends; });
  return known;
}

/// Answers in the order of the questions; element -1 stands for an edge that is not a side.
std::vector<EdgeSide> answers(const std::vector<Side>& known, const std::vector<Ends>& edges) {
  std::vector<EdgeSide> found;
  for (const Ends& ends : edges) {
    const auto at = std::lower_bound(known.begin(), known.end(), ends,
                                     [](const Side& side, const Ends& wanted) { return side.ends < wanted; });
    found.push_back(at != known.end() && at->ends == ends ? at->side : EdgeSide{-1, 0});
  }
  return found;
}

} // namespace

std::vector<EdgeSide> left_sides(const ExchangeMesh& mesh, const std::function<GlobalId(std::int64_t row)>& element) {
  const std::vector<Side> known = meeting_sides(mesh, element);
  comm::Outbox<Ends> questions;
  for (std::int64_t row = 0; row < mesh.rank_lines(); ++row)
    questions[meeting_rank(mesh.line(row)[0], mesh)].push_back(mesh.line(row));
  comm::Outbox<EdgeSide> replies;
  for (const comm::Message& message : comm::send(mesh.comm(), questions))
    replies[message.peer] = answers(known, comm::from_bytes<Ends>(message.data));
  std::map<int, std::vector<EdgeSide>> by_rank;
  for (const comm::Message& message : comm::send(mesh.comm(), replies))
    by_rank[message.peer] = comm::from_bytes<EdgeSide>(message.data);
  std::vector<EdgeSide> sides;
  comm::run_agreed(mesh.comm(), [&] {
    std::map<int, std::size_t> next;
    for (std::int64_t row = 0; row < mesh.rank_lines(); ++row) {
      const int rank = meeting_rank(mesh.line(row)[0], mesh);
      sides.push_back(by_rank.at(rank).at(next[rank]++));
      if (sides.back().element < 0)
        throw FileError(fmt::format("the mesh has an edge with the label {} from point {} to point {}, counted from 0, "
                                    "but no triangle on its left; expected each labelled edge to be a side of a "
                                    "triangle",
                                    mesh.line_label(row), mesh.line(row)[0], mesh.line(row)[1]));
    }
  });
  return sides;
}

std::vector<LabelledPoint> labelled_points(const ExchangeMesh& mesh) {
  comm::Outbox<LabelledPoint> away;
  for (std::int64_t row = 0; row < mesh.rank_lines(); ++row)
    for (const GlobalId point : mesh.line(row))
      away[meeting_rank(point, mesh)].push_back({point, mesh.line_label(row)});
  std::vector<LabelledPoint> points;
  for (const comm::Message& message : comm::send(mesh.comm(), away)) {
    const std::vector<LabelledPoint> arrived = comm::from_bytes<LabelledPoint>(message.data);
    points.insert(points.end(), arrived.begin(), arrived.end());
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

} // namespace trime::formats
