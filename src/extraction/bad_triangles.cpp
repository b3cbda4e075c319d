// SPDX-License-Identifier: BSD-3-Clause
#include "extraction/bad_triangles.hpp"

#include "core/angle.hpp"
#include "extraction/rules.hpp"

#include <algorithm>
#include <cmath>

namespace trime::extraction {
namespace {

using geometry::lexicographically_less;
using geometry::Vec2;
using mesh::BadTriangle;

bool is_worse(const BadTriangle& a, const BadTriangle& b) {
  return a.alpha != b.alpha ? a.alpha > b.alpha : lexicographically_less(a.place, b.place);
}

/// Inside angle of the polygon of chords at a site, in degrees.
double inside_angle(const polygon::BoundarySites& boundary, LocalIndex k) {
  const geometry::Segment out = boundary.chord(k), in = boundary.chord(boundary.sites[at(k)].previous);
  const Vec2 ahead = out.b - out.a, back = in.a - in.b;
  const double angle = angle_of(cross(ahead, back), dot(ahead, back)) * degrees_per_radian;
  return angle < 0 ? angle + 360 : angle;
}

} // namespace

SharpCorners::SharpCorners(const polygon::BoundarySites& boundary, const geometry::Periods& periods)
    : periods_(periods) {
  for (LocalIndex k = 0; k < std::ssize(boundary.sites); ++k)
    if (boundary.sites[at(k)].corner)
      if (const double degrees = inside_angle(boundary, k); degrees < ExtractionRules::sharp_degrees)
        corners_.push_back({periods.wrap(boundary.sites[at(k)].position), degrees});
  std::sort(corners_.begin(), corners_.end(),
            [](const Corner& a, const Corner& b) { return lexicographically_less(a.place, b.place); });
}

SharpCorners::Corner SharpCorners::near(Vec2 p, Vec2 q, Vec2 r) const {
  const double longest =
      std::sqrt(std::fmax(squared_length(q - p), std::fmax(squared_length(r - q), squared_length(p - r))));
  const double reach = ExtractionRules::corner_reach * longest;
  Corner best;
  double least = reach * reach;
  for (const Vec2 vertex : {p, q, r})
    for (const double shift : {-periods_.x, 0.0, periods_.x}) { // a corner across the border
      const double x = vertex.x + shift;
      auto corner = std::lower_bound(corners_.begin(), corners_.end(), x - reach,
                                     [](const Corner& c, double low) { return c.place.x < low; });
      for (; corner != corners_.end() && corner->place.x <= x + reach; ++corner) {
        const double d = squared_length(periods_.nearest_image(corner->place, vertex) - vertex);
        if (d < least || (d == least && (best.degrees == 0 || lexicographically_less(corner->place, best.place)))) {
          least = d;
          best = *corner;
        }
      }
      if (periods_.x == 0)
        break;
    }
  return best;
}

void BadTriangles::add(const BadTriangle& triangle) {
  ++count_;
  if (triangle.corner_degrees == 0 && (away_.alpha == 0 || is_worse(triangle, away_)))
    away_ = triangle;
  if (worst_.size() == ExtractionRules::most_listed) {
    if (!is_worse(triangle, worst_.back()))
      return;
    worst_.pop_back();
  }
  worst_.insert(std::upper_bound(worst_.begin(), worst_.end(), triangle, is_worse), triangle);
}

void BadTriangles::merge(const BadTriangles& other) {
  const std::int64_t count = count_ + other.count_;
  for (const BadTriangle& triangle : other.worst_)
    add(triangle);
  if (other.away_.alpha > 0 && (away_.alpha == 0 || is_worse(other.away_, away_)))
    away_ = other.away_;
  count_ = count;
}

void BadTriangles::gather(const comm::Communicator& comm, std::int64_t count) {
  if (count == 0)
    return;
  std::vector<BadTriangle> sent = worst_;
  const bool is_listed = std::ranges::any_of(
      worst_, [&](const BadTriangle& one) { return one.alpha == away_.alpha && one.place == away_.place; });
  if (away_.alpha > 0 && !is_listed)
    sent.push_back(away_);
  *this = {};
  for (const BadTriangle& triangle : comm::from_bytes<BadTriangle>(comm.all_gather(comm::to_bytes<BadTriangle>(sent))))
    add(triangle);
  count_ = count;
}

void BadTriangles::tell(mesh::QualitySummary& quality) const {
  quality.bad_triangles = count_;
  quality.worst_triangles = worst_;
  quality.worst_away = away_;
}

} // namespace trime::extraction
