// SPDX-License-Identifier: BSD-3-Clause
#include "refinement/middles.hpp"

#include "comm/agree.hpp"
#include "core/thread_loop.hpp"
#include "geometry/predicates.hpp"
#include "refinement/curve_middles.hpp"
#include "refinement/facet_crossings.hpp"
#include "trime/mesh/quality.hpp"

#include <algorithm>
#include <optional>

namespace trime::refinement {

using geometry::Vec2;

namespace {

// [R/2r] Triangles with a larger alpha are bad, unless the one that was divided has a larger one: such triangles are
// listed in the report of a run.
constexpr double bad_alpha = 2;

} // namespace

Middles::Middles(const comm::Communicator& comm, const geometry::Frame& frame, const handover::LocalMesh& mesh,
                 const EdgeTable& edges, const geometry::Boundary* curves)
    : comm_(comm), frame_(frame), mesh_(mesh), edges_(edges), places_(at(edges.size())), facets_(at(edges.size()), -1),
      states_(at(edges.size()), State::inside) {
  for (std::size_t k = 0; k < mesh.facets.size(); ++k) {
    const LocalIndex edge = edges.find(mesh.facets[k][0], mesh.facets[k][1]);
    facets_[at(edge)] = static_cast<LocalIndex>(k);
    states_[at(edge)] = State::straight;
  }
  thread_loop(edges.size(), 1024, [&](std::ptrdiff_t edge, int) {
    places_[static_cast<std::size_t>(edge)] = straight_place(static_cast<LocalIndex>(edge));
  });
  if (!curves)
    return;
  place_on_curves(*curves);
  for (std::vector<Ends> failed;;) { // each round straightens an edge that was curved
    failed = comm::gather_everywhere(comm, failures());
    if (failed.empty())
      failed = comm::gather_everywhere(comm, crossings());
    if (failed.empty())
      return;
    for (const Ends& ends : failed)
      straighten(ends);
  }
}

/// From the lower end, so that all ranks round in the same way.
Vec2 Middles::straight_place(LocalIndex edge) const {
  const geometry::Periods& periods = frame_.periods();
  const Vec2 a = mesh_.points[at(edges_.lower(edge))];
  const Vec2 b = periods.nearest_image(mesh_.points[at(edges_.upper(edge))], a);
  return periods.wrap(frame_.lattice().snap(0.5 * (a + b)));
}

void Middles::place_on_curves(const geometry::Boundary& curves) {
  const geometry::Periods& periods = frame_.periods();
  const geometry::Box& box = frame_.container();
  const CurveMiddles middles(curves, std::max(box.width(), box.height()));
  thread_loop(std::ssize(mesh_.facets), 64, [&](std::ptrdiff_t item, int) {
    const auto k = static_cast<std::size_t>(item);
    const Vec2 a = mesh_.points[at(mesh_.facets[k][0])];
    const Vec2 b = periods.nearest_image(mesh_.points[at(mesh_.facets[k][1])], a);
    const LocalIndex edge = edges_.find(mesh_.facets[k][0], mesh_.facets[k][1]);
    if (const std::optional<CurveMiddle> found = middles.middle(a, b, mesh_.facet_parts[k])) {
      const Vec2 p = found->place;
      places_[at(edge)] = periods.any() ? periods.wrap(frame_.lattice().snap(p)) : frame_.snap(p);
      states_[at(edge)] = found->is_on_curve ? State::on_curve : State::near_curve;
    }
  });
}

std::array<Vec2, 3> Middles::corners(LocalIndex triangle) const {
  const auto& [a, b, c] = mesh_.triangles[at(triangle)];
  const geometry::Periods& periods = frame_.periods();
  const Vec2 p = mesh_.points[at(a)];
  return {p, periods.nearest_image(mesh_.points[at(b)], p), periods.nearest_image(mesh_.points[at(c)], p)};
}

Children Middles::children(LocalIndex triangle) const {
  const std::array<Vec2, 3> p = corners(triangle);
  const std::array<LocalIndex, 3>& edges = edges_.of_triangle(triangle);
  std::array<Vec2, 3> m;
  for (std::size_t j = 0; j < 3; ++j)
    m[j] = frame_.periods().nearest_image(place(edges[j]), 0.5 * (p[j] + p[(j + 1) % 3]));
  return {p, m, frame_.lattice()};
}

bool Middles::has_curve(LocalIndex triangle) const {
  return std::ranges::any_of(edges_.of_triangle(triangle), [&](LocalIndex edge) { return is_curved(edge); });
}

/// Are the triangles as good as they must be, and the diametral circles of the new boundary edges empty?
bool Middles::is_good(LocalIndex triangle) const {
  const Children children = this->children(triangle);
  if (!children.is_sound(frame_.lattice()))
    return false;
  const std::array<Vec2, 3> p = corners(triangle);
  if (children.alpha() > std::max(bad_alpha, mesh::aspect_ratio(p[0], p[1], p[2])))
    return false;
  for (int j = 0; j < 3; ++j) {
    const LocalIndex edge = edges_.of_triangle(triangle)[static_cast<std::size_t>(j)];
    if (!is_curved(edge) ||
        geometry::diametral_side(children.at(j), children.at((j + 1) % 3), children.at((j + 2) % 3)) < 0)
      continue;
    if (geometry::diametral_side(children.at(j), children.at(3 + j), children.at(children.across(j, 0))) < 0 ||
        geometry::diametral_side(children.at(3 + j), children.at((j + 1) % 3), children.at(children.across(j, 1))) < 0)
      return false;
  }
  return true;
}

/// Are both halves of an inner edge locally Delaunay?
bool Middles::is_delaunay(LocalIndex edge) const {
  const auto& [left, right] = edges_.triangles(edge);
  const Children here = children(left), there = children(right);
  const int j = static_cast<int>(edges_.place_in(left, edge)), k = static_cast<int>(edges_.place_in(right, edge));
  for (const int half : {0, 1}) { // the triangles run along the edge in opposite directions
    const Vec2 a = here.at(half == 0 ? j : 3 + j), b = here.at(half == 0 ? 3 + j : (j + 1) % 3);
    const Vec2 beyond = frame_.periods().nearest_image(there.at(there.across(k, 1 - half)), here.at(3 + j));
    if (geometry::is_inside_circle(a, b, here.at(here.across(j, half)), beyond, frame_.lattice()))
      return false;
  }
  return true;
}

void Middles::list_curved(LocalIndex triangle, std::vector<Ends>& list) const {
  for (const LocalIndex edge : edges_.of_triangle(triangle))
    if (is_curved(edge))
      list.push_back(ends(edge));
}

/// Returns the edges of this rank's triangles whose vertices must not lie on the curve.
std::vector<Middles::Ends> Middles::failures() const {
  std::vector<Ends> failed;
  for (LocalIndex t = 0; t < static_cast<LocalIndex>(mesh_.triangles.size()); ++t) {
    if (!has_curve(t))
      continue;
    if (t < mesh_.owned_triangles && !is_good(t))
      list_curved(t, failed);
    for (const LocalIndex edge : edges_.of_triangle(t)) {
      const auto& [left, right] = edges_.triangles(edge);
      if (edge >= edges_.owned() || left < 0 || right < 0 || is_delaunay(edge))
        continue;
      list_curved(left, failed);
      list_curved(right, failed);
    }
  }
  std::ranges::sort(failed);
  failed.erase(std::unique(failed.begin(), failed.end()), failed.end());
  return failed;
}

/// Returns the edges of this rank with halves that cross other boundary edges. Every rank gets all halves: as a run
/// holds the sites of the boundary.
std::vector<Middles::Ends> Middles::crossings() const {
  std::vector<LocalIndex> curved; // by segment that is tried
  std::vector<geometry::Segment> mine, tried;
  for (const std::array<LocalIndex, 2>& facet : mesh_.facets) {
    const LocalIndex edge = edges_.find(facet[0], facet[1]);
    if (edge >= edges_.owned())
      continue;
    const Vec2 a = mesh_.points[at(facet[0])], m = place(edge), b = mesh_.points[at(facet[1])];
    for (const geometry::Segment& half :
         {geometry::Segment{a, frame_.periods().nearest_image(m, a)}, {m, frame_.periods().nearest_image(b, m)}}) {
      mine.push_back(half);
      if (!is_curved(edge))
        continue;
      tried.push_back(half);
      curved.push_back(edge);
    }
  }
  std::vector<Ends> found;
  for (const std::size_t k : crossing(comm::gather_everywhere(comm_, std::move(mine)), tried, frame_.periods()))
    found.push_back(ends(curved[k]));
  return found;
}

void Middles::straighten(const Ends& ends) {
  const auto local = [&](GlobalId point) -> LocalIndex {
    if (point >= mesh_.first_point && point < mesh_.first_point + mesh_.owned_points)
      return static_cast<LocalIndex>(point - mesh_.first_point);
    const auto found = std::lower_bound(mesh_.ghost_ids.begin(), mesh_.ghost_ids.end(), point);
    return found != mesh_.ghost_ids.end() && *found == point
               ? mesh_.owned_points + static_cast<LocalIndex>(found - mesh_.ghost_ids.begin())
               : -1;
  };
  const LocalIndex a = local(ends[0]), b = local(ends[1]);
  const LocalIndex edge = a < 0 || b < 0 ? -1 : edges_.find(a, b);
  if (edge < 0)
    return;
  states_[at(edge)] = State::refused;
  places_[at(edge)] = straight_place(edge);
}

BoundaryMiddles Middles::counts() const {
  std::array<std::int64_t, 4> counts{};
  for (LocalIndex edge = 0; edge < edges_.owned(); ++edge)
    if (const State state = states_[at(edge)]; state != State::inside)
      ++counts[static_cast<std::size_t>(state) - 1];
  comm_.sum(counts);
  return {counts[1], counts[2], counts[0], counts[3]};
}

} // namespace trime::refinement
