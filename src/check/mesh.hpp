// SPDX-License-Identifier: BSD-3-Clause
// The arrays of a mesh file as they are stored, and periodic images of points.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace trime_check {

struct Point {
  double x = 0, y = 0;
};
inline Point operator-(Point a, Point b) {
  return {a.x - b.x, a.y - b.y};
}
inline Point operator+(Point a, Point b) {
  return {a.x + b.x, a.y + b.y};
}

using Triangle = std::array<std::int64_t, 3>;
using Facet = std::array<std::int64_t, 2>;

/// Periods of the container; 0 along an axis that is not periodic.
struct Periods {
  double x = 0, y = 0;

  bool any() const { return x > 0 || y > 0; }
  /// Returns the periodic image of p that is nearest to q. Exact for points of the coordinate lattice, because the
  /// periods are multiples of its step.
  Point near(Point p, Point q) const {
    const auto shift = [](double d, double period) { return period > 0 ? -period * std::round(d / period) : 0.0; };
    return {p.x + shift(p.x - q.x, x), p.y + shift(p.y - q.y, y)};
  }
};

struct Mesh {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  std::vector<Facet> facets;
  std::vector<std::int64_t> facet_tags, facet_parts, facet_labels;
  std::vector<std::int64_t> facet_markers; ///< empty if no part of the shape has markers
  std::vector<double> asked_sizes;
  std::vector<Facet> curve_edges; ///< edges on curves inside the shape; empty if the file has none
  std::vector<std::int64_t> curve_numbers, curve_labels;
  std::vector<Facet> interfaces;        ///< edges between regions; empty if the file has none
  std::vector<Facet> interface_regions; ///< regions on the left and on the right of each
  std::vector<std::int64_t> interface_pairs, interface_labels;
  std::vector<std::int64_t> interface_curves; ///< curve on which the edge lies; -1 for none
  std::vector<Facet> split_pairs;             ///< points on the left and on the right of curves that are split
  std::vector<std::int64_t> split_curves, split_paths;
  std::vector<Facet> lines; ///< all edges with labels; empty if the file does not list them
  std::vector<std::int64_t> line_labels;

  std::vector<double> alpha, beta, size;
  std::vector<std::int64_t> region, boundary, fixed;
  std::vector<double> depth; ///< empty if the file has none

  bool has_vtk = true,
       has_plain = true; ///< whether the file has the groups /VTKHDF and /Mesh/mesh; a run may leave out one of the two
  // Copies of points and triangles in the file, in the layout that other readers expect.
  std::vector<double> vtk_points, petsc_points;
  std::vector<std::int64_t> connectivity, offsets, types,
      counts; ///< `counts`: numbers of points, cells and connectivity entries

  Periods periods;

  Point at(std::int64_t id) const { return points[static_cast<std::size_t>(id)]; }
  /// Returns the corners of a triangle at periodic images that are next to each other.
  std::array<Point, 3> corners(const Triangle& t) const {
    const Point a = at(t[0]);
    return {a, periods.near(at(t[1]), a), periods.near(at(t[2]), a)};
  }
  /// Returns the cosine of the angle of a triangle at its corner k.
  double cosine(const Triangle& t, std::size_t k) const {
    const std::array<Point, 3> c = corners(t);
    const Point u = c[(k + 1) % 3] - c[k], v = c[(k + 2) % 3] - c[k];
    return (u.x * v.x + u.y * v.y) / (std::hypot(u.x, u.y) * std::hypot(v.x, v.y));
  }
};

inline Facet ascending(const Facet& edge) {
  return {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])};
}

/// Formats a place for messages.
inline std::string place_of(Point p) {
  return fmt::format("({:.9g}, {:.9g})", p.x, p.y);
}
inline std::string place_of(const Mesh& mesh, std::size_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  return fmt::format("triangle {} ({} {} {}) at {}", triangle, t[0], t[1], t[2], place_of(mesh.at(t[0])));
}
inline std::string place_of(const Mesh& mesh, const Facet& facet) {
  return fmt::format("edge {} {} at {}", facet[0], facet[1], place_of(mesh.at(facet[0])));
}

} // namespace trime_check
