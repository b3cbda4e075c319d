// SPDX-License-Identifier: BSD-3-Clause
#include "contours/inner_lines.hpp"

#include "contours/segment_faces.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace trime::contours {
namespace {

using geometry::Vec2;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

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
  const std::vector<char> on_left = SegmentFaces(vertices, segments).material(holes);
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
