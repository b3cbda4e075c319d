// SPDX-License-Identifier: BSD-3-Clause
#include "contours/ring_nesting.hpp"

#include "geometry/box_tree.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace trime::contours {
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

/// The edges of a ring, to find those right of a point.
class RingEdges {
public:
  explicit RingEdges(const Ring& ring) : ring_(ring) {
    std::vector<Box> boxes;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      Box& box = boxes.emplace_back();
      box.include(ring[k].position);
      box.include(ring[(k + 1) % ring.size()].position);
      whole_ = geometry::united(whole_, box);
    }
    tree_ = geometry::BoxTree(boxes);
  }

  /// Does the ring run around p? O(log(edges) + those right of p).
  bool enclose(Vec2 p) const {
    const double rounding = 1e-12 * std::fmax(std::fabs(whole_.min.x), std::fabs(whole_.max.x));
    bool inside = false;
    tree_.for_each_meeting({{p.x - rounding, p.y}, {whole_.max.x, p.y}}, [&](std::size_t k) {
      const Vec2 a = ring_[k].position, b = ring_[(k + 1) % ring_.size()].position;
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y)))
        inside = !inside;
    });
    return inside;
  }
  const Box& box() const { return whole_; }

private:
  const Ring& ring_;
  Box whole_;
  geometry::BoxTree tree_;
};

class Nesting {
public:
  explicit Nesting(const std::vector<Ring>& rings) : rings_(rings), areas_(rings.size()), rank_(rings.size()) {
    std::vector<Box> boxes;
    for (std::size_t k = 0; k < rings.size(); ++k) {
      edges_.emplace_back(rings[k]);
      boxes.push_back(edges_.back().box());
      areas_[k] = area_of(rings[k]);
    }
    tree_ = geometry::BoxTree(boxes);
    std::vector<std::size_t> by_area(rings.size());
    std::iota(by_area.begin(), by_area.end(), std::size_t{0});
    std::stable_sort(by_area.begin(), by_area.end(),
                     [this](std::size_t a, std::size_t b) { return areas_[a] < areas_[b]; });
    for (std::size_t k = 0; k < by_area.size(); ++k)
      rank_[by_area[k]] = k;
  }

  /// The smallest ring around p that is larger than `above`.
  std::size_t around(Vec2 p, double above) const {
    std::size_t smallest = nowhere;
    tree_.for_each_meeting({p, p}, [&](std::size_t k) {
      if (areas_[k] > above && (smallest == nowhere || rank_[k] < rank_[smallest]) && edges_[k].enclose(p))
        smallest = k;
    });
    return smallest;
  }
  /// The smallest ring around ring k. Rings may meet in vertices, so the middle of an edge is asked.
  std::size_t around(std::size_t k) const {
    return around(0.5 * (rings_[k][0].position + rings_[k][1].position), areas_[k]);
  }

private:
  const std::vector<Ring>& rings_;
  std::vector<RingEdges> edges_;
  std::vector<double> areas_;
  std::vector<std::size_t> rank_; // by area
  geometry::BoxTree tree_;        // of the boxes of the rings
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
      warnings.push_back(fmt::format("{}:{}: the hole point ({}, {}) lies outside all rings and is ignored", source,
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
    warnings.push_back(fmt::format("{}:{}: {} ring{} no hole point inside (the first one begins here), so both sides "
                                   "are meshed. Lines inside the shape are not kept: to make a hole, add a hole point",
                                   source, rings[first][0].line, inner, inner == 1 ? " has" : "s have"));
  return kept;
}

} // namespace trime::contours
