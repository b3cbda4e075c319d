// SPDX-License-Identifier: BSD-3-Clause
#include "cover.hpp"

#include "exact.hpp"
#include "inside.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>

namespace trime_check {
namespace {

// Samples of all curves together: about one a facet, and enough of them where there are few facets.
constexpr double least_samples = 64;
// [longer side of the container] The two sides of a curve are asked so far from it, or at this share of a piece of it.
constexpr double beside = 1e-7, beside_share = 1e-2;
// [longer side of the container] A place nearer than this counts as on the curve.
constexpr double least_beside = 1e-11;
// Places in a row and in a column of the grid over the shape.
constexpr int grid_places = 128;

namespace index = boost::geometry::index;
using Place = boost::geometry::model::d2::point_xy<double>;
using PlaceBox = boost::geometry::model::box<Place>;
using BoxTree = index::rtree<std::pair<PlaceBox, std::size_t>, index::rstar<16>>;

/// The boxes of a tree around a place or its images, until one is accepted.
template <class Accept>
bool any_around(const BoxTree& tree, const std::vector<Point>& images, const Accept& accept) {
  for (const Point image : images)
    for (auto at = tree.qbegin(index::intersects(Place(image.x, image.y))); at != tree.qend(); ++at)
      if (accept(image, at->second))
        return true;
  return false;
}

BoxTree boxes_of(const std::vector<ChangedLoop>& loops) {
  std::vector<std::pair<PlaceBox, std::size_t>> boxes;
  for (const ChangedLoop& loop : loops) {
    const double reach = loop.length / 2;
    boxes.emplace_back(
        PlaceBox({loop.place.x - reach, loop.place.y - reach}, {loop.place.x + reach, loop.place.y + reach}),
        boxes.size());
  }
  return BoxTree(boxes);
}

BoxTree boxes_of(const Mesh& mesh) {
  std::vector<std::pair<PlaceBox, std::size_t>> boxes;
  for (const Triangle& t : mesh.triangles) {
    const auto [a, b, c] = mesh.corners(t);
    boxes.emplace_back(PlaceBox({std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})},
                                {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})}),
                       boxes.size());
  }
  return BoxTree(boxes);
}

class Cover {
public:
  Cover(const Shape& shape, const Mesh& mesh, const Changes& changes, Report& report)
      : shape_(shape), mesh_(mesh), changes_(changes), report_(report), facets_(mesh) {}

  void run() {
    check_triangles();
    check_curves();
    check_grid();
  }

private:
  /// @brief Returns how far the boundary may lie from the curves at the nearest facet. Its length counts where it is
  /// longer than was asked: a size that jumps is different on the rest of its curve.
  double reach(const Nearest& facet) const {
    if (mesh_.facets.empty())
      return 0;
    const Facet& ends = mesh_.facets[facet.number];
    const Point a = mesh_.at(ends[0]), d = mesh_.periods.near(mesh_.at(ends[1]), a) - a;
    return changes_.stray * std::max(mesh_.asked_sizes[facet.number], std::hypot(d.x, d.y));
  }

  /// Returns the same distance at a triangle, which may lie where a hole was filled, far from any facet.
  double reach(const Triangle& triangle, Point middle) const {
    double size = 0;
    for (const std::int64_t id : triangle)
      size = std::max(size, mesh_.size[static_cast<std::size_t>(id)]);
    return std::max(changes_.stray * size, reach(facets_.nearest(middle)));
  }

  void check_triangles() {
    Tally outside;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto [a, b, c] = mesh_.corners(mesh_.triangles[t]);
      const Point middle{(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3};
      if (shape_.contains(middle))
        continue;
      const double limit = reach(mesh_.triangles[t], middle);
      if (shape_.distance_from_any(middle, limit) > limit)
        outside.note([&] { return place_of(mesh_, t); });
    }
    report_.none("outside", outside,
                 fmt::format("triangles whose centroid lies outside the shape by more than {:.3g} h", changes_.stray));
  }

  bool bounds_shape(const CurveSample& sample) const {
    const double step = std::min(beside * shape_.side(), beside_share * sample.length);
    const Point off{step * sample.normal.x, step * sample.normal.y};
    return step > least_beside * shape_.side() &&
           shape_.contains(sample.place + off) != shape_.contains(sample.place - off);
  }

  double spacing() const {
    double length = 0;
    for (const Part& part : used_parts())
      length += part.curve->length();
    return length / std::max(least_samples, static_cast<double>(mesh_.facets.size()));
  }

  std::vector<std::reference_wrapper<const Part>> used_parts() const {
    std::vector<std::reference_wrapper<const Part>> used;
    for (std::size_t k = 0; k < shape_.parts.size(); ++k)
      if (shape_.region->uses(k))
        used.emplace_back(shape_.parts[k]);
    return used;
  }

  void check_curves() {
    if (!changes_.are_known) {
      report_.skip("uncovered_curves", "the file does not say which loops were simplified, because it is an "
                                       "intermediate step of a run or has no table `rings`");
      return;
    }
    const BoxTree changed = boxes_of(changes_.loops);
    Tally bare;
    std::int64_t judged = 0, left_out = 0;
    const double spacing = this->spacing();
    for (const Part& part : used_parts())
      for (const CurveSample& sample : part.curve->samples(spacing)) {
        if (!bounds_shape(sample))
          continue;
        const Nearest facet = facets_.nearest(shape_.images(sample.place).front());
        ++judged;
        if (facet.distance <= reach(facet))
          continue;
        if (any_around(changed, shape_.images(sample.place), [](Point, std::size_t) { return true; }))
          ++left_out;
        else
          bare.note([&] { return fmt::format("{} of {}", place_of(sample.place), part.name); });
      }
    report_.none("uncovered_curves", bare,
                 fmt::format("places without a facet within {1:.3g} h, among {0} places on the curves around the shape",
                             judged, changes_.stray));
    if (left_out > 0)
      report_.skip(
          "uncovered_loops",
          fmt::format(
              "{} places on curves have no facet nearby, because the shape was simplified there; number of loops "
              "that were simplified or dropped: {}",
              left_out, changes_.loops.size()));
  }

  /// The box of the parts of the region within the container.
  Box grid_box() const {
    const Box& all = shape_.container;
    if (shape_.periods.any())
      return all;
    Box box{all.max, all.min};
    for (const Part& part : used_parts()) {
      const Box own = part.curve->box();
      box = {{std::min(box.min.x, own.min.x), std::min(box.min.y, own.min.y)},
             {std::max(box.max.x, own.max.x), std::max(box.max.y, own.max.y)}};
    }
    return {{std::max(box.min.x, all.min.x), std::max(box.min.y, all.min.y)},
            {std::min(box.max.x, all.max.x), std::min(box.max.y, all.max.y)}};
  }

  void check_grid() {
    double largest = 0; // islands may be dropped where no facet is near, so no place knows its own h
    for (const std::vector<double>* sizes : {&mesh_.size, &mesh_.asked_sizes})
      for (const double size : *sizes)
        largest = std::max(largest, size);
    const double depth = changes_.stray * largest;
    const BoxTree triangles = boxes_of(mesh_);
    const Box box = grid_box();
    Tally bare;
    std::int64_t judged = 0, left_out = 0;
    const bool any_changed = !changes_.are_known || !changes_.loops.empty();
    for (int i = 0; i < grid_places; ++i)
      for (int j = 0; j < grid_places; ++j) {
        const Point p{box.min.x + (i + 0.5) / grid_places * (box.max.x - box.min.x),
                      box.min.y + (j + 0.5) / grid_places * (box.max.y - box.min.y)};
        if (!shape_.contains(p))
          continue;
        ++judged;
        if (is_covered(triangles, p) || is_beside_facet(p))
          continue;
        if (any_changed && shape_.distance_from_any(p, depth) <= depth)
          ++left_out;
        else
          bare.note([&] { return place_of(p); });
      }
    const std::string narrow =
        left_out == 0 ? ""
                      : fmt::format("; {} more within {:.3g} of curves are not counted, because loops were simplified",
                                    left_out, depth);
    if (judged == 0)
      report_.skip("uncovered_places", "no node of the test grid lies in the shape");
    else
      report_.none(
          "uncovered_places", bare,
          fmt::format("places in no triangle and farther than {1:.3g} h from facets, among {0} places in the shape{2}",
                      judged, changes_.stray, narrow));
  }

  bool is_beside_facet(Point p) const {
    const Nearest facet = facets_.nearest(p);
    return facet.distance <= reach(facet);
  }

  bool is_covered(const BoxTree& triangles, Point p) const {
    return any_around(triangles, images_of(p, mesh_.periods), [&](Point image, std::size_t t) {
      const auto [a, b, c] = mesh_.corners(mesh_.triangles[t]);
      return !is_left_turn(b, a, image) && !is_left_turn(c, b, image) && !is_left_turn(a, c, image);
    });
  }

  const Shape& shape_;
  const Mesh& mesh_;
  const Changes& changes_;
  Report& report_;
  FacetFinder facets_;
};

} // namespace

void check_cover(const Shape& shape, const Mesh& mesh, const Changes& changes, Report& report) {
  Cover(shape, mesh, changes, report).run();
}

} // namespace trime_check
