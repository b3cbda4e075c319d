// SPDX-License-Identifier: BSD-3-Clause
#include "shape/quotient.hpp"

namespace trime::shape {
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
