// SPDX-License-Identifier: BSD-3-Clause
#include "trime/geometry/piece_tree.hpp"

#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace trime::geometry {
namespace {

/// In a periodic container no piece leads out of one image of it: the image that holds the middle becomes canonical.
Piece wrapped(Piece piece, const Periods& periods) {
  const Vec2 middle = 0.5 * (piece.start + piece.end), shift = periods.wrap(middle) - middle;
  piece.start = piece.start + shift;
  piece.end = piece.end + shift;
  piece.center = piece.center + shift;
  return piece;
}

} // namespace

PieceTree::PieceTree(const Boundary& boundary) : periods_(boundary.periods) {
  std::size_t count = 0;
  bool has_arcs = false;
  for (const Loop& loop : boundary.loops) {
    count += loop.pieces.size();
    has_arcs =
        has_arcs || std::any_of(loop.pieces.begin(), loop.pieces.end(), [](const Piece& p) { return p.circular; });
  }
  ends_.reserve(count);
  std::vector<Box> runs;
  runs.reserve((count + run_length - 1) / run_length);
  for (const Loop& loop : boundary.loops)
    for (const Piece& unrolled : loop.pieces) {
      const Piece piece = periods_.any() ? wrapped(unrolled, periods_) : unrolled;
      if (ends_.size() % run_length == 0)
        runs.emplace_back();
      const Box box = piece.covering_box();
      runs.back().include(box.min);
      runs.back().include(box.max);
      ends_.push_back({piece.start, piece.end});
      if (has_arcs)
        arc_of_.push_back(piece.circular ? static_cast<LocalIndex>(arcs_.size()) : -1);
      if (piece.circular)
        arcs_.push_back(piece);
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

double PieceTree::squared_distance_of(std::size_t piece, Vec2 p) const {
  const LocalIndex arc = arc_of_.empty() ? -1 : arc_of_[piece];
  if (arc < 0)
    return squared_distance(p, {ends_[piece].a, ends_[piece].b});
  const double distance = arcs_[at(arc)].distance(p);
  return distance * distance;
}

/// Within this file Nearest::distance is squared.
void PieceTree::look_at_run(std::size_t run, Vec2 p, Nearest& best) const {
  const std::size_t last = std::min(ends_.size(), (run + 1) * run_length);
  for (std::size_t k = run * run_length; k < last; ++k)
    if (const double squared = squared_distance_of(k, p); squared < best.distance)
      best = {squared, k};
}

/// Pieces lie in the container, the nearest is at most half a period away: one image to each side is enough.
template <class Visit>
void PieceTree::for_each_image(Vec2 p, const Visit& visit) const {
  const Vec2 canonical = periods_.any() ? periods_.wrap(p) : p;
  for (const int i : {0, -1, 1})
    for (const int j : {0, -1, 1})
      if ((i == 0 || periods_.x > 0) && (j == 0 || periods_.y > 0))
        visit(canonical + Vec2{i * periods_.x, j * periods_.y});
}

PieceTree::Nearest PieceTree::nearest(Vec2 p) const {
  Nearest best{std::numeric_limits<double>::infinity(), 0};
  if (ends_.empty())
    return best;
  for_each_image(p, [&](Vec2 image) { search(image, best); });
  best.distance = std::sqrt(best.distance);
  return best;
}

std::vector<std::size_t> PieceTree::within(Vec2 p, double distance) const {
  std::vector<std::size_t> found;
  if (ends_.empty())
    return found;
  const double squared = distance * distance;
  const std::size_t leaves = boxes_.size() / 2;
  std::vector<std::size_t> open;
  for_each_image(p, [&](Vec2 image) {
    open.push_back(1);
    while (!open.empty()) {
      const std::size_t node = open.back();
      open.pop_back();
      if (!(boxes_[node].squared_distance(image) <= squared))
        continue;
      if (node < leaves) {
        open.insert(open.end(), {2 * node, 2 * node + 1});
        continue;
      }
      const std::size_t first = (node - leaves) * run_length, last = std::min(ends_.size(), first + run_length);
      for (std::size_t k = first; k < last; ++k)
        if (squared_distance_of(k, image) <= squared)
          found.push_back(k);
    }
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// Goes over to the nearest piece to p if that is nearer than `best`.
void PieceTree::search(Vec2 p, Nearest& best) const {
  struct Entry {
    std::size_t node;
    double squared_distance;
  };
  std::array<Entry, 64> stack; // deeper than any tree in memory
  const std::size_t leaves = boxes_.size() / 2;
  std::size_t size = 0;
  stack[size++] = {1, boxes_[1].squared_distance(p)};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.squared_distance >= best.distance)
      continue;
    if (entry.node >= leaves) {
      look_at_run(entry.node - leaves, p, best);
      continue;
    }
    Entry near{2 * entry.node, boxes_[2 * entry.node].squared_distance(p)};
    Entry far{2 * entry.node + 1, boxes_[2 * entry.node + 1].squared_distance(p)};
    if (far.squared_distance < near.squared_distance)
      std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
}

} // namespace trime::geometry
