// SPDX-License-Identifier: BSD-3-Clause
// Regions and curves from the .poly files of Triangle.
#include "contours/contour_text.hpp"
#include "contours/faults.hpp"
#include "contours/poly_file.hpp"
#include "contours/segment_faces.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/predicates.hpp"
#include "trime/contours/contour.hpp"
#include "trime/core/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace trime::contours {
namespace {

using geometry::Vec2;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// The faces need segments that meet in their ends only.
class Meetings {
public:
  Meetings(const PolyFile& file, const std::string& source) : file_(file), source_(source) {}

  /// @throws GeometryError for the first segment that meets another one elsewhere
  void refuse() const {
    std::vector<geometry::Box> boxes;
    for (const FileSegment& s : file_.segments) {
      geometry::Box& box = boxes.emplace_back();
      box.include(place(s.from));
      box.include(place(s.to));
    }
    const geometry::BoxTree tree(boxes);
    for (std::size_t k = 0; k < boxes.size(); ++k)
      for (const std::size_t other : tree.meeting(boxes[k]))
        if (other > k && meet(file_.segments[k], file_.segments[other]))
          throw GeometryError(fmt::format(
              "{}:{}: this segment and the one in line {} meet where they have no common vertex; region points need "
              "segments that meet in vertices only: add a vertex there, near ({}, {})",
              source_, file_.segments[k].line, file_.segments[other].line, middle(file_.segments[k]).x,
              middle(file_.segments[k]).y));
  }

private:
  Vec2 place(int vertex) const { return file_.vertices[at(vertex)].position; }
  Vec2 middle(const FileSegment& s) const { return 0.5 * (place(s.from) + place(s.to)); }

  /// Does vertex v lie on s, but not at its ends?
  bool is_on(int v, const FileSegment& s) const {
    const Vec2 p = place(v), a = place(s.from), b = place(s.to);
    return v != s.from && v != s.to && geometry::orient2d(a, b, p) == 0 && std::fmin(a.x, b.x) <= p.x &&
           p.x <= std::fmax(a.x, b.x) && std::fmin(a.y, b.y) <= p.y && p.y <= std::fmax(a.y, b.y);
  }

  bool meet(const FileSegment& s, const FileSegment& t) const {
    if (is_on(s.from, t) || is_on(s.to, t) || is_on(t.from, s) || is_on(t.to, s))
      return true;
    const auto parts = [this](const FileSegment& line, const FileSegment& ends) {
      const Vec2 a = place(line.from), b = place(line.to);
      return geometry::orient2d(a, b, place(ends.from)) * geometry::orient2d(a, b, place(ends.to)) < 0;
    };
    return parts(s, t) && parts(t, s);
  }

  const PolyFile& file_;
  const std::string& source_;
};

std::string shown(const RegionPoint& point) {
  return fmt::format("({}, {})", point.at.position.x, point.at.position.y);
}

/// The attributes as markers, numbered in the order of the file.
class Attributes {
public:
  explicit Attributes(Contour& contour) : contour_(contour) {}

  int marker_of(const RegionPoint& point) {
    constexpr double none = std::numeric_limits<double>::infinity();
    const auto [found, is_new] = numbers_.try_emplace(point.attribute, static_cast<int>(numbers_.size()) + 1);
    if (is_new) {
      contour_.marker_names.push_back(fmt::format("{:.10g}", point.attribute));
      contour_.largest_areas.push_back(none);
    }
    double& largest = contour_.largest_areas[at(found->second - 1)];
    if (point.largest_area > 0)
      largest = std::fmin(largest, point.largest_area);
    return found->second;
  }
  /// Without limits there is no list of them.
  void finish() {
    if (std::none_of(contour_.largest_areas.begin(), contour_.largest_areas.end(),
                     [](double area) { return std::isfinite(area); }))
      contour_.largest_areas.clear();
  }

private:
  Contour& contour_;
  std::map<double, int> numbers_;
};

/// Returns the face around each region point. @throws GeometryError for a point in no face, and for two in one face
std::vector<std::size_t> faces_of_points(const PolyFile& file, const SegmentFaces& faces, const std::string& source) {
  std::vector<FilePoint> points;
  for (const RegionPoint& point : file.regions)
    points.push_back(point.at);
  const std::vector<std::size_t> around = faces.around(points), holes = faces.around(file.holes);
  std::map<std::size_t, const RegionPoint*> point_in;
  for (std::size_t k = 0; k < around.size(); ++k) {
    const RegionPoint& point = file.regions[k];
    const bool is_in_hole = std::find(holes.begin(), holes.end(), around[k]) != holes.end();
    if (around[k] == SegmentFaces::nowhere || is_in_hole)
      throw GeometryError(fmt::format(
          "{}:{}: the region point {} lies {}; expected a point inside of a face that segments enclose: move the point",
          source, point.at.line, shown(point),
          around[k] == SegmentFaces::nowhere ? "outside of all segments" : "in a hole"));
    const auto [other, is_first] = point_in.try_emplace(around[k], &point);
    if (!is_first)
      throw GeometryError(fmt::format("{}:{}: the region points {} and {} (line {}) lie in the same face; expected one "
                                      "point in each face: remove or move one of them",
                                      source, point.at.line, shown(point), shown(*other->second),
                                      other->second->at.line));
  }
  return around;
}

void add_face(const PolyFile& file, const std::vector<FileSegment>& border, int marker, RingBuilder& builder,
              Contour& contour) {
  for (const auto& ring : rings_of_segments(file.vertices, border, contour.source, contour.warnings)) {
    for (const RingVertex& vertex : ring)
      builder.add(vertex.position, vertex.line, marker);
    builder.end_ring();
  }
}

/// The other end of a segment.
int far_end(const FileSegment& s, int vertex) {
  return s.from == vertex ? s.to : s.from;
}

/// Joins segments with equal markers to lines.
class LineJoiner {
public:
  explicit LineJoiner(const PolyFile& file) : file_(file), is_used_(file.segments.size(), 0) {
    for (std::size_t k = 0; k < file.segments.size(); ++k)
      for (const int end : {file.segments[k].from, file.segments[k].to})
        at_end_[{end, file.segments[k].marker}].push_back(k);
  }

  void add_to(Contour& contour) {
    for (const bool closed : {false, true}) // lines with ends first; what is left are rings
      for (std::size_t k = 0; k < file_.segments.size(); ++k)
        for (const int end : {file_.segments[k].from, file_.segments[k].to})
          if (is_used_[k] == 0 && (closed || at_end_[{end, file_.segments[k].marker}].size() != 2))
            add_line(contour, line_from(end, k), file_.segments[k].marker);
  }

private:
  /// Follows the line that begins at `vertex` with segment k.
  std::vector<FilePoint> line_from(int vertex, std::size_t k) {
    const int marker = file_.segments[k].marker;
    std::vector<FilePoint> line{point(vertex)};
    for (std::size_t next = k; is_used_[next] == 0;) {
      is_used_[next] = 1;
      vertex = far_end(file_.segments[next], vertex);
      line.push_back(point(vertex));
      const std::vector<std::size_t>& here = at_end_[{vertex, marker}];
      if (here.size() == 2)
        next = here[0] == next ? here[1] : here[0];
    }
    return line;
  }
  FilePoint point(int vertex) const { return {file_.vertices[at(vertex)].position, file_.vertices[at(vertex)].line}; }

  const PolyFile& file_;
  std::vector<char> is_used_;
  std::map<std::pair<int, int>, std::vector<std::size_t>> at_end_; // segments by vertex and marker
};

} // namespace

Contour parse_poly_regions(std::string_view text, const std::string& source, std::string_view nodes) {
  PolyFile file = read_poly_file(text, source, nodes);
  if (file.regions.empty())
    return parse_poly(text, source, nodes);
  Contour contour;
  contour.source = source;
  remove_open_chains(file.vertices, file.segments, source, contour.warnings);
  contour.warnings.clear(); // lines with free ends do not change a region
  Meetings(file, source).refuse();
  const SegmentFaces faces(file.vertices, file.segments);
  const std::vector<std::size_t> around = faces_of_points(file, faces, source);
  RingBuilder builder(contour);
  Attributes attributes(contour);
  for (std::size_t k = 0; k < around.size(); ++k) {
    builder.set_polygon(static_cast<int>(k) + 1);
    add_face(file, faces.border(around[k]), attributes.marker_of(file.regions[k]), builder, contour);
  }
  builder.finish();
  attributes.finish();
  check_reading(contour, Faults::refuse, "segments around region points");
  return contour;
}

Contour parse_poly_lines(std::string_view text, const std::string& source, std::string_view nodes) {
  PolyFile file = read_poly_file(text, source, nodes);
  Contour contour;
  contour.source = source;
  std::erase_if(file.segments, [&](const FileSegment& s) {
    return file.vertices[at(s.from)].position == file.vertices[at(s.to)].position;
  });
  if (file.segments.empty())
    throw GeometryError(fmt::format("{}: expected segments with a length, found none", source));
  LineJoiner(file).add_to(contour);
  return contour;
}

} // namespace trime::contours
