// SPDX-License-Identifier: BSD-3-Clause
#include "trime/shape/contour.hpp"

#include "contour_text.hpp"
#include "core/read_file.hpp"
#include "shape/rules.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace trime::shape {

namespace {

using geometry::Box;
using geometry::Vec2;

constexpr int most_warnings = 5;

bool ends_with_extension(const std::string& path, std::string_view extension) {
  if (path.size() < extension.size())
    return false;
  for (std::size_t i = 0; i < extension.size(); ++i) {
    const char c = path[path.size() - extension.size() + i];
    if ((c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c) != extension[i])
      return false;
  }
  return true;
}

/// Makes rings out of vertices in reading order; knows about repeated vertices, not about text.
class RingBuilder {
public:
  explicit RingBuilder(Contour& contour) : contour_(contour) {}

  void add(Vec2 p, int line) {
    check_coordinates(p, contour_.source, line);
    if (!ring_.points.empty() && ring_.points.back() == p) {
      warn(p, line);
      return;
    }
    ring_.points.push_back(p);
    ring_.lines.push_back(line);
  }

  void end_ring() {
    if (ring_.points.empty())
      return;
    if (ring_.points.size() > 1 && ring_.points.front() == ring_.points.back()) {
      ring_.points.pop_back();
      ring_.lines.pop_back();
    }
    if (const int distinct = distinct_vertices(); distinct < 3)
      throw GeometryError(fmt::format("{}:{}: the ring that starts here at ({}, {}) has {} distinct {}; expected at "
                                      "least 3",
                                      contour_.source, ring_.lines[0], ring_.points[0].x, ring_.points[0].y, distinct,
                                      distinct == 1 ? "vertex" : "vertices"));
    contour_.rings.push_back(std::move(ring_));
    ring_ = {};
  }

  void finish() {
    end_ring();
    if (contour_.rings.empty())
      throw GeometryError(
          fmt::format("{}: expected lines 'x y' that make a ring, found no vertex at all", contour_.source));
    if (merged_ > most_warnings)
      contour_.warnings.push_back(
          fmt::format("{}: {} more repeated consecutive vertices merged", contour_.source, merged_ - most_warnings));
  }

private:
  /// 1, 2, or 3 for three and more.
  int distinct_vertices() const {
    const std::vector<Vec2>& p = ring_.points;
    std::size_t other = 1;
    while (other < p.size() && p[other] == p[0])
      ++other;
    if (other >= p.size())
      return 1;
    for (std::size_t k = other + 1; k < p.size(); ++k)
      if (p[k] != p[0] && p[k] != p[other])
        return 3;
    return 2;
  }

  void warn(Vec2 p, int line) {
    if (++merged_ <= most_warnings)
      contour_.warnings.push_back(fmt::format("{}:{}: vertex ({}, {}) repeats the one before it; the two are merged",
                                              contour_.source, line, p.x, p.y));
  }

  Contour& contour_;
  ContourRing ring_;
  int merged_ = 0;
};

} // namespace

Contour parse_xy(std::string_view text, const std::string& source) {
  check_encoding(text, source);
  Contour contour;
  contour.source = source;
  RingBuilder builder(contour);
  VertexReader reader(contour.source);
  for_each_line(text, [&](std::string_view content, int number, bool parts_rings) {
    if (parts_rings)
      builder.end_ring();
    else if (!content.empty())
      if (const auto vertex = reader.read(content, number))
        builder.add(*vertex, number);
  });
  builder.finish();
  contour.warnings.insert(contour.warnings.begin(), reader.warnings().begin(), reader.warnings().end());
  return contour;
}

std::vector<FilePoint> parse_points(std::string_view text, const std::string& source) {
  check_encoding(text, source);
  std::vector<FilePoint> points;
  VertexReader reader(source);
  for_each_line(text, [&](std::string_view content, int number, bool) {
    if (content.empty())
      return;
    const auto p = reader.read(content, number);
    if (!p) // nobody would hear the warning
      throw GeometryError(fmt::format("{}:{}: expected two numbers 'x y', found the names of columns; put '#' before "
                                      "them",
                                      source, number));
    check_coordinates(*p, source, number);
    points.push_back({*p, number});
  });
  if (points.empty())
    throw GeometryError(fmt::format("{}: expected points, one 'x y' a line, found none", source));
  return points;
}

std::string read_contour_text(const std::string& path, const std::string& hint) {
  for (const std::string_view extension : {".poly", ".geojson", ".json"})
    if (ends_with_extension(path, extension))
      throw ConfigError(fmt::format("{}: contours of type '{}' cannot be read by this version; expected an '.xy' file "
                                    "with one 'x y' per line and a blank line between rings",
                                    path, extension));
  return read_file(path, hint);
}

Contour read_xy(const std::string& path) {
  return parse_xy(read_contour_text(path), path);
}

Contour make_contour(const std::vector<std::vector<Vec2>>& rings, const std::string& source) {
  Contour contour;
  contour.source = source;
  RingBuilder builder(contour);
  int number = 0;
  for (const std::vector<Vec2>& ring : rings) {
    for (const Vec2 p : ring)
      builder.add(p, ++number);
    builder.end_ring();
  }
  builder.finish();
  return contour;
}

Normalization fit_to_container(const Contour& contour, const Box& container) {
  Box box;
  for (const ContourRing& ring : contour.rings)
    for (const Vec2 p : ring.points)
      box.include(p);
  const double side = std::fmax(box.width(), box.height());
  if (!(side >= ShapeRules::smallest_normalized)) // also where all coordinates are equal
    throw GeometryError(fmt::format("{}: the rings are {:g} wide and {:g} high; expected {:g} at least, to normalize "
                                    "them: scale the coordinates up",
                                    contour.source, box.width(), box.height(), ShapeRules::smallest_normalized));
  Normalization fit;
  fit.from = 0.5 * (box.min + box.max);
  fit.to = 0.5 * (container.min + container.max);
  fit.scale = ShapeRules::normalized_share * std::fmin(container.width(), container.height()) / side;
  return fit;
}

} // namespace trime::shape
