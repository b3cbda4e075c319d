// SPDX-License-Identifier: BSD-3-Clause
#include "contours/date_line.hpp"

#include "contours/segment_rings.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace trime::contours {
namespace {

using geometry::Vec2;

/// [degrees] An edge that begins at -180 and is longer gets a vertex at this distance: once -180 is 180, only a short
/// edge obviously crosses the date line.
constexpr double obvious = 45;

/// Returns the side of the date line on which a place lies: 1 at 180, -1 at -180, 0 elsewhere.
int side_of(Vec2 p) {
  if (std::fabs(std::fabs(p.x) - date_line) > on_meridian)
    return 0;
  return p.x > 0 ? 1 : -1;
}

std::size_t after(const ContourRing& ring, std::size_t k) {
  return k + 1 == ring.points.size() ? 0 : k + 1;
}

int marker_of(const ContourRing& ring, std::size_t k) {
  return ring.markers.empty() ? 0 : ring.markers[k];
}

/// The side along which the edge runs; 0 for all other edges.
int side_of_edge(const ContourRing& ring, std::size_t k) {
  const int side = side_of(ring.points[k]);
  return side == side_of(ring.points[after(ring, k)]) ? side : 0;
}

bool has_edge_on_meridian(const ContourRing& ring) {
  for (std::size_t k = 0; k < ring.points.size(); ++k)
    if (side_of_edge(ring, k) != 0)
      return true;
  return false;
}

/// The meridian between neighbouring latitudes of vertices, with the numbers of edges on both sides.
class Meridian {
public:
  explicit Meridian(std::span<const ContourRing> rings) {
    for_each_edge(rings, [&](const ContourRing& ring, std::size_t k, int) {
      latitudes_.push_back(ring.points[k].y);
      latitudes_.push_back(ring.points[after(ring, k)].y);
    });
    std::sort(latitudes_.begin(), latitudes_.end());
    latitudes_.erase(std::unique(latitudes_.begin(), latitudes_.end()), latitudes_.end());
    std::vector<std::pair<int, int>> edges(latitudes_.size(), {0, 0});
    for_each_edge(rings, [&](const ContourRing& ring, std::size_t k, int side) {
      const std::size_t a = index_of(ring.points[k].y), b = index_of(ring.points[after(ring, k)].y);
      for (std::size_t i = std::min(a, b); i < std::max(a, b); ++i)
        ++(side > 0 ? edges[i].first : edges[i].second);
    });
    for (std::size_t i = 0; i + 1 < latitudes_.size(); ++i) {
      const int pairs = std::min(edges[i].first, edges[i].second);
      east_.push_back(pairs);
      west_.push_back(pairs);
      shared_ += pairs > 0 ? latitudes_[i + 1] - latitudes_[i] : 0;
    }
  }

  double shared_length() const { return shared_; }

  /// Calls visit(from, to) with the latitudes of each piece of an edge that stays, in the direction of the edge.
  template <class Visit>
  void for_each_left(double from, double to, int side, const Visit& visit) {
    std::vector<int>& unpaired = side > 0 ? east_ : west_;
    const std::size_t end = index_of(to);
    for (std::size_t i = index_of(from); i != end;) {
      const std::size_t next = i < end ? i + 1 : i - 1;
      if (int& pairs = unpaired[std::min(i, next)]; pairs > 0)
        --pairs;
      else
        visit(latitudes_[i], latitudes_[next]);
      i = next;
    }
  }

private:
  template <class Visit>
  static void for_each_edge(std::span<const ContourRing> rings, const Visit& visit) {
    for (const ContourRing& ring : rings)
      for (std::size_t k = 0; k < ring.points.size(); ++k)
        if (const int side = side_of_edge(ring, k); side != 0)
          visit(ring, k, side);
  }
  std::size_t index_of(double latitude) const {
    return static_cast<std::size_t>(std::lower_bound(latitudes_.begin(), latitudes_.end(), latitude) -
                                    latitudes_.begin());
  }

  std::vector<double> latitudes_;
  std::vector<int> east_, west_; // edges of each side that are still to be removed, by interval
  double shared_ = 0;
};

/// The edges of rings that are cut at the date line, without those on which polygons meet.
class CutRings {
public:
  explicit CutRings(Meridian& meridian) : meridian_(meridian) {}

  void add(const ContourRing& ring) {
    polygon_ = ring.polygon;
    for (std::size_t k = 0; k < ring.points.size(); ++k) {
      const Vec2 a = ring.points[k], b = ring.points[after(ring, k)];
      line_ = ring.lines[k];
      marker_ = marker_of(ring, k);
      if (const int side = side_of_edge(ring, k); side != 0)
        meridian_.for_each_left(a.y, b.y, side, [&](double from, double to) {
          add_edge({date_line, from}, {date_line, to});
        });
      else
        add_path(a, b);
    }
  }

  /// Appends the rings that the edges form.
  void join(Contour& contour) const {
    for (const std::vector<RingVertex>& vertices :
         rings_of_segments(vertices_, segments_, contour.source, contour.warnings)) {
      ContourRing& ring = contour.rings.emplace_back();
      for (const RingVertex& vertex : vertices) {
        ring.points.push_back(vertex.position);
        ring.lines.push_back(origins_[static_cast<std::size_t>(vertex.line)].line);
        ring.markers.push_back(vertex.marker);
      }
      ring.polygon = origins_[static_cast<std::size_t>(vertices[0].line)].polygon;
      if (std::all_of(ring.markers.begin(), ring.markers.end(), [](int marker) { return marker == 0; }))
        ring.markers.clear();
    }
  }

private:
  struct Origin {
    int line, polygon;
  };

  static Vec2 moved(Vec2 p) { return side_of(p) == 0 ? p : Vec2{date_line, p.y}; }

  /// Adds an edge that may be too long to be joined to 180 where it was joined to -180.
  void add_path(Vec2 a, Vec2 b) {
    const auto inner = [](Vec2 from, Vec2 to) { return from + (obvious / (to.x - from.x)) * (to - from); };
    const bool far_from_a = side_of(a) < 0 && b.x - a.x > 2 * obvious && b.x < date_line - on_meridian,
               far_from_b = side_of(b) < 0 && a.x - b.x > 2 * obvious && a.x < date_line - on_meridian;
    if (far_from_a || far_from_b) {
      const Vec2 middle = far_from_a ? inner(a, b) : inner(b, a);
      add_edge(moved(a), middle);
      add_edge(middle, moved(b));
    } else {
      add_edge(moved(a), moved(b));
    }
  }

  void add_edge(Vec2 a, Vec2 b) {
    if (a == b) // along a pole, from 180 to -180
      return;
    const int first = static_cast<int>(vertices_.size());
    for (const Vec2 p : {a, b}) {
      const int index = static_cast<int>(vertices_.size());
      vertices_.push_back({p, index, index + 1});
      origins_.push_back({line_, polygon_});
    }
    segments_.push_back({first, first + 1, marker_, line_});
  }

  Meridian& meridian_;
  std::vector<FileVertex> vertices_; // FileVertex::line is the index of the origin
  std::vector<Origin> origins_;
  std::vector<FileSegment> segments_;
  int line_ = 0, marker_ = 0, polygon_ = 0;
};

/// Returns the index behind the last ring of the polygon to which a ring belongs.
std::size_t end_of_polygon(std::span<const ContourRing> rings, std::size_t first) {
  std::size_t end = first + 1;
  while (end < rings.size() && rings[first].polygon != 0 && rings[end].polygon == rings[first].polygon)
    ++end;
  return end;
}

} // namespace

double join_at_date_line(Contour& contour, DateLine treatment) {
  const double shared = Meridian(contour.rings).shared_length();
  if (!(shared > 0))
    return 0;
  std::vector<ContourRing> rings = std::exchange(contour.rings, {});
  for (std::size_t first = 0, end = 0; first < rings.size(); first = end) {
    end = treatment == DateLine::join ? rings.size() : end_of_polygon(rings, first);
    const std::span<ContourRing> group(rings.begin() + static_cast<std::ptrdiff_t>(first), end - first);
    Meridian meridian(group);
    CutRings cut(meridian);
    for (ContourRing& ring : group)
      if (has_edge_on_meridian(ring))
        cut.add(ring);
      else
        contour.rings.push_back(std::move(ring));
    cut.join(contour);
  }
  return shared;
}

} // namespace trime::contours
