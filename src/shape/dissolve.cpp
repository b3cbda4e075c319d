// SPDX-License-Identifier: BSD-3-Clause
#include "shape/dissolve.hpp"

#include "core/angle.hpp"
#include "geometry/box_tree.hpp"
#include "shape/arrangement.hpp"
#include "shape/contour_polygon.hpp"
#include "shape/part_images.hpp"
#include "shape/region_state.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace trime::shape {
namespace {

using geometry::cross;
using geometry::dot;
using geometry::Frame;
using geometry::length;
using geometry::SegmentGrid;
using geometry::Vec2;

double area_of(std::span<const Vec2> ring) {
  double twice = 0;
  for (std::size_t k = 0; k < ring.size(); ++k)
    twice += cross(ring[k] - ring[0], ring[(k + 1) % ring.size()] - ring[0]);
  return 0.5 * twice;
}

/// One polygon of the map as a part, with line and marker of each of its segments.
struct MapPolygon {
  Part part;
  std::vector<int> lines, markers;
  double area;
};

MapPolygon polygon_of(const std::vector<LatticeRing>& rings) {
  Polygon polygon;
  std::vector<int> lines, markers;
  for (LocalIndex first = 0; const LatticeRing& ring : rings) {
    polygon.rings.push_back({first, static_cast<LocalIndex>(ring.points.size()), false});
    first += polygon.rings.back().count;
    lines.insert(lines.end(), ring.lines.begin(), ring.lines.end());
    markers.insert(markers.end(), ring.markers.begin(), ring.markers.end());
    markers.resize(lines.size(), 0);
  }
  polygon.grid = SegmentGrid(segments_of(rings));
  orient_rings(polygon);
  double area = 0;
  for (std::size_t r = 0; r < rings.size(); ++r)
    area += area_of(rings[r].points) * (polygon.rings[r].reversed ? -1 : 1);
  return {Part::polygon("a polygon", std::move(polygon)), std::move(lines), std::move(markers), area};
}

class Union {
public:
  Union(std::vector<MapPolygon> polygons, const Frame& frame, const std::string& source)
      : polygons_(std::move(polygons)), source_(source), placed_(place()), arrangement_(placed_, frame), frame_(frame) {
  }

  Dissolved make() {
    classify();
    link();
    Dissolved found;
    found.polygons = polygons_.size();
    found.shared_length = shared_length_;
    for (const MapPolygon& polygon : polygons_)
      found.overlap += polygon.area;
    std::vector<bool> used(kept_.size(), false);
    for (std::size_t first = 0; first < kept_.size(); ++first)
      if (!used[first])
        if (LatticeRing ring = ring_from(first, used); ring.points.size() > 2) {
          found.overlap -= area_of(ring.points);
          found.rings.push_back(std::move(ring));
        }
    return found;
  }

private:
  /// A piece of the arrangement with the union on its left.
  struct Kept {
    LocalIndex from, to;
    int polygon;
  };

  std::vector<PlacedPart> place() const {
    std::vector<PlacedPart> placed;
    for (const MapPolygon& polygon : polygons_)
      placed.push_back({&polygon.part, static_cast<int>(placed.size()), {}});
    return placed;
  }
  Vec2 point(LocalIndex vertex) const { return arrangement_.vertices().point(vertex); }

  void classify();
  void keep(const Arrangement::Piece& piece, std::size_t left, std::size_t right);
  void link();
  std::size_t next_of(std::size_t k) const;
  LatticeRing ring_from(std::size_t first, std::vector<bool>& used) const;

  const std::vector<MapPolygon> polygons_;
  const std::string& source_;
  const std::vector<PlacedPart> placed_;
  const Arrangement arrangement_;
  const Frame& frame_;
  std::vector<Kept> kept_;
  std::vector<std::size_t> departing_; // kept pieces, by the vertex at which they start
  double shared_length_ = 0;
};

/// Counts the polygons on both sides of each piece.
void Union::classify() {
  std::vector<geometry::Box> boxes;
  std::vector<InsideWalk> walks;
  for (const PlacedPart& placed : placed_) {
    boxes.push_back(box_of(*placed.part));
    walks.emplace_back(*placed.part);
  }
  const geometry::BoxTree tree(boxes);
  std::vector<std::size_t> seen(placed_.size(), 0); // the last piece, counted from 1, along which each polygon runs
  for (std::size_t number = 1; const Arrangement::Piece& piece : arrangement_.pieces()) {
    std::size_t left = 1, right = 0;
    seen[static_cast<std::size_t>(piece.part)] = number;
    for (LocalIndex t = piece.first_twin; t < piece.first_twin + piece.twin_count; ++t) {
      const Arrangement::Twin& twin = arrangement_.twins()[static_cast<std::size_t>(t)];
      seen[static_cast<std::size_t>(twin.part)] = number;
      ++(twin.along ? left : right);
    }
    const Vec2 a = point(piece.from), b = point(piece.to), middle = frame_.lattice().snap(a + 0.5 * (b - a));
    tree.for_each_meeting({middle, middle}, [&](std::size_t k) {
      if (seen[k] != number && walks[k].inside(middle)) {
        ++left;
        ++right;
      }
    });
    keep(piece, left, right);
    ++number;
  }
}

void Union::keep(const Arrangement::Piece& piece, std::size_t left, std::size_t right) {
  if (piece.twin_count > 0)
    shared_length_ += length(point(piece.to) - point(piece.from));
  if (left > 0 && right == 0)
    kept_.push_back({piece.from, piece.to, piece.part});
  else if (right > 0 && left == 0)
    kept_.push_back({piece.to, piece.from, piece.part});
}

void Union::link() {
  std::vector<int> balance(static_cast<std::size_t>(arrangement_.vertices().size()), 0);
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    departing_.push_back(k);
    ++balance[at(kept_[k].from)];
    --balance[at(kept_[k].to)];
  }
  std::sort(departing_.begin(), departing_.end(), [this](std::size_t a, std::size_t b) {
    return kept_[a].from != kept_[b].from ? kept_[a].from < kept_[b].from : a < b;
  });
  if (const auto wrong = std::find_if(balance.begin(), balance.end(), [](int count) { return count != 0; });
      wrong != balance.end())
    throw GeometryError(fmt::format(
        "{}: borders of polygons nearly coincide at {}: they are nearer than about {:.2g} to each other but not equal; "
        "make them equal, or move them apart",
        source_, Place(point(static_cast<LocalIndex>(wrong - balance.begin())), 12),
        VertexTable::merge_steps * frame_.step()));
}

/// The piece that bounds the same sector of the union: the first one clockwise from the piece that arrives.
std::size_t Union::next_of(std::size_t k) const {
  const LocalIndex vertex = kept_[k].to;
  const auto [first, last] =
      std::equal_range(departing_.begin(), departing_.end(), vertex, [this](const auto& a, const auto& b) {
        const auto start = [this](const auto& x) {
          if constexpr (std::is_same_v<std::decay_t<decltype(x)>, LocalIndex>)
            return x;
          else
            return kept_[x].from;
        };
        return start(a) < start(b);
      });
  const Vec2 back = point(kept_[k].from) - point(vertex);
  std::size_t best = *first;
  double least = 2 * pi;
  for (auto found = first; found != last; ++found) {
    const Vec2 d = point(kept_[*found].to) - point(vertex);
    const double turn = angle_of(cross(d, back), dot(d, back)), clockwise = turn > 0 ? turn : turn + 2 * pi;
    if (clockwise < least) {
      least = clockwise;
      best = *found;
    }
  }
  return best;
}

LatticeRing Union::ring_from(std::size_t first, std::vector<bool>& used) const {
  LatticeRing ring;
  for (std::size_t k = first; !used[k]; k = next_of(k)) {
    used[k] = true;
    const Vec2 a = point(kept_[k].from), b = point(kept_[k].to);
    const MapPolygon& polygon = polygons_[static_cast<std::size_t>(kept_[k].polygon)];
    const auto segment = at(polygon.part.as_polygon()->grid.nearest(a + 0.5 * (b - a)).segment);
    ring.points.push_back(a);
    ring.lines.push_back(polygon.lines[segment]);
    ring.markers.push_back(polygon.markers[segment]);
  }
  return ring;
}

} // namespace

Dissolved dissolve(const std::vector<LatticeRing>& rings, const Frame& frame, const std::string& source) {
  std::map<int, std::vector<LatticeRing>> by_polygon;
  for (const LatticeRing& ring : rings)
    by_polygon[ring.polygon].push_back(ring);
  std::vector<MapPolygon> polygons;
  for (const auto& [number, its_rings] : by_polygon)
    polygons.push_back(polygon_of(its_rings));
  return Union(std::move(polygons), frame, source).make();
}

} // namespace trime::shape
