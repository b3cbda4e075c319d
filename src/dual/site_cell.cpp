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

/// Adds up the triangles between the first corner of a polygon and each of its sides, so that little cancels.
class MomentSum {
public:
  void add(Vec2 corner) {
    if (!has_first_)
      first_ = corner;
    has_first_ = true;
    const Vec2 next = corner - first_;
    const double part = cross(last_, next);
    twice_ += part;
    sum_ = sum_ + part * (last_ + next);
    last_ = next;
  }
  Moments moments() const { return {0.5 * twice_, first_ + (1 / (3 * twice_)) * sum_}; }

private:
  bool has_first_ = false;
  Vec2 first_{0, 0}, last_{0, 0}, sum_{0, 0}; // the last one relative to the first one
  double twice_ = 0;
};

/// Adds up the corners of a part.
struct PartMoments {
  const Surroundings& around;
  MomentSum sum{};

  void centre(std::size_t triangle) { sum.add(around.centres[triangle]); }
  void middle(std::size_t spoke) { sum.add(around.middle(spoke)); }
  void site() { sum.add({0, 0}); }
};

} // namespace

void look_around(const Cells& cells, LocalIndex site, Surroundings& around) {
  const Fan fan = cells.fan(site);
  const std::size_t count = fan.triangles.size(), spokes = count + (fan.is_closed ? 0 : 1);
  const Vec2 place = cells.points[at(site)];
  around.is_closed = fan.is_closed;
  around.triangles.assign(fan.triangles.begin(), fan.triangles.end());
  around.regions.resize(count);
  around.centres.resize(count);
  around.ends.resize(spokes);
  around.arms.resize(spokes);
  for (std::size_t k = 0; k < count; ++k) {
    const CellTriangle& triangle = cells.triangles[at(fan.triangles[k])];
    around.ends[k] = triangle.corner_behind(site, 1);
    if (k + 1 == count && !fan.is_closed)
      around.ends[count] = triangle.corner_behind(site, 2);
    around.regions[k] = triangle.region;
    around.centres[k] = cells.centre_from(place, triangle);
  }
  for (std::size_t k = 0; k < spokes; ++k)
    around.arms[k] = difference(cells.points[at(around.ends[k])], place, cells.period);
}

Moments moments_inside(const Cells& cells, LocalIndex site) {
  MomentSum sum;
  for (const LocalIndex triangle : cells.fan(site).triangles)
    sum.add(cells.centre_from(cells.points[at(site)], cells.triangles[at(triangle)]));
  return sum.moments();
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
  if (!around.is_divided())
    return {around.regions[0], 0, around.triangles.size(), true};
  const std::vector<CellPart> parts = parts_of(around);
  if (parts.size() == 1)
    return parts[0];
  std::map<std::int32_t, double> areas;
  for (const CellPart& part : parts)
    areas[part.region] += moments_of(around, part).area;
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
  MomentSum sum;
  for (const Vec2 corner : corners)
    sum.add(corner);
  return sum.moments();
}

Moments moments_of(const Surroundings& around, const CellPart& part) {
  PartMoments corners{around};
  for_each_corner(around, part, corners);
  return corners.sum.moments();
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
