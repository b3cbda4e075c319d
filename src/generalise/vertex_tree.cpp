// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/vertex_tree.hpp"

#include "core/hilbert.hpp"
#include "generalise/rules.hpp"
#include "geometry/predicates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace trime::generalise {
namespace {

using geometry::Box;
using geometry::Vec2;

constexpr LocalIndex run_length = 8; // vertices
constexpr std::size_t fan = 4;       // boxes in a box

/// A triangle, counter-clockwise or without area.
struct ClosedTriangle {
  std::array<LocalIndex, 3> vertices; // -1: all vertices at the corners are left out
  std::array<Vec2, 3> at;
  Box box;

  bool has(LocalIndex vertex) const { return vertex == vertices[0] || vertex == vertices[1] || vertex == vertices[2]; }
  bool holds(Vec2 p) const {
    if (vertices[0] < 0 && (p == at[0] || p == at[1] || p == at[2]))
      return false;
    return box.contains(p) && geometry::orient2d(at[0], at[1], p) >= 0 && geometry::orient2d(at[1], at[2], p) >= 0 &&
           geometry::orient2d(at[2], at[0], p) >= 0;
  }
  /// Returns false only if no point of the box lies in the triangle: the differences of lattice points are exact, and
  /// rounding is monotone.
  bool may_meet(const Box& other) const {
    if (other.min.x > box.max.x || other.max.x < box.min.x || other.min.y > box.max.y || other.max.y < box.min.y)
      return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 p = at[k], d = at[(k + 1) % 3] - p;
      const Vec2 farthest{d.y > 0 ? other.min.x : other.max.x, d.x > 0 ? other.max.y : other.min.y};
      if (d.x * (farthest.y - p.y) < d.y * (farthest.x - p.x))
        return false;
    }
    return true;
  }
};

} // namespace

VertexTree::VertexTree(const geometry::Boundary& boundary, const geometry::Lattice& lattice,
                       std::span<const Vec2> points)
    : lattice_(lattice) {
  for (const geometry::Loop& loop : boundary.loops)
    add_loop(loop, lattice);
  first_of_loop_.push_back(static_cast<LocalIndex>(points_.size()));
  for (const Vec2 p : points) {
    runs_.push_back({static_cast<LocalIndex>(points_.size()), static_cast<LocalIndex>(points_.size()) + 1});
    add(p, false);
  }
  if (!runs_.empty()) {
    sort_runs();
    build_levels();
  }
}

void VertexTree::add(Vec2 p, bool starts_piece) {
  points_.push_back(p);
  is_left_.push_back(1);
  starts_piece_.push_back(starts_piece);
}

void VertexTree::add_loop(const geometry::Loop& loop, const geometry::Lattice& lattice) {
  const auto first = static_cast<LocalIndex>(points_.size());
  first_of_loop_.push_back(first);
  for (const geometry::Piece& piece : loop.pieces) {
    add(piece.start, true);
    if (!piece.circular)
      continue;
    const double whole = piece.length(), parts = std::ceil(std::fabs(piece.sweep) / GeneraliseRules::arc_step);
    for (double part = 1; part < parts; ++part)
      add(lattice.snap(piece.point(whole * part / parts)), false);
  }
  const auto end = static_cast<LocalIndex>(points_.size());
  for (LocalIndex begin = first; begin < end; begin += run_length)
    runs_.push_back({begin, std::min(end, begin + run_length)});
}

/// Sorts the runs by where they begin, since loops near each other may be far apart in the list.
void VertexTree::sort_runs() {
  Box box;
  for (const Vec2 p : points_)
    box.include(p);
  if (box.width() == 0 && box.height() == 0)
    return; // one place
  constexpr int level = 20;
  const double scale = std::ldexp(0.999, level) / std::fmax(box.width(), box.height());
  std::vector<std::pair<std::uint64_t, Run>> order;
  order.reserve(runs_.size());
  for (const Run& run : runs_) {
    const Vec2 p = points_[at(run.begin)] - box.min;
    order.emplace_back(
        hilbert_key(static_cast<std::uint32_t>(p.x * scale), static_cast<std::uint32_t>(p.y * scale), level), run);
  }
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first, a.second.begin) < std::pair(b.first, b.second.begin);
  });
  for (std::size_t k = 0; k < order.size(); ++k)
    runs_[k] = order[k].second;
}

void VertexTree::build_levels() {
  std::vector<Box> boxes;
  for (const Run& run : runs_) {
    Box box;
    for (LocalIndex v = run.begin; v < run.end; ++v)
      box.include(points_[at(v)]);
    boxes.push_back(box);
  }
  levels_.push_back(std::move(boxes));
  while (levels_.back().size() > 1) {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> above((below.size() + fan - 1) / fan);
    for (std::size_t k = 0; k < below.size(); ++k) {
      above[k / fan].include(below[k].min);
      above[k / fan].include(below[k].max);
    }
    levels_.push_back(std::move(above));
  }
}

std::vector<LocalIndex> VertexTree::starts_of_loop(std::size_t loop) const {
  std::vector<LocalIndex> starts;
  for (LocalIndex v = first_of_loop_[loop]; v < first_of_loop_[loop + 1]; ++v)
    if (starts_piece_[at(v)])
      starts.push_back(v);
  return starts;
}

template <class Triangle>
bool VertexTree::holds_any(std::size_t level, std::size_t node, const Triangle& triangle) const {
  if (!triangle.may_meet(levels_[level][node]))
    return false;
  if (level == 0) {
    for (LocalIndex v = runs_[node].begin; v < runs_[node].end; ++v)
      if (is_left_[at(v)] && !triangle.has(v) && triangle.holds(points_[at(v)]))
        return true;
    return false;
  }
  const std::size_t end = std::min(levels_[level - 1].size(), (node + 1) * fan);
  for (std::size_t below = node * fan; below < end; ++below)
    if (holds_any(level - 1, below, triangle))
      return true;
  return false;
}

bool VertexTree::is_empty(std::array<LocalIndex, 3> corners) const {
  return is_empty(corners, {points_[at(corners[0])], points_[at(corners[1])], points_[at(corners[2])]});
}

bool VertexTree::has_room(const geometry::Segment& segment, LocalIndex from, double height) {
  const Vec2 along = segment.b - segment.a, away = points_[at(from)] - segment.a, across{-along.y, along.x};
  const double share = std::clamp(dot(away, along) / squared_length(along), 0.0, 1.0),
               side = cross(along, away) > 0 ? -1 : 1;
  const Vec2 beyond = segment.a + share * along + (side * height / geometry::length(along)) * across;
  remove(from); // it may lie on the segment
  const bool is_empty = is_empty_at({segment.a, lattice_.snap(beyond), segment.b});
  restore(from);
  return is_empty;
}

bool VertexTree::is_empty_at(std::array<Vec2, 3> corners) const {
  return is_empty({-1, -1, -1}, corners);
}

bool VertexTree::is_empty(std::array<LocalIndex, 3> corners, std::array<Vec2, 3> places) const {
  if (geometry::orient2d(places[0], places[1], places[2]) < 0)
    std::swap(places[0], places[1]);
  ClosedTriangle triangle{corners, places, {}};
  for (const Vec2 p : places)
    triangle.box.include(p);
  return !holds_any(levels_.size() - 1, 0, triangle);
}

} // namespace trime::generalise
