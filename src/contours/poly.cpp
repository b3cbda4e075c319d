// SPDX-License-Identifier: BSD-3-Clause
// The .poly files of Triangle (Shewchuk, https://www.cs.cmu.edu/~quake/triangle.poly.html).
#include "contours/contour_text.hpp"
#include "contours/faults.hpp"
#include "contours/inner_lines.hpp"
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

using geometry::Vec2;

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
    warnings.push_back(fmt::format("{}:{}: {} ring{} no hole point inside (the first one begins here), so both sides "
                                   "are meshed. Lines inside the shape are not kept: to make a hole, add a hole point",
                                   source, rings[first][0].line, inner, inner == 1 ? " has" : "s have"));
  return kept;
}

constexpr int most_columns = 1000; // of attributes

/// A head line: how many rows follow, and what each has.
struct Head {
  int rows;
  std::vector<int> columns;
};

class PolyReader {
public:
  PolyReader(std::string_view text, const std::string& source, std::string_view nodes)
      : source_(source), lines_(text, source, ","), node_source_(source.substr(0, source.size() - 5) + ".node"),
        node_lines_(nodes, node_source_, ",") {}

  Contour read(Faults faults) {
    Contour contour;
    contour.source = source_;
    read_vertices();
    read_segments();
    read_holes();
    if (lines_.next())
      contour.warnings.push_back(
          fmt::format("{}:{}: regional attributes are ignored: the mesh has one region", source_, lines_.number()));
    if (segments_.empty())
      throw GeometryError(fmt::format("{}: expected segments that make rings, found none", source_));
    tell_unused(contour.warnings);
    RingBuilder builder(contour);
    const std::vector<FileSegment> all = segments_;
    remove_open_chains(vertices_, segments_, source_, contour.warnings);
    remove_inner_lines(vertices_, segments_, holes_, contour);
    const auto rings = rings_of_segments(vertices_, segments_, source_, contour.warnings);
    const auto kept = rings_around_material(rings, holes_, source_, contour.warnings);
    if (kept.empty()) // throws if a ring around a hole point is open: then the hole is all that the other rings enclose
      rings_of_segments(vertices_, all, source_, contour.warnings);
    for (const std::size_t k : kept) {
      for (const RingVertex& v : rings[k])
        builder.add(v.position, v.line, v.marker);
      builder.end_ring();
    }
    builder.finish();
    check_reading(contour, faults, "segments that enclose an area without a hole point in it");
    return contour;
  }

private:
  static Head head_of(WordLines& lines, const char* what, std::size_t columns) {
    if (!lines.next())
      lines.refuse(what);
    Head head{lines.integer_at(0, what), {}};
    for (std::size_t k = 1; k <= columns; ++k) // what is not given is 0
      head.columns.push_back(k < lines.words().size() ? lines.integer_at(k, what) : 0);
    if (head.rows < 0 || std::any_of(head.columns.begin(), head.columns.end(),
                                     [](int column) { return column < 0 || column > most_columns; }))
      lines.refuse(what);
    return head;
  }

  static void next_row(WordLines& lines, int row, int rows, const char* what) {
    if (!lines.next())
      lines.refuse(fmt::format("{} {} of {}", what, row + 1, rows));
  }

  void read_vertices() {
    constexpr const char* head_text = "'VERTICES 2 ATTRIBUTES MARKERS'";
    Head head = head_of(lines_, head_text, 3);
    WordLines* lines = &lines_;
    if (head.rows == 0) {
      lines = &node_lines_;
      head = head_of(*lines, head_text, 3);
    }
    if (head.columns[0] != 2 && head.columns[0] != 0)
      lines->refuse("a plane .poly, whose first line is 'VERTICES 2 ATTRIBUTES MARKERS'");
    for (int k = 0; k < head.rows; ++k) {
      next_row(*lines, k, head.rows, "vertex");
      constexpr const char* what = "'NUMBER X Y' of a vertex";
      const FileVertex vertex{
          {lines->number_at(1, what), lines->number_at(2, what)}, lines->number(), lines->integer_at(0, what)};
      if (k == 0)
        first_number_ = vertex.number;
      if (vertex.number != first_number_ + k || (first_number_ != 0 && first_number_ != 1))
        lines->refuse(fmt::format("vertex {}: vertices are numbered one by one from 0 or 1", first_number_ + k));
      check_coordinates(vertex.position, lines == &lines_ ? source_ : node_source_, vertex.line);
      vertices_.push_back(vertex);
    }
  }

  int vertex_at(std::size_t column) const {
    constexpr const char* what = "'NUMBER VERTEX VERTEX MARKER' of a segment";
    const int number = lines_.integer_at(column, what), count = static_cast<int>(vertices_.size());
    if (number < first_number_ || number - first_number_ >= count)
      lines_.refuse(fmt::format("vertices from {} to {}", first_number_, first_number_ + count - 1));
    return number - first_number_;
  }

  void read_segments() {
    const Head head = head_of(lines_, "'SEGMENTS MARKERS'", 1);
    for (int k = 0; k < head.rows; ++k) {
      next_row(lines_, k, head.rows, "segment");
      const bool has_marker = head.columns[0] > 0 && lines_.words().size() > 3;
      segments_.push_back({vertex_at(1), vertex_at(2), has_marker ? lines_.integer_at(3, "a marker as an integer") : 0,
                           lines_.number()});
    }
  }

  void read_holes() {
    constexpr const char* what = "'NUMBER X Y' of a hole";
    if (!lines_.next())
      return; // many programs end the file here
    const int holes = lines_.integer_at(0, "the number of holes");
    for (int k = 0; k < holes; ++k) {
      next_row(lines_, k, holes, "hole");
      holes_.push_back({{lines_.number_at(1, what), lines_.number_at(2, what)}, lines_.number()});
    }
  }

  void tell_unused(std::vector<std::string>& warnings) const {
    std::vector<char> used(vertices_.size(), 0);
    for (const FileSegment& s : segments_)
      used[static_cast<std::size_t>(s.from)] = used[static_cast<std::size_t>(s.to)] = 1;
    const auto unused = std::find(used.begin(), used.end(), 0);
    if (const auto count = std::count(used.begin(), used.end(), 0); count > 0)
      warnings.push_back(
          fmt::format("{}:{}: {} on no segment, and {} ignored; list points that the mesh must keep in the "
                      "file of [meshing] fixed_points",
                      source_, vertices_[static_cast<std::size_t>(unused - used.begin())].line,
                      count == 1 ? "this vertex lies" : fmt::format("this vertex and {} more lie", count - 1),
                      count == 1 ? "is" : "are"));
  }

  const std::string& source_;
  WordLines lines_;
  std::string node_source_;
  WordLines node_lines_;
  int first_number_ = 1;
  std::vector<FileVertex> vertices_;
  std::vector<FileSegment> segments_;
  std::vector<FilePoint> holes_;
};

} // namespace

Contour parse_poly(std::string_view text, const std::string& source, std::string_view nodes, Faults faults) {
  check_encoding(text, source);
  return PolyReader(text, source, nodes).read(faults);
}

} // namespace trime::contours
