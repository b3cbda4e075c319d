// SPDX-License-Identifier: BSD-3-Clause
#include "acceptance/judge.hpp"

#include "comm/agree.hpp"
#include "core/angle.hpp"
#include "trime/core/error.hpp"
#include "trime/handover/local_mesh.hpp"
#include "trime/mesh/quality.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <numeric>
#include <optional>

namespace trime::acceptance {
namespace {

using geometry::Vec2;
using handover::LocalMesh;
using Corners = std::array<Vec2, 3>;

constexpr std::size_t measures = static_cast<std::size_t>(Measure::looped_open_boundary) + 1;
constexpr double none = std::numeric_limits<double>::max();
// [edges] Shorter links, as between two right-angled triangles that have one circumcentre, point where rounding makes
// them point. Points that are rounded at 1e-9 edges turn a link of this length by at most the good cosine.
constexpr double least_direction = 1e-6;
// [1] By this share of itself a limit may be missed: half a corner of 60 degrees has 30 degrees, up to rounding.
constexpr double rounding = 1e-9;

std::size_t at(LocalIndex index) {
  return static_cast<std::size_t>(index);
}

/// Collects the values of one rule on this rank.
struct Tally {
  SolverRule rule;
  std::int64_t measured = 0, broken = 0, ears = 0;
  double worst = -none; // as badness(): larger is worse
  double item = none;   // number of the first item with the worst value; exact, since it is below 2^53
  Vec2 place{};

  /// Larger values are worse. A value that is not a number, as of a triangle without an area, is infinitely bad.
  double badness(double value) const {
    return std::isnan(value) ? std::numeric_limits<double>::infinity() : rule.is_least ? -value : value;
  }

  void add(double value, GlobalId number, Vec2 where, bool is_ear = false) {
    const double bad = badness(value);
    const bool is_broken = bad > badness(rule.limit) + rounding * std::fabs(rule.limit);
    ++measured;
    broken += is_broken;
    ears += is_broken && is_ear;
    const auto its = static_cast<double>(number);
    if (bad < worst || (bad == worst && its >= item))
      return;
    worst = bad;
    item = its;
    place = where;
  }
};

double area_of(const Corners& p) {
  return 0.5 * geometry::cross(p[1] - p[0], p[2] - p[0]);
}

Vec2 middle_of(const Corners& p) {
  return (1 / 3.0) * (p[0] + p[1] + p[2]);
}

double skewness_of(const Corners& p) {
  const double longest =
      std::max({geometry::length(p[1] - p[0]), geometry::length(p[2] - p[1]), geometry::length(p[0] - p[2])});
  return longest / std::sqrt(area_of(p) / pi); // not a number if the triangle lies upside down
}

/// The circumcentre, or where the line to it from the centre of mass leaves the triangle.
Vec2 cell_centre(const Corners& p) {
  const Vec2 u = p[1] - p[0], v = p[2] - p[0];
  const double uu = geometry::squared_length(u), vv = geometry::squared_length(v), d = 2 * geometry::cross(u, v);
  const Vec2 circumcentre = p[0] + Vec2{(vv * u.y - uu * v.y) / -d, (uu * v.x - vv * u.x) / -d};
  const Vec2 mass = middle_of(p), way = circumcentre - mass;
  double share = 1;
  for (std::size_t k = 0; k < 3; ++k) { // sides are to the left of their outside
    const Vec2 side = p[(k + 1) % 3] - p[k];
    const double inside = geometry::cross(side, mass - p[k]), change = geometry::cross(side, way);
    if (inside + change < 0)
      share = std::fmin(share, inside / -change);
  }
  return mass + share * way;
}

/// One side of a local triangle at the lower of its end points.
struct Side {
  GlobalId high; // the other end
  LocalIndex triangle;
  int k; // the side from the k-th corner
};

/// All measures of one mesh.
class Judge {
public:
  /// @param marks of all local points, see Measure::boundary_marks
  Judge(const LocalMesh& mesh, const geometry::Periods& periods, std::span<const double> marks,
        std::vector<Tally>& tallies)
      : mesh_(mesh), periods_(periods), marks_(marks) {
    for (Tally& tally : tallies)
      of_measure_[static_cast<std::size_t>(tally.rule.measure)].push_back(&tally);
  }

  void triangles() const;
  void points() const;
  void sides() const;

private:
  /// The corners of a triangle next to each other, also in a periodic container.
  Corners corners(LocalIndex triangle) const {
    const auto& [a, b, c] = mesh_.triangles[at(triangle)];
    const Vec2 p = mesh_.points[at(a)];
    if (!periods_.any())
      return {p, mesh_.points[at(b)], mesh_.points[at(c)]};
    return {p, periods_.nearest_image(mesh_.points[at(b)], p), periods_.nearest_image(mesh_.points[at(c)], p)};
  }
  bool wants(std::initializer_list<Measure> some) const {
    return std::ranges::any_of(
        some, [&](Measure measure) { return !of_measure_[static_cast<std::size_t>(measure)].empty(); });
  }
  void add(Measure measure, double value, GlobalId number, Vec2 where, bool is_ear = false) const {
    for (Tally* tally : of_measure_[static_cast<std::size_t>(measure)])
      tally->add(value, number, where, is_ear);
  }
  template <class Visit>
  void for_each_side(const Visit& visit) const;
  void add_pair(const Side& one, const Side& other) const;

  const LocalMesh& mesh_;
  const geometry::Periods periods_;
  const std::span<const double> marks_;
  std::array<std::vector<Tally*>, measures> of_measure_; // the rules of each measure
};

void Judge::triangles() const {
  std::vector<std::int8_t> edges(at(mesh_.owned_triangles), 0);
  for (LocalIndex facet = 0; facet < mesh_.owned_facets; ++facet)
    ++edges[at(mesh_.facet_triangles[at(facet)])];
  for (LocalIndex t = 0; t < mesh_.owned_triangles; ++t) {
    const Corners p = corners(t);
    const GlobalId number = mesh_.triangle_ids[at(t)];
    const Vec2 middle = middle_of(p);
    const bool has_area = area_of(p) > 0;
    if (wants({Measure::least_angle}))
      add(Measure::least_angle, has_area ? mesh::min_angle_degrees(p[0], p[1], p[2]) : NAN, number, middle);
    if (wants({Measure::largest_angle}))
      add(Measure::largest_angle, has_area ? mesh::max_angle_degrees(p[0], p[1], p[2]) : NAN, number, middle);
    add(Measure::skewness, skewness_of(p), number, middle);
    const bool is_ear = edges[at(t)] == 2;
    add(Measure::boundary_edges, edges[at(t)], number, middle, is_ear);
    double marks = 0, marked = 0;
    for (const LocalIndex corner : mesh_.triangles[at(t)]) {
      marks += marks_[at(corner)];
      marked += marks_[at(corner)] > 0;
    }
    add(Measure::boundary_corners, marked, number, middle, is_ear);
    add(Measure::boundary_marks, marks, number, middle);
  }
}

void Judge::points() const {
  std::vector<std::int32_t> triangles(at(mesh_.owned_points), 0), paths(at(mesh_.owned_points), 0);
  for (const std::array<LocalIndex, 3>& triangle : mesh_.triangles)
    for (const LocalIndex corner : triangle)
      if (corner < mesh_.owned_points)
        ++triangles[at(corner)];
  for (const auto& [from, to] : mesh_.facets)
    if (from < mesh_.owned_points)
      ++paths[at(from)];
  for (LocalIndex p = 0; p < mesh_.owned_points; ++p) {
    add(Measure::triangles_at_point, triangles[at(p)], mesh_.global_id(p), mesh_.points[at(p)]);
    if (mesh_.boundary[at(p)] == 0)
      add(Measure::cell_edges, triangles[at(p)], mesh_.global_id(p), mesh_.points[at(p)]);
    else
      add(Measure::boundary_paths, paths[at(p)], mesh_.global_id(p), mesh_.points[at(p)]);
  }
}

/// Calls visit(low, 3 t + k) for the side from the k-th corner of each local triangle t, if this rank owns the lower
/// end. Both triangles of such a side are local, so each side counts on one rank.
template <class Visit>
void Judge::for_each_side(const Visit& visit) const {
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const LocalIndex a = mesh_.triangles[t][k], b = mesh_.triangles[t][(k + 1) % 3];
      if (const LocalIndex low = mesh_.global_id(a) < mesh_.global_id(b) ? a : b; low < mesh_.owned_points)
        visit(at(low), static_cast<std::int64_t>(3 * t + k));
    }
}

void Judge::add_pair(const Side& one, const Side& other) const {
  const Corners p = corners(one.triangle);
  const std::size_t k = at(one.k);
  const std::array<Vec2, 2> side{p[k], p[(k + 1) % 3]};
  const auto& across = mesh_.triangles[at(other.triangle)];
  const Vec2 middle = 0.5 * (side[0] + side[1]);
  const Vec2 far = mesh_.points[at(across[at((other.k + 2) % 3)])];
  const Vec2 d = periods_.any() ? periods_.nearest_image(far, middle) : far;
  const GlobalId number = 3 * mesh_.triangle_ids[at(one.triangle)] + one.k;
  const double here = area_of(p), there = area_of({side[1], side[0], d}), larger = std::fmax(here, there);
  add(Measure::area_share, larger > 0 ? std::fmin(here, there) / larger : 0, number, middle);
  const FlowLink link = flow_link(side, p[(k + 2) % 3], d);
  if (link.cosine)
    add(Measure::link_cosine, *link.cosine, number, middle);
  add(Measure::link_length, link.length, number, middle);
}

/// Pairs the sides at each point that have the same other end.
void Judge::sides() const {
  if (!wants({Measure::area_share, Measure::link_cosine, Measure::link_length}))
    return;
  std::vector<std::size_t> first(at(mesh_.owned_points) + 1, 0); // by lower end
  for_each_side([&](std::size_t low, std::int64_t) { ++first[low]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::int64_t> all(first.back());
  for_each_side([&](std::size_t low, std::int64_t side) { all[--first[low]] = side; });
  std::vector<Side> around;
  for (std::size_t low = 0; low + 1 < first.size(); ++low) {
    around.clear();
    for (std::size_t n = first[low]; n < first[low + 1]; ++n) {
      const auto t = static_cast<LocalIndex>(all[n] / 3);
      const auto k = static_cast<int>(all[n] % 3);
      const GlobalId a = mesh_.global_id(mesh_.triangles[at(t)][at(k)]);
      const GlobalId b = mesh_.global_id(mesh_.triangles[at(t)][at((k + 1) % 3)]);
      around.push_back({std::max(a, b), t, k});
    }
    std::ranges::sort(around, {}, &Side::high);
    for (std::size_t n = 0; n + 1 < around.size(); ++n) {
      const Side &one = around[n], &other = around[n + 1];
      const bool is_first = mesh_.triangle_ids[at(one.triangle)] < mesh_.triangle_ids[at(other.triangle)];
      if (one.high == other.high)
        add_pair(is_first ? one : other, is_first ? other : one);
    }
  }
}

/// Returns the marks of all local points, see Measure::boundary_marks. Collective.
std::vector<double> marks_of(const LocalMesh& mesh, const std::vector<bool>& open_parts,
                             const comm::Communicator& comm) {
  std::vector<double> marks(mesh.points.size());
  std::ranges::transform(mesh.boundary, marks.begin(), [](std::int32_t tag) { return tag != 0 ? 1.0 : 0.0; });
  for (std::size_t facet = 0; facet < mesh.facets.size(); ++facet) {
    const auto part = static_cast<std::size_t>(mesh.facet_parts[facet]);
    if (part < open_parts.size() && open_parts[part])
      for (const LocalIndex end : mesh.facets[facet])
        marks[at(end)] = 2;
  }
  handover::update_ghosts(comm, mesh, marks); // not all facets of a ghost are known here
  return marks;
}

std::vector<Tally> tallies_of(std::span<const Solver> solvers) {
  std::vector<Tally> tallies;
  for (const SolverRule& rule : solver_rules())
    if (std::ranges::find(solvers, rule.solver) != solvers.end())
      tallies.push_back({rule});
  return tallies;
}

/// Adds what is known of the whole mesh on all ranks; rank 0 counts it.
void add_facts(const BoundaryFacts& boundary, std::vector<Tally>& tallies) {
  for (Tally& tally : tallies)
    if (tally.rule.measure == Measure::components) {
      tally.measured = boundary.components;
      tally.worst = static_cast<double>(boundary.components);
      tally.broken = boundary.components - 1;
    } else if (tally.rule.measure == Measure::looped_open_boundary) {
      tally.measured = boundary.outer_loops;
      tally.broken = boundary.open_outer_loops;
      tally.worst = static_cast<double>(boundary.open_outer_loops);
    }
}

/// Combines the tallies of all ranks. Collective.
std::vector<Verdict> combined(const std::vector<Tally>& here, const comm::Communicator& comm) {
  std::vector<std::int64_t> counts;
  std::vector<double> worst, first;
  for (const Tally& tally : here) {
    counts.insert(counts.end(), {tally.measured, tally.broken, tally.ears});
    worst.push_back(tally.worst);
  }
  comm.sum_and_max(counts, worst);
  for (std::size_t k = 0; k < here.size(); ++k)
    first.push_back(here[k].worst == worst[k] ? here[k].item : none);
  comm.min(first);
  std::vector<double> places;
  for (std::size_t k = 0; k < here.size(); ++k) {
    const bool is_mine = here[k].item != none && here[k].worst == worst[k] && here[k].item == first[k];
    places.insert(places.end(), {is_mine ? here[k].place.x : -none, is_mine ? here[k].place.y : -none});
  }
  comm.max(places);
  std::vector<Verdict> verdicts;
  for (std::size_t k = 0; k < here.size(); ++k) {
    const SolverRule& rule = here[k].rule;
    const std::int64_t* count = &counts[3 * k];
    const double value = count[0] == 0 ? rule.limit : rule.is_least ? -worst[k] : worst[k];
    verdicts.push_back({rule, count[0], count[1], count[2], value, {places[2 * k], places[2 * k + 1]}});
    if (!verdicts.back().has_place())
      verdicts.back().place = {NAN, NAN};
  }
  return verdicts;
}

/// The name of a measure in a sentence.
std::string words_of(Measure measure) {
  if (measure == Measure::boundary_corners) // "boundary corners" would be those of the shape
    return "corners on the boundary";
  std::string words(name_of(measure));
  std::ranges::replace(words, '_', ' ');
  return words;
}

} // namespace

FlowLink flow_link(const std::array<Vec2, 2>& side, Vec2 c, Vec2 d) {
  const Vec2 origin = side[0], along = side[1] - origin; // near the triangles, where coordinates round least
  const Corners left{Vec2{}, along, c - origin}, right{along, Vec2{}, d - origin};
  const Vec2 link = cell_centre(right) - cell_centre(left);
  const double length = geometry::length(link), edge = geometry::length(along);
  const double root = 0.5 * (std::sqrt(area_of(left)) + std::sqrt(area_of(right)));
  FlowLink result{std::nullopt, length / root};
  if (!(length <= least_direction * edge))
    result.cosine = std::fabs(geometry::dot(link, along)) / (length * edge);
  return result;
}

std::vector<Verdict> judge(const mesh::DistributedMesh& mesh, std::span<const Solver> solvers,
                           const BoundaryFacts& boundary, const comm::Communicator& comm) {
  std::vector<Tally> tallies = tallies_of(solvers);
  if (tallies.empty())
    return {};
  const LocalMesh local = handover::make_local_mesh(comm, mesh);
  const std::vector<double> marks = marks_of(local, boundary.open_parts, comm);
  const Judge judge(local, boundary.periods, marks, tallies);
  comm::run_agreed(comm, [&] { // the memory may not suffice
    judge.triangles();
    judge.points();
    judge.sides();
  });
  if (comm.is_root())
    add_facts(boundary, tallies);
  return combined(tallies, comm);
}

std::string text_of(const Verdict& v, bool splits_ears) {
  const std::string where = v.has_place() ? fmt::format(" at {}", Place(v.place, 6)) : "";
  return fmt::format("{}: {} {:.4g}{}, expected at {} {:g}; {} of {} {} break this rule{}: {}{}",
                     word_of(v.rule.solver), words_of(v.rule.measure), v.worst, where,
                     v.rule.is_least ? "least" : "most", v.rule.limit, v.broken, v.measured, v.rule.breakers,
                     v.rule.refuses ? fmt::format(", and {} refuses the mesh", word_of(v.rule.solver)) : "",
                     v.rule.advice, v.ears > 0 && !splits_ears ? v.rule.advice_on_ears : "");
}

} // namespace trime::acceptance
