// SPDX-License-Identifier: BSD-3-Clause
#include "contours/segment_faces.hpp"

#include "geometry/predicates.hpp"

#include <algorithm>
#include <numeric>

namespace trime::contours {

using geometry::Vec2;

SegmentFaces::SegmentFaces(const std::vector<FileVertex>& vertices, const std::vector<FileSegment>& segments)
    : vertices_(vertices), segments_(segments), cycle_(2 * segments.size(), nowhere) {
  link();
  for (std::size_t first = 0; first < cycle_.size(); ++first)
    if (cycle_[first] == nowhere)
      add_cycle(first);
  find_faces();
}

/// Sorts the half-edges around each vertex.
void SegmentFaces::link() {
  std::vector<std::size_t> order(cycle_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto is_lower = [this](std::size_t half) {
    const Vec2 from = place(half), to = place(half ^ 1);
    return to.y < from.y || (to.y == from.y && to.x < from.x);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (origin(a) != origin(b))
      return origin(a) < origin(b);
    if (is_lower(a) != is_lower(b))
      return is_lower(b);
    const int turn = geometry::orient2d(place(a), place(a ^ 1), place(b ^ 1));
    return turn != 0 ? turn > 0 : a < b;
  });
  before_.resize(cycle_.size());
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && origin(order[end]) == origin(order[first]))
      ++end;
    for (std::size_t k = first; k < end; ++k)
      before_[order[k]] = order[k == first ? end - 1 : k - 1];
  }
}

void SegmentFaces::add_cycle(std::size_t first) {
  RingVertices cycle;
  double twice = 0;
  for (std::size_t half = first; cycle_[half] == nowhere; half = before_[half ^ 1]) {
    cycle_[half] = cycles_.size();
    cycle.push_back({place(half), 0, 0});
    twice += geometry::cross(place(half) - place(first), place(half ^ 1) - place(first));
  }
  areas_.push_back(twice / 2);
  cycles_.push_back(std::move(cycle));
}

void SegmentFaces::find_faces() {
  face_.assign(cycles_.size(), nowhere);
  for (std::size_t c = 0; c < cycles_.size(); ++c)
    if (areas_[c] > 0) {
      face_[c] = bounded_.size();
      bounded_.push_back(cycles_[c]);
    }
  const Nesting nesting(bounded_);
  for (std::size_t c = 0; c < cycles_.size(); ++c) {
    constexpr double rounding = 1 + 1e-9; // the area inside of the same segments is not larger
    if (face_[c] == nowhere)
      face_[c] = nesting.around(cycles_[c][0].position, -rounding * areas_[c]);
  }
  halves_.resize(bounded_.size());
  for (std::size_t half = 0; half < cycle_.size(); ++half)
    if (const std::size_t face = face_[cycle_[half]]; face != nowhere)
      halves_[face].push_back(half);
}

std::vector<std::size_t> SegmentFaces::around(const std::vector<FilePoint>& points) const {
  const Nesting nesting(bounded_);
  std::vector<std::size_t> faces;
  for (const FilePoint& point : points)
    faces.push_back(nesting.around(point.position, 0));
  return faces;
}

std::vector<char> SegmentFaces::material(const std::vector<FilePoint>& holes) const {
  std::vector<char> is_hole(bounded_.size(), 0);
  for (const std::size_t face : around(holes))
    if (face != nowhere)
      is_hole[face] = 1;
  std::vector<char> on_left;
  for (const std::size_t cycle : cycle_)
    on_left.push_back(face_[cycle] != nowhere && is_hole[face_[cycle]] == 0 ? 1 : 0);
  return on_left;
}

std::vector<FileSegment> SegmentFaces::border(std::size_t face) const {
  std::vector<FileSegment> segments;
  for (const std::size_t half : halves_[face])
    if (face_[cycle_[half ^ 1]] != face)
      segments.push_back(segments_[half / 2]);
  return segments;
}

} // namespace trime::contours
