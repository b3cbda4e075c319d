// SPDX-License-Identifier: BSD-3-Clause
// Parting rings where they touch; see part_touches.
#include "geometry/predicates.hpp"
#include "shape/lattice_rings.hpp"
#include "shape/rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace trime::shape {

namespace {

using geometry::cross;
using geometry::dot;
using geometry::Frame;
using geometry::length;
using geometry::lexicographically_less;
using geometry::orient2d;
using geometry::Segment;
using geometry::SegmentGrid;
using geometry::Vec2;

/// A vertex that lies on the edge that starts at vertex `edge`, both counted through all rings.
struct OnEdge {
  LocalIndex edge;
  double along;
  Vec2 place;
};

/// Does p lie on s, not at its ends?
bool lies_on(Vec2 p, const Segment& s, double tolerance) {
  const Vec2 d = s.b - s.a, u = p - s.a;
  const double along = dot(u, d), whole = squared_length(d);
  return p != s.a && p != s.b && along > 0 && along < whole && std::fabs(cross(d, u)) <= tolerance * std::sqrt(whole);
}

Vec2 unit(Vec2 v) {
  return (1 / length(v)) * v;
}

/// Puts vertices on edges into these edges, with the lines of the edges.
void split_edges(std::vector<LatticeRing>& rings, const std::vector<SegmentPair>& meetings, const SegmentGrid& grid,
                 double tolerance) {
  std::vector<OnEdge> splits;
  const auto look = [&](LocalIndex edge, Vec2 p) {
    const Segment& s = grid.segments()[at(edge)];
    if (lies_on(p, s, tolerance))
      splits.push_back({edge, dot(p - s.a, s.b - s.a), p});
  };
  for (const auto& [i, j] : meetings) {
    look(i, grid.segments()[at(j)].a);
    look(i, grid.segments()[at(j)].b);
    look(j, grid.segments()[at(i)].a);
    look(j, grid.segments()[at(i)].b);
  }
  std::sort(splits.begin(), splits.end(), [](const OnEdge& a, const OnEdge& b) {
    return a.edge != b.edge     ? a.edge < b.edge
           : a.along != b.along ? a.along < b.along
                                : lexicographically_less(a.place, b.place);
  });
  auto next = splits.begin();
  for (LocalIndex edge = 0; LatticeRing & ring : rings) {
    LatticeRing whole;
    whole.polygon = ring.polygon;
    for (std::size_t k = 0; k < ring.points.size(); ++k, ++edge) {
      whole.points.push_back(ring.points[k]);
      whole.lines.push_back(ring.lines[k]);
      for (; next != splits.end() && next->edge == edge; ++next)
        if (whole.points.back() != next->place) {
          whole.points.push_back(next->place);
          whole.lines.push_back(ring.lines[k]);
        }
    }
    ring = std::move(whole);
  }
}

/// @brief Vertices with two arms each, which can be joined again.
///
/// Edge e leads from vertex e to the next of its ring: end 2 e is its start, end 2 e + 1 its other end.
class Web {
public:
  Web(const std::vector<LatticeRing>& rings, const SegmentGrid& grid, const Frame& frame, const TouchOptions& options)
      : grid_(grid), frame_(frame), options_(options) {
    LocalIndex first = 0;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      const LatticeRing& ring = rings[r];
      const auto n = static_cast<LocalIndex>(ring.points.size());
      for (LocalIndex k = 0; k < n; ++k) {
        places_.push_back(ring.points[at(k)]);
        lines_.push_back(ring.lines[at(k)]);
        ring_.push_back(r);
        polygons_.push_back(ring.polygon);
        ends_.push_back({2 * (first + (k + n - 1) % n) + 1, 2 * (first + k)});
      }
      first += n;
    }
    before_ = places_;
    vertex_.resize(2 * places_.size());
    for (std::size_t v = 0; v < places_.size(); ++v)
      vertex_[at(ends_[v][0])] = vertex_[at(ends_[v][1])] = static_cast<LocalIndex>(v);
  }

  std::vector<RingTouch> part();
  std::vector<LatticeRing> rings() const;

private:
  /// An end of an edge at a shared place, seen from there.
  struct Arm {
    LocalIndex end;
    Vec2 toward;
  };
  struct Sector {
    LocalIndex from, to; ///< ends; the area lies counter-clockwise from the first to the second
    Vec2 moved;          ///< where its vertex goes if it does
    bool sharp;
  };

  Vec2 other_end(LocalIndex end) const { return before_[at(vertex_[at(end ^ 1)])]; }
  std::vector<Arm> arms_around(const std::vector<LocalIndex>& visits) const;
  bool can_part(const std::vector<Arm>& arms) const;
  bool area_on_left(const Arm& arm, Vec2 place) const;
  Sector sector(const std::vector<Arm>& arms, std::size_t first, Vec2 place) const;
  bool part_at(const std::vector<LocalIndex>& visits);

  const SegmentGrid& grid_; ///< of the rings as they are in the web
  const Frame& frame_;
  const TouchOptions& options_;
  std::vector<Vec2> places_, before_;           ///< of each vertex, now and at first
  std::vector<int> lines_, polygons_;           ///< of each vertex
  std::vector<std::size_t> ring_;               ///< of each vertex, as given
  std::vector<std::array<LocalIndex, 2>> ends_; ///< of each vertex
  std::vector<LocalIndex> vertex_;              ///< of each end
};

/// The arms in counter-clockwise order.
std::vector<Web::Arm> Web::arms_around(const std::vector<LocalIndex>& visits) const {
  const Vec2 place = before_[at(visits[0])];
  std::vector<Arm> arms;
  for (const LocalIndex v : visits)
    for (const LocalIndex end : ends_[at(v)])
      arms.push_back({end, other_end(end)});
  const auto lower = [&](Vec2 p) { return p.y < place.y || (p.y == place.y && p.x < place.x); };
  std::sort(arms.begin(), arms.end(), [&](const Arm& a, const Arm& b) {
    if (lower(a.toward) != lower(b.toward))
      return lower(b.toward);
    const int turn = orient2d(place, a.toward, b.toward);
    return turn != 0 ? turn > 0 : a.end < b.end;
  });
  return arms;
}

/// False if two arms lie on each other, or two rings cross. A ring that crosses itself in a vertex has a clear area.
bool Web::can_part(const std::vector<Arm>& arms) const {
  for (std::size_t k = 0; k < arms.size(); ++k) {
    const Vec2 place = before_[at(vertex_[at(arms[k].end)])], next = arms[(k + 1) % arms.size()].toward;
    if (orient2d(place, arms[k].toward, next) == 0 && dot(arms[k].toward - place, next - place) > 0)
      return false;
  }
  for (std::size_t k = 0; k < arms.size(); ++k) {
    const LocalIndex v = vertex_[at(arms[k].end)];
    std::vector<LocalIndex> open; // visits of other rings that have one arm between those of v
    for (std::size_t j = k + 1; j < arms.size() && vertex_[at(arms[j].end)] != v; ++j) {
      const LocalIndex w = vertex_[at(arms[j].end)];
      if (const auto found = std::find(open.begin(), open.end(), w); found != open.end())
        open.erase(found);
      else if (ring_[at(w)] != ring_[at(v)])
        open.push_back(w);
    }
    const bool first_arm = std::any_of(arms.begin() + static_cast<std::ptrdiff_t>(k) + 1, arms.end(),
                                       [&](const Arm& arm) { return vertex_[at(arm.end)] == v; });
    if (first_arm && !open.empty())
      return false;
  }
  return true;
}

/// Is the area on the left of the arm, as it is seen from the place?
bool Web::area_on_left(const Arm& arm, Vec2 place) const {
  const Vec2 d = arm.toward - place, p = frame_.lattice().snap(place + 0.5 * d);
  const int turn = orient2d(place, arm.toward, p);
  // On the line: the grid answers for p + (epsilon^2, epsilon).
  const bool left = turn != 0 ? turn > 0 : d.x > 0 || (d.x == 0 && d.y < 0);
  return grid_.inside(p) == left;
}

/// @brief If possible, the vertex moves to where no disc over an arm of another sector holds it, and no disc over its
/// arms holds the place. That is a direction at least 90 degrees from the former arms and at most 90 degrees from the
/// latter. In a reflex sector a direction must lie to the left of the first arm and to the right of the second; from
/// elsewhere the edges would cross all other arms.
Web::Sector Web::sector(const std::vector<Arm>& arms, std::size_t first, Vec2 place) const {
  const std::size_t second = (first + 1) % arms.size();
  const auto direction_of = [&](std::size_t k) { return unit(arms[k].toward - place); };
  const Vec2 u = direction_of(first), w = direction_of(second);
  const Vec2 across = u - w, middle = unit({-across.y, across.x}); // into the sector
  Sector result{arms[first].end, arms[second].end, {}, std::fabs(cross(middle, u)) < ShapeRules::sharp_sine};
  double least = 2;
  Vec2 best = middle;
  for (const double share : ShapeRules::tried_directions) { // from the middle of the sector towards its arms
    const Vec2 d = unit(middle + std::fabs(share) * ((share < 0 ? w : u) - middle));
    if (share != 0 && (cross(u, d) <= 0 || cross(d, w) <= 0))
      continue;
    double worst = std::fmax(-dot(d, u), -dot(d, w));
    for (std::size_t k = 0; k < arms.size(); ++k)
      if (k != first && k != second)
        worst = std::fmax(worst, dot(d, direction_of(k)));
    if (worst < least) {
      least = worst;
      best = d;
    }
    if (least <= 0)
      break;
  }
  const double sine = std::fmin(std::fabs(cross(best, u)), std::fabs(cross(best, w)));
  const double shortest_step = ShapeRules::touch_gap * frame_.step();
  double step = options_.gap / std::fmax(sine, ShapeRules::least_sine);
  for (const Arm& arm : arms)
    step = std::fmin(step, std::fmax(shortest_step, ShapeRules::farthest_move * length(arm.toward - place)));
  result.moved = frame_.snap(place + step * best);
  return result;
}

bool Web::part_at(const std::vector<LocalIndex>& visits) {
  const std::vector<Arm> arms = arms_around(visits);
  if (!can_part(arms))
    return false;
  const Vec2 place = before_[at(visits[0])];
  const std::size_t first = area_on_left(arms[0], place) != options_.outside ? 0 : 1;
  std::vector<Sector> sectors;
  for (std::size_t k = first; k < arms.size(); k += 2)
    sectors.push_back(sector(arms, k, place));
  std::sort(sectors.begin(), sectors.end(), [](const Sector& a, const Sector& b) {
    return a.sharp != b.sharp ? a.sharp : std::min(a.from, a.to) < std::min(b.from, b.to);
  });
  for (std::size_t k = 0; k < sectors.size(); ++k) {
    const LocalIndex v = visits[k];
    ends_[at(v)] = {sectors[k].from, sectors[k].to};
    vertex_[at(sectors[k].from)] = vertex_[at(sectors[k].to)] = v;
    if (k > 0)
      places_[at(v)] = sectors[k].moved;
  }
  return true;
}

std::vector<RingTouch> Web::part() {
  std::vector<LocalIndex> order(places_.size());
  for (std::size_t v = 0; v < order.size(); ++v)
    order[v] = static_cast<LocalIndex>(v);
  std::sort(order.begin(), order.end(), [&](LocalIndex a, LocalIndex b) {
    return before_[at(a)] != before_[at(b)] ? lexicographically_less(before_[at(a)], before_[at(b)]) : a < b;
  });
  std::vector<RingTouch> touches;
  std::vector<LocalIndex> visits;
  for (std::size_t k = 0; k < order.size(); k += visits.size()) {
    visits.clear();
    for (std::size_t j = k; j < order.size() && before_[at(order[j])] == before_[at(order[k])]; ++j)
      visits.push_back(order[j]);
    if (visits.size() > 1 && part_at(visits))
      touches.push_back({before_[at(visits[0])], lines_[at(visits[0])], lines_[at(visits[1])]});
  }
  std::sort(touches.begin(), touches.end(), [](const RingTouch& a, const RingTouch& b) { return a.line < b.line; });
  return touches;
}

std::vector<LatticeRing> Web::rings() const {
  std::vector<LatticeRing> rings;
  std::vector<bool> used(places_.size(), false); // edges
  for (std::size_t first = 0; first < places_.size(); ++first) {
    if (used[first])
      continue;
    LatticeRing ring;
    ring.polygon = polygons_[first];
    auto end = static_cast<LocalIndex>(2 * first);
    while (!used[at(end / 2)]) {
      used[at(end / 2)] = true;
      const LocalIndex v = vertex_[at(end)];
      ring.points.push_back(places_[at(v)]);
      ring.lines.push_back(lines_[at(v)]);
      const LocalIndex next = vertex_[at(end ^ 1)];
      end = ends_[at(next)][0] == (end ^ 1) ? ends_[at(next)][1] : ends_[at(next)][0];
    }
    rings.push_back(std::move(ring));
  }
  return rings;
}

} // namespace

std::vector<RingTouch> part_touches(std::vector<LatticeRing>& rings, const std::vector<SegmentPair>& meetings,
                                    const SegmentGrid& grid, const Frame& frame, const TouchOptions& options) {
  split_edges(rings, meetings, grid, ShapeRules::on_edge * frame.step());
  const SegmentGrid split(segments_of(rings));
  Web web(rings, split, frame, options);
  std::vector<RingTouch> touches = web.part();
  rings = web.rings();
  return touches;
}

} // namespace trime::shape
