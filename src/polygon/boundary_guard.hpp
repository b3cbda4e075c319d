// SPDX-License-Identifier: BSD-3-Clause
// Finds out whether an inner site has left the polygon of boundary edges (chords)
// or entered the diametral circle of a chord, and to which place the site must be pushed. The guard does not move,
// delete or count sites itself.
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

/// @brief Answers queries about the polygon of chords between neighbouring boundary sites. Chord i goes from boundary
/// site i to the next one.
///
/// A grid has about 64 cells per chord (at most 2^22). A cell that no diametral circle touches stores whether it lies
/// inside or outside of the polygon, and its distance, in cells, from the nearest circle. The other cells list the
/// circles that reach into them. Far from the boundary every query reads one byte. Points must lie on the coordinate
/// lattice of the sites. Immutable and thread-safe; takes O(B log B) time to build for B sites, by all threads.
///
/// In a periodic container, queries accept any periodic image of a point, and all images of the chords count. The
/// chords and images that meet the container are completed to closed polygons outside of it. Then the even-odd rule
/// separates inside from outside; the inner side of one chord shows which is which. Without sites, every point is
/// inside, and only curves inside the shape have circles.
///
/// The chords of curves inside the shape have diametral circles, too. A site in such a circle is pushed to the side on
/// which it lies.
class BoundaryGuard {
public:
  BoundaryGuard(const BoundarySites& sites, const geometry::Lattice& lattice);

  /// Returns whether p lies inside the polygon of chords. Exact; for a point on the boundary, the symbolic perturbation
  /// of SegmentGrid decides.
  bool inside(geometry::Vec2 p) const;
  /// Returns the distance to the nearest chord, at most `reach`.
  double distance(geometry::Vec2 p, double reach) const;
  /// Returns a lower bound on the distance to the nearest chord, at most `reach`, by one look-up.
  /// @pre p lies in the container
  double distance_below(geometry::Vec2 p, double reach) const { return std::min(reach, clear_way(p)); }
  /// @brief Returns the place to which an inner site at p must move; nothing if p is inside and in no closed diametral
  /// circle.
  ///
  /// The site is moved away from one chord: the chord in whose diametral circle p lies deepest (relative to its
  /// radius), or the nearest chord if p is outside. The new place is PolygonRules::push_way chord lengths away from the
  /// middle of the chord. The direction to the new place is that of p if this points inside, makes at least 30 degrees
  /// with the chord and leads to a good place; otherwise it is the inner normal. Near sharp notches the new place may
  /// be bad itself. The search for the nearest chord begins with the local size h. The result depends only on p and the
  /// boundary sites; in a periodic container it is the image next to p.
  std::optional<geometry::Vec2> correct(geometry::Vec2 p, double h, const geometry::Lattice& lattice) const;
  /// Returns whether `correct` returns a place for p.
  bool pushes(geometry::Vec2 p) const;
  /// Returns true if `correct` certainly returns nothing for p, which is the case for most places. Cost: one look-up.
  bool is_clear(geometry::Vec2 p) const { return state_at(periods_.wrap(p)) > 0; }
  /// Returns whether p lies outside, strictly inside a diametral circle, or nearer to a chord than
  /// PolygonRules::near_chord.
  bool encroaches(geometry::Vec2 p) const;

  GuardCells cells() const;

  /// Returns the chords, by boundary site; in a periodic container, the images whose middles lie in the container.
  const geometry::SegmentGrid& chords() const { return chords_; }
  std::size_t memory_bytes() const;

private:
  static constexpr std::int8_t near_disc = 0; ///< state of a cell into which a diametral circle may reach

  /// A chord or a periodic image of a chord.
  struct NearChord {
    geometry::Segment chord;
    double squared_distance;
  };

  geometry::Box choose_cells();
  void add_images(const geometry::SegmentGrid& chords, const geometry::Box& window);
  void close_chords(const geometry::Box& window, const geometry::Lattice& lattice);
  // The following queries take canonical points.
  bool inside_polygon(geometry::Vec2 p) const;
  std::optional<NearChord> nearest(const geometry::SegmentGrid& chords, geometry::Vec2 p, double reach) const;
  const geometry::Segment& disc(LocalIndex k) const {
    return k < chord_count() ? chords_.segments()[k] : images_[static_cast<std::size_t>(k - chord_count())];
  }
  bool has_both_sides(LocalIndex k) const { return k >= chord_count() + first_inner_; }
  LocalIndex chord_count() const { return static_cast<LocalIndex>(chords_.segments().size()); }
  bool has_rim() const { return !chords_.segments().empty(); }
  bool is_empty() const { return !has_rim() && inner_.segments().empty(); }
  void classify_cells(const geometry::Lattice& lattice);
  std::vector<std::uint8_t> clearance_of(int low, int high) const;
  void classify_row(int j, const std::uint8_t* clearance, const geometry::Lattice& lattice);
  int state_at(geometry::Vec2 p) const;
  /// Returns a distance from p within which no chord lies.
  double clear_way(geometry::Vec2 p) const;
  /// Returns the number (see disc()) of the chord in whose closed diametral circle p lies deepest, relative to the
  /// radius. If p lies equally deep in several circles, the lowest number counts. Returns -1 if p lies in none of them.
  LocalIndex deepest_disc(geometry::Vec2 p) const;

  geometry::Periods periods_;
  geometry::SegmentGrid chords_;          // each as the periodic image whose middle lies in the container
  geometry::SegmentGrid inner_;           // chords of curves inside the shape; the image is chosen in the same way
  std::vector<geometry::Segment> images_; // images of chords whose diametral circles reach into the container; then the
                                          // chords of curves inside the shape, and their images
  LocalIndex first_inner_ = 0;            // index in images_ of the first chord of a curve
  geometry::SegmentGrid
      closed_; // chords and images, completed to closed polygons outside of the container; for periodic containers only
  bool inverted_ = false; // whether the inside of the shape is the outside of closed_
  DiscCells cells_;
  std::vector<std::int8_t> state_; // by cell: positive inside, negative outside; the absolute value is the number of
                                   // cells to the next cell with a circle
};

} // namespace trime::polygon
