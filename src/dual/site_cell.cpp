// SPDX-License-Identifier: BSD-3-Clause
#include "dual/site_cell.hpp"

#include <cmath>
#include <map>

namespace trime::dual {
namespace {

using geometry::Vec2;

/// Collects the corners of a part.
struct CornerPlaces {
  const Surroundings& around;
  std::vector<Vec2> places{};

  void centre(std::size_t triangle) { places.push_back(around.centres[triangle]); }
  void middle(std::size_t spoke) { places.push_back(around.middle(spoke)); }
  void site() { places.push_back({0, 0}); }
};

std::size_t slot_of(const CellTriangle& triangle, LocalIndex site) {
  return triangle.corners[0] == site ? 0 : triangle.corners[1] == site ? 1 : 2;
}

} // namespace

std::optional<std::size_t> Surroundings::left(std::size_t spoke) const {
  return spoke < triangles.size() ? std::optional(spoke) : std::nullopt;
}

std::optional<std::size_t> Surroundings::right(std::size_t spoke) const {
  if (spoke > 0)
    return spoke - 1;
  return is_closed ? std::optional(triangles.size() - 1) : std::nullopt;
}

bool Surroundings::is_divided_at(std::size_t spoke) const {
  const auto on_left = left(spoke), on_right = right(spoke);
  return !on_left || !on_right || regions[*on_left] != regions[*on_right];
}

void look_around(const Cells& cells, LocalIndex site, Surroundings& around) {
  const Fan fan = cells.fan(site);
  const Vec2 place = cells.points[at(site)];
  around.is_closed = fan.is_closed;
  around.triangles.assign(fan.triangles.begin(), fan.triangles.end());
  around.ends.clear();
  around.centres.clear();
  around.regions.clear();
  for (const LocalIndex t : fan.triangles) {
    const CellTriangle& triangle = cells.triangles[at(t)];
    around.ends.push_back(triangle.corners[(slot_of(triangle, site) + 1) % 3]);
    around.regions.push_back(triangle.region);
    around.centres.push_back(difference(cells.points[at(triangle.corners[0])], place, cells.period) + triangle.centre);
  }
  if (!fan.is_closed) {
    const CellTriangle& last = cells.triangles[at(fan.triangles.back())];
    around.ends.push_back(last.corners[(slot_of(last, site) + 2) % 3]);
  }
  around.arms.clear();
  for (const LocalIndex end : around.ends)
    around.arms.push_back(difference(cells.points[at(end)], place, cells.period));
}

std::vector<CellPart> parts_of(const Surroundings& around) {
  const std::size_t count = around.triangles.size();
  std::vector<std::size_t> divided;
  for (std::size_t spoke = 0; spoke < around.arms.size(); ++spoke)
    if (around.is_divided_at(spoke))
      divided.push_back(spoke);
  if (divided.empty())
    return {{around.regions[0], 0, count, true}};
  if (around.is_closed)
    divided.push_back(divided[0] + count);
  std::vector<CellPart> parts;
  for (std::size_t k = 0; k + 1 < divided.size(); ++k)
    parts.push_back({around.regions[divided[k] % count], divided[k], divided[k + 1] - divided[k], false});
  return parts;
}

CellPart whole_cell(const Surroundings& around) {
  const std::vector<CellPart> parts = parts_of(around);
  if (parts.size() == 1)
    return parts[0];
  std::map<std::int32_t, double> areas;
  for (const CellPart& part : parts)
    areas[part.region] += moments_of(corners_of(around, part)).area;
  auto largest = areas.begin();
  for (auto region = areas.begin(); region != areas.end(); ++region)
    if (region->second > largest->second)
      largest = region;
  return {largest->first, 0, around.triangles.size(), around.is_closed};
}

std::vector<Vec2> corners_of(const Surroundings& around, const CellPart& part) {
  CornerPlaces corners{around};
  for_each_corner(around, part, corners);
  return corners.places;
}

Moments moments_of(std::span<const Vec2> corners) {
  double twice = 0;
  Vec2 sum{0, 0};
  for (std::size_t k = 0; k < corners.size(); ++k) { // relative to the first corner, so that little cancels
    const Vec2 a = corners[k] - corners[0], b = corners[(k + 1) % corners.size()] - corners[0];
    const double part = cross(a, b);
    twice += part;
    sum = sum + part * (a + b);
  }
  return {0.5 * twice, corners[0] + (1 / (3 * twice)) * sum};
}

double half_dual_length(const Surroundings& around, std::size_t spoke, std::size_t triangle) {
  const std::size_t apex = triangle == spoke ? around.spoke_behind(spoke, 1) : triangle;
  const Vec2 to_site = Vec2{0, 0} - around.arms[apex], to_end = around.arms[spoke] - around.arms[apex];
  return 0.5 * length(around.arms[spoke]) * dot(to_site, to_end) / std::fabs(cross(to_site, to_end));
}

std::array<double, 3> kites_of(Vec2 b, Vec2 c) {
  const Vec2 side = c - b;
  // An eighth of the squared length of each side times the cotangent of the angle opposite to it.
  const double scale = 0.125 / cross(b, c);
  const double at_b = scale * squared_length(c) * -dot(b, side), at_c = scale * squared_length(b) * dot(c, side),
               at_0 = scale * squared_length(side) * dot(b, c);
  return {at_b + at_c, at_0 + at_c, at_0 + at_b};
}

std::vector<double> kites_around(const Surroundings& around) {
  std::vector<double> kites;
  for (std::size_t k = 0; k < around.triangles.size(); ++k)
    kites.push_back(kites_of(around.arms[k], around.arms[around.spoke_behind(k, 1)])[0]);
  return kites;
}

CellFace face_of(const Surroundings& around, std::size_t spoke) {
  CellFace face;
  face.length = length(around.arms[spoke]);
  const auto left = around.left(spoke), right = around.right(spoke);
  face.is_boundary = !left || !right;
  for (const auto& triangle : {left, right}) {
    if (!triangle)
      continue;
    const double half = half_dual_length(around, spoke, *triangle);
    if (face.parts == 1 && around.regions[*triangle] == face.regions[0]) {
      face.dual_lengths[0] += half;
      continue;
    }
    face.regions[static_cast<std::size_t>(face.parts)] = around.regions[*triangle];
    face.dual_lengths[static_cast<std::size_t>(face.parts++)] = half;
  }
  return face;
}

} // namespace trime::dual
