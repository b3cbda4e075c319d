// SPDX-License-Identifier: BSD-3-Clause
#include "dual/cells.hpp"

#include "comm/outbox.hpp"

#include <algorithm>
#include <iterator>

namespace trime::dual {
namespace {

using geometry::Vec2;

/// A point on its way to the rank whose site it is.
struct SentPoint {
  GlobalId number;
  Vec2 place;
};

/// A triangle with the numbers of its corners, also on its way to the ranks of its corners.
struct NumberedTriangle {
  GlobalId number;
  std::array<GlobalId, 3> corners;
  std::int64_t region; // as long as the numbers, so that all bytes are set
};

NumberedTriangle numbered_triangle(const mesh::DistributedMesh& mesh, std::size_t t) {
  return {mesh.triangle_slab.first + static_cast<GlobalId>(t), mesh.triangle_ids(t),
          mesh.region.empty() ? 1 : mesh.region[t]};
}

/// The sites of this rank: its share of the points.
std::vector<Vec2> own_sites(const mesh::DistributedMesh& mesh, const Cells& cells, const comm::Communicator& comm) {
  std::vector<Vec2> sites(at(cells.site_count));
  const auto keep = [&](GlobalId number, Vec2 place) {
    sites[static_cast<std::size_t>(number - cells.first_site)] = place;
  };
  comm::Outbox<SentPoint> away;
  for (std::size_t k = 0; k < mesh.points.size(); ++k) {
    const GlobalId number = mesh.point_slab.first + static_cast<GlobalId>(k);
    if (cells.is_here(number))
      keep(number, mesh.points[k]);
    else
      away[cells.shares.rank_of(number)].push_back({number, mesh.points[k]});
  }
  for (const comm::Message& message : comm::send(comm, away))
    for (const SentPoint& point : comm::from_bytes<SentPoint>(message.data))
      keep(point.number, point.place);
  return sites;
}

/// Triangles of other ranks with a corner at a site of this rank, by number.
std::vector<NumberedTriangle> triangles_of_others(const mesh::DistributedMesh& mesh, const Cells& cells,
                                                  const comm::Communicator& comm) {
  comm::Outbox<NumberedTriangle> away;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const NumberedTriangle triangle = numbered_triangle(mesh, t);
    std::array<int, 3> ranks{};
    for (std::size_t k = 0; k < 3; ++k) {
      ranks[k] = cells.is_here(triangle.corners[k]) ? comm.rank() : cells.shares.rank_of(triangle.corners[k]);
      if (ranks[k] != comm.rank() && std::find(ranks.begin(), ranks.begin() + k, ranks[k]) == ranks.begin() + k)
        away[ranks[k]].push_back(triangle);
    }
  }
  std::vector<NumberedTriangle> others;
  for (const comm::Message& message : comm::send(comm, away)) { // by rank, as the numbers are
    const std::vector<NumberedTriangle> arrived = comm::from_bytes<NumberedTriangle>(message.data);
    others.insert(others.end(), arrived.begin(), arrived.end());
  }
  return others;
}

/// Calls use(triangle) for all triangles with a corner at a site of this rank, by number. Those of this rank's slab are
/// not listed, since the list would take more memory than the cells.
template <class Use>
void for_each_triangle(const mesh::DistributedMesh& mesh, const std::vector<NumberedTriangle>& others,
                       const Cells& cells, const Use& use) {
  const auto behind = std::partition_point(others.begin(), others.end(), [&](const NumberedTriangle& triangle) {
    return triangle.number < mesh.triangle_slab.first;
  });
  std::for_each(others.begin(), behind, use);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const NumberedTriangle triangle = numbered_triangle(mesh, t);
    if (std::any_of(triangle.corners.begin(), triangle.corners.end(), [&](GlobalId p) { return cells.is_here(p); }))
      use(triangle);
  }
  std::for_each(behind, others.end(), use);
}

/// Points of other ranks that the triangles at sites of this rank use, ascending and each once.
std::vector<GlobalId> points_of_others(const mesh::DistributedMesh& mesh, const std::vector<NumberedTriangle>& others,
                                       const Cells& cells) {
  std::vector<GlobalId> wanted;
  for_each_triangle(mesh, others, cells, [&](const NumberedTriangle& triangle) {
    for (const GlobalId corner : triangle.corners)
      if (!cells.is_here(corner))
        wanted.push_back(corner);
  });
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  return wanted;
}

/// Asks the ranks of these sites for their places. @param wanted ascending
std::vector<Vec2> places_of(const std::vector<GlobalId>& wanted, const std::vector<Vec2>& sites, const Cells& cells,
                            const comm::Communicator& comm) {
  comm::Outbox<GlobalId> questions;
  for (const GlobalId point : wanted)
    questions[cells.shares.rank_of(point)].push_back(point);
  comm::Outbox<Vec2> answers;
  for (const comm::Message& question : comm::send(comm, questions))
    for (const GlobalId point : comm::from_bytes<GlobalId>(question.data))
      answers[question.peer].push_back(sites[static_cast<std::size_t>(point - cells.first_site)]);
  std::vector<Vec2> places;
  for (const comm::Message& answer : comm::send(comm, answers)) { // by rank, as the numbers are
    const std::vector<Vec2> arrived = comm::from_bytes<Vec2>(answer.data);
    places.insert(places.end(), arrived.begin(), arrived.end());
  }
  return places;
}

/// Keeps the points of other ranks that triangles at sites use, and those that the slab of the mesh uses.
void add_foreign(const mesh::DistributedMesh& mesh, const std::vector<NumberedTriangle>& others, Cells& cells,
                 const comm::Communicator& comm) {
  cells.foreign = points_of_others(mesh, others, cells);
  std::vector<GlobalId> wanted;
  std::set_union(cells.foreign.begin(), cells.foreign.end(), mesh.foreign.begin(), mesh.foreign.end(),
                 std::back_inserter(wanted));
  std::erase_if(wanted, [&](GlobalId point) { return cells.is_here(point); });
  const std::vector<Vec2> places = places_of(wanted, cells.points, cells, comm);
  const auto place_of = [&](GlobalId point) {
    const auto found = std::lower_bound(wanted.begin(), wanted.end(), point);
    return places.at(static_cast<std::size_t>(found - wanted.begin()));
  };
  for (const GlobalId point : mesh.foreign)
    cells.slab_places.push_back(cells.is_here(point) ? cells.points[static_cast<std::size_t>(point - cells.first_site)]
                                                     : place_of(point));
  for (const GlobalId point : cells.foreign)
    cells.points.push_back(place_of(point));
}

LocalIndex local_index(GlobalId point, const Cells& cells) {
  if (cells.is_here(point))
    return static_cast<LocalIndex>(point - cells.first_site);
  const auto found = std::lower_bound(cells.foreign.begin(), cells.foreign.end(), point);
  return cells.site_count + static_cast<LocalIndex>(found - cells.foreign.begin());
}

void add_triangles(const mesh::DistributedMesh& mesh, const std::vector<NumberedTriangle>& others, Cells& cells) {
  std::size_t count = 0;
  for_each_triangle(mesh, others, cells, [&](const NumberedTriangle&) { ++count; });
  cells.triangles.reserve(count);
  for_each_triangle(mesh, others, cells, [&](const NumberedTriangle& triangle) {
    const auto& [a, b, c] = triangle.corners;
    cells.triangles.push_back({triangle.number,
                               {local_index(a, cells), local_index(b, cells), local_index(c, cells)},
                               static_cast<std::int32_t>(triangle.region)});
  });
}

} // namespace

Cells make_cells(const mesh::DistributedMesh& mesh, Vec2 period, const comm::Communicator& comm) {
  Cells cells;
  cells.shares = {mesh.point_slab.total, comm.size()};
  cells.first_site = cells.shares.first(comm.rank());
  cells.site_count = static_cast<LocalIndex>(cells.shares.first(comm.rank() + 1) - cells.first_site);
  cells.triangle_count = mesh.triangle_slab.total;
  cells.period = period;
  cells.points = own_sites(mesh, cells, comm);
  {
    const std::vector<NumberedTriangle> others = triangles_of_others(mesh, cells, comm);
    add_foreign(mesh, others, cells, comm);
    add_triangles(mesh, others, cells);
  }
  find_fans(cells, comm);
  return cells;
}

SlabTriangle slab_triangle(const mesh::DistributedMesh& mesh, const Cells& cells, std::size_t triangle) {
  const auto place = [&](std::size_t k) {
    const auto corner = at(mesh.triangles[triangle][k]);
    return corner < mesh.points.size() ? mesh.points[corner] : cells.slab_places[corner - mesh.points.size()];
  };
  const Vec2 first = place(0);
  return {first, difference(place(1), first, cells.period), difference(place(2), first, cells.period)};
}

Vec2 slab_centre(const mesh::DistributedMesh& mesh, const Cells& cells, std::size_t triangle) {
  const SlabTriangle of = slab_triangle(mesh, cells, triangle);
  return of.first + circumcentre(of.b, of.c);
}

} // namespace trime::dual
