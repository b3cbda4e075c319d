// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/vertex_moves.hpp"

#include "generalise/rules.hpp"
#include "geometry/predicates.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace trime::generalise {

using geometry::Vec2;

VertexMoves::VertexMoves(const CurveMap& map, const std::vector<char>& labels, const geometry::Lattice& lattice,
                         const geometry::Box& bounds)
    : map_(map), mesh_(map.mesh()), rim_(mesh_, labels), lattice_(lattice), bounds_(bounds),
      places_(at(mesh_.vertex_count())) {
  root_.resize(places_.size());
  forget();
}

/// All vertices are where they were.
void VertexMoves::forget() {
  for (LocalIndex v = 0; v < mesh_.vertex_count(); ++v)
    places_[at(v)] = mesh_.point(v);
  std::iota(root_.begin(), root_.end(), 0);
  is_root_.assign(places_.size(), 0);
  any_ = false;
}

/// Triangles with an edge of length 0 do not.
bool VertexMoves::turns_over(LocalIndex t) const {
  const LocalIndex a = root(mesh_.origin(3 * t)), b = root(mesh_.origin(3 * t + 1)), c = root(mesh_.origin(3 * t + 2));
  return a != b && b != c && c != a && geometry::orient2d(places_[at(a)], places_[at(b)], places_[at(c)]) <= 0;
}

VertexMoves::Sides VertexMoves::sides_of(const NarrowPart& part) const {
  Sides sides;
  std::vector<geometry::Segment> ends;
  for (const LocalIndex t : part.triangles) {
    int walls = 0;
    for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e) {
      const LocalIndex a = mesh_.origin(e), b = mesh_.target(e), apex = mesh_.origin(Triangulation::previous(e));
      const Vec2 along = mesh_.point(b) - mesh_.point(a);
      const double whole = length(along);
      if (!is_wall(e)) {
        for (const LocalIndex v : {a, b})
          sides.vertices[v].gap = std::fmin(sides.vertices[v].gap, whole);
        continue;
      }
      ++walls;
      const Vec2 outward = (-1 / whole) * geometry::left_normal(along);
      for (const LocalIndex v : {a, b})
        sides.vertices[v].away = sides.vertices[v].away + outward;
      double& gap = sides.vertices[apex].gap;
      gap = std::fmin(gap, cross(along, mesh_.point(apex) - mesh_.point(a)) / whole);
    }
    if (walls == 2)
      for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e)
        if (is_wall(e) && is_wall(Triangulation::previous(e)))
          ends.push_back({mesh_.point(mesh_.origin(e)), mesh_.point(mesh_.origin(e))});
  }
  sides.ends = geometry::SegmentGrid(std::move(ends));
  return sides;
}

/// How far a vertex is to move: half of what is missing, less near the end of a slit; 0 if nothing is.
double VertexMoves::missing_way(const NarrowPart& part, const Sides& sides, LocalIndex v) const {
  double way = 0.5 * (part.widened_to * map_.size(v) - sides.vertices.at(v).gap);
  if (way <= 0 || map_.is_kept(v))
    return 0;
  if (const auto end = sides.ends.nearest(mesh_.point(v), way / GeneraliseRules::slit_taper))
    way = std::fmin(way, GeneraliseRules::slit_taper * std::sqrt(end->squared_distance));
  return way;
}

bool VertexMoves::is_too_narrow(const NarrowPart& part) const {
  const Sides sides = sides_of(part);
  return std::any_of(sides.vertices.begin(), sides.vertices.end(), [&](const auto& entry) {
    return missing_way(part, sides, entry.first) > GeneraliseRules::least_shift * map_.size(entry.first);
  });
}

void VertexMoves::widen_one(const NarrowPart& part, std::vector<Vec2>& shifts) const {
  const Sides sides = sides_of(part);
  for (const auto& [v, here] : sides.vertices) {
    const double norm = length(here.away), way = missing_way(part, sides, v);
    if (way > 0 && norm > 0.5 && root(v) == v)
      shifts[at(v)] = (way / norm) * here.away;
  }
}

/// Shifts of vertices that follow each other on the curve differ by less than their distance: no spikes.
void VertexMoves::calm(std::vector<Vec2>& shifts) const {
  std::vector<HalfEdge> edges;
  for (HalfEdge e = 0; e < 3 * mesh_.triangle_count(); ++e)
    if (mesh_.mark(e) >= 0 &&
        (shifts[at(root(mesh_.origin(e)))] != Vec2{} || shifts[at(root(mesh_.target(e)))] != Vec2{}))
      edges.push_back(e);
  for (int round = 0; round < GeneraliseRules::calming_rounds; ++round) {
    bool changed = false;
    for (const HalfEdge e : edges) {
      const LocalIndex a = root(mesh_.origin(e)), b = root(mesh_.target(e));
      const double most = GeneraliseRules::steepest_shift * length(mesh_.point(b) - mesh_.point(a));
      const double difference = length(shifts[at(a)] - shifts[at(b)]);
      if (a == b || difference <= most)
        continue;
      const double factor = most / difference;
      shifts[at(a)] = factor * shifts[at(a)];
      shifts[at(b)] = factor * shifts[at(b)];
      changed = true;
    }
    if (!changed)
      return;
  }
}

VertexMoves::Moving VertexMoves::those_moving(const std::vector<Vec2>& shifts) const {
  Moving moving;
  for (LocalIndex v = 4; v < mesh_.vertex_count(); ++v)
    if (shifts[at(root(v))] != Vec2{})
      moving.vertices.push_back(v);
  for (LocalIndex t = 0; t < mesh_.triangle_count(); ++t)
    for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e)
      if (shifts[at(root(mesh_.origin(e)))] != Vec2{}) {
        moving.triangles.push_back(t);
        break;
      }
  return moving;
}

void VertexMoves::place(const Moving& moving, const std::vector<Vec2>& shifts) {
  for (const LocalIndex v : moving.vertices) {
    const Vec2 p = lattice_.snap(mesh_.point(root(v)) + shifts[at(root(v))]);
    places_[at(v)] = {std::clamp(p.x, bounds_.min.x, bounds_.max.x), std::clamp(p.y, bounds_.min.y, bounds_.max.y)};
  }
}

std::vector<LocalIndex> VertexMoves::turned_over(std::span<const LocalIndex> triangles) const {
  std::vector<LocalIndex> bad;
  for (const LocalIndex t : triangles)
    if (turns_over(t))
      for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e)
        bad.push_back(root(mesh_.origin(e)));
  std::sort(bad.begin(), bad.end());
  bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
  return bad;
}

void VertexMoves::shorten(std::vector<Vec2>& shifts) {
  const Moving moving = those_moving(shifts);
  place(moving, shifts);
  for (int round = 0; round <= GeneraliseRules::displacement_rounds; ++round) {
    const double factor = round == GeneraliseRules::displacement_rounds ? 0 : 0.5;
    const std::vector<LocalIndex> bad = turned_over(moving.triangles);
    if (bad.empty())
      break;
    bool stopped = false;
    for (const LocalIndex v : bad) {
      stopped |= shifts[at(v)] != Vec2{};
      shifts[at(v)] = factor * shifts[at(v)];
    }
    place(moving, shifts);
    if (factor == 0 && stopped)
      --round; // those next to them follow
  }
}

std::int64_t VertexMoves::widen(std::vector<NarrowPart> parts) {
  parts.erase(std::remove_if(parts.begin(), parts.end(), [&](const NarrowPart& part) { return !is_too_narrow(part); }),
              parts.end());
  if (parts.empty())
    return 0;
  thin(parts);
  std::vector<Vec2> shifts(places_.size());
  for (const NarrowPart& part : parts)
    widen_one(part, shifts);
  calm(shifts);
  shorten(shifts);
  any_ = false;
  for (LocalIndex v = 4; v < mesh_.vertex_count(); ++v)
    any_ |= length(places_[at(v)] - mesh_.point(v)) > GeneraliseRules::least_shift * map_.size(v) && root(v) == v;
  if (!any_) // what joined vertices alone moved is not worth it
    forget();
  return any_ ? std::ssize(parts) : 0;
}

/// Joins vertices on the sides of narrow parts that are nearer to each other than the parts become wide.
void VertexMoves::thin(std::span<const NarrowPart> parts) {
  std::vector<char> beside(places_.size());
  for (const NarrowPart& part : parts)
    for (const LocalIndex t : part.triangles)
      for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e)
        beside[at(mesh_.origin(e))] = 1;
  for (LocalIndex v = 4; v < mesh_.vertex_count(); ++v) {
    if (!beside[at(v)])
      continue;
    const LocalIndex u = map_.next_on_curve(v);
    if (!rim_.holds(mesh_.find_edge(v, u)))
      continue;
    const double close = GeneraliseRules::thinned * GeneraliseRules::narrow_outside * map_.size(v);
    if (beside[at(u)] && !map_.is_kept(u) && root(u) == u && is_alone(u) && leaves_a_loop(mesh_.find_edge(v, u)) &&
        squared_length(mesh_.point(u) - places_[at(v)]) < close * close)
      merge(u, root(v));
  }
}

/// 1 - cosine of the turn of the rim at the start of e, edges without length left out; 0 if nothing else is left.
double VertexMoves::turn_at(HalfEdge e) const {
  const auto along = [&](HalfEdge f) { return places_[at(mesh_.target(f))] - places_[at(mesh_.origin(f))]; };
  HalfEdge ahead = e, behind = rim_.previous(e);
  while (along(ahead) == Vec2{})
    if (ahead = rim_.next(ahead); ahead == e)
      return 0;
  while (along(behind) == Vec2{})
    behind = rim_.previous(behind);
  const Vec2 in = along(behind), out = along(ahead);
  return 1 - dot(in, out) / std::sqrt(squared_length(in) * squared_length(out));
}

void VertexMoves::merge_close_corners() {
  for (HalfEdge e = 0; e < 3 * mesh_.triangle_count(); ++e) {
    if (!rim_.holds(e))
      continue;
    const LocalIndex v = root(mesh_.origin(e)), u = root(mesh_.target(e));
    const double close = GeneraliseRules::close_corners * std::fmin(map_.size(u), map_.size(v));
    if (u == v || !(squared_length(places_[at(u)] - places_[at(v)]) < close * close))
      continue;
    const double at_v = turn_at(e), at_u = turn_at(rim_.next(e));
    if (std::fmin(at_v, at_u) < GeneraliseRules::corner_turn)
      continue;
    const bool moves_u = map_.is_kept(v) || (!map_.is_kept(u) && at_u < at_v);
    if (const LocalIndex mover = moves_u ? u : v; !map_.is_kept(mover) && is_alone(mover) && leaves_a_loop(e))
      merge(mover, moves_u ? v : u);
  }
}

/// Has the loop of the half-edge e on the rim two more places than the ends of e?
bool VertexMoves::leaves_a_loop(HalfEdge e) const {
  const Vec2 a = places_[at(mesh_.origin(e))], b = places_[at(mesh_.target(e))];
  std::optional<Vec2> third;
  for (HalfEdge f = rim_.next(e); f != e; f = rim_.next(f)) {
    const Vec2 p = places_[at(mesh_.target(f))];
    if (p == a || p == b)
      continue;
    if (third && *third != p)
      return true;
    third = p;
  }
  return false;
}

/// Moves u to the place of v, if no triangle turns over.
void VertexMoves::merge(LocalIndex u, LocalIndex v) {
  const Vec2 old = places_[at(u)];
  places_[at(u)] = places_[at(v)];
  root_[at(u)] = root_[at(v)];
  is_root_[at(v)] = 1;
  const HalfEdge first = mesh_.leaving(u);
  HalfEdge e = first;
  do {
    if (turns_over(Triangulation::triangle(e))) {
      places_[at(u)] = old;
      root_[at(u)] = u;
      return;
    }
    e = mesh_.around(e);
  } while (e != first);
  any_ = true;
}

double VertexMoves::largest_share() const {
  double largest = 0;
  for (LocalIndex v = 4; v < mesh_.vertex_count(); ++v)
    if (places_[at(v)] != mesh_.point(v))
      largest = std::fmax(largest, length(places_[at(v)] - mesh_.point(v)) / map_.size(v));
  return largest;
}

} // namespace trime::generalise
