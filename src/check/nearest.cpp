// SPDX-License-Identifier: BSD-3-Clause
#include "nearest.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/segment.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <limits>
#include <utility>

namespace trime_check {
namespace {

namespace index = boost::geometry::index;
using Place = boost::geometry::model::d2::point_xy<double>;
using Segment = boost::geometry::model::segment<Place>;
template <class Shape>
using NumberedTree = index::rtree<std::pair<Shape, std::size_t>, index::rstar<16>>;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns the nearest of all images except those of one number.
template <class Shape>
Nearest nearest_in(const NumberedTree<Shape>& tree, const std::vector<Point>& images, std::size_t but) {
  Nearest best{0, infinity};
  for (const Point image : images) {
    const Place place(image.x, image.y);
    for (auto at = tree.qbegin(index::nearest(place, 2)); at != tree.qend(); ++at)
      if (const double distance = boost::geometry::distance(place, at->first);
          at->second != but && distance < best.distance)
        best = {at->second, distance};
  }
  return best;
}

constexpr std::size_t nothing = std::numeric_limits<std::size_t>::max();

} // namespace

std::vector<Point> images_of(Point p, const Periods& periods) {
  std::vector<Point> images;
  for (const int i : {0, -1, 1})
    for (const int j : {0, -1, 1})
      if ((i == 0 || periods.x > 0) && (j == 0 || periods.y > 0))
        images.push_back({p.x + i * periods.x, p.y + j * periods.y});
  return images;
}

struct PointFinder::Tree {
  std::vector<Point> points;
  NumberedTree<Place> places;
};

PointFinder::PointFinder(const std::vector<Point>& points, const Periods& periods)
    : tree_(std::make_unique<Tree>()), periods_(periods) {
  std::vector<std::pair<Place, std::size_t>> places;
  for (std::size_t k = 0; k < points.size(); ++k)
    places.emplace_back(Place(points[k].x, points[k].y), k);
  *tree_ = {points, NumberedTree<Place>(places)};
}

PointFinder::~PointFinder() = default;

Nearest PointFinder::nearest(Point p) const {
  return nearest_in(tree_->places, images_of(p, periods_), nothing);
}

Nearest PointFinder::nearest_other(std::size_t number) const {
  return nearest_in(tree_->places, images_of(tree_->points[number], periods_), number);
}

struct FacetFinder::Tree {
  NumberedTree<Segment> segments;
};

FacetFinder::FacetFinder(const Mesh& mesh) : tree_(std::make_unique<Tree>()), periods_(mesh.periods) {
  std::vector<std::pair<Segment, std::size_t>> segments;
  for (std::size_t k = 0; k < mesh.facets.size(); ++k) {
    const Point a = mesh.at(mesh.facets[k][0]), b = mesh.periods.near(mesh.at(mesh.facets[k][1]), a);
    segments.emplace_back(Segment({a.x, a.y}, {b.x, b.y}), k);
  }
  tree_->segments = NumberedTree<Segment>(segments);
}

FacetFinder::~FacetFinder() = default;

Nearest FacetFinder::nearest(Point p) const {
  return nearest_in(tree_->segments, images_of(p, periods_), nothing);
}

} // namespace trime_check
