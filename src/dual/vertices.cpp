// SPDX-License-Identifier: BSD-3-Clause
#include "dual/vertices.hpp"

#include "comm/outbox.hpp"

#include <algorithm>
#include <cmath>

namespace trime::dual {
namespace {

using geometry::Vec2;

/// An edge whose middle the rank of its lower end has numbered.
struct NumberedEdge {
  GlobalId lower, upper;
};

} // namespace

/// Makes the corners of a part of the cell of one site.
struct CellVertices::Collector {
  const CellVertices& vertices;
  const Surroundings& around;
  LocalIndex site_index;
  std::vector<CellCorner> corners{};

  void centre(std::size_t k) {
    const CellTriangle& triangle = vertices.cells_.triangles[at(around.triangles[k])];
    corners.push_back({triangle.number, around.centres[k], vertices.is_displaced(site_index, triangle.corners[0])});
  }
  void middle(std::size_t spoke) {
    const Cells& cells = vertices.cells_;
    const LocalIndex end = around.ends[spoke];
    const bool is_lower = cells.number_of(site_index) < cells.number_of(end);
    corners.push_back({vertices.middle_at(site_index, end), around.middle(spoke),
                       !is_lower && vertices.is_displaced(site_index, end)});
  }
  void site() {
    const auto& list = vertices.site_vertices_;
    const auto found = std::lower_bound(list.begin(), list.end(), site_index,
                                        [](const SiteVertex& at, LocalIndex wanted) { return at.site < wanted; });
    corners.push_back({found->vertex, {0, 0}, false});
  }
};

CellVertices::CellVertices(const Cells& cells, const comm::Communicator& comm) : cells_(cells) {
  comm::run_agreed(comm, [&] { find(); });
  number(comm);
  fetch_others(comm);
}

/// Finds the vertices of this rank behind the circumcentres. Sites in the inside of a region are passed over fast.
void CellVertices::find() {
  Surroundings around;
  for (LocalIndex site = 0; site < cells_.site_count; ++site) {
    if (cells_.region_inside(site) != 0)
      continue;
    look_around(cells_, site, around);
    const Vec2 place = cells_.points[at(site)];
    for (std::size_t spoke = 0; spoke < around.arms.size(); ++spoke) {
      if (!around.is_divided_at(spoke))
        continue;
      const bool is_facet = !around.left(spoke) || !around.right(spoke);
      divided_.push_back({site, around.ends[spoke], static_cast<std::int32_t>(spoke), is_facet, -1});
      if (cells_.number_of(site) < cells_.number_of(around.ends[spoke]))
        places_[is_facet ? facet_middles : interface_middles].push_back(place + around.middle(spoke));
    }
    site_vertices_.push_back({site, -1});
    places_[around.is_closed ? interface_sites : boundary_sites].push_back(place);
  }
}

/// Gives numbers to the vertices of this rank. The rank of the lower end numbers the middle of an edge.
void CellVertices::number(const comm::Communicator& comm) {
  std::array<GlobalId, 4> next{}, totals{};
  for (std::size_t group = 0; group < next.size(); ++group) {
    next[group] = comm.exclusive_scan(std::ssize(places_[group]));
    totals[group] = std::ssize(places_[group]);
  }
  comm.sum(totals);
  first_[0] = cells_.triangle_count;
  for (std::size_t group = 0; group < next.size(); ++group) {
    first_[group + 1] = first_[group] + totals[group];
    next[group] += first_[group];
  }
  rank_first_ = next;
  for (Divided& at : divided_)
    if (cells_.number_of(at.site) < cells_.number_of(at.end))
      at.vertex = next[at.is_facet ? facet_middles : interface_middles]++;
  for (SiteVertex& at : site_vertices_)
    at.vertex = next[cells_.fan(at.site).is_closed ? interface_sites : boundary_sites]++;
}

/// Asks the ranks of the lower ends for the numbers of middles.
void CellVertices::fetch_others(const comm::Communicator& comm) {
  std::vector<Divided*> open; // by the number of the lower end, so by its rank
  for (Divided& at : divided_)
    if (at.vertex < 0)
      open.push_back(&at);
  std::stable_sort(open.begin(), open.end(), [&](const Divided* a, const Divided* b) {
    return cells_.number_of(a->end) < cells_.number_of(b->end);
  });
  comm::Outbox<NumberedEdge> questions;
  for (const Divided* at : open)
    questions[cells_.shares.rank_of(cells_.number_of(at->end))].push_back(
        {cells_.number_of(at->end), cells_.number_of(at->site)});
  comm::Outbox<GlobalId> answers;
  for (const comm::Message& question : comm::send(comm, questions))
    for (const NumberedEdge& edge : comm::from_bytes<NumberedEdge>(question.data)) {
      const auto site = static_cast<LocalIndex>(edge.lower - cells_.first_site);
      auto found = std::lower_bound(divided_.begin(), divided_.end(), site,
                                    [](const Divided& at, LocalIndex wanted) { return at.site < wanted; });
      while (found != divided_.end() && found->site == site && cells_.number_of(found->end) != edge.upper)
        ++found;
      answers[question.peer].push_back(found != divided_.end() && found->site == site ? found->vertex : -1);
    }
  auto at = open.begin();
  for (const comm::Message& answer : comm::send(comm, answers))
    for (const GlobalId vertex : comm::from_bytes<GlobalId>(answer.data))
      (*at++)->vertex = vertex;
}

GlobalId CellVertices::middle_at(LocalIndex site, LocalIndex end) const {
  auto found = std::lower_bound(divided_.begin(), divided_.end(), site,
                                [](const Divided& at, LocalIndex wanted) { return at.site < wanted; });
  while (found->end != end)
    ++found;
  return found->vertex;
}

/// Returns whether a point lies a period away from where it is seen from the site.
bool CellVertices::is_displaced(LocalIndex site, LocalIndex from) const {
  const Vec2 d = cells_.points[at(from)] - cells_.points[at(site)], period = cells_.period;
  return (period.x > 0 && std::fabs(d.x) > 0.5 * period.x) || (period.y > 0 && std::fabs(d.y) > 0.5 * period.y);
}

std::vector<CellCorner> CellVertices::corners(const Surroundings& around, LocalIndex site, const CellPart& part) const {
  Collector collector{*this, around, site};
  for_each_corner(around, part, collector);
  return collector.corners;
}

} // namespace trime::dual
