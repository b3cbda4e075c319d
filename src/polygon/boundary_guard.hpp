// SPDX-License-Identifier: BSD-3-Clause
// Keeps interior sites away from the boundary: finds out whether a site has left the polygon of chords or entered the
// diametral disc of a chord, and where to push it. It does not move, delete or count sites itself.
#pragma once

#include "polygon/disc_cells.hpp"
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
/// A flat grid has about 64 cells per chord (at most 2^22). A cell that no disc touches stores whether it lies inside
/// or outside, and its distance from the discs in cells. The other cells list the discs that reach into them. Far from
/// the boundary every query reads one byte. Points must lie on the lattice of the sites. Immutable and thread-safe; O(B
/// log B) to build, by all threads.
///
/// In a periodic container queries accept any image of a point, and all images of the chords count. There, the chords
/// and images that meet the container are closed to polygons outside it. Then the even-odd rule gives the inside, or
/// the outside, of all points; the inner side of one chord shows which. Without sites, everything is inside.
class BoundaryGuard {
public:
  BoundaryGuard(const BoundarySites& sites, const geometry::Lattice& lattice);

  /// Returns whether p lies inside the polygon of chords. Exact; on the boundary itself, the perturbation of
  /// SegmentGrid decides.
  bool inside(geometry::Vec2 p) const;
  /// Returns the distance to the nearest chord, at most `reach`.
  double distance(geometry::Vec2 p, double reach) const;
  /// Returns a lower bound of the distance, at most `reach`, by one look-up. @pre p lies in the container
  double distance_below(geometry::Vec2 p, double reach) const { return std::min(reach, clear_way(p)); }
  /// @brief Returns the place to which an interior site at p must move, or nothing if p is inside and in no closed
  /// diametral disc.
  ///
  /// The chord is the one in whose disc p lies deepest (relative to its radius), or the nearest one if p is outside.
  /// The new place is PolygonRules::push_way chord lengths from the middle of the chord. It lies towards p if this
  /// direction makes at least 30 degrees with the chord on its inner side and leads to a good place, otherwise along
  /// the inner normal. Near sharp notches it may be a bad place itself. The search for the nearest chord begins with
  /// the local size h. The result depends only on p and the sites; in a periodic container it is the image next to p.
  std::optional<geometry::Vec2> correct(geometry::Vec2 p, double h, const geometry::Lattice& lattice) const;
  /// Returns whether `correct` returns a place for p.
  bool pushes(geometry::Vec2 p) const;
  /// Returns true if `correct` certainly returns nothing for p, as for most places. One look-up.
  bool is_clear(geometry::Vec2 p) const { return state_at(periods_.wrap(p)) > 0; }
  /// Returns whether p lies outside, strictly inside a diametral disc, or nearer to a chord than
  /// PolygonRules::near_chord.
  bool encroaches(geometry::Vec2 p) const;

  GuardCells cells() const;

  /// The chords by site; in a periodic container, those images whose middles are canonical.
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
  /// Returns a distance within which there is no chord.
  double clear_way(geometry::Vec2 p) const;
  /// Returns the number (see disc()) of the closed diametral disc in which p lies deepest, the lowest of equals; -1 if
  /// p lies in none.
  LocalIndex deepest_disc(geometry::Vec2 p) const;

  geometry::Periods periods_;
  geometry::SegmentGrid chords_;          // each at the image whose middle is canonical
  std::vector<geometry::Segment> images_; // images of chords whose discs reach into the container
  geometry::SegmentGrid closed_; // chords and images, closed outside the container; for periodic containers only
  bool inverted_ = false;        // true if the inside of the shape is the outside of closed_
  DiscCells cells_;
  std::vector<std::int8_t> state_; // by cell: positive inside, negative outside; the absolute value is the number of
                                   // cells to the next near_disc cell
};

} // namespace trime::polygon
