// SPDX-License-Identifier: BSD-3-Clause
// The triangulation around a bad triangle, with data of its vertices, and the quality of its triangles.
#pragma once

#include "cleanup/patch_data.hpp"
#include "cleanup/patch_mesh.hpp"
#include "cleanup/rules.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace trime::cleanup {

/// The vertices of a triangle, counter-clockwise.
using Corners = std::array<LocalIndex, 3>;

/// The role of a vertex. A scored vertex is held, but its triangles count.
enum class VertexRole : std::uint8_t { gone, held, scored, free };

/// A vertex on the boundary, with its place and its neighbours along the loop.
struct BoundaryVertex {
  BoundaryName site =
      mesh::free_site; ///< its name; for a new site, the name of the last old site before it; -1 if it lies inside
  LocalIndex previous = -1, next = -1; ///< vertices; -1 if they lie beyond the patch
  LocalIndex loop = -1;
  double arc = 0;
  double tolerance = 0; ///< see BoundaryPlace
  bool changed = false; ///< the chord to the next vertex has changed
};

/// A measure of triangles: the sum of (alpha - 1)^2, in which bad triangles have more weight, and the largest alpha.
struct AlphaScore {
  double sum = 0, max = 1;

  void add(double alpha, double bad_alpha) {
    const double excess = alpha - 1, bad = std::max(0.0, alpha - bad_alpha);
    sum += excess * excess + CleanupRules::bad_weight * bad * bad;
    max = std::max(max, alpha);
  }
};

/// A bad triangle for which operations are tried.
struct BadPlace {
  Corners corners;
  geometry::Vec2 middle;
  double alpha;
  double size; ///< h in the middle of the triangle
};

/// @brief A triangulation with data of its vertices. A trial works on a copy of the patch, which is dropped if it does
/// not help.
struct Patch {
  Patch(const geometry::Lattice& lattice, const geometry::Periods& periods) : mesh(lattice, periods) {}

  /// Removes everything except the frame. @param size h at the vertices of the frame
  void start(geometry::Vec2 center, double half_width, double size);
  /// @brief Adds a vertex to the triangulation. @return its index, or -1 if one lies there already
  LocalIndex add(geometry::Vec2 p, double h, const BoundaryVertex& on_boundary, VertexRole its_role);
  /// Sets the data of vertex v, the last one of the triangulation.
  void append(LocalIndex v, double h, const BoundaryVertex& on_boundary, VertexRole its_role);

  bool is_gone(LocalIndex v) const { return role[at(v)] == VertexRole::gone; }
  bool on_boundary(LocalIndex v) const { return boundary[at(v)].site >= 0; }
  bool is_chord(LocalIndex from, LocalIndex to) const { return boundary[at(from)].next == to; }
  geometry::Segment chord(LocalIndex v) const { return {mesh.position(v), mesh.position(boundary[at(v)].next)}; }
  /// Returns the number of chords of the boundary that are not edges.
  LocalIndex missing_chords() const;
  /// Returns a chord in whose closed diametral disc p lies, if there is one.
  std::optional<geometry::Segment> entered_disc(geometry::Vec2 p) const;

  /// Returns whether a triangle lies inside the shape and has a vertex whose triangles count.
  bool counts(const PatchMesh::Triangle& triangle) const {
    return may_count(triangle) && (has_inner_vertex(triangle) || lies_inside(triangle));
  }
  /// Returns whether all vertices of a triangle are sites, one of them with triangles that count.
  bool may_count(const PatchMesh::Triangle& triangle) const {
    const auto& [a, b, c] = triangle.vertex;
    return std::min(a, std::min(b, c)) >= PatchMesh::frame &&
           std::max(role[at(a)], std::max(role[at(b)], role[at(c)])) >= VertexRole::scored;
  }
  /// Returns whether a triangle counts and is worse than `bad_alpha`. For most triangles no root is needed.
  bool is_bad(const PatchMesh::Triangle& triangle, double bad_alpha) const {
    return may_count(triangle) && !is_surely_below(bad_alpha, triangle.vertex) && counts(triangle) &&
           alpha(triangle.vertex) > bad_alpha;
  }
  /// See mesh::is_surely_below.
  bool is_surely_below(double limit, const Corners& corners) const;
  /// Returns mesh::aspect_ratio; infinite if the triangle has no area.
  double alpha(const Corners& corners) const {
    const geometry::Vec2 p = mesh.position(corners[0]), u = mesh.position(corners[1]) - p,
                         v = mesh.position(corners[2]) - p;
    const double a = geometry::length(u), b = geometry::length(v), c = geometry::length(v - u);
    const double twice_area = geometry::cross(u, v);
    return twice_area == 0 ? INFINITY : std::max(1.0, a * b * c * (a + b + c) / (4 * twice_area * twice_area));
  }
  geometry::Vec2 middle_of(const Corners& corners) const {
    return (1.0 / 3) * (mesh.position(corners[0]) + mesh.position(corners[1]) + mesh.position(corners[2]));
  }

  PatchMesh mesh;
  std::vector<VertexRole> role;         ///< role by vertex
  std::vector<double> size;             ///< h by vertex
  std::vector<BoundaryVertex> boundary; ///< place on the boundary by vertex
  std::vector<LocalIndex> rim;          ///< vertices on the boundary, including removed ones
  GlobalId gain = 0;                    ///< number of sites added since the start
  bool broken = false;                  ///< an operation of the triangulation failed: the patch can no longer be used

private:
  bool has_inner_vertex(const PatchMesh::Triangle& triangle) const {
    const auto& [a, b, c] = triangle.vertex;
    return !on_boundary(a) || !on_boundary(b) || !on_boundary(c);
  }
  bool lies_inside(const PatchMesh::Triangle& triangle) const;
};

} // namespace trime::cleanup
