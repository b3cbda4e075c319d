// SPDX-License-Identifier: BSD-3-Clause
// Keeps interior sites off the boundary: tells whether a site has left the polygon of chords or entered the diametral
// disc of a chord, and where to push it. Does not move, delete or count anything itself.
#pragma once

#include "trime/geometry/lattice.hpp"
#include "trime/geometry/segment_grid.hpp"
#include "trime/meshing/boundary_sites.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trime::meshing {

/// @brief Queries about the polygon of chords between neighbouring boundary sites. Chord i goes from site i to its
/// next.
///
/// A flat grid of about 64 cells a chord (at most 2^22) says of each cell that it lies inside or outside, clear of all
/// discs, or lists the discs that reach into it: far from the boundary every query reads one byte. Points must lie on
/// the lattice of the sites. Immutable and thread-safe; O(B log B) to build.
class BoundaryGuard {
public:
  BoundaryGuard(const BoundarySites& sites, const geometry::Lattice& lattice);

  /// Inside the polygon of chords; exact, with the perturbation of SegmentGrid on the boundary itself.
  bool inside(geometry::Vec2 p) const;
  /// Distance to the nearest chord, or `reach` if that is farther.
  double distance(geometry::Vec2 p, double reach) const;
  /// @brief Where an interior site at p with local size h must go; nothing if p is inside and in no closed diametral
  /// disc.
  ///
  /// The chord is the one in whose disc p lies deepest (relative to its radius), or the nearest one if p is outside.
  /// The new place is 0.6 of the chord length from the chord's middle: towards p if that makes at least 30 degrees with
  /// the chord on its inner side and leads to a good place, else along the inner normal. It may be bad itself near
  /// sharp notches. h only says where the search for the nearest chord begins. A pure function of p and the sites.
  std::optional<geometry::Vec2> correct(geometry::Vec2 p, double h, const geometry::Lattice& lattice) const;
  /// p lies outside, strictly inside some diametral disc, or nearer to a chord than 0.05 of the chord's length.
  bool encroaches(geometry::Vec2 p) const;

  const geometry::SegmentGrid& chords() const { return chords_; }
  std::size_t memory_bytes() const;

private:
  enum class Cell : std::uint8_t { near, inside, outside }; // near: a disc may reach into the cell

  void build_grid();
  void classify_clear_cells(const geometry::Lattice& lattice);
  template <class Visit>
  void for_each_cell_of(LocalIndex chord, const Visit& visit) const;
  /// Index of the cell of p; -1 outside of the grid, where nothing is inside or near.
  std::int64_t cell_at(geometry::Vec2 p) const;
  Cell state_at(geometry::Vec2 p) const;
  /// Chords whose discs may hold p.
  std::span<const LocalIndex> chords_at(std::int64_t cell) const;
  /// The chord in whose closed diametral disc p lies deepest, lowest index on ties; -1 if in none.
  LocalIndex deepest_disc(geometry::Vec2 p) const;

  geometry::SegmentGrid chords_;
  geometry::Vec2 corner_;
  double side_ = 1, inverse_side_ = 1; // of a cell
  int columns_ = 0, rows_ = 0;
  std::vector<Cell> state_;
  std::vector<LocalIndex> cell_start_, cell_chord_; // the chords near each cell, ascending
};

} // namespace trime::meshing
