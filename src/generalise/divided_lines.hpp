// SPDX-License-Identifier: BSD-3-Clause
// Divides arcs where others end on them, and gives parts of interfaces the names of curves.
#pragma once

#include "generalise/arc_cuts.hpp"
#include "generalise/line_pieces.hpp"

#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace trime::generalise {

/// Notes where lines that take over parts of other arcs get vertices and names, and divides them there. Refers to the
/// lines and the arcs.
class DividedLines {
public:
  DividedLines(const LinePieces& lines, const std::vector<geometry::InnerArc>& arcs) : lines_(lines), arcs_(arcs) {}

  /// The line gets a vertex here, and ends or begins there if it is an arc.
  void add(const Foot& foot);
  /// A straight piece of an interface leads through this place from now on, which need not lie on it. @pre is_bent() is
  /// false for the piece
  void bend(const Foot& foot);
  bool is_bent(std::size_t piece) const { return bent_.contains(piece); }
  /// A curve follows the pieces next to its samples from now on. Where they belong to an interface without a name, this
  /// gets the name and the direction of the curve between two vertices in which other arcs end, if more than half of
  /// its way between them is followed. The first curve counts.
  /// @param part the name of the curve, as Piece::part
  void follow(const ArcCuts& cuts, const SampleRun& run, int part);
  /// Lets a ring begin with this piece.
  void begin_at(std::size_t ring, std::size_t piece) { begins_at_[ring] = static_cast<std::ptrdiff_t>(piece); }

  bool has_turned_rings() const { return !begins_at_.empty(); }
  /// Returns the vertices that a piece has got.
  const std::vector<geometry::Vec2>* feet_on(std::size_t piece) const;
  /// Returns the vertices of all pieces, by their numbers.
  const std::map<std::size_t, std::vector<geometry::Vec2>>& feet() const { return feet_; }
  /// Returns what becomes of an arc. Cost: O(n) for n pieces, and O(m log m) for m feet on a piece.
  std::vector<geometry::InnerArc> parts_of(std::size_t arc) const;

private:
  /// A part of an interface that a curve follows: ways from the start of the arc. In a ring, `to` may lie up to one
  /// turn behind the end.
  struct Followed {
    double from, to;
    bool is_backward; ///< the curve leads from `to` to `from`
    int part;
  };
  /// A part of an arc between two ways. In a ring, `to` may lie behind the end.
  struct Part {
    geometry::InnerArc arc;
    double from, to;
  };

  double way_of(std::size_t at, geometry::Vec2 p) const;
  bool add_divided(std::size_t at, std::vector<Part>& made) const;
  void close(std::vector<Part>& parts, double whole) const;
  void name(Part& part, std::size_t number, double whole) const;

  const LinePieces& lines_;
  const std::vector<geometry::InnerArc>& arcs_;
  std::map<std::size_t, std::vector<geometry::Vec2>> feet_; // by piece
  std::set<std::size_t> bent_;                              // pieces that lead through a place next to them
  std::map<std::size_t, std::ptrdiff_t> begins_at_;         // by ring: its first piece in the next round
  std::map<std::size_t, std::vector<Followed>> followed_;   // by interface
};

} // namespace trime::generalise
