// SPDX-License-Identifier: BSD-3-Clause
// The boundary as curves by arc length, and the boundary sites as a linked list in which sites move, are removed and
// are inserted. The cost of a change depends on the number of changed sites only.
#pragma once

#include "polygon/polygon.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::polygon {

/// @brief Finds places on the loops of a boundary by arc length. Immutable, thread-safe; keeps a reference to the
/// boundary. Memory: O(pieces).
class BoundaryCurve {
public:
  explicit BoundaryCurve(const geometry::Boundary& boundary);

  const geometry::Boundary& boundary() const { return boundary_; }
  double length(LocalIndex loop) const { return arcs_[static_cast<std::size_t>(loop)].starts.back(); }
  /// Returns the arc length from the start of the loop to a site.
  double arc(LocalIndex loop, const BoundarySite& site) const {
    return arcs_[static_cast<std::size_t>(loop)].starts[static_cast<std::size_t>(site.piece)] + site.along;
  }
  /// A place on a loop. The arc length may lie up to one length of the loop before its start or after its end. Cost:
  /// O(1) if pieces are about equally long, otherwise at most O(log pieces).
  struct CurvePlace {
    LocalIndex piece;
    double along;
    geometry::Vec2 point;   ///< position along the unrolled loop
    geometry::Vec2 tangent; ///< unit vector
  };
  CurvePlace place(LocalIndex loop, double arc) const;

  /// How the curve between two places differs from the straight chord a-b between the sites there (or periodic images
  /// of them). The second place is less than one length of the loop ahead of the first. Cost: O(pieces between).
  struct Strayed {
    double deviation = 0; ///< largest distance from the chord to a junction of pieces, or to a point of an arc
    double farthest = 0;  ///< arc length of the point with that distance; may exceed the length of the loop
    bool leaves_disc =
        false;          ///< whether a junction or a point of an arc lies outside of the diametral circle of the chord
    bool bent = false;  ///< whether a junction between the places turns by more than half a degree
    bool sharp = false; ///< whether a junction between the places turns by more than 30 degrees
  };
  Strayed strayed(LocalIndex loop, double from, double to, const geometry::Segment& chord) const;

private:
  struct Arcs {                               // the arc lengths of a loop
    std::vector<double> starts;               // arc length at which each piece starts; then the length of the loop
    std::vector<std::uint32_t> first_in_cell; // the range of arc lengths is divided into equal cells: the first piece
                                              // that starts in each cell or after it
    double cells_per_arc = 0;
    std::size_t cell(double arc) const;
    std::size_t piece(double arc) const;
  };
  const geometry::Boundary& boundary_;
  std::vector<Arcs> arcs_; // by loop
};

enum class EditKind : std::int32_t { move, remove, insert };

/// A change of one boundary site. Sites keep their order along the loop.
struct BoundaryEdit {
  LocalIndex site =
      -1; ///< the site that moves along its curve or is removed; for an insertion, the site before the new one
  EditKind kind = EditKind::move;
  double arc = 0;          ///< arc length of the new position
  geometry::Vec2 position; ///< new position, in the container
  std::uint64_t patch = 0; ///< number of the clean-up patch that makes the change; only one patch may divide a chord
};

/// @brief A copy of the boundary sites as a linked list. Sites keep their indices until renumber is called. New sites
/// are appended, so indices do not follow the loops. All ranks hold the same copy.
class BoundaryChain {
public:
  /// Copies the sites. `curve` must outlive this object.
  BoundaryChain(const BoundarySites& boundary, const BoundaryCurve& curve);

  /// Returns the sites; `loop_start`, counts and sums are those after the last renumber, or after construction.
  const BoundarySites& sites() const { return sites_; }
  LocalIndex loop(LocalIndex site) const { return loops_[static_cast<std::size_t>(site)]; }
  const BoundaryCurve& curve() const { return curve_; }

  /// @brief Makes the changes: first all moves and removals, then the insertions. If one chord gets several new sites,
  /// they are ordered by arc length. Cost: O(edits log edits).
  /// @pre neighbouring sites are at most half a period apart; each loop keeps at least 3 sites
  /// @throws InternalError if a site is changed twice, if two patches divide the same chord, or if a site does not
  /// exist
  /// @return the indices of changed and new sites; an index occurs as often as its site was changed
  std::vector<LocalIndex> apply(std::vector<BoundaryEdit> edits);

  /// @brief Numbers the sites along the loops again. A loop begins with the first of its old sites that still exists.
  /// Cost: O(sites + pieces).
  /// @return the new index of each old one, -1 if the site was removed
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
  std::vector<std::uint8_t> is_gone_; // by site: whether it was removed
};

} // namespace trime::polygon
