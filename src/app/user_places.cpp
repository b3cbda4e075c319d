// SPDX-License-Identifier: BSD-3-Clause
#include "app/user_places.hpp"

#include "contours/map_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trime::app {
namespace {

using geometry::Vec2;

/// [extent of the contour] A place farther from all its vertices is not described by them.
constexpr double farthest = 0.25;
/// [extent of the contour] The lattice moves a vertex by less.
constexpr double same_place = 1e-10;

std::string in_degrees(Vec2 place) {
  return fmt::format("longitude {:.10g}, latitude {:.10g}", place.x, place.y);
}

} // namespace

void UserPlaces::add(const contours::Contour& contour, const contours::Normalization& place) {
  OneContour one{{}, place, place.scale != 1 || place.from != place.to, {}, {}, {}, {}, {}};
  one.named.source = contour.source;
  one.named.features = contour.features;
  one.named.is_map = contour.is_map;
  one.named.in_degrees = contour.in_degrees;
  std::size_t count = 0;
  for (const contours::ContourRing& ring : contour.rings)
    one.ring_ends.push_back(count += ring.points.size());
  one.vertices.reserve(count);
  one.lines.reserve(count);
  for (const contours::ContourRing& ring : contour.rings)
    for (std::size_t k = 0; k < ring.points.size(); ++k) {
      one.vertices.push_back(place.apply(ring.points[k]));
      one.lines.push_back(ring.lines[k]);
      if (!ring.in_file.empty())
        one.in_file.push_back(ring.in_file[k]);
      one.box.include(one.vertices.back());
    }
  contours_.push_back(std::move(one));
}

/// In brackets, with a blank before them; nothing if no contour is near.
std::string UserPlaces::name_of(Vec2 place) const {
  const OneContour* contour = nullptr;
  std::size_t vertex = 0;
  double least = INFINITY;
  for (const OneContour& one : contours_) {
    const double reach = farthest * std::fmax(one.box.width(), one.box.height());
    for (std::size_t k = 0; k < one.vertices.size(); ++k)
      if (const double d = squared_length(one.vertices[k] - place); d < least && d < reach * reach) {
        least = d;
        contour = &one;
        vertex = k;
      }
  }
  const std::optional<Vec2> earth = on_earth_ ? on_earth_(place) : std::nullopt;
  if (contour == nullptr)
    return earth ? fmt::format(" [{}]", in_degrees(*earth)) : "";
  const std::string file = contours::where(contour->named, contour->lines[vertex]);
  if (earth)
    return fmt::format(" [{}: {}]", file, in_degrees(*earth));
  const bool projected = !contour->in_file.empty();
  if (!contour->moved && !projected)
    return fmt::format(" [{}]", file);
  const Vec2 user = projected ? contour->in_file[vertex] : contour->place.undo(place);
  return contour->named.in_degrees ? fmt::format(" [{}: {}]", file, in_degrees(user))
                                   : fmt::format(" [{}: ({:.10g}, {:.10g})]", file, user.x, user.y);
}

std::vector<std::int32_t> UserPlaces::ring_lines(const geometry::Boundary& boundary) const {
  struct Vertex {
    Vec2 place;
    double reach;
    int line;
  };
  std::vector<Vertex> vertices;
  double reach = 0;
  for (const OneContour& one : contours_) {
    const double own = same_place * std::fmax(one.box.width(), one.box.height());
    reach = std::fmax(reach, own);
    std::size_t k = 0;
    for (const std::size_t end : one.ring_ends)
      for (const std::size_t first = k; k < end; ++k)
        vertices.push_back({one.vertices[k], own, one.lines[first]});
  }
  std::stable_sort(vertices.begin(), vertices.end(),
                   [](const Vertex& a, const Vertex& b) { return a.place.x < b.place.x; });
  const auto line_at = [&](Vec2 p) {
    auto v = std::lower_bound(vertices.begin(), vertices.end(), p.x - reach,
                              [](const Vertex& vertex, double x) { return vertex.place.x < x; });
    for (; v != vertices.end() && v->place.x <= p.x + reach; ++v)
      if (squared_length(v->place - p) <= v->reach * v->reach)
        return v->line;
    return 0;
  };
  std::vector<std::int32_t> lines;
  for (const geometry::Loop& loop : boundary.loops) {
    lines.push_back(0);
    for (std::size_t k = 0; k < loop.pieces.size() && lines.back() == 0 && !vertices.empty(); ++k)
      lines.back() = line_at(loop.pieces[k].start);
  }
  return lines;
}

std::string UserPlaces::explain(const PlacedText& message) const {
  return message.with_notes([this](double x, double y) { return name_of({x, y}); });
}

} // namespace trime::app
