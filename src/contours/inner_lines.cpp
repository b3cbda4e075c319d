// SPDX-License-Identifier: BSD-3-Clause
#include "contours/inner_lines.hpp"

#include "contours/ring_nesting.hpp"
#include "geometry/predicates.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

namespace trime::contours {
namespace {

using geometry::Vec2;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// The faces between segments. Half-edge 2 k leads along segment k, half-edge 2 k + 1 back; the face of a half-edge
/// lies on its left.
class Faces {
public:
  Faces(const std::vector<FileVertex>& vertices, const std::vector<FileSegment>& segments)
      : vertices_(vertices), segments_(segments), face_(2 * segments.size(), nowhere) {
    link();
    for (std::size_t first = 0; first < face_.size(); ++first)
      if (face_[first] == nowhere)
        add_face(first);
  }

  /// Returns whether each half-edge has material on its left.
  std::vector<char> material(const std::vector<FilePoint>& holes) const {
    std::vector<RingVertices> bounded; // the faces with an area
    std::vector<std::size_t> index(cycles_.size(), nowhere);
    for (std::size_t f = 0; f < cycles_.size(); ++f)
      if (areas_[f] > 0) {
        index[f] = bounded.size();
        bounded.push_back(cycles_[f]);
      }
    const Nesting nesting(bounded);
    std::vector<char> is_hole(bounded.size(), 0);
    for (const FilePoint& hole : holes)
      if (const std::size_t face = nesting.around(hole.position, 0); face != nowhere)
        is_hole[face] = 1;
    std::vector<char> has_material(cycles_.size(), 0);
    for (std::size_t f = 0; f < cycles_.size(); ++f) {
      constexpr double rounding = 1 + 1e-9; // the area inside of the same segments is not larger
      const std::size_t face =
          index[f] != nowhere ? index[f] : nesting.around(cycles_[f][0].position, -rounding * areas_[f]);
      has_material[f] = face != nowhere && is_hole[face] == 0 ? 1 : 0;
    }
    std::vector<char> on_left;
    for (const std::size_t f : face_)
      on_left.push_back(has_material[f]);
    return on_left;
  }

private:
  static constexpr std::size_t nowhere = Nesting::nowhere;

  int origin(std::size_t half) const { return half % 2 == 0 ? segments_[half / 2].from : segments_[half / 2].to; }
  Vec2 place(std::size_t half) const { return vertices_[at(origin(half))].position; }

  /// Sorts the half-edges around each vertex.
  void link() {
    std::vector<std::size_t> order(face_.size());
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
    before_.resize(face_.size());
    for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
      while (end < order.size() && origin(order[end]) == origin(order[first]))
        ++end;
      for (std::size_t k = first; k < end; ++k)
        before_[order[k]] = order[k == first ? end - 1 : k - 1];
    }
  }

  void add_face(std::size_t first) {
    RingVertices cycle;
    double twice = 0;
    for (std::size_t half = first; face_[half] == nowhere; half = before_[half ^ 1]) {
      face_[half] = cycles_.size();
      cycle.push_back({place(half), 0, 0});
      twice += geometry::cross(place(half) - place(first), place(half ^ 1) - place(first));
    }
    areas_.push_back(twice / 2);
    cycles_.push_back(std::move(cycle));
  }

  const std::vector<FileVertex>& vertices_;
  const std::vector<FileSegment>& segments_;
  std::vector<std::size_t> before_; // the half-edge clockwise from each one, at the same vertex
  std::vector<std::size_t> face_;   // of each half-edge
  std::vector<RingVertices> cycles_;
  std::vector<double> areas_; // negative: the outside of segments that hang together
};

bool has_odd_vertex(std::size_t vertices, const std::vector<FileSegment>& segments) {
  std::vector<char> is_odd(vertices, 0);
  for (const FileSegment& s : segments)
    for (const int end : {s.from, s.to})
      is_odd[at(end)] ^= 1;
  return std::any_of(is_odd.begin(), is_odd.end(), [](char odd) { return odd != 0; });
}

} // namespace

void remove_inner_lines(const std::vector<FileVertex>& vertices, std::vector<FileSegment>& segments,
                        const std::vector<FilePoint>& holes, Contour& contour) {
  if (!has_odd_vertex(vertices.size(), segments))
    return;
  const std::vector<char> on_left = Faces(vertices, segments).material(holes);
  std::vector<FileSegment> kept;
  std::size_t first = segments.size();
  for (std::size_t k = 0; k < segments.size(); ++k)
    if (on_left[2 * k] != on_left[2 * k + 1])
      kept.push_back(segments[k]);
    else
      first = std::min(first, k);
  if (kept.empty())
    return;
  const std::size_t gone = segments.size() - kept.size();
  const FileSegment& named = segments[first];
  const Vec2 p = vertices[at(named.from)].position;
  contour.warnings.push_back(fmt::format(
      "{}:{}: {} segment{} inside the shape {} left out, because both sides are meshed (the first one begins "
      "at ({}, {})); only rings around the mesh and its holes are kept",
      contour.source, named.line, gone, gone == 1 ? "" : "s", gone == 1 ? "is" : "are", p.x, p.y));
  segments = std::move(kept);
}

} // namespace trime::contours
