// SPDX-License-Identifier: BSD-3-Clause
#include "projection/straight_edges.hpp"

#include "core/angle.hpp"
#include "geometry/box_tree.hpp"
#include "projection/projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace trime::projection {
namespace {

using contours::Contour;
using contours::ContourRing;
using geometry::Box;
using geometry::Vec2;

/// [longer side of all contours] An edge may deviate by this from its line: 0.01 of the size of the triangles at 10^8
/// points, and 10^7 steps of the coordinate lattice.
constexpr double allowed_share = 1e-6;
/// [longer side in the file] A vertex within this distance of an edge lies on it: files are written with rounded
/// digits.
constexpr double on_edge_share = 1e-10;
constexpr int most_halvings = 12;
/// [degrees] Ends farther from each other in longitude are joined across the date line.
constexpr double wide = 270;

struct End {
  Vec2 in_file, in_plane;
};

/// Converts places on edges, in one reference system.
class EdgeDivider {
public:
  EdgeDivider(const std::string& system, const std::string& plane, double allowed)
      : transform_(system, plane), geographic_(is_geographic(system)), allowed_(allowed) {}

  /// True for edges that surely stay within the allowed distance: the curvature of a line of the map in the plane is
  /// about tan(latitude) divided by the radius of the Earth; four times as much is certain.
  bool is_short(const End& a, const End& b) const {
    const double flat = length(b.in_plane - a.in_plane);
    if (!geographic_ || flat == 0)
      return flat == 0 && a.in_file == b.in_file;
    const double angle = length(b.in_file - a.in_file) * degrees,
                 north = std::fmax(std::fabs(a.in_file.y), std::fabs(b.in_file.y));
    const SinCos latitude = sin_cos(std::fmin(north, 89.99) * degrees);
    return 0.5 * flat * angle * (latitude.sin / latitude.cos + 2) < allowed_;
  }

  /// Returns how far the edge is from its line, at most.
  double deviation(const End& a, const End& b) const {
    double most = 0;
    for (const double t : {0.25, 0.5, 0.75})
      if (const auto p = transform_.apply(between(a.in_file, b.in_file, t)))
        most = std::fmax(most, distance(*p, a.in_plane, b.in_plane));
    return most;
  }
  bool deviates(const End& a, const End& b) const { return !is_short(a, b) && deviation(a, b) > allowed_; }

  /// Appends vertices from a to b, without both.
  void divide(const End& a, const End& b, std::vector<End>& vertices) const {
    const bool turned = lexicographically_less(b.in_file, a.in_file); // one answer for both directions
    const auto first = static_cast<std::ptrdiff_t>(vertices.size());
    turned ? halve(b, a, most_halvings, vertices) : halve(a, b, most_halvings, vertices);
    if (turned)
      std::reverse(vertices.begin() + first, vertices.end());
  }

private:
  Vec2 between(Vec2 a, Vec2 b, double t) const {
    if (const double east = b.x - a.x; geographic_ && std::fabs(east) > wide && std::fabs(east) < 360)
      b.x -= east > 0 ? 360 : -360;
    return a + t * (b - a);
  }

  static double distance(Vec2 p, Vec2 a, Vec2 b) {
    const Vec2 d = b - a;
    const double whole = squared_length(d);
    const double t = whole > 0 ? std::clamp(dot(p - a, d) / whole, 0.0, 1.0) : 0;
    return length(p - (a + t * d));
  }

  void halve(const End& a, const End& b, int halvings, std::vector<End>& vertices) const {
    if (halvings == 0 || !deviates(a, b))
      return;
    End middle{between(a.in_file, b.in_file, 0.5), {}};
    const auto place = transform_.apply(middle.in_file);
    if (!place)
      return;
    middle.in_plane = *place;
    halve(a, middle, halvings - 1, vertices);
    vertices.push_back(middle);
    halve(middle, b, halvings - 1, vertices);
  }

  Transform transform_;
  bool geographic_;
  double allowed_;
};

/// An edge of a contour that may need vertices, with the vertices of files that lie on it.
struct LongEdge {
  std::size_t ring, vertex; ///< ring among all rings of one reference system, and the vertex at which the edge starts
  End from, to;
  std::vector<std::pair<double, End>> on; ///< position along the edge, in the file

  Box box(double margin) const {
    Box box;
    box.include(from.in_file);
    box.include(to.in_file);
    return {box.min - Vec2{margin, margin}, box.max + Vec2{margin, margin}};
  }
};

/// The rings of all contours of one reference system.
class MapEdges {
public:
  MapEdges(std::vector<ContourRing*> rings, const EdgeDivider& divider, double on_edge)
      : rings_(std::move(rings)), divider_(divider), on_edge_(on_edge) {}

  void divide(DividedEdges& divided) {
    std::vector<LongEdge> edges = long_edges(divided);
    if (edges.empty())
      return;
    // Edges along these, even short ones, must have the same vertices.
    for (const ContourRing* ring : rings_)
      marked_.emplace_back(ring->points.size(), 0);
    for (const LongEdge& edge : edges)
      marked_[edge.ring][edge.vertex] = marked_[edge.ring][after(edge.ring, edge.vertex)] = 1;
    find_vertices_on(edges, [&](std::size_t r, std::size_t k, LongEdge&, double) { marked_[r][k] = 1; });
    edges = marked_edges(edges);
    find_vertices_on(edges, [&](std::size_t r, std::size_t k, LongEdge& edge, double along) {
      if (marked_[r][k] != 0)
        edge.on.emplace_back(along, end(r, k));
    });
    add_vertices(edges, divided);
  }

private:
  std::size_t after(std::size_t r, std::size_t k) const { return k + 1 == rings_[r]->points.size() ? 0 : k + 1; }
  /// An open line has no edge from its last vertex.
  bool is_edge(std::size_t r, std::size_t k) const { return !rings_[r]->open || k + 1 < rings_[r]->points.size(); }
  End end(std::size_t r, std::size_t k) const { return {rings_[r]->in_file[k], rings_[r]->points[k]}; }

  std::vector<LongEdge> long_edges(DividedEdges& divided) const {
    std::vector<LongEdge> edges;
    for (std::size_t r = 0; r < rings_.size(); ++r)
      for (std::size_t k = 0; k < rings_[r]->points.size(); ++k)
        if (const End a = end(r, k), b = end(r, after(r, k)); is_edge(r, k) && divider_.deviates(a, b)) {
          divided.deviation = std::fmax(divided.deviation, divider_.deviation(a, b));
          edges.push_back({r, k, a, b, {}});
        }
    return edges;
  }

  /// Edges with both ends on long edges, in addition to those.
  std::vector<LongEdge> marked_edges(const std::vector<LongEdge>& known) const {
    std::vector<LongEdge> edges;
    std::size_t next = 0;
    for (std::size_t r = 0; r < rings_.size(); ++r)
      for (std::size_t k = 0; k < rings_[r]->points.size(); ++k) {
        const bool is_known = next < known.size() && known[next].ring == r && known[next].vertex == k;
        next += is_known ? 1 : 0;
        if (is_known || (is_edge(r, k) && marked_[r][k] != 0 && marked_[r][after(r, k)] != 0))
          edges.push_back({r, k, end(r, k), end(r, after(r, k)), {}});
      }
    return edges;
  }

  /// Calls found(ring, vertex, edge, position) for each vertex on one of the edges, not at its ends.
  template <class Found>
  void find_vertices_on(std::vector<LongEdge>& edges, const Found& found) const {
    std::vector<Box> boxes;
    for (const LongEdge& edge : edges)
      boxes.push_back(edge.box(on_edge_));
    const geometry::BoxTree tree(boxes);
    for (std::size_t r = 0; r < rings_.size(); ++r)
      for (std::size_t k = 0; k < rings_[r]->points.size(); ++k) {
        const Vec2 p = rings_[r]->in_file[k];
        tree.for_each_meeting({p, p}, [&](std::size_t e) {
          const Vec2 d = edges[e].to.in_file - edges[e].from.in_file, u = p - edges[e].from.in_file;
          const double along = dot(u, d), whole = squared_length(d);
          if (std::fabs(d.x) <= wide && along > 0 && along < whole && p != edges[e].to.in_file &&
              std::fabs(cross(d, u)) <= on_edge_ * std::sqrt(whole))
            found(r, k, edges[e], along);
        });
      }
  }

  std::vector<End> vertices_on(LongEdge& edge) const {
    const auto place = [](const std::pair<double, End>& stop) { return stop.second.in_file; };
    std::sort(edge.on.begin(), edge.on.end(), [&](const auto& a, const auto& b) {
      return a.first != b.first ? a.first < b.first : lexicographically_less(place(a), place(b));
    });
    std::vector<End> vertices;
    End last = edge.from;
    for (const auto& stop : edge.on)
      if (stop.second.in_file != last.in_file) {
        divider_.divide(last, stop.second, vertices);
        vertices.push_back(last = stop.second);
      }
    divider_.divide(last, edge.to, vertices);
    return vertices;
  }

  /// @param edges in the order of the rings and vertices
  void add_vertices(std::vector<LongEdge>& edges, DividedEdges& divided) {
    for (std::size_t next = 0; next < edges.size();) {
      const std::size_t r = edges[next].ring;
      ContourRing &ring = *rings_[r], whole;
      for (std::size_t k = 0; k < ring.points.size(); ++k) {
        const int marker = ring.markers.empty() ? 0 : ring.markers[k];
        const auto add = [&](const End& vertex) {
          whole.points.push_back(vertex.in_plane);
          whole.in_file.push_back(vertex.in_file);
          whole.lines.push_back(ring.lines[k]);
          if (!ring.markers.empty())
            whole.markers.push_back(marker);
        };
        add(end(r, k));
        if (next == edges.size() || edges[next].ring != r || edges[next].vertex != k)
          continue;
        const std::vector<End> vertices = vertices_on(edges[next++]);
        std::for_each(vertices.begin(), vertices.end(), add);
        divided.vertices += vertices.size();
        divided.edges += vertices.empty() ? 0 : 1;
      }
      ring.points = std::move(whole.points);
      ring.in_file = std::move(whole.in_file);
      ring.lines = std::move(whole.lines);
      ring.markers = std::move(whole.markers);
    }
  }

  std::vector<ContourRing*> rings_;
  const EdgeDivider& divider_;
  double on_edge_;
  std::vector<std::vector<char>> marked_; // is each vertex on a long edge, or at its end?
};

double longer_side(std::span<const Contour> contours, std::vector<Vec2> ContourRing::*places) {
  Box box;
  for (const Contour& contour : contours)
    for (const ContourRing& ring : contour.rings)
      for (const Vec2 p : ring.*places)
        box.include(p);
  return std::fmax(box.width(), box.height());
}

} // namespace

DividedEdges divide_long_edges(std::span<Contour> contours, const std::string& plane) {
  DividedEdges divided;
  const double side = longer_side(contours, &ContourRing::points);
  if (!(side > 0))
    return divided;
  const double on_edge = on_edge_share * longer_side(contours, &ContourRing::in_file);
  const auto system_of = [](const Contour& contour) {
    return contour.crs.empty() ? std::string(lon_lat) : contour.crs;
  };
  std::vector<std::string> done;
  for (const Contour& first : contours) {
    const std::string system = system_of(first);
    if (first.rings.empty() || std::find(done.begin(), done.end(), system) != done.end())
      continue;
    done.push_back(system);
    std::vector<ContourRing*> rings;
    for (Contour& contour : contours)
      for (ContourRing& ring : contour.rings)
        if (system_of(contour) == system)
          rings.push_back(&ring);
    const EdgeDivider divider(system, plane, allowed_share * side);
    MapEdges(std::move(rings), divider, on_edge).divide(divided);
  }
  return divided;
}

} // namespace trime::projection
