// SPDX-License-Identifier: BSD-3-Clause
// The boundary as curves by arc length, and the sites on it while some of them move, come and go: every change costs
// what it touches.
#pragma once

#include "polygon/polygon.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::polygon {

/// @brief Places on the loops of a boundary by arc length. Immutable, thread-safe; keeps a reference to the boundary.
/// O(pieces) memory.
class BoundaryCurve {
public:
  explicit BoundaryCurve(const geometry::Boundary& boundary);

  const geometry::Boundary& boundary() const { return boundary_; }
  double length(LocalIndex loop) const { return arcs_[static_cast<std::size_t>(loop)].starts.back(); }
  /// Returns the arc length from the start of the loop to a site.
  double arc(LocalIndex loop, const BoundarySite& site) const {
    return arcs_[static_cast<std::size_t>(loop)].starts[static_cast<std::size_t>(site.piece)] + site.along;
  }
  /// A place on a loop; its arc may lie up to one length of the loop before the start or behind the end. O(1) if pieces
  /// are about equally long, otherwise at most O(log pieces).
  struct CurvePlace {
    LocalIndex piece;
    double along;
    geometry::Vec2 point;   ///< on the unrolled loop
    geometry::Vec2 tangent; ///< unit vector
  };
  CurvePlace place(LocalIndex loop, double arc) const;

  /// How the curve from one place to a later one, less than one length of the loop ahead, differs from the chord a-b
  /// between them or their images. O(pieces between)
  struct Strayed {
    double deviation = 0; ///< largest distance from the chord, of junctions and points on arcs
    double farthest = 0;  ///< arc length of that point from the start of the loop; may exceed the length of the loop
    bool leaves_disc = false; ///< such a point lies outside the diametral disc of the chord
    bool bent = false;        ///< a junction between the places turns by more than half a degree
    bool sharp = false;       ///< a junction between the places turns by more than 30 degrees
  };
  Strayed strayed(LocalIndex loop, double from, double to, const geometry::Segment& chord) const;

private:
  struct Arcs {                               // arc lengths of a loop
    std::vector<double> starts;               // where each piece starts; then the length of the loop
    std::vector<std::uint32_t> first_in_cell; // the first start in each of equal cells of the arc or behind it
    double cells_per_arc = 0;
    std::size_t cell(double arc) const;
    std::size_t piece(double arc) const;
  };
  const geometry::Boundary& boundary_;
  std::vector<Arcs> arcs_; // by loop
};

enum class EditKind : std::int32_t { move, remove, insert };

/// One change of the boundary sites. Sites keep their order along the loop.
struct BoundaryEdit {
  LocalIndex site = -1; ///< the site that moves along its curve or is removed; for a new site, the site before it
  EditKind kind = EditKind::move;
  double arc = 0;          ///< arc length of the new place
  geometry::Vec2 position; ///< new place, canonical
  std::uint64_t patch = 0; ///< number of the patch that makes the edit: only one patch may divide a chord
};

/// @brief A copy of boundary sites as a linked list. Sites keep their indices until renumber is called. New sites are
/// appended, so indices no longer follow the loops. All ranks hold the same copy.
class BoundaryChain {
public:
  /// The curve must outlive the object.
  BoundaryChain(const BoundarySites& boundary, const BoundaryCurve& curve);

  /// The sites; `loop_start`, counts and sums are those after the last renumber, or at first.
  const BoundarySites& sites() const { return sites_; }
  LocalIndex loop(LocalIndex site) const { return loops_[static_cast<std::size_t>(site)]; }
  const BoundaryCurve& curve() const { return curve_; }

  /// @brief Carries out edits: first all moves and removals, then the insertions. Several new sites of one chord get
  /// the order of their arcs. O(edits log edits)
  /// @pre neighbouring sites lie within half a period of each other; a loop keeps 3 sites
  /// @throws InternalError if a site is changed twice, if two patches divide a chord, or if a site is gone already
  /// @return the indices that have changed or are new, each as often as it was changed
  std::vector<LocalIndex> apply(std::vector<BoundaryEdit> edits);

  /// @brief Numbers the sites along the loops again. A loop begins with the first of its old sites that still exists.
  /// O(sites + pieces) @return for each old index the new one, -1 if the site is gone
  std::vector<LocalIndex> renumber();

private:
  void move_or_remove(const BoundaryEdit& edit, std::vector<LocalIndex>& changed);
  void insert(const BoundaryEdit& edit, std::vector<LocalIndex>& changed);
  void place(LocalIndex site, double arc, geometry::Vec2 position);
  void close_chord(LocalIndex site);
  std::vector<LocalIndex> list_along_loops();
  void check(std::span<const BoundaryEdit> edits) const;

  const BoundaryCurve& curve_;
  BoundarySites sites_;
  std::vector<LocalIndex> loops_;     // by site
  std::vector<std::uint8_t> is_gone_; // by site
};

} // namespace trime::polygon
