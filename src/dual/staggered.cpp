// SPDX-License-Identifier: BSD-3-Clause
#include "dual/staggered.hpp"

#include "comm/outbox.hpp"
#include "core/thread_loop.hpp"

#include <algorithm>
#include <tuple>

namespace trime::dual {
namespace {

/// A key on its way to the rank that numbered it.
struct AskedNumber {
  GlobalId owner, other;
};

/// An edge of a ring on its way to another rank.
struct SentRingEdge {
  GlobalId point, edge;
  double dual_length, kite_share;
  std::int64_t is_first;
};

LocalIndex local_point(const Cells& cells, GlobalId number) {
  if (cells.is_here(number))
    return static_cast<LocalIndex>(number - cells.first_site);
  const auto found = std::lower_bound(cells.foreign.begin(), cells.foreign.end(), number);
  return cells.site_count + static_cast<LocalIndex>(found - cells.foreign.begin());
}

std::size_t corner_slot(const CellTriangle& triangle, LocalIndex point) {
  return triangle.corners[0] == point ? 0 : triangle.corners[1] == point ? 1 : 2;
}

} // namespace

StaggeredGrid::StaggeredGrid(const Cells& cells, bool only_whole, const comm::Communicator& comm) : cells_(cells) {
  number_cells(only_whole, comm);
  count_parts(comm);
  comm::run_agreed(comm, [&] { find_foreign(); });
  fetch_numbers(foreign_edges_, edge, comm);
  fetch_numbers(foreign_vertices_, vertex, comm);
  comm::run_agreed(comm, [&] { number_triangles(); });
  fetch_rings(comm);
}

std::size_t StaggeredGrid::spokes_of(LocalIndex site) const {
  const Fan fan = cells_.fan(site);
  return fan.triangles.size() + (fan.is_closed ? 0 : 1);
}

/// Returns the other end of a spoke, see Surroundings.
LocalIndex StaggeredGrid::spoke_end(LocalIndex site, std::size_t spoke) const {
  const Fan fan = cells_.fan(site);
  const bool is_last = spoke == fan.triangles.size(); // on the boundary
  const CellTriangle& triangle = cells_.triangles[at(fan.triangles[is_last ? spoke - 1 : spoke])];
  return triangle.corners[(corner_slot(triangle, site) + (is_last ? 2 : 1)) % 3];
}

/// Returns the end with a cell, the lower number if both have one; -1 if none has.
LocalIndex StaggeredGrid::owner_of(LocalIndex a, LocalIndex b) const {
  if (!is_cell(a) || !is_cell(b))
    return is_cell(a) ? a : is_cell(b) ? b : -1;
  return cells_.number_of(a) < cells_.number_of(b) ? a : b;
}

/// Returns the corner with a cell and the lowest number; -1 if none has a cell.
LocalIndex StaggeredGrid::owner_of(LocalIndex triangle) const {
  const auto& [a, b, c] = cells_.triangles[at(triangle)].corners;
  const LocalIndex first = owner_of(a, b);
  return first < 0 ? (is_cell(c) ? c : -1) : owner_of(first, c);
}

bool StaggeredGrid::owns_vertex(LocalIndex site, LocalIndex triangle) const {
  return owner_of(triangle) == site;
}

/// Numbers the cells, and asks other ranks for the numbers of theirs.
void StaggeredGrid::number_cells(bool only_whole, const comm::Communicator& comm) {
  numbers_.assign(cells_.points.size(), -1);
  GlobalId count = 0;
  for (LocalIndex site = 0; site < cells_.site_count; ++site)
    if (!only_whole || cells_.closed[at(site)])
      numbers_[at(site)] = count++;
  first_[cell] = comm.exclusive_scan(count);
  totals_[cell] = comm.sum(count);
  for (LocalIndex site = 0; site < cells_.site_count; ++site)
    if (numbers_[at(site)] >= 0)
      numbers_[at(site)] += first_[cell];
  comm::Outbox<GlobalId> questions, answers;
  for (const GlobalId point : cells_.foreign)
    questions[cells_.shares.rank_of(point)].push_back(point);
  for (const comm::Message& question : comm::send(comm, questions))
    for (const GlobalId point : comm::from_bytes<GlobalId>(question.data))
      answers[question.peer].push_back(numbers_[static_cast<std::size_t>(point - cells_.first_site)]);
  std::size_t next = at(cells_.site_count);
  for (const comm::Message& answer : comm::send(comm, answers)) // by rank, as the points are
    for (const GlobalId number : comm::from_bytes<GlobalId>(answer.data))
      numbers_[next++] = number;
}

/// Counts the edges and vertices that belong to each site.
void StaggeredGrid::count_parts(const comm::Communicator& comm) {
  std::int64_t edges = 0, vertices = 0, inner = 0, most = 0;
  for (const Kind kind : {edge, vertex})
    before_[kind].assign(at(cells_.site_count) + 1, 0);
  for (LocalIndex site = 0; site < cells_.site_count; ++site) {
    const std::size_t spokes = spokes_of(site);
    for (std::size_t spoke = 0; is_cell(site) && spoke < spokes; ++spoke) {
      const LocalIndex end = spoke_end(site, spoke);
      edges += owns_edge(site, end) ? 1 : 0;
      inner += owns_edge(site, end) && is_cell(end) ? 1 : 0;
    }
    for (const LocalIndex triangle : cells_.fan(site).triangles)
      vertices += owns_vertex(site, triangle) ? 1 : 0;
    most = std::max(most, is_cell(site) ? static_cast<std::int64_t>(spokes) : 0);
    before_[edge][at(site) + 1] = edges;
    before_[vertex][at(site) + 1] = vertices;
  }
  first_[edge] = comm.exclusive_scan(edges);
  first_[vertex] = comm.exclusive_scan(vertices);
  std::array<std::int64_t, 3> sums{edges, vertices, inner};
  comm.sum(sums);
  totals_[edge] = sums[0];
  totals_[vertex] = sums[1];
  inner_edges_ = sums[2];
  most_edges_ = comm.max(most);
}

/// Returns the number of an edge that belongs to a site of this rank.
GlobalId StaggeredGrid::own_edge(LocalIndex site, LocalIndex end) const {
  GlobalId number = first_[edge] + before_[edge][at(site)];
  for (std::size_t spoke = 0; spoke < spokes_of(site); ++spoke) {
    const LocalIndex other = spoke_end(site, spoke);
    if (other == end)
      return number;
    number += owns_edge(site, other) ? 1 : 0;
  }
  return -1;
}

/// Returns the number of a vertex that belongs to a site of this rank.
GlobalId StaggeredGrid::own_vertex(LocalIndex site, GlobalId triangle) const {
  GlobalId number = first_[vertex] + before_[vertex][at(site)];
  for (const LocalIndex other : cells_.fan(site).triangles) {
    if (cells_.triangles[at(other)].number == triangle)
      return number;
    number += owns_vertex(site, other) ? 1 : 0;
  }
  return -1;
}

GlobalId StaggeredGrid::number_in(const std::vector<Foreign>& table, GlobalId owner, GlobalId other) {
  const auto found = std::lower_bound(table.begin(), table.end(), std::tuple(owner, other),
                                      [](const Foreign& at, const std::tuple<GlobalId, GlobalId>& wanted) {
                                        return std::tuple(at.owner, at.other) < wanted;
                                      });
  return found != table.end() && found->owner == owner && found->other == other ? found->number : -1;
}

GlobalId StaggeredGrid::find_edge(LocalIndex a, LocalIndex b) const {
  const LocalIndex owner = owner_of(a, b), other = owner == a ? b : a;
  if (owner < 0)
    return -1;
  return owner < cells_.site_count ? own_edge(owner, other)
                                   : number_in(foreign_edges_, cells_.number_of(owner), cells_.number_of(other));
}

GlobalId StaggeredGrid::find_vertex(LocalIndex triangle) const {
  const LocalIndex owner = owner_of(triangle);
  if (owner < 0)
    return -1;
  const GlobalId number = cells_.triangles[at(triangle)].number;
  return owner < cells_.site_count ? own_vertex(owner, number)
                                   : number_in(foreign_vertices_, cells_.number_of(owner), number);
}

/// Lists the edges and vertices of other ranks in triangles at the sites of this rank.
void StaggeredGrid::find_foreign() {
  for (std::size_t t = 0; t < cells_.triangles.size(); ++t) {
    const CellTriangle& triangle = cells_.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const LocalIndex a = triangle.corners[k], b = triangle.corners[(k + 1) % 3], owner = owner_of(a, b);
      if (owner >= cells_.site_count)
        foreign_edges_.push_back({cells_.number_of(owner), cells_.number_of(owner == a ? b : a), -1});
    }
    if (const LocalIndex owner = owner_of(static_cast<LocalIndex>(t)); owner >= cells_.site_count)
      foreign_vertices_.push_back({cells_.number_of(owner), triangle.number, -1});
  }
  const auto key = [](const Foreign& one) { return std::tuple(one.owner, one.other); };
  for (auto* table : {&foreign_edges_, &foreign_vertices_}) {
    std::sort(table->begin(), table->end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    table->erase(
        std::unique(table->begin(), table->end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }),
        table->end());
  }
}

/// Asks the ranks of the owners for numbers. @param table ascending by owner, so by rank
void StaggeredGrid::fetch_numbers(std::vector<Foreign>& table, Kind kind, const comm::Communicator& comm) {
  comm::Outbox<AskedNumber> questions;
  for (const Foreign& wanted : table)
    questions[cells_.shares.rank_of(wanted.owner)].push_back({wanted.owner, wanted.other});
  comm::Outbox<GlobalId> answers;
  for (const comm::Message& question : comm::send(comm, questions))
    for (const AskedNumber& asked : comm::from_bytes<AskedNumber>(question.data)) {
      const auto site = static_cast<LocalIndex>(asked.owner - cells_.first_site);
      answers[question.peer].push_back(kind == edge ? own_edge(site, local_point(cells_, asked.other))
                                                    : own_vertex(site, asked.other));
    }
  auto wanted = table.begin();
  for (const comm::Message& answer : comm::send(comm, answers))
    for (const GlobalId number : comm::from_bytes<GlobalId>(answer.data))
      (wanted++)->number = number;
}

/// Numbers the sides of all triangles and the triangles, so that they are looked up fast from now on.
void StaggeredGrid::number_triangles() {
  sides_.resize(cells_.triangles.size());
  vertices_.resize(cells_.triangles.size());
  thread_loop(std::ssize(cells_.triangles), 1024, [&](std::ptrdiff_t t, int) {
    const auto& corners = cells_.triangles[static_cast<std::size_t>(t)].corners;
    for (std::size_t k = 0; k < 3; ++k)
      sides_[static_cast<std::size_t>(t)][k] = find_edge(corners[k], corners[(k + 1) % 3]);
    vertices_[static_cast<std::size_t>(t)] = find_vertex(static_cast<LocalIndex>(t));
  });
  foreign_edges_ = {};
  foreign_vertices_ = {};
}

GlobalId StaggeredGrid::edge_of_spoke(LocalIndex site, std::size_t spoke) const {
  const Fan fan = cells_.fan(site);
  const bool is_last = spoke == fan.triangles.size(); // on the boundary
  const LocalIndex triangle = fan.triangles[is_last ? spoke - 1 : spoke];
  return edge_at(triangle, (corner_slot(cells_.triangles[at(triangle)], site) + (is_last ? 2 : 0)) % 3);
}

/// Fetches the rings of cells of other ranks that are the second ones of edges of this rank.
void StaggeredGrid::fetch_rings(const comm::Communicator& comm) {
  std::vector<LocalIndex> wanted;
  for (LocalIndex site = 0; site < cells_.site_count; ++site)
    for (std::size_t spoke = 0; is_cell(site) && spoke < spokes_of(site); ++spoke)
      if (const LocalIndex end = spoke_end(site, spoke);
          end >= cells_.site_count && is_cell(end) && owns_edge(site, end))
        wanted.push_back(end);
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  comm::Outbox<GlobalId> questions;
  for (const LocalIndex point : wanted)
    questions[cells_.shares.rank_of(cells_.number_of(point))].push_back(cells_.number_of(point));
  comm::Outbox<SentRingEdge> answers;
  for (const comm::Message& question : comm::send(comm, questions))
    for (const GlobalId point : comm::from_bytes<GlobalId>(question.data))
      for (const RingEdge& one : ring(static_cast<LocalIndex>(point - cells_.first_site)))
        answers[question.peer].push_back({point, one.edge, one.dual_length, one.kite_share, one.is_first ? 1 : 0});
  for (const comm::Message& answer : comm::send(comm, answers))
    for (const SentRingEdge& sent : comm::from_bytes<SentRingEdge>(answer.data)) {
      const LocalIndex point = local_point(cells_, sent.point);
      if (foreign_rings_.empty() || foreign_rings_.back().point != point)
        foreign_rings_.push_back({point, {}});
      foreign_rings_.back().edges.push_back({sent.edge, sent.dual_length, sent.kite_share, sent.is_first == 1});
    }
}

const StaggeredGrid::ForeignRing& StaggeredGrid::foreign_ring(LocalIndex point) const {
  return *std::lower_bound(foreign_rings_.begin(), foreign_rings_.end(), point,
                           [](const ForeignRing& at, LocalIndex wanted) { return at.point < wanted; });
}

std::vector<GlobalId> StaggeredGrid::ring_numbers(LocalIndex point) const {
  std::vector<GlobalId> numbers;
  if (point >= cells_.site_count)
    for (const RingEdge& one : foreign_ring(point).edges)
      numbers.push_back(one.edge);
  else
    for (std::size_t spoke = 0; spoke < spokes_of(point); ++spoke)
      numbers.push_back(edge_of_spoke(point, spoke));
  return numbers;
}

std::vector<RingEdge> StaggeredGrid::ring(LocalIndex point) const {
  if (point >= cells_.site_count)
    return foreign_ring(point).edges;
  Surroundings around;
  look_around(cells_, point, around);
  const std::vector<double> kites = kites_around(around);
  double area = 0;
  for (const double kite : kites)
    area += kite;
  std::vector<RingEdge> edges;
  for (std::size_t spoke = 0; spoke < around.arms.size(); ++spoke)
    edges.push_back({edge_of_spoke(point, spoke), face_of(around, spoke).dual_length(),
                     around.left(spoke) ? kites[*around.left(spoke)] / area : 0, owns_edge(point, around.ends[spoke])});
  return edges;
}

} // namespace trime::dual
