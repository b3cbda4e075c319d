// SPDX-License-Identifier: BSD-3-Clause
// The triangulation around a bad triangle: its sites, which of them may move, data of its vertices, and the quality of
// its triangles.
#pragma once

#include "cleanup/patch_data.hpp"
#include "cleanup/patch_mesh.hpp"
#include "cleanup/rules.hpp"
#include "polygon/boundary_chain.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace trime::cleanup {

/// The vertices of a triangle, counter-clockwise.
using Corners = std::array<LocalIndex, 3>;

/// The role of a vertex: it was removed; it is fixed; it is fixed, but its triangles count in the sum; or it may move,
/// and its triangles count.
enum class VertexRole : std::uint8_t { gone, held, scored, free };

/// A vertex on the boundary, with its place and its neighbours along the loop.
struct BoundaryVertex {
  BoundaryName site = mesh::free_site; ///< its name; a new site has the name of the last old site before it; negative
                                       ///< if the vertex lies inside
  LocalIndex previous = -1, next = -1; ///< neighbours along the loop; -1 if they lie outside the patch
  LocalIndex loop = -1;
  double arc = 0;
  double tolerance = 0; ///< see BoundaryPlace
  bool changed = false; ///< the chord to the next vertex has changed
};

/// A measure of triangles: the sum of (alpha - 1)^2, with an additional term for bad triangles, and the largest alpha.
struct AlphaScore {
  double sum = 0, max = 1;
  double obtuse = 0; ///< the part of the sum that obtuse triangles add, if they count

  void add(double alpha, double bad_alpha) {
    const double excess = alpha - 1, bad = std::max(0.0, alpha - bad_alpha);
    sum += excess * excess + CleanupRules::bad_weight * bad * bad;
    max = std::max(max, alpha);
  }
  /// Adds what a triangle costs if it is obtuse. @param cotangent of its largest angle
  void add_angle(double cotangent, double weight) {
    if (cotangent >= CleanupRules::obtuse_cotangent)
      return;
    const double cost = weight * (1 + CleanupRules::obtuse_slope * (CleanupRules::obtuse_cotangent - cotangent));
    obtuse += cost;
    sum += cost;
  }
};

/// A bad triangle at which operations are tried.
struct BadPlace {
  Corners corners;
  geometry::Vec2 middle;
  double alpha;
  double size; ///< h in the middle of the triangle
};

/// @brief A triangulation with data of its vertices. A trial works on a copy of the patch. The copy is discarded if the
/// trial does not improve the triangles.
struct Patch {
  Patch(const geometry::Lattice& lattice, const geometry::Periods& periods) : mesh(lattice, periods) {}

  /// Removes everything except the frame. @param size h at the vertices of the frame
  void start(geometry::Vec2 center, double half_width, double size);
  /// @brief Adds a vertex to the triangulation. @return its index, or -1 if a vertex lies at p already
  LocalIndex add(geometry::Vec2 p, double h, const BoundaryVertex& on_boundary, VertexRole its_role);
  /// Sets the data of vertex v, which must be the last vertex of the triangulation.
  void append(LocalIndex v, double h, const BoundaryVertex& on_boundary, VertexRole its_role);

  bool is_gone(LocalIndex v) const { return role[at(v)] == VertexRole::gone; }
  bool on_boundary(LocalIndex v) const { return boundary[at(v)].site >= 0; }
  bool on_curve(LocalIndex v) const { return boundary[at(v)].site <= first_on_curve; }
  bool is_chord(LocalIndex from, LocalIndex to) const { return boundary[at(from)].next == to; }
  /// Returns whether an edge is a chord of a curve inside the shape.
  bool is_wall(LocalIndex u, LocalIndex w) const {
    return std::find(walls.begin(), walls.end(), std::pair(std::min(u, w), std::max(u, w))) != walls.end();
  }
  /// Returns whether a wall lies between two places.
  bool is_behind_wall(geometry::Vec2 p, geometry::Vec2 q) const;
  /// Returns whether one of the edges of a triangle is a wall.
  bool has_wall(const Corners& corners) const {
    return is_wall(corners[0], corners[1]) || is_wall(corners[1], corners[2]) || is_wall(corners[2], corners[0]);
  }
  geometry::Segment chord(LocalIndex v) const { return {mesh.position(v), mesh.position(boundary[at(v)].next)}; }
  /// Returns the number of boundary edges and chords of inner curves that are not edges of the triangulation.
  LocalIndex missing_chords() const;
  /// Returns a boundary edge, or a chord of a curve with p on its left, whose closed diametral disc contains p, if
  /// there is one.
  std::optional<geometry::Segment> entered_disc(geometry::Vec2 p) const;

  /// Returns whether a triangle lies inside the shape and has a vertex whose triangles count.
  bool counts(const PatchMesh::Triangle& triangle) const {
    return may_count(triangle) && (has_inner_vertex(triangle) || lies_inside(triangle));
  }
  /// Returns whether all vertices of a triangle are sites, and triangles of at least one of them count.
  bool may_count(const PatchMesh::Triangle& triangle) const {
    const auto& [a, b, c] = triangle.vertex;
    return std::min(a, std::min(b, c)) >= PatchMesh::frame &&
           std::max(role[at(a)], std::max(role[at(b)], role[at(c)])) >= VertexRole::scored;
  }
  /// Returns whether a triangle counts and its alpha exceeds `bad_alpha`. For most triangles this needs no square root.
  bool is_bad(const PatchMesh::Triangle& triangle, double bad_alpha) const {
    return may_count(triangle) && !is_surely_below(bad_alpha, triangle.vertex) && counts(triangle) &&
           alpha(triangle.vertex) > bad_alpha;
  }
  /// See mesh::is_surely_below.
  bool is_surely_below(double limit, const Corners& corners) const;
  /// Returns mesh::aspect_ratio, or infinity if the triangle has no area. If ear_alpha is above 0, an ear has that
  /// much more, see is_ear().
  double alpha(const Corners& corners) const {
    return ear_alpha > 0 && is_ear(corners) ? ear_alpha + aspect_ratio(corners) : aspect_ratio(corners);
  }
  /// Returns whether a triangle has two boundary edges, with an angle of at least 60 degrees between them.
  bool is_ear(const Corners& corners) const;
  double aspect_ratio(const Corners& corners) const {
    const geometry::Vec2 p = mesh.position(corners[0]), u = mesh.position(corners[1]) - p,
                         v = mesh.position(corners[2]) - p;
    const double a = geometry::length(u), b = geometry::length(v), c = geometry::length(v - u);
    const double twice_area = geometry::cross(u, v);
    return twice_area == 0 ? INFINITY : std::max(1.0, a * b * c * (a + b + c) / (4 * twice_area * twice_area));
  }
  /// Returns the cotangent of the largest angle: negative if the triangle is obtuse. Rounded.
  double least_cotangent(const Corners& corners) const {
    const geometry::Vec2 p = mesh.position(corners[0]), u = mesh.position(corners[1]) - p,
                         v = mesh.position(corners[2]) - p;
    const double uu = geometry::dot(u, u), vv = geometry::dot(v, v), uv = geometry::dot(u, v);
    return std::min(uv, std::min(uu - uv, vv - uv)) / geometry::cross(u, v);
  }
  /// Returns whether the triangle is obtuse. Exact.
  bool is_obtuse(const Corners& corners) const;
  geometry::Vec2 middle_of(const Corners& corners) const {
    return (1.0 / 3) * (mesh.position(corners[0]) + mesh.position(corners[1]) + mesh.position(corners[2]));
  }

  PatchMesh mesh;
  std::vector<VertexRole> role;         ///< role by vertex
  std::vector<double> size;             ///< h by vertex
  std::vector<BoundaryVertex> boundary; ///< by vertex: place on the boundary
  std::vector<LocalIndex> rim;          ///< vertices on the boundary, including vertices that were removed
  std::vector<std::pair<LocalIndex, LocalIndex>> walls; ///< chords of curves inside the shape; the lower vertex first
  GlobalId gain = 0;                                    ///< number of sites added since the start
  double ear_alpha = 0; ///< what ears add to their alpha, so that they are divided; 0: ears count like other triangles
  bool broken = false;  ///< an operation of the triangulation failed: the patch can no longer be used

private:
  bool has_inner_vertex(const PatchMesh::Triangle& triangle) const {
    const auto& [a, b, c] = triangle.vertex;
    return !on_boundary(a) || !on_boundary(b) || !on_boundary(c);
  }
  bool lies_inside(const PatchMesh::Triangle& triangle) const;
};

/// @brief The place of a patch and the sites around it before any change. Trials are compared with this state. One
/// object serves one patch after the other.
class PatchStart {
public:
  /// The arguments must outlive the object. @param boundary sites before the clean-up; only their loops and periods are
  /// used
  PatchStart(const polygon::BoundarySites& boundary, const polygon::BoundaryCurve& curve,
             const geometry::Lattice& lattice, double ear_alpha = 0)
      : boundary_(boundary), curve_(curve), lattice_(lattice), patch_(lattice, boundary.periods) {
    patch_.ear_alpha = ear_alpha;
  }

  /// @brief Triangulates the sites. @return false if nothing can be changed, because there are too many sites or all
  /// lie near the rim of the patch
  /// @param sites see PatchOptimizer::improve
  bool build(geometry::Vec2 center, double size, std::span<const PatchSite> sites);

  const Patch& patch() const { return patch_; }
  LocalIndex vertices() const { return patch_.mesh.vertices(); }
  LocalIndex missing_chords() const { return missing_chords_; }
  const geometry::Periods& periods() const { return boundary_.periods; }
  const polygon::BoundaryCurve& curve() const { return curve_; }
  /// Returns the chords of the curves inside, as they were before the clean-up.
  const polygon::InnerChords& inner() const { return boundary_.inner; }
  /// Returns the number of sites of a loop at the beginning of the clean-up.
  LocalIndex sites_of_loop(LocalIndex loop) const {
    return boundary_.loop_start[at(loop) + 1] - boundary_.loop_start[at(loop)];
  }
  const geometry::Lattice& lattice() const { return lattice_; }
  geometry::Vec2 center() const { return center_; }
  double size() const { return size_; }

  /// Returns whether a vertex is new or has moved.
  bool has_changed(const Patch& now, LocalIndex v) const {
    return v >= vertices() || now.mesh.position(v) != patch_.mesh.position(v);
  }
  /// Returns whether a place is far enough from the sites that must not move.
  bool is_in_core(geometry::Vec2 p) const {
    return distance(p) < (CleanupRules::reach - CleanupRules::free_depth - CleanupRules::core_depth) * size_;
  }
  /// Returns whether a new site with size h would be far enough from the rim.
  bool has_room(geometry::Vec2 p, double h) const {
    return distance(p) + CleanupRules::free_depth * std::fmax(h, size_) < CleanupRules::reach * size_;
  }
  /// Returns whether a place is far enough from the rim for a site to move there.
  bool is_off_rim(geometry::Vec2 p) const {
    return !(distance(p) > (CleanupRules::reach - CleanupRules::free_depth + CleanupRules::most_outwards) * size_);
  }
  double distance(geometry::Vec2 p) const { return geometry::length(p - center_); }

private:
  bool may_move(const PatchSite& site) const;
  bool is_deep(const PatchSite& site) const;
  VertexRole role_of(const PatchSite& site) const;
  static BoundaryVertex on_boundary(const PatchSite& site);
  void link_boundary();
  void link_curves();

  const polygon::BoundarySites& boundary_;
  const polygon::BoundaryCurve& curve_;
  geometry::Lattice lattice_;
  Patch patch_;
  std::vector<BoundaryName> next_; // by vertex on the boundary: the next site of its loop
  geometry::Vec2 center_;
  double size_ = 1;
  LocalIndex missing_chords_ = 0;
};

/// @brief The sites that rest. A triangle is not tried if its three sites rest. A site that has moved or is new does
/// not rest.
class PatchRests {
public:
  /// @param sites sites of the patch, in the order of its vertices
  void start(std::span<const PatchSite> sites) {
    rests_.assign(PatchMesh::frame, 0);
    for (const PatchSite& site : sites)
      rests_.push_back(site.rests != 0);
    at_start_ = rests_;
  }
  bool rests(LocalIndex v) const { return rests_[at(v)] != 0; }
  bool all_rest(const Corners& corners) const { return rests(corners[0]) && rests(corners[1]) && rests(corners[2]); }
  /// @pre the site was in the patch at the start
  bool has_changed(LocalIndex v) const { return rests_[at(v)] != at_start_[at(v)]; }

  void let_rest(const Corners& corners) {
    for (const LocalIndex v : corners)
      rests_[at(v)] = 1;
  }
  void wake(std::span<const LocalIndex> vertices) {
    for (const LocalIndex v : vertices)
      rests_[at(v)] = 0;
  }
  /// Ends the rest of sites that have moved far. New sites do not rest.
  void wake_moved(const Patch& before, const Patch& now) {
    rests_.resize(at(now.mesh.vertices()), 0);
    for (LocalIndex v = PatchMesh::frame; v < before.mesh.vertices(); ++v) {
      const double limit = CleanupRules::waking_move * now.size[at(v)];
      if (rests(v) && geometry::squared_length(now.mesh.position(v) - before.mesh.position(v)) > limit * limit)
        rests_[at(v)] = 0;
    }
  }

private:
  std::vector<std::uint8_t> rests_, at_start_; // by vertex
};

} // namespace trime::cleanup
