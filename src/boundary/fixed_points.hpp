// SPDX-License-Identifier: BSD-3-Clause
// The fixed points of a user: those on the boundary become corners, and those inside the shape become sites that never
// move. Removes other sites that are too near to fixed points, and warns about problems.
#pragma once

#include "boundary/site_tree.hpp"
#include "mesh/binned_points.hpp"
#include "mesh/tile_grid.hpp"
#include "polygon/boundary_guard.hpp"
#include "trime/core/log.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trime::boundary {

using geometry::FixedPoint;

/// @brief The fixed points, which are the same on every rank. Positions are lattice points in the container. Immutable.
/// @pre the boundary and the list of given points outlive the object
class FixedPoints {
public:
  /// @brief Rounds the points to the coordinate lattice. Points that are equal afterwards are kept once, with a
  /// warning. Cost: O((points + pieces) log(points + pieces)).
  /// @throws GeometryError if a point is not finite or lies outside of the container, or if two different points on the
  /// boundary are nearer to each other than the tolerance within which a point lies on a curve
  FixedPoints(const geometry::Boundary& boundary, const geometry::Box& container, std::span<const FixedPoint> given,
              const geometry::Lattice& lattice, Log& log);

  bool empty() const { return all_.empty(); }
  /// All fixed points, in lexicographic order.
  std::span<const geometry::Vec2> all() const { return all_; }
  /// The fixed points that are not on the boundary.
  std::span<const geometry::Vec2> inside() const { return inside_; }
  /// Returns the points that must stay inside when the boundary is simplified: inside(), and points of the curves that
  /// were given to hold().
  std::span<const geometry::Vec2> held() const { return held_.empty() ? inside() : held_; }
  /// Returns the fixed points that are vertices of curves, in lexicographic order. They no longer are in inside().
  std::span<const geometry::Vec2> on_curves() const { return on_curves_; }
  /// @brief Lets the simplification of the boundary keep the curves and interfaces inside the shape. Takes the points
  /// that are vertices of curves out of inside().
  /// @throws GeometryError if a point of inside() lies on a curve, but is not a vertex of it
  void hold(const geometry::Domain& domain);
  /// Returns the given boundary with a corner at each fixed point that lies on it. If there is no such point, returns a
  /// reference to the given boundary itself.
  const geometry::Boundary& cornered_boundary() const { return cornered_ ? *cornered_ : given_boundary_; }

  /// Checks that all fixed points lie inside the shape.
  /// @param left_out loops of components that are left out on purpose
  /// @throws GeometryError for the first point outside the shape or in such a component, with its label and its
  /// distance
  void check_inside(const polygon::BoundaryGuard& guard, std::span<const geometry::Loop> left_out = {}) const;
  /// Checks that no two fixed points are nearer to each other than the shortest edge that the user allows.
  /// @throws GeometryError that names two such points
  void check_distances(double shortest_edge) const;
  /// Returns the number of free sites that place_among would keep.
  std::int64_t count_clear(std::span<const mesh::Site> sites, const sizing::SizeField& size) const;
  /// @brief Removes free sites that are too near to a fixed point, then adds the fixed points that lie in these tiles.
  void place_among(mesh::SiteList& sites, const mesh::TileRange& tiles, const sizing::SizeField& size) const;
  /// Warns once about fixed points that are nearer than the local size to each other or to the boundary.
  void warn_of_close_ones(const polygon::BoundaryGuard& guard, const sizing::SizeField& size, Log& log) const;

private:
  void take_corners();
  bool is_near(geometry::Vec2 p, double distance) const;
  const std::string& label(geometry::Vec2 p) const;

  const geometry::Boundary& given_boundary_;
  std::optional<geometry::Boundary> cornered_; ///< set only if fixed points lie on the boundary
  std::span<const FixedPoint> given_;
  const geometry::Lattice lattice_;
  double tolerance_;                         ///< largest distance from a curve at which a point counts as lying on it
  std::vector<geometry::Vec2> all_, inside_; ///< in lexicographic order
  std::vector<geometry::Vec2> on_curves_;    ///< in lexicographic order; a point may occur twice
  std::vector<geometry::Vec2> held_;         ///< inside_ and points of curves; empty if there are no curves
  std::vector<std::size_t> source_;          ///< index in given_ of each point of all_
  SiteTree tree_;                            ///< search tree of the points in inside_
};

} // namespace trime::boundary
