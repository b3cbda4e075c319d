// SPDX-License-Identifier: BSD-3-Clause
#include "shape/vertex_table.hpp"

#include "core/random.hpp"

#include <cmath>

namespace trime::shape {
namespace {

using geometry::Lattice;
using geometry::squared_length;
using geometry::Vec2;
constexpr double cell_steps = 0x1p7; // a few times merge_steps: crowded vertices share no cell, most searches see one
} // namespace

struct VertexMatch {
  LocalIndex vertex;
  double squared_distance;
};

VertexTable::VertexTable(const Lattice& lattice, std::size_t expected) : lattice_(lattice) {
  std::size_t slots = 64;
  while (slots < expected)
    slots *= 2;
  heads_.assign(slots, -1);
  points_.reserve(expected);
  owners_.reserve(expected);
  next_.reserve(expected);
}

VertexTable::Cell VertexTable::cell_of(Vec2 p) const {
  const double inverse = lattice_.inverse_step() / cell_steps;
  return {static_cast<std::int64_t>(std::floor(p.x * inverse)), static_cast<std::int64_t>(std::floor(p.y * inverse))};
}

std::size_t VertexTable::slot_of(Cell cell) const {
  return mix_bits(mix_bits(static_cast<std::uint64_t>(cell.i)) ^ static_cast<std::uint64_t>(cell.j)) &
         (heads_.size() - 1);
}

void VertexTable::find_in(Cell cell, Vec2 p, int owner, VertexMatch& best) const {
  // Vertices of other cells may share the slot: the distance sorts them out.
  for (LocalIndex v = heads_[slot_of(cell)]; v >= 0; v = next_[v]) {
    const double distance = squared_length(points_[v] - p);
    const bool may_merge = distance == 0 || owner == nobody || owners_[v] != owner;
    if (may_merge && (distance < best.squared_distance || (distance == best.squared_distance && v < best.vertex)))
      best = {v, distance};
  }
}

LocalIndex VertexTable::insert(Vec2 p, int owner) {
  const double reach = merge_steps * lattice_.step();
  const Cell low = cell_of(p - Vec2{reach, reach}), high = cell_of(p + Vec2{reach, reach});
  const LocalIndex fresh = size();
  VertexMatch best{fresh, reach * reach};
  for (std::int64_t j = low.j; j <= high.j; ++j)
    for (std::int64_t i = low.i; i <= high.i; ++i)
      find_in({i, j}, p, owner, best);
  if (best.vertex < fresh) {
    if (owners_[best.vertex] != owner)
      owners_[best.vertex] = shared;
    return best.vertex;
  }
  points_.push_back(p);
  owners_.push_back(owner == nobody ? shared : owner);
  next_.push_back(-1);
  if (points_.size() > heads_.size())
    grow();
  else
    link(fresh);
  return fresh;
}

void VertexTable::forget_search() {
  owners_ = {};
  next_ = {};
  heads_ = {};
}

void VertexTable::link(LocalIndex v) {
  LocalIndex& head = heads_[slot_of(cell_of(points_[v]))];
  next_[v] = head;
  head = v;
}

void VertexTable::grow() {
  heads_.assign(2 * heads_.size(), -1);
  for (LocalIndex v = 0; v < size(); ++v)
    link(v);
}

using geometry::Frame;
using geometry::Periods;
using geometry::Vec2;

Quotient::Quotient(const VertexTable& vertices, const std::vector<LocalIndex>& used, const Frame& frame)
    : vertices_(vertices), periodic_(frame.periods().any()), nodes_(frame.lattice(), periodic_ ? used.size() : 0) {
  if (!periodic_)
    return;
  node_.assign(vertices.size(), -1);
  shift_.assign(vertices.size(), {});
  const Periods& periods = frame.periods();
  const double zone = 4 * VertexTable::merge_steps * frame.step();
  for (const LocalIndex v : used) {
    const Vec2 p = vertices.point(v);
    if (periods.x > 0 && p.x > frame.inner().max.x - zone)
      shift_[v].x = periods.x;
    if (periods.y > 0 && p.y > frame.inner().max.y - zone)
      shift_[v].y = periods.y;
    if (shift_[v] == Vec2{})
      node_[v] = nodes_.insert(p, 0); // one owner: only equal ones merge
  }
  for (const LocalIndex v : used)
    if (shift_[v] != Vec2{})
      node_[v] = nodes_.insert(vertices.point(v) - shift_[v], VertexTable::nobody);
}

} // namespace trime::shape
