// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz.hpp"

#include "trime/geometry/lattice.hpp"
#include "trime/shape/part.hpp"
#include "trime/shape/region_shape.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace trime::fuzz {

void use(const contours::Contour& contour) {
  constexpr std::size_t most_vertices = 300; // a few milliseconds under sanitizers
  std::size_t vertices = 0;
  for (const contours::ContourRing& ring : contour.rings) {
    vertices += ring.points.size();
    TRIME_ASSERT(ring.points.size() >= (ring.open ? 2U : 3U) && ring.lines.size() == ring.points.size(),
                 "{} vertices, {} lines", ring.points.size(), ring.lines.size());
    TRIME_ASSERT(ring.markers.empty() || ring.markers.size() == ring.points.size(), "{} markers", ring.markers.size());
    for (const geometry::Vec2 p : ring.points)
      TRIME_ASSERT(std::isfinite(p.x) && std::isfinite(p.y), "({}, {})", p.x, p.y);
  }
  TRIME_ASSERT(!contour.rings.empty(), "a contour without a ring");
  const std::string bytes = contours::to_bytes(contour);
  TRIME_ASSERT(contours::to_bytes(contours::contour_of_bytes(bytes)) == bytes, "{} bytes", bytes.size());
  if (vertices > most_vertices)
    return;
  for (const bool is_periodic : {false, true})
    survives([&] {
      const geometry::Frame frame({{0, 0}, {1, 1}}, is_periodic, false);
      std::vector<shape::Part> parts;
      parts.push_back(
          shape::Part::contour("part", contour, contours::fit_to_container(contour, frame.container()), frame));
      const shape::RegionShape shape(std::move(parts), "part", frame);
      TRIME_ASSERT(shape.boundary().area > 0, "area {}", shape.boundary().area);
      TRIME_ASSERT(std::isfinite(shape.signed_distance({0.5, 0.5})), "distance");
    });
}

void use_curves(const contours::Contour& contour) {
  constexpr std::size_t most_vertices = 100;
  std::size_t vertices = 0;
  for (const contours::ContourRing& ring : contour.rings)
    vertices += ring.points.size();
  TRIME_ASSERT(!contour.rings.empty(), "curves without a line");
  const std::string bytes = contours::to_bytes(contour);
  TRIME_ASSERT(contours::to_bytes(contours::contour_of_bytes(bytes)) == bytes, "{} bytes", bytes.size());
  if (vertices > most_vertices)
    return;
  for (const char clip : {'\0', '\1'})
    survives([&] {
      const geometry::Frame frame({{0, 0}, {1, 1}});
      const contours::Normalization place = contours::fit_to_container(contour, frame.container());
      std::vector<shape::CurveLine> lines;
      for (const contours::ContourRing& ring : contour.rings) {
        shape::CurveLine& line = lines.emplace_back();
        line.closed = !ring.open;
        for (const geometry::Vec2 p : ring.points)
          line.points.push_back(clip != 0 ? 2 * place.apply(p) : place.apply(p));
      }
      shape::InnerParts curves;
      curves.curves.push_back(shape::Part::curve("curve", std::move(lines), frame));
      curves.clip = {clip};
      const geometry::Domain domain = shape::domain_of({}, "domain", frame, curves);
      for (const geometry::InnerArc& arc : domain.curves().arcs)
        for (std::size_t k = 1; k < arc.pieces.size(); ++k)
          TRIME_ASSERT(arc.pieces[k].start == arc.pieces[k - 1].end, "an arc with a gap");
    });
}

} // namespace trime::fuzz
