// SPDX-License-Identifier: BSD-3-Clause
#include "trime/contours/contour.hpp"

#include "contours/contour_text.hpp"
#include "contours/ring_builder.hpp"
#include "contours/rules.hpp"
#include "trime/core/error.hpp"

#include <cmath>

namespace trime::contours {

using geometry::Box;
using geometry::Vec2;

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
  builder.finish("lines 'x y' that make a ring");
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
    throw GeometryError(fmt::format("{}: expected points, one 'x y' per line, found none", source));
  return points;
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
  builder.finish("vertices that make a ring");
  return contour;
}

Normalization fit_to_container(const Contour& contour, const Box& container) {
  Box box;
  for (const ContourRing& ring : contour.rings)
    for (const Vec2 p : ring.points)
      box.include(p);
  const double side = std::fmax(box.width(), box.height());
  if (!(side >= ContourRules::smallest_normalized)) // also where all coordinates are equal
    throw GeometryError(fmt::format("{}: the rings are {:g} wide and {:g} high; expected at least {:g} for normalize = "
                                    "true; scale the coordinates up",
                                    contour.source, box.width(), box.height(), ContourRules::smallest_normalized));
  Normalization fit;
  fit.from = 0.5 * (box.min + box.max);
  fit.to = 0.5 * (container.min + container.max);
  fit.scale = ContourRules::normalized_share * std::fmin(container.width(), container.height()) / side;
  return fit;
}

} // namespace trime::contours
