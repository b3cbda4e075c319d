// SPDX-License-Identifier: BSD-3-Clause
#include "dual/cells.hpp"

#include "comm/outbox.hpp"
#include "core/thread_loop.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace trime::dual {
namespace {

using geometry::Vec2;

/// A point on its way to the rank whose site it is.
struct SentPoint {
  GlobalId number;
  Vec2 place;
};

/// A triangle on its way to the ranks of its corners.
struct SentTriangle {
  GlobalId number;
  std::array<GlobalId, 3> corners;
  std::int64_t region;
};

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

/// All triangles with a corner at a site of this rank, by number.
std::vector<SentTriangle> triangles_at_sites(const mesh::DistributedMesh& mesh, const Cells& cells,
                                             const comm::Communicator& comm) {
  std::vector<SentTriangle> kept;
  comm::Outbox<SentTriangle> away;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const SentTriangle triangle{mesh.triangle_slab.first + static_cast<GlobalId>(t), mesh.triangle_ids(t),
                                mesh.region.empty() ? 1 : mesh.region[t]};
    std::array<int, 3> ranks{};
    for (std::size_t k = 0; k < 3; ++k) {
      ranks[k] = cells.shares.rank_of(triangle.corners[k]);
      if (std::find(ranks.begin(), ranks.begin() + k, ranks[k]) != ranks.begin() + k)
        continue;
      if (ranks[k] == comm.rank())
        kept.push_back(triangle);
      else
        away[ranks[k]].push_back(triangle);
    }
  }
  for (const comm::Message& message : comm::send(comm, away)) {
    const std::vector<SentTriangle> arrived = comm::from_bytes<SentTriangle>(message.data);
    kept.insert(kept.end(), arrived.begin(), arrived.end());
  }
  std::sort(kept.begin(), kept.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
  return kept;
}

/// Points of other ranks that this rank needs, ascending and each once.
std::vector<GlobalId> wanted_points(const mesh::DistributedMesh& mesh, const std::vector<SentTriangle>& triangles,
                                    const Cells& cells, bool for_slab) {
  std::vector<GlobalId> wanted;
  for (const SentTriangle& triangle : triangles)
    for (const GlobalId corner : triangle.corners)
      if (!cells.is_here(corner))
        wanted.push_back(corner);
  if (for_slab)
    std::copy_if(mesh.foreign.begin(), mesh.foreign.end(), std::back_inserter(wanted),
                 [&](GlobalId point) { return !cells.is_here(point); });
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
void add_foreign(const mesh::DistributedMesh& mesh, const std::vector<SentTriangle>& triangles, Cells& cells,
                 const comm::Communicator& comm) {
  const std::vector<GlobalId> wanted = wanted_points(mesh, triangles, cells, true);
  const std::vector<Vec2> places = places_of(wanted, cells.points, cells, comm);
  const auto place_of = [&](GlobalId point) {
    const auto found = std::lower_bound(wanted.begin(), wanted.end(), point);
    return places.at(static_cast<std::size_t>(found - wanted.begin()));
  };
  for (const GlobalId point : mesh.foreign)
    cells.slab_places.push_back(cells.is_here(point) ? cells.points[static_cast<std::size_t>(point - cells.first_site)]
                                                     : place_of(point));
  cells.foreign = wanted_points(mesh, triangles, cells, false);
  for (const GlobalId point : cells.foreign)
    cells.points.push_back(place_of(point));
}

LocalIndex local_index(GlobalId point, const Cells& cells) {
  if (cells.is_here(point))
    return static_cast<LocalIndex>(point - cells.first_site);
  const auto found = std::lower_bound(cells.foreign.begin(), cells.foreign.end(), point);
  return cells.site_count + static_cast<LocalIndex>(found - cells.foreign.begin());
}

void add_triangles(const std::vector<SentTriangle>& triangles, Cells& cells) {
  cells.triangles.resize(triangles.size());
  thread_loop(std::ssize(triangles), 1024, [&](std::ptrdiff_t t, int) {
    const SentTriangle& sent = triangles[static_cast<std::size_t>(t)];
    CellTriangle& made = cells.triangles[static_cast<std::size_t>(t)];
    made.number = sent.number;
    made.region = static_cast<std::int32_t>(sent.region);
    for (std::size_t k = 0; k < 3; ++k)
      made.corners[k] = local_index(sent.corners[k], cells);
    const auto side = [&](std::size_t k) {
      return difference(cells.points[at(made.corners[k])], cells.points[at(made.corners[0])], cells.period);
    };
    made.centre = circumcentre(side(1), side(2));
  });
}

} // namespace

Vec2 difference(Vec2 to, Vec2 from, Vec2 period) {
  Vec2 d = to - from;
  if (period.x > 0)
    d.x -= period.x * std::nearbyint(d.x / period.x);
  if (period.y > 0)
    d.y -= period.y * std::nearbyint(d.y / period.y);
  return d;
}

Vec2 circumcentre(Vec2 b, Vec2 c) {
  const double bb = squared_length(b), cc = squared_length(c), twice = 2 * cross(b, c);
  return {(bb * c.y - cc * b.y) / twice, (cc * b.x - bb * c.x) / twice};
}

Cells make_cells(const mesh::DistributedMesh& mesh, Vec2 period, const comm::Communicator& comm) {
  Cells cells;
  cells.shares = {mesh.point_slab.total, comm.size()};
  cells.first_site = cells.shares.first(comm.rank());
  cells.site_count = static_cast<LocalIndex>(cells.shares.first(comm.rank() + 1) - cells.first_site);
  cells.triangle_count = mesh.triangle_slab.total;
  cells.period = period;
  cells.points = own_sites(mesh, cells, comm);
  {
    const std::vector<SentTriangle> triangles = triangles_at_sites(mesh, cells, comm);
    add_foreign(mesh, triangles, cells, comm);
    add_triangles(triangles, cells);
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
