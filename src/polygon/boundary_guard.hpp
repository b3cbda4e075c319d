// SPDX-License-Identifier: BSD-3-Clause
// Keeps interior sites off the boundary: finds out whether a site has left the polygon of chords or entered the
// diametral disc of a chord, and where to push it. Does not move, delete or count anything itself.
#pragma once

#include "polygon/disc_cells.hpp"
#include "polygon/guard_cells.hpp"
#include "polygon/polygon.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/segment_grid.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace trime::polygon {

/// @brief Queries about the polygon of chords between neighbouring boundary sites. Chord i goes from site i to its
/// next.
///
/// A flat grid has about 64 cells per chord (at most 2^22). A cell clear of all discs stores whether it lies inside or
/// outside, and how many cells it is away from them; the other cells list the discs that reach into them. So far from
/// the boundary every query reads one byte. Points must lie on the lattice of the sites. Immutable and thread-safe; O(B
/// log B) to build, by all threads.
///
/// In a periodic container any image of a point may be asked for, and all images of the chords count. There the chords
/// and images that meet one image of the container are closed outside of it, so that the even-odd rule holds within up
/// to a global change of sides, which the inner side of one chord decides. Without sites, all is inside.
class BoundaryGuard {
public:
  BoundaryGuard(const BoundarySites& sites, const geometry::Lattice& lattice);

  /// Inside the polygon of chords; exact, with the perturbation of SegmentGrid on the boundary itself.
  bool inside(geometry::Vec2 p) const;
  /// Distance to the nearest chord, or `reach` if that is farther.
  double distance(geometry::Vec2 p, double reach) const;
  /// A lower bound of the distance, `reach` if it is not below that; for p in the container, by one look-up.
  double distance_below(geometry::Vec2 p, double reach) const { return std::min(reach, clear_way(p)); }
  /// @brief Where an interior site at p with local size h must go; nothing if p is inside and in no closed diametral
  /// disc.
  ///
  /// The chord is the one in whose disc p lies deepest (relative to its radius), or the nearest one if p is outside.
  /// The new place is PolygonRules::push_way of the chord length from the chord's middle: towards p if that makes at
  /// least 30 degrees with the chord on its inner side and leads to a good place, else along the inner normal. It may
  /// be bad itself near sharp notches. h only says where the search for the nearest chord begins. A pure function of p
  /// and the sites; of a periodic container it is the image next to p, canonical or not.
  std::optional<geometry::Vec2> correct(geometry::Vec2 p, double h, const geometry::Lattice& lattice) const;
  /// Does `correct` have something to say about p?
  bool pushes(geometry::Vec2 p) const;
  /// True where it surely has not: one look-up. Most places are clear.
  bool is_clear(geometry::Vec2 p) const { return state_at(periods_.wrap(p)) > 0; }
  /// p lies outside, strictly inside some diametral disc, or nearer to a chord than PolygonRules::near_chord.
  bool encroaches(geometry::Vec2 p) const;

  GuardCells cells() const;

  /// Chord i of each site, in a periodic container that image whose middle is canonical.
  const geometry::SegmentGrid& chords() const { return chords_; }
  std::size_t memory_bytes() const;

private:
  static constexpr std::int8_t near_disc = 0; ///< state of a cell that a disc may reach into

  /// A chord or an image of one.
  struct NearChord {
    geometry::Segment chord;
    double squared_distance;
  };

  geometry::Box choose_cells();
  void add_images(const geometry::Box& window);
  void close_chords(const geometry::Box& window, const geometry::Lattice& lattice);
  // The queries work on canonical points.
  bool inside_polygon(geometry::Vec2 p) const;
  std::optional<NearChord> nearest(geometry::Vec2 p, double reach) const;
  const geometry::Segment& disc(LocalIndex k) const {
    return k < chord_count() ? chords_.segments()[k] : images_[static_cast<std::size_t>(k - chord_count())];
  }
  LocalIndex chord_count() const { return static_cast<LocalIndex>(chords_.segments().size()); }
  bool is_empty() const { return chords_.segments().empty(); }
  void classify_cells(const geometry::Lattice& lattice);
  std::vector<std::uint8_t> clearance_of(int low, int high) const;
  void classify_row(int j, const std::uint8_t* clearance, const geometry::Lattice& lattice);
  int state_at(geometry::Vec2 p) const;
  /// A distance that no chord is nearer to p.
  double clear_way(geometry::Vec2 p) const;
  /// The number for disc() of the closed diametral disc in which p lies deepest, lowest on ties; -1 if in none.
  LocalIndex deepest_disc(geometry::Vec2 p) const;

  geometry::Periods periods_;
  geometry::SegmentGrid chords_;          // each where its middle is canonical
  std::vector<geometry::Segment> images_; // of chords, whose discs reach into the container
  geometry::SegmentGrid closed_;          // chords and images, closed outside; periodic containers only
  bool inverted_ = false;                 // the inside is where closed_ has its outside
  DiscCells cells_;
  std::vector<std::int8_t>
      state_; // inside > 0, outside < 0; its amount is the number of cells to the next one near a disc
};

} // namespace trime::polygon
