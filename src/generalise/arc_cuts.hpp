// SPDX-License-Identifier: BSD-3-Clause
// Cuts those parts out of an arc that belong to other lines.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace trime::generalise {

/// A place along an arc.
struct Sample {
  std::size_t piece; ///< number of a piece of the arc
  double way;        ///< from the start of the arc
  geometry::Vec2 place;
  double h;                   ///< there
  double distance = INFINITY; ///< from the nearest line that the arc may follow; infinity if that is far away
  std::size_t at = 0;         ///< the nearest piece of that line, as a number of LinePieces
  /// Returns whether it is nearer to that line than GeneraliseRules::rim_distance h.
  bool is_near() const;
};

/// Returns how far the line next to an arc may lead between its places nearest to two samples, one after the other, if
/// the arc follows it there. Around a corner, these places are farther apart.
double longest_way_beside(const Sample& before, const Sample& behind);

/// Samples next to other lines, one after the other.
struct SampleRun {
  std::size_t first, last;
};

/// A vertex of a line, or a place where it gets one.
struct Foot {
  geometry::Vec2 place;
  std::size_t at; ///< the piece on which it lies, as a number of LinePieces
};

/// The feet at the beginning and the end of a run.
using Feet = std::array<std::optional<Foot>, 2>;

/// Says which parts of an arc belong to other lines, and where the rest of it ends.
struct ArcCuts {
  std::size_t arc; ///< its number
  const geometry::InnerArc* given;
  std::vector<Sample> samples;   ///< from the start of the arc to its end
  std::vector<SampleRun> runs{}; ///< that belong to other lines, in their order
  std::vector<Feet> feet{};      ///< by run; there is a foot where a part of the arc is left before or behind it

  /// Returns whether the run ends where the arc starts (side 0) or ends (side 1).
  bool is_end(const SampleRun& run, std::size_t side) const {
    return side == 0 ? run.first == 0 : run.last + 1 == samples.size();
  }
  /// Returns the last sample that is left before a run (side 0) or the first one behind it. @pre there is one
  const Sample& beyond(const SampleRun& run, std::size_t side) const {
    return samples[side == 0 ? run.first - 1 : run.last + 1];
  }
  /// Returns a straight piece with the name of the arc; its ends lie on the lattice.
  geometry::Piece edge(geometry::Vec2 from, geometry::Vec2 to, const geometry::Lattice& lattice) const;
  /// Returns what is left of the arc, with straight edges that lead to the feet. Cost: O(samples + pieces).
  std::vector<geometry::InnerArc> rest(const geometry::Lattice& lattice) const;
};

} // namespace trime::generalise
