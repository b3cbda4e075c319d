// SPDX-License-Identifier: BSD-3-Clause
// The points that a user wants to keep: those on the boundary become corners of it, those inside become sites that
// never move. Knows where they lie, what is too near to them, and what to say about it.
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

/// @brief Replicated: the same on every rank. Positions are canonical lattice points. Immutable; the boundary and the
/// list of points that it is made from must outlive it.
class FixedPoints {
public:
  /// @brief Points that the lattice makes equal are kept once, with a warning. O((points + pieces) log(points +
  /// pieces)).
  /// @throws GeometryError if a point is not finite or lies outside of the container, and if two on the boundary
  /// differ but are nearer to each other than what counts as on it
  FixedPoints(const geometry::Boundary& boundary, const geometry::Box& container, std::span<const FixedPoint> given,
              const geometry::Lattice& lattice, Log& log);

  bool empty() const { return all_.empty(); }
  /// All of them, in lexicographic order.
  std::span<const geometry::Vec2> all() const { return all_; }
  /// The fixed points that are not on the boundary.
  std::span<const geometry::Vec2> inside() const { return inside_; }
  /// The boundary as it was given, with a corner at each point that lies on it; itself, not a copy, if none does.
  const geometry::Boundary& cornered_boundary() const { return cornered_ ? *cornered_ : given_boundary_; }

  /// @throws GeometryError for the first point that the boundary leaves outside: its label, and how far outside
  void check_inside(const polygon::BoundaryGuard& guard) const;
  /// Number of free sites that place_among would leave.
  std::int64_t count_clear(std::span<const mesh::Site> sites, const sizing::SizeField& size) const;
  /// @brief Takes out free sites that are too near to a fixed one, then adds the fixed sites of these tiles.
  void place_among(mesh::SiteList& sites, const mesh::TileRange& tiles, const sizing::SizeField& size) const;
  /// One warning about points nearer than the local size to each other or to the boundary.
  void warn_of_close_ones(const polygon::BoundaryGuard& guard, const sizing::SizeField& size, Log& log) const;

private:
  void take_corners();
  bool is_near(geometry::Vec2 p, double distance) const;
  const std::string& label(geometry::Vec2 p) const;

  const geometry::Boundary& given_boundary_;
  std::optional<geometry::Boundary> cornered_; ///< only with points on the boundary
  std::span<const FixedPoint> given_;
  const geometry::Lattice lattice_;
  double tolerance_;                         ///< how near to a curve counts as on it
  std::vector<geometry::Vec2> all_, inside_; ///< in lexicographic order
  std::vector<std::size_t> source_;          ///< of each point of all_: its number in given_
  SiteTree tree_;                            ///< of inside_
};

} // namespace trime::boundary
