// SPDX-License-Identifier: BSD-3-Clause
#include "inside.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/segment.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>

namespace trime_check {

double InsideTest::Side::x_at(double y) const {
  return y == b.y ? b.x : a.x + (y - a.y) * (b.x - a.x) / (b.y - a.y);
}

bool InsideTest::Side::is_right_of(Point p) const {
  return p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y);
}

InsideTest::InsideTest(const std::vector<Ring>& rings) {
  for (const Ring& ring : rings)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      heights_.push_back(ring[k].y);
      if (const Side side{ring[k], ring[(k + 1) % ring.size()]}; side.a.y != side.b.y)
        sides_.push_back(side);
    }
  std::ranges::sort(heights_);
  heights_.erase(std::unique(heights_.begin(), heights_.end()), heights_.end());
  leaves_ = std::bit_ceil(heights_.size() + 1);
  nodes_.resize(2 * leaves_);
  for (const Side& side : sides_)
    visit_nodes(side, [&](std::size_t node) { ++nodes_[node].end; });
  std::size_t total = 0;
  for (Node& node : nodes_) {
    const std::size_t count = node.end;
    node.begin = node.end = total;
    total += count;
  }
  order_.resize(total);
  for (std::size_t k = 0; k < sides_.size(); ++k)
    visit_nodes(sides_[k], [&](std::size_t node) { order_[nodes_[node].end++] = static_cast<std::uint32_t>(k); });
  for (std::size_t node = 1; node < nodes_.size(); ++node)
    sort_node(node);
}

std::size_t InsideTest::heights_below(double y) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(heights_, y) - heights_.begin());
}

/// The nodes that together make up the height of a side.
template <class Visit>
void InsideTest::visit_nodes(const Side& side, const Visit& visit) const {
  const auto [low, high] = std::minmax(side.a.y, side.b.y);
  std::size_t first = leaves_ + heights_below(low) - 1, end = leaves_ + heights_below(high) - 1;
  for (; first < end; first /= 2, end /= 2) {
    if (first % 2 == 1)
      visit(first++);
    if (end % 2 == 1)
      visit(--end);
  }
}

void InsideTest::sort_node(std::size_t number) {
  Node& node = nodes_[number];
  if (node.begin == node.end)
    return;
  const std::size_t height = leaves_ / std::bit_floor(number), band = (number - std::bit_floor(number)) * height;
  const double low = heights_[band], high = heights_[band + height];
  struct Crossing {
    double low, high;
    std::uint32_t side;
  };
  std::vector<Crossing> crossings;
  for (std::size_t k = node.begin; k < node.end; ++k)
    crossings.push_back({sides_[order_[k]].x_at(low), sides_[order_[k]].x_at(high), order_[k]});
  std::ranges::sort(crossings, {}, [](const Crossing& c) { return std::tuple(c.low, c.high, c.side); });
  node.is_sorted = std::ranges::is_sorted(crossings, {}, &Crossing::high);
  for (std::size_t k = 0; k < crossings.size(); ++k)
    order_[node.begin + k] = crossings[k].side;
}

bool InsideTest::contains(Point p) const {
  const std::size_t below = heights_below(p.y);
  if (below == 0 || below == heights_.size())
    return false;
  bool inside = false;
  for (std::size_t number = leaves_ + below - 1; number > 0; number /= 2) {
    const Node& node = nodes_[number];
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(node.begin);
    const auto end = order_.begin() + static_cast<std::ptrdiff_t>(node.end);
    const auto is_right = [&](std::uint32_t side) { return sides_[side].is_right_of(p); };
    const auto count = node.is_sorted ? end - std::partition_point(begin, end, std::not_fn(is_right))
                                      : std::count_if(begin, end, is_right);
    inside = inside != (count % 2 == 1);
  }
  return inside;
}

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
