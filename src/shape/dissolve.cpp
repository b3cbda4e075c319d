// SPDX-License-Identifier: BSD-3-Clause
#include "shape/dissolve.hpp"

#include "core/angle.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/even_odd.hpp"
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

/// Does the ring contain a point that is not on it?
bool holds(std::span<const Vec2> ring, Vec2 p) {
  bool inside = false;
  for (std::size_t k = 0; k < ring.size(); ++k)
    inside = inside != geometry::crosses_ray(ring[k], ring[(k + 1) % ring.size()], p);
  return inside;
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
  Union(std::vector<MapPolygon> polygons, const Frame& frame, const DissolveOptions& options)
      : polygons_(std::move(polygons)), options_(options), placed_(place()), arrangement_(placed_, frame),
        frame_(frame) {}

  Dissolved make() {
    Dissolved found;
    is_shown_.assign(polygons_.size(), false);
    classify();
    for (std::size_t k = 0; k < polygons_.size(); ++k)
      if (!is_shown_[k])
        found.covered.push_back(polygons_[k].lines[0]);
    std::sort(found.covered.begin(), found.covered.end());
    link();
    if (options_.widest_gap > 0)
      close_gaps(found);
    found.polygons = polygons_.size();
    found.shared_length = shared_length_;
    for (const MapPolygon& polygon : polygons_)
      found.overlap += polygon.area;
    found.overlap += found.gap_area;
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

  /// A hole of the union, as a ring of kept pieces.
  struct Gap {
    std::vector<std::size_t> pieces;
    std::vector<Vec2> ring;
    double area;
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
  void note_shown(const Arrangement::Piece& piece, std::size_t left, std::size_t right);
  void link();
  /// Which of the pieces that depart from the end of a piece follows it.
  enum class Side {
    inner, ///< the next one around the union: both bound one sector of the union
    outer, ///< the next one around what lies outside
  };
  std::size_t next_of(std::size_t k, Side side) const;
  std::vector<Gap> gaps() const;
  void close_gaps(Dissolved& found);
  LatticeRing ring_from(std::size_t first, std::vector<bool>& used) const;

  const std::vector<MapPolygon> polygons_;
  const DissolveOptions& options_;
  const std::vector<PlacedPart> placed_;
  const Arrangement arrangement_;
  const Frame& frame_;
  std::vector<Kept> kept_;
  std::vector<bool> is_shown_;         // of each polygon: does a piece of it bound the union, or a gap between others?
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
    note_shown(piece, left, right);
    keep(piece, left, right);
    ++number;
  }
}

/// A polygon along a piece shows there, unless others cover both sides of the piece.
void Union::note_shown(const Arrangement::Piece& piece, std::size_t left, std::size_t right) {
  const auto note = [&](int polygon, bool on_left) {
    if ((on_left ? left - 1 : left) == 0 || (on_left ? right : right - 1) == 0)
      is_shown_[static_cast<std::size_t>(polygon)] = true;
  };
  note(piece.part, true);
  for (LocalIndex t = piece.first_twin; t < piece.first_twin + piece.twin_count; ++t) {
    const Arrangement::Twin& twin = arrangement_.twins()[static_cast<std::size_t>(t)];
    note(twin.part, twin.along);
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
  departing_.clear();
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
        options_.source, options_.in_file(point(static_cast<LocalIndex>(wrong - balance.begin()))),
        VertexTable::merge_steps * frame_.step()));
}

/// The first piece clockwise (inner) or counter-clockwise (outer) from the piece that arrives.
std::size_t Union::next_of(std::size_t k, Side side) const {
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
    const double turn = angle_of(cross(d, back), dot(d, back)), clockwise = turn > 0 ? turn : turn + 2 * pi,
                 angle = side == Side::inner ? clockwise : 2 * pi - clockwise;
    if (angle < least) {
      least = angle;
      best = *found;
    }
  }
  return best;
}

/// Holes of the union between two or more polygons that are narrow and have nothing inside.
std::vector<Union::Gap> Union::gaps() const {
  std::vector<Gap> narrow;
  std::vector<geometry::Box> boxes;
  std::vector<Vec2> islands; // a vertex of each ring around a component of the union
  std::vector<bool> used(kept_.size(), false);
  for (std::size_t first = 0; first < kept_.size(); ++first) {
    Gap gap;
    double around = 0;
    bool of_one = true;
    for (std::size_t k = first; !used[k]; k = next_of(k, Side::outer)) {
      used[k] = true;
      gap.pieces.push_back(k);
      gap.ring.push_back(point(kept_[k].from));
      around += length(point(kept_[k].to) - point(kept_[k].from));
      of_one = of_one && kept_[k].polygon == kept_[first].polygon;
    }
    gap.area = gap.ring.empty() ? 0 : -area_of(gap.ring);
    if (gap.area < 0)
      islands.push_back(gap.ring[0]);
    else if (gap.area > 0 && !of_one && 2 * gap.area < options_.widest_gap * around) {
      boxes.push_back(geometry::Box());
      for (const Vec2 p : gap.ring)
        boxes.back().include(p);
      narrow.push_back(std::move(gap));
    }
  }
  const geometry::BoxTree tree(boxes);
  for (const Vec2 island : islands)
    tree.for_each_meeting({island, island}, [&](std::size_t k) {
      if (holds(narrow[k].ring, island))
        narrow[k].pieces.clear();
    });
  std::erase_if(narrow, [](const Gap& gap) { return gap.pieces.empty(); });
  return narrow;
}

void Union::close_gaps(Dissolved& found) {
  const std::vector<Gap> closed = gaps();
  if (closed.empty())
    return;
  std::vector<bool> gone(kept_.size(), false);
  for (const Gap& gap : closed) {
    ++found.gaps;
    found.gap_area += gap.area;
    for (const std::size_t k : gap.pieces)
      gone[k] = true;
  }
  std::vector<Kept> left;
  for (std::size_t k = 0; k < kept_.size(); ++k)
    if (!gone[k])
      left.push_back(kept_[k]);
  kept_ = std::move(left);
  link();
}

LatticeRing Union::ring_from(std::size_t first, std::vector<bool>& used) const {
  LatticeRing ring;
  for (std::size_t k = first; !used[k]; k = next_of(k, Side::inner)) {
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

Dissolved dissolve(const std::vector<LatticeRing>& rings, const Frame& frame, const DissolveOptions& options) {
  std::map<int, std::vector<LatticeRing>> by_polygon;
  for (const LatticeRing& ring : rings)
    by_polygon[ring.polygon].push_back(ring);
  std::vector<MapPolygon> polygons;
  for (const auto& [number, its_rings] : by_polygon)
    polygons.push_back(polygon_of(its_rings));
  return Union(std::move(polygons), frame, options).make();
}

} // namespace trime::shape
