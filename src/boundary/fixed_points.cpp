// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/fixed_points.hpp"

#include "boundary/feature_rule.hpp"
#include "boundary/rules.hpp"
#include "geometry/cornered_boundary.hpp"
#include "sizing/size_blocks.hpp"
#include "trime/core/error.hpp"
#include "trime/geometry/piece_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace trime::boundary {

using geometry::Vec2;
using polygon::BoundaryGuard;

namespace {

SiteTree tree_of(const std::vector<Vec2>& points) {
  std::vector<SiteTree::Entry> items;
  for (std::size_t k = 0; k < points.size(); ++k)
    items.push_back({points[k], static_cast<LocalIndex>(k)});
  return SiteTree(std::move(items));
}

/// Points in square cells of one side, to find those nearer than it.
class NearPoints {
public:
  /// @param origin so near to all points that they lie in fewer than 2^62 cells along each axis
  NearPoints(Vec2 origin, double side) : origin_(origin), side_(side) {}
  void add(Vec2 p) { cells_[cell_of(p)].push_back(p); }
  /// The first one in lexicographic order that is at most the side from p.
  std::optional<Vec2> first_near(Vec2 p) const {
    std::optional<Vec2> first;
    const auto [i, j] = cell_of(p);
    for (const std::int64_t column : {i - 1, i, i + 1})
      for (const std::int64_t row : {j - 1, j, j + 1})
        if (const auto cell = cells_.find({column, row}); cell != cells_.end())
          for (const Vec2 q : cell->second)
            if (geometry::length(q - p) <= side_ && (!first || lexicographically_less(q, *first)))
              first = q;
    return first;
  }

private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  Cell cell_of(Vec2 p) const {
    return {static_cast<std::int64_t>(std::floor((p.x - origin_.x) / side_)),
            static_cast<std::int64_t>(std::floor((p.y - origin_.y) / side_))};
  }

  Vec2 origin_;
  double side_;
  std::map<Cell, std::vector<Vec2>> cells_;
};

/// A point is nearer than the local size to something else.
struct Closeness {
  std::size_t count = 0;
  double least = std::numeric_limits<double>::infinity(); // distance over size
  double distance = 0;
  Vec2 first, second;
  bool to_boundary = false;
};

} // namespace

FixedPoints::FixedPoints(const geometry::Boundary& boundary, const geometry::Box& box,
                         std::span<const FixedPoint> given, const geometry::Lattice& lattice, Log& log)
    : given_boundary_(boundary), given_(given), lattice_(lattice),
      tolerance_(BoundaryRules::on_boundary * std::max(box.width(), box.height())), tree_({}) {
  std::vector<Vec2> places;
  for (const FixedPoint& point : given) {
    const Vec2 p = point.position;
    if (!std::isfinite(p.x) || !std::isfinite(p.y))
      throw GeometryError(fmt::format("{}: expected finite coordinates, found ({}, {})", point.label, p.x, p.y));
    const bool beyond = (boundary.periods.x == 0 && (p.x < box.min.x || p.x > box.max.x)) ||
                        (boundary.periods.y == 0 && (p.y < box.min.y || p.y > box.max.y));
    if (beyond)
      throw GeometryError(fmt::format("{}: the fixed point ({}, {}) lies outside the container [{}, {}] x [{}, {}]; "
                                      "expected a point in the shape",
                                      point.label, p.x, p.y, box.min.x, box.max.x, box.min.y, box.max.y));
    places.push_back(boundary.periods.wrap(lattice.snap(p)));
  }
  std::vector<std::size_t> order(given.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return lexicographically_less(places[a], places[b]); });
  for (const std::size_t k : order) {
    if (!all_.empty() && all_.back() == places[k]) {
      log.warning("{}: the fixed point ({}, {}) is the same as that of {}; it is kept once", given[k].label,
                  given[k].position.x, given[k].position.y, given[source_.back()].label);
      continue;
    }
    all_.push_back(places[k]);
    source_.push_back(k);
  }
  if (!all_.empty())
    take_corners();
  tree_ = tree_of(inside_);
}

/// Divides the points into those on the boundary, which become corners of it, and the others.
void FixedPoints::take_corners() {
  const geometry::Boundary& boundary = given_boundary_;
  const geometry::PieceTree pieces(boundary);
  std::optional<geometry::CorneredBoundary> cornered; // takes more memory than the boundary
  NearPoints on_curve(boundary.bounding_box().min, tolerance_);
  for (const Vec2 p : all_) {
    if (pieces.distance(p) > tolerance_) {
      inside_.push_back(p);
      continue;
    }
    // If two points are nearer to each other than the tolerance for "on the boundary", only one of them could be a
    // corner.
    for (const Vec2 shift : geometry::images_of(boundary.periods))
      if (const std::optional<Vec2> q = on_curve.first_near(p + shift))
        throw GeometryError(
            fmt::format("{}: the fixed point {} on the boundary is {:.2g} from that of {}: expected the same point "
                        "or a distance above {:.2g}; take out one of them",
                        label(p), Place(p, 12), geometry::length(*q - (p + shift)), label(*q), tolerance_));
    if (!cornered)
      cornered.emplace(boundary, pieces, tolerance_);
    cornered->add_corner(p);
    on_curve.add(p);
  }
  if (cornered)
    cornered_ = cornered->result();
}

namespace {

/// Points inside a piece that are at most `spacing` apart.
std::vector<Vec2> points_between(const geometry::Piece& piece, double spacing, const geometry::Lattice& lattice) {
  const double length = piece.length(), parts = std::fmax(1, std::ceil(length / spacing));
  std::vector<Vec2> points;
  for (int k = 1; k < static_cast<int>(parts); ++k)
    points.push_back(lattice.snap(piece.point(k / parts * length)));
  return points;
}

/// Returns the distance of a piece from the nearest periodic image of a point.
double distance_of_images(const geometry::Piece& piece, Vec2 p, const geometry::Periods& periods) {
  const Vec2 near = periods.nearest_image(p, 0.5 * (piece.start + piece.end));
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2 shift : geometry::images_of(periods))
    least = std::fmin(least, piece.distance(near + shift));
  return least;
}

} // namespace

void FixedPoints::hold(const geometry::Domain& domain) {
  const geometry::InnerCurves& curves = domain.curves();
  if (curves.empty())
    return;
  const geometry::Periods& periods = given_boundary_.periods;
  const geometry::Box box = given_boundary_.bounding_box();
  const double spacing = BoundaryRules::held_spacing * std::max(box.width(), box.height());
  std::vector<Vec2> nodes;
  for (const geometry::InnerArc& arc : curves.arcs)
    for (const geometry::Piece& piece : arc.pieces) {
      const Vec2 start = periods.wrap(piece.start), end = periods.wrap(piece.end);
      const bool is_first = &piece == &arc.pieces.front(), is_last = &piece == &arc.pieces.back();
      if (!is_first || arc.closed)
        held_.push_back(start);
      for (const Vec2 p : points_between(piece, spacing, lattice_))
        held_.push_back(periods.wrap(p));
      if (is_first)
        nodes.push_back(start);
      if (is_last)
        nodes.push_back(end);
      for (const Vec2 p : inside_)
        if (p == start || p == end)
          on_curves_.push_back(p);
        else if (distance_of_images(piece, p, periods) <= tolerance_)
          throw GeometryError(fmt::format("{}: the fixed point {} lies on the {}, but is not a vertex of it; "
                                          "make it a vertex of the curve or of a part instead",
                                          label(p), Place(p, 12), domain.line_name(piece.part, arc.left, arc.right)));
    }
  const geometry::PieceTree boundary(given_boundary_);
  std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(held_),
               [&](Vec2 p) { return boundary.distance(p) > tolerance_; });
  std::sort(on_curves_.begin(), on_curves_.end(), geometry::lexicographically_less);
  std::erase_if(inside_, [this](Vec2 p) {
    return std::binary_search(on_curves_.begin(), on_curves_.end(), p, geometry::lexicographically_less);
  });
  tree_ = tree_of(inside_);
  held_.insert(held_.end(), inside_.begin(), inside_.end());
  std::sort(held_.begin(), held_.end(), geometry::lexicographically_less);
  held_.erase(std::unique(held_.begin(), held_.end()), held_.end());
}

const std::string& FixedPoints::label(Vec2 p) const {
  const auto found = std::lower_bound(all_.begin(), all_.end(), p, geometry::lexicographically_less);
  return given_[source_[static_cast<std::size_t>(found - all_.begin())]].label;
}

void FixedPoints::check_inside(const BoundaryGuard& guard, std::span<const geometry::Loop> left_out) const {
  for (const Vec2 p : inside_) {
    if (guard.inside(p))
      continue;
    if (lies_within(left_out, p))
      throw GeometryError(fmt::format("{}: the fixed point {} lies in a component of the shape that "
                                      "meshing.components leaves out; expected a point in the component that is "
                                      "meshed. Take the point out, or set components = all",
                                      label(p), Place(p)));
    const geometry::PieceTree pieces(cornered_boundary());
    double distance = std::numeric_limits<double>::infinity();
    for (const Vec2 shift : geometry::images_of(given_boundary_.periods))
      distance = std::fmin(distance, pieces.distance(p + shift));
    throw GeometryError(fmt::format("{}: the fixed point {} lies outside the shape, {:.6g} from its boundary; "
                                    "expected a point inside, or on the boundary to within {:.2g}",
                                    label(p), Place(p), distance, tolerance_));
  }
}

void FixedPoints::check_distances(double shortest_edge) const {
  if (all_.size() < 2 || !(shortest_edge > 0))
    return;
  const SiteTree tree = tree_of(all_);
  for (std::size_t k = 0; k < all_.size(); ++k)
    for (const Vec2 shift : geometry::images_of(given_boundary_.periods))
      tree.for_each_within(all_[k] + shift, shortest_edge, [&](const SiteTree::Entry& other) {
        if (static_cast<std::size_t>(other.index) != k)
          throw GeometryError(fmt::format("the fixed points {} and {} are {:.6g} apart, but shortest_edge = {:g} in "
                                          "[sizing] allows no edge that short: take one of them out, or set a smaller "
                                          "shortest_edge",
                                          Place(all_[k]), Place(other.position),
                                          geometry::length(all_[k] + shift - other.position), shortest_edge));
      });
}

/// Is a point of inside_ nearer to p?
bool FixedPoints::is_near(Vec2 p, double distance) const {
  const Vec2 across{distance, 0};
  for (const Vec2 shift : geometry::images_of(given_boundary_.periods))
    if (tree_.find_in_disc(lattice_.snap(p + shift - across), lattice_.snap(p + shift + across), -1, -1) >= 0)
      return true;
  return false;
}

std::int64_t FixedPoints::count_clear(std::span<const mesh::Site> sites, const sizing::SizeField& size) const {
  std::vector<std::uint8_t> clear(sites.size());
  sizing::loop_over_blocks(size, std::ssize(sites), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    std::vector<Vec2> places;
    for (std::ptrdiff_t k = begin; k < end; ++k)
      places.push_back(sites[static_cast<std::size_t>(k)].position);
    const std::vector<double> sizes = sizing::sizes_at(size, places);
    for (std::size_t k = 0; k < places.size(); ++k)
      clear[static_cast<std::size_t>(begin) + k] = !is_near(places[k], BoundaryRules::fixed_clearance * sizes[k]);
  });
  return std::count(clear.begin(), clear.end(), std::uint8_t{1});
}

void FixedPoints::place_among(mesh::SiteList& sites, const mesh::TileRange& tiles,
                              const sizing::SizeField& size) const {
  if (inside_.empty())
    return;
  std::vector<std::uint8_t> taken(sites.size());
  sizing::loop_over_blocks(size, std::ssize(sites), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    std::vector<Vec2> places;
    std::vector<std::size_t> numbers;
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
      if (sites[k].boundary == mesh::free_site) {
        places.push_back(sites[k].position);
        numbers.push_back(k);
      }
    const std::vector<double> sizes = sizing::sizes_at(size, places);
    for (std::size_t k = 0; k < places.size(); ++k)
      taken[numbers[k]] = is_near(places[k], BoundaryRules::fixed_clearance * sizes[k]);
  });
  std::size_t kept = 0;
  for (std::size_t k = 0; k < sites.size(); ++k)
    if (!taken[k])
      sites[kept++] = sites[k];
  sites.resize(kept);
  for (const Vec2 p : inside_) {
    const LocalIndex tile = tiles.grid.place(p).tile;
    if (tile >= tiles.first && tile < tiles.last)
      sites.push_back({p, mesh::fixed_site});
  }
}

void FixedPoints::warn_of_close_ones(const BoundaryGuard& guard, const sizing::SizeField& size, Log& log) const {
  Closeness close;
  std::vector<std::uint8_t> is_close(inside_.size(), 0);
  std::vector<std::size_t> near;
  const auto note = [&](Vec2 p, Vec2 other, double distance, double h, bool to_boundary) {
    if (distance / h < close.least)
      close = {0, distance / h, distance, p, other, to_boundary};
  };
  for (std::size_t k = 0; k < inside_.size(); ++k) {
    const Vec2 p = inside_[k];
    const double h = size.size(p);
    if (const double distance = guard.distance(p, h); distance < h) {
      is_close[k] = 1;
      note(p, p, distance, h, true);
    }
    near.clear();
    tree_.for_each_within(p, h * (1 + 1e-12), [&](const SiteTree::Entry& other) {
      if (const auto j = static_cast<std::size_t>(other.index); j > k)
        near.push_back(j);
    });
    std::sort(near.begin(), near.end());
    for (const std::size_t j : near)
      if (const double distance = geometry::length(inside_[j] - p); distance < h) {
        is_close[k] = is_close[j] = 1;
        note(p, inside_[j], distance, h, false);
      }
  }
  const auto count = std::count(is_close.begin(), is_close.end(), 1);
  if (count == 0)
    return;
  const std::string what =
      close.to_boundary
          ? fmt::format("{} lies at a distance of {:.3g} from the boundary", Place(close.first), close.distance)
          : fmt::format("{} and {} are {:.3g} apart", Place(close.first), Place(close.second), close.distance);
  log.warning("{} of {} fixed points inside are nearer to each other or to the boundary than the local size: expect "
              "small angles there. The worst case: {}, which is {:.2g} times the size",
              count, inside_.size(), what, close.least);
}

} // namespace trime::boundary
