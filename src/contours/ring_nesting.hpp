// SPDX-License-Identifier: BSD-3-Clause
// Finds which of many rings lie around a point or another ring.
#pragma once

#include "contours/segment_rings.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/even_odd.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace trime::contours {

using RingVertices = std::vector<RingVertex>;

/// Returns the area of a ring, positive for both orientations.
inline double area_of(const RingVertices& ring) {
  double twice = 0;
  for (std::size_t k = 0; k < ring.size(); ++k)
    twice +=
        geometry::cross(ring[k].position - ring[0].position, ring[(k + 1) % ring.size()].position - ring[0].position);
  return std::fabs(twice) / 2;
}

/// The edges of a ring, to find those right of a point.
class RingEdges {
public:
  explicit RingEdges(const RingVertices& ring) : ring_(ring) {
    std::vector<geometry::Box> boxes;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      geometry::Box& box = boxes.emplace_back();
      box.include(ring[k].position);
      box.include(ring[(k + 1) % ring.size()].position);
      whole_ = geometry::united(whole_, box);
    }
    tree_ = geometry::BoxTree(boxes);
  }

  /// Returns whether the ring runs around p. O(log(edges) + those right of p).
  bool enclose(geometry::Vec2 p) const {
    bool inside = false;
    tree_.for_each_meeting({p, {whole_.max.x, p.y}}, [&](std::size_t k) {
      inside = inside != geometry::crosses_ray(ring_[k].position, ring_[(k + 1) % ring_.size()].position, p);
    });
    return inside;
  }
  const geometry::Box& box() const { return whole_; }

private:
  const RingVertices& ring_;
  geometry::Box whole_;
  geometry::BoxTree tree_;
};

/// Rings by the area that they enclose. The rings must outlive this object.
class Nesting {
public:
  static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

  explicit Nesting(const std::vector<RingVertices>& rings) : rings_(rings), areas_(rings.size()), rank_(rings.size()) {
    std::vector<geometry::Box> boxes;
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

  /// Returns the index of the smallest ring around p whose area is larger than `above`, or `nowhere`.
  std::size_t around(geometry::Vec2 p, double above) const {
    std::size_t smallest = nowhere;
    tree_.for_each_meeting({p, p}, [&](std::size_t k) {
      if (areas_[k] > above && (smallest == nowhere || rank_[k] < rank_[smallest]) && edges_[k].enclose(p))
        smallest = k;
    });
    return smallest;
  }
  /// Returns the smallest ring around ring k. Rings may meet in vertices, so the middle of an edge is asked.
  std::size_t around(std::size_t k) const {
    return around(0.5 * (rings_[k][0].position + rings_[k][1].position), areas_[k]);
  }

private:
  const std::vector<RingVertices>& rings_;
  std::vector<RingEdges> edges_;
  std::vector<double> areas_;
  std::vector<std::size_t> rank_; // by area
  geometry::BoxTree tree_;        // a tree of the boxes of the rings
};

} // namespace trime::contours
