// SPDX-License-Identifier: BSD-3-Clause
#include "shape/ring_nesting.hpp"

#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trime::shape {
namespace {

using geometry::Box;
using geometry::Vec2;
using Ring = std::vector<RingVertex>;

constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

double area_of(const Ring& ring) {
  double twice = 0;
  for (std::size_t k = 0; k < ring.size(); ++k)
    twice +=
        geometry::cross(ring[k].position - ring[0].position, ring[(k + 1) % ring.size()].position - ring[0].position);
  return std::fabs(twice) / 2;
}

bool encloses(const Ring& ring, Vec2 p) {
  bool inside = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec2 a = ring[k].position, b = ring[(k + 1) % ring.size()].position;
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y)))
      inside = !inside;
  }
  return inside;
}

class Nesting {
public:
  explicit Nesting(const std::vector<Ring>& rings) : rings_(rings), boxes_(rings.size()), areas_(rings.size()) {
    for (std::size_t k = 0; k < rings.size(); ++k) {
      for (const RingVertex& v : rings[k])
        boxes_[k].include(v.position);
      areas_[k] = area_of(rings[k]);
    }
    by_area_.resize(rings.size());
    std::iota(by_area_.begin(), by_area_.end(), std::size_t{0});
    std::stable_sort(by_area_.begin(), by_area_.end(),
                     [this](std::size_t a, std::size_t b) { return areas_[a] < areas_[b]; });
  }

  /// The smallest ring around p that is larger than `above`.
  std::size_t around(Vec2 p, double above) const {
    for (const std::size_t k : by_area_)
      if (areas_[k] > above && boxes_[k].contains(p) && encloses(rings_[k], p))
        return k;
    return nowhere;
  }
  /// The smallest ring around ring k. Rings may meet in vertices, so the middle of an edge is asked.
  std::size_t around(std::size_t k) const {
    return around(0.5 * (rings_[k][0].position + rings_[k][1].position), areas_[k]);
  }

private:
  const std::vector<Ring>& rings_;
  std::vector<Box> boxes_;
  std::vector<double> areas_;
  std::vector<std::size_t> by_area_;
};

} // namespace

std::vector<std::size_t> rings_around_material(const std::vector<Ring>& rings, const std::vector<FilePoint>& holes,
                                               const std::string& source, std::vector<std::string>& warnings) {
  const Nesting nesting(rings);
  std::vector<char> is_hole(rings.size(), 0); // right inside of each ring
  for (const FilePoint& hole : holes)
    if (const std::size_t ring = nesting.around(hole.position, 0); ring != nowhere)
      is_hole[ring] = 1;
    else
      warnings.push_back(fmt::format("{}:{}: the hole ({}, {}) lies outside of all rings; it means nothing", source,
                                     hole.line, hole.position.x, hole.position.y));
  std::vector<std::size_t> kept;
  std::size_t inner = 0, first = nowhere;
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const std::size_t parent = nesting.around(k);
    const bool outside_is_empty = parent == nowhere || is_hole[parent] != 0;
    if (outside_is_empty != (is_hole[k] != 0))
      kept.push_back(k);
    else if (!outside_is_empty && ++inner == 1)
      first = k;
  }
  if (inner > 0)
    warnings.push_back(fmt::format("{}:{}: {} ring{} no hole point inside, here first, so both sides are meshed; lines "
                                   "inside are not kept: to make a hole add a hole point",
                                   source, rings[first][0].line, inner, inner == 1 ? " has" : "s have"));
  return kept;
}

} // namespace trime::shape
