// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/piece_locator.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace trime::sizing {

using geometry::Box;
using geometry::Piece;
using geometry::Vec2;

namespace {

Vec2 nearest_on_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double along = dot(p - a, d), whole = squared_length(d);
  return along <= 0 ? a : along >= whole ? b : a + (along / whole) * d;
}

Vec2 nearest_on_arc(Vec2 p, const Piece& arc) {
  const Vec2 q = p - arc.center;
  const double from_center = geometry::length(q);
  if (from_center > 0 && arc.distance(p) == std::fabs(from_center - arc.radius))
    return arc.center + (arc.radius / from_center) * q;
  return squared_length(p - arc.start) <= squared_length(p - arc.end) ? arc.start : arc.end;
}

} // namespace

PieceLocator::PieceLocator(const geometry::Boundary& boundary, const Images& images) {
  std::vector<Box> runs;
  for (const geometry::Loop& loop : boundary.loops)
    for (const Piece& piece : loop.pieces)
      if (piece.circular)
        arcs_.push_back(piece);
  for (const Vec2 shift : images.shifts()) {
    LocalIndex arc = 0;
    for (const geometry::Loop& loop : boundary.loops)
      for (const Piece& piece : loop.pieces) {
        const LocalIndex index = piece.circular ? arc++ : -1;
        Box box = piece.covering_box();
        box = {box.min + shift, box.max + shift};
        if (!images.in_reach(box))
          continue;
        if (items_.size() % run_length == 0)
          runs.emplace_back();
        runs.back().include(box.min);
        runs.back().include(box.max);
        items_.push_back({piece.start + shift, piece.end + shift, shift, index});
      }
  }
  std::size_t leaves = 1;
  while (leaves < runs.size())
    leaves *= 2;
  boxes_.resize(2 * leaves);
  std::copy(runs.begin(), runs.end(), boxes_.begin() + static_cast<std::ptrdiff_t>(leaves));
  for (std::size_t k = leaves - 1; k >= 1; --k)
    for (const Box& child : {boxes_[2 * k], boxes_[2 * k + 1]})
      if (child.min.x <= child.max.x) {
        boxes_[k].include(child.min);
        boxes_[k].include(child.max);
      }
}

void PieceLocator::visit(std::size_t run, Vec2 p, Best& best) const {
  const std::size_t last = std::min(items_.size(), (run + 1) * run_length);
  for (std::size_t k = run * run_length; k < last; ++k) {
    const Item& item = items_[k];
    const Vec2 point = item.arc < 0 ? nearest_on_segment(p, item.a, item.b)
                                    : nearest_on_arc(p - item.shift, arcs_[item.arc]) + item.shift;
    const double distance = squared_length(point - p);
    if (distance < best.squared_distance)
      best = {point, distance};
  }
}

std::optional<Vec2> PieceLocator::nearest(Vec2 p, double reach) const {
  struct Entry {
    std::size_t node;
    double squared_distance;
  };
  std::array<Entry, 64> stack; // deeper than any tree in memory
  const std::size_t leaves = boxes_.size() / 2;
  Best best{{}, reach * reach};
  std::size_t size = 0;
  stack[size++] = {1, 0.0};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.squared_distance * (1 + 2 * slack) >= best.squared_distance)
      continue;
    if (entry.node >= leaves) {
      visit(entry.node - leaves, p, best);
      continue;
    }
    Entry near{2 * entry.node, boxes_[2 * entry.node].squared_distance(p)};
    Entry far{2 * entry.node + 1, boxes_[2 * entry.node + 1].squared_distance(p)};
    if (far.squared_distance < near.squared_distance)
      std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
  return best.squared_distance < reach * reach ? std::optional(best.point) : std::nullopt;
}

} // namespace trime::sizing
