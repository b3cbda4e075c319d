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

Vec2 nearest_on_arc(Vec2 p, const Piece& arc) {
  const Vec2 q = p - arc.center;
  const double from_center = geometry::length(q);
  if (from_center > 0 && arc.distance(p) == std::fabs(from_center - arc.radius))
    return arc.center + (arc.radius / from_center) * q;
  return squared_length(p - arc.start) <= squared_length(p - arc.end) ? arc.start : arc.end;
}

} // namespace

PieceLocator::PieceLocator(const geometry::Boundary& boundary, const Images& images) {
  std::vector<Box> boxes;
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
        boxes.push_back(box);
        items_.push_back({piece.start + shift, piece.end + shift, shift, index});
      }
  }
  for (std::size_t first = 0; first < items_.size(); first += BoxTree::width)
    add_run(first);
  tree_ = BoxTree(
      items_.size(), [&](std::size_t k) { return boxes[k]; }, [](std::size_t) { return 0.0; });
}

void PieceLocator::add_run(std::size_t first) {
  Run run{};
  run.a_x.fill(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t k = first; k < std::min(items_.size(), first + BoxTree::width); ++k) {
    const Item& item = items_[k];
    if (item.arc >= 0) {
      run.has_arcs = true;
      continue;
    }
    const Vec2 d = item.b - item.a;
    const double square = squared_length(d);
    run.a_x[k - first] = item.a.x;
    run.a_y[k - first] = item.a.y;
    run.d_x[k - first] = d.x;
    run.d_y[k - first] = d.y;
    run.inverse_square[k - first] = square > 0 ? 1 / square : 0;
  }
  runs_.push_back(run);
}

void PieceLocator::visit(std::size_t first, std::size_t last, Vec2 p, Best& best) const {
  using Lanes = BoxTree::Lanes;
  const Run& run = runs_[first / BoxTree::width];
  for (std::size_t k = 0; k < BoxTree::width; k += 2) {
    const Lanes a_x = BoxTree::load(run.a_x, k), a_y = BoxTree::load(run.a_y, k);
    const Lanes d_x = BoxTree::load(run.d_x, k), d_y = BoxTree::load(run.d_y, k);
    const Lanes along = ((p.x - a_x) * d_x + (p.y - a_y) * d_y) * BoxTree::load(run.inverse_square, k);
    const Lanes positive = along > 0 ? along : Lanes{}, t = positive < 1 ? positive : Lanes{} + 1;
    const Lanes x = a_x + t * d_x, y = a_y + t * d_y;
    const Lanes squared = (x - p.x) * (x - p.x) + (y - p.y) * (y - p.y);
    if (lanes::bits(squared < best.squared_distance) == 0)
      continue;
    for (int lane = 0; lane < 2; ++lane)
      if (squared[lane] < best.squared_distance)
        best = {{x[lane], y[lane]}, squared[lane]};
  }
  if (!run.has_arcs)
    return;
  for (std::size_t k = first; k < last; ++k) {
    const Item& item = items_[k];
    if (item.arc < 0)
      continue;
    const Vec2 point = nearest_on_arc(p - item.shift, arcs_[item.arc]) + item.shift;
    const double distance = squared_length(point - p);
    if (distance < best.squared_distance)
      best = {point, distance};
  }
}

std::optional<Vec2> PieceLocator::nearest(Vec2 p, double reach) const {
  Best best{{}, reach * reach};
  tree_.search(
      p, [&](BoxTree::Lanes) { return BoxTree::Lanes{} + best.squared_distance * (1 / (1 + 2 * slack)); },
      [&](std::size_t first, std::size_t last) { visit(first, last, p, best); });
  return best.squared_distance < reach * reach ? std::optional(best.point) : std::nullopt;
}

} // namespace trime::sizing
