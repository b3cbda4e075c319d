// SPDX-License-Identifier: BSD-3-Clause
// The fixed points of a user: those on the boundary become corners, and those inside become sites that never move.
// Finds sites that are too near to them, and warns about problems.
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

/// @brief The fixed points, which are the same on every rank. Positions are canonical lattice points. Immutable. @pre
/// the boundary and the list of given points outlive the object
class FixedPoints {
public:
  /// @brief Points that are equal on the lattice are kept once, with a warning. O((points + pieces) log(points +
  /// pieces)).
  /// @throws GeometryError if a point is not finite or lies outside the container, or if two different points on the
  /// boundary are nearer to each other than the tolerance for lying on it
  FixedPoints(const geometry::Boundary& boundary, const geometry::Box& container, std::span<const FixedPoint> given,
              const geometry::Lattice& lattice, Log& log);

  bool empty() const { return all_.empty(); }
  /// All fixed points, in lexicographic order.
  std::span<const geometry::Vec2> all() const { return all_; }
  /// The fixed points that are not on the boundary.
  std::span<const geometry::Vec2> inside() const { return inside_; }
  /// The given boundary, with a corner at each point that lies on it. If no point does, this is the given boundary
  /// itself, not a copy.
  const geometry::Boundary& cornered_boundary() const { return cornered_ ? *cornered_ : given_boundary_; }

  /// @param left_out loops of components that are left out on purpose
  /// @throws GeometryError for the first point outside the shape or in such a component, with its label and its
  /// distance
  void check_inside(const polygon::BoundaryGuard& guard, std::span<const geometry::Loop> left_out = {}) const;
  /// Returns the number of free sites that place_among would keep.
  std::int64_t count_clear(std::span<const mesh::Site> sites, const sizing::SizeField& size) const;
  /// @brief Removes free sites that are too near to a fixed point, then adds the fixed points of these tiles.
  void place_among(mesh::SiteList& sites, const mesh::TileRange& tiles, const sizing::SizeField& size) const;
  /// Warns once about points nearer than the local size to each other or to the boundary.
  void warn_of_close_ones(const polygon::BoundaryGuard& guard, const sizing::SizeField& size, Log& log) const;

private:
  void take_corners();
  bool is_near(geometry::Vec2 p, double distance) const;
  const std::string& label(geometry::Vec2 p) const;

  const geometry::Boundary& given_boundary_;
  std::optional<geometry::Boundary> cornered_; ///< set only if points lie on the boundary
  std::span<const FixedPoint> given_;
  const geometry::Lattice lattice_;
  double tolerance_;                         ///< how near to a curve counts as on it
  std::vector<geometry::Vec2> all_, inside_; ///< in lexicographic order
  std::vector<std::size_t> source_;          ///< number in given_ of each point of all_
  SiteTree tree_;                            ///< tree of inside_
};

} // namespace trime::boundary
