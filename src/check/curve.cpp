// SPDX-License-Identifier: BSD-3-Clause
#include "curve.hpp"

#include "inside.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/segment.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <limits>

namespace trime_check {
namespace {

constexpr double degrees_per_radian = 57.295779513082320877;
constexpr double full_turn = 6.283185307179586477;
constexpr double least_arcs = 16; // with the samples of a circle in their middles
constexpr double infinity = std::numeric_limits<double>::infinity();

namespace index = boost::geometry::index;
using Place = boost::geometry::model::d2::point_xy<double>;
using Segment = boost::geometry::model::segment<Place>;

/// Pieces of a straight side, of equal lengths.
void sample_side(Point a, Point b, double spacing, std::vector<CurveSample>& found) {
  const Point along = b - a;
  const double length = std::hypot(along.x, along.y), count = std::ceil(length / spacing);
  for (double k = 0; k < count; ++k)
    found.push_back({{a.x + (k + 0.5) / count * along.x, a.y + (k + 0.5) / count * along.y},
                     {-along.y / length, along.x / length},
                     length / count});
}

class Circle : public Curve {
public:
  Circle(Point center, double radius) : center_(center), radius_(radius) {}
  double distance(Point p) const override { return std::fabs(std::hypot(p.x - center_.x, p.y - center_.y) - radius_); }
  bool contains(Point p) const override { return std::hypot(p.x - center_.x, p.y - center_.y) < radius_; }
  Box box() const override {
    return {{center_.x - radius_, center_.y - radius_}, {center_.x + radius_, center_.y + radius_}};
  }
  std::vector<Point> corners(double) const override { return {}; }
  double length() const override { return full_turn * radius_; }
  std::vector<CurveSample> samples(double spacing) const override {
    const double count = std::max(least_arcs, std::ceil(length() / spacing));
    std::vector<CurveSample> found;
    for (double k = 0; k < count; ++k) {
      const Point normal{std::cos(full_turn * k / count), std::sin(full_turn * k / count)};
      found.push_back({{center_.x + radius_ * normal.x, center_.y + radius_ * normal.y}, normal, length() / count});
    }
    return found;
  }

private:
  Point center_;
  double radius_;
};

/// Closed rings of straight sides, inside by even-odd.
class Polygon : public Curve {
public:
  explicit Polygon(std::vector<Ring> rings) : rings_(std::move(rings)), inside_(rings_) {
    std::vector<Segment> sides;
    for_each_side([&](Point a, Point b) { sides.push_back({{a.x, a.y}, {b.x, b.y}}); });
    tree_ = Tree(sides);
  }

  double distance(Point p) const override {
    const Place place(p.x, p.y);
    const auto nearest = tree_.qbegin(index::nearest(place, 1));
    return nearest == tree_.qend() ? infinity : boost::geometry::distance(place, *nearest);
  }

  bool contains(Point p) const override { return inside_.contains(p); }
  Box box() const override { return box_of(rings_); }

  std::vector<Point> corners(double degrees) const override {
    std::vector<Point> found;
    for (const Ring& ring : rings_)
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point into = ring[k] - ring[(k + ring.size() - 1) % ring.size()];
        const Point out = ring[(k + 1) % ring.size()] - ring[k];
        const double turn = std::atan2(into.x * out.y - into.y * out.x, into.x * out.x + into.y * out.y);
        if (std::fabs(turn) * degrees_per_radian > degrees)
          found.push_back(ring[k]);
      }
    return found;
  }

  double length() const override {
    double sum = 0;
    for_each_side([&](Point a, Point b) { sum += std::hypot(b.x - a.x, b.y - a.y); });
    return sum;
  }
  std::vector<CurveSample> samples(double spacing) const override {
    std::vector<CurveSample> found;
    for_each_side([&](Point a, Point b) { sample_side(a, b, spacing, found); });
    return found;
  }

private:
  template <class Visit>
  void for_each_side(const Visit& visit) const {
    for (const Ring& ring : rings_)
      for (std::size_t k = 0; k < ring.size(); ++k)
        visit(ring[k], ring[(k + 1) % ring.size()]);
  }

  using Tree = index::rtree<Segment, index::rstar<16>>;

  std::vector<Ring> rings_;
  InsideTest inside_;
  Tree tree_;
};

/// The container, whose periodic sides are not part of the boundary.
class ContainerCurve : public Curve {
public:
  ContainerCurve(const Box& box, const Periods& periods) : box_(box), periods_(periods) {}
  double distance(Point p) const override {
    const double x = std::min(std::fabs(p.x - box_.min.x), std::fabs(p.x - box_.max.x));
    const double y = std::min(std::fabs(p.y - box_.min.y), std::fabs(p.y - box_.max.y));
    if (periods_.x > 0 || periods_.y > 0) // strips have straight sides without ends
      return std::min(periods_.x > 0 ? infinity : x, periods_.y > 0 ? infinity : y);
    const Point off{std::max({box_.min.x - p.x, 0.0, p.x - box_.max.x}),
                    std::max({box_.min.y - p.y, 0.0, p.y - box_.max.y})};
    return off.x > 0 || off.y > 0 ? std::hypot(off.x, off.y) : std::min(x, y);
  }
  bool contains(Point p) const override {
    return (periods_.x > 0 || (p.x > box_.min.x && p.x < box_.max.x)) &&
           (periods_.y > 0 || (p.y > box_.min.y && p.y < box_.max.y));
  }
  Box box() const override { return box_; }
  std::vector<Point> corners(double) const override {
    if (periods_.any())
      return {};
    return {box_.min, {box_.max.x, box_.min.y}, box_.max, {box_.min.x, box_.max.y}};
  }
  double length() const override {
    return (periods_.x > 0 ? 0 : 2 * (box_.max.y - box_.min.y)) + (periods_.y > 0 ? 0 : 2 * (box_.max.x - box_.min.x));
  }
  std::vector<CurveSample> samples(double spacing) const override {
    std::vector<CurveSample> found;
    if (!(periods_.x > 0)) {
      sample_side(box_.min, {box_.min.x, box_.max.y}, spacing, found);
      sample_side({box_.max.x, box_.min.y}, box_.max, spacing, found);
    }
    if (!(periods_.y > 0)) {
      sample_side(box_.min, {box_.max.x, box_.min.y}, spacing, found);
      sample_side({box_.min.x, box_.max.y}, box_.max, spacing, found);
    }
    return found;
  }

private:
  Box box_;
  Periods periods_;
};

} // namespace

Box box_of(const std::vector<Ring>& rings) {
  Box box{{infinity, infinity}, {-infinity, -infinity}};
  for (const Ring& ring : rings)
    for (const Point p : ring)
      box = {{std::min(box.min.x, p.x), std::min(box.min.y, p.y)},
             {std::max(box.max.x, p.x), std::max(box.max.y, p.y)}};
  return box;
}

std::vector<Ring> rectangle(const Box& box) {
  return {{box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}}};
}

std::unique_ptr<Curve> make_circle(Point center, double radius) {
  return std::make_unique<Circle>(center, radius);
}

std::unique_ptr<Curve> make_polygon(std::vector<Ring> rings) {
  return std::make_unique<Polygon>(std::move(rings));
}

std::unique_ptr<Curve> make_container(const Box& box, const Periods& periods) {
  return std::make_unique<ContainerCurve>(box, periods);
}

} // namespace trime_check
