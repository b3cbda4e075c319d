// SPDX-License-Identifier: BSD-3-Clause
// Shapes from the .poly files of Triangle.
#include "contours/faults.hpp"
#include "contours/inner_lines.hpp"
#include "contours/poly_file.hpp"
#include "contours/ring_nesting.hpp"
#include "contours/segment_rings.hpp"
#include "trime/contours/contour.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace trime::contours {
namespace {

using Ring = RingVertices;

constexpr std::size_t nowhere = Nesting::nowhere;

/// @brief Returns the rings with material on one side only, ascending: by even-odd nesting they enclose what all rings
/// enclose, except the areas right around a hole point. Others are left out; a warning lists those with material on
/// both sides, and hole points outside of all rings.
/// @pre rings do not cross. O(vertices) for each ring and hole within the boxes of others.
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
    warnings.push_back(
        fmt::format("{}:{}: {} ring{} no hole point inside (the first one begins here), so both sides "
                    "are meshed. To make a hole, add a hole point; to keep the lines, add [curve.NAME] with this file",
                    source, rings[first][0].line, inner, inner == 1 ? " has" : "s have"));
  return kept;
}

void tell_unused(const PolyFile& file, const std::string& source, std::vector<std::string>& warnings) {
  std::vector<char> used(file.vertices.size(), 0);
  for (const FileSegment& s : file.segments)
    used[static_cast<std::size_t>(s.from)] = used[static_cast<std::size_t>(s.to)] = 1;
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (const auto count = std::count(used.begin(), used.end(), 0); count > 0)
    warnings.push_back(
        fmt::format("{}:{}: {} on no segment, and {} ignored; list points that the mesh must keep in the "
                    "file of [meshing] fixed_points",
                    source, file.vertices[static_cast<std::size_t>(unused - used.begin())].line,
                    count == 1 ? "this vertex lies" : fmt::format("this vertex and {} more lie", count - 1),
                    count == 1 ? "is" : "are"));
}

/// Adds the rings around what the segments of the file enclose.
void add_rings(PolyFile& file, Contour& contour) {
  RingBuilder builder(contour);
  const std::vector<FileSegment> all = file.segments;
  remove_open_chains(file.vertices, file.segments, contour.source, contour.warnings);
  remove_inner_lines(file.vertices, file.segments, file.holes, contour);
  const auto rings = rings_of_segments(file.vertices, file.segments, contour.source, contour.warnings);
  const auto kept = rings_around_material(rings, file.holes, contour.source, contour.warnings);
  if (kept.empty()) // throws if a ring around a hole point is open: then the hole is all that the other rings enclose
    rings_of_segments(file.vertices, all, contour.source, contour.warnings);
  for (const std::size_t k : kept) {
    for (const RingVertex& v : rings[k])
      builder.add(v.position, v.line, v.marker);
    builder.end_ring();
  }
  builder.finish();
}

} // namespace

Contour parse_poly(std::string_view text, const std::string& source, std::string_view nodes, Faults faults) {
  PolyFile file = read_poly_file(text, source, nodes);
  Contour contour;
  contour.source = source;
  if (file.segments.empty())
    throw GeometryError(fmt::format("{}: expected segments that make rings, found none", source));
  tell_unused(file, source, contour.warnings);
  const std::size_t before = contour.warnings.size();
  if (!file.regions.empty())
    contour.warnings.push_back(fmt::format("{}:{}: region points do not change the shape; [region.NAME] with this file "
                                           "makes a region of each attribute",
                                           source, file.regions[0].at.line));
  add_rings(file, contour);
  contour.inner_warnings.assign(contour.warnings.begin() + static_cast<std::ptrdiff_t>(before), contour.warnings.end());
  check_reading(contour, faults, "segments that enclose an area without a hole point in it");
  return contour;
}

} // namespace trime::contours
