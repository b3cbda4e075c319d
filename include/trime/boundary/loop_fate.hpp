// SPDX-License-Identifier: BSD-3-Clause
// What became of a loop of the boundary that was given: a part of the result.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <vector>

namespace trime::boundary {

/// A loop of the shape and the loops of the mesh that follow it.
struct LoopFate {
  enum class State {
    kept,       ///< bit for bit; chords may leave corners out, see FeatureOptions::tolerance
    simplified, ///< one loop of the mesh follows it and no other
    split,      ///< several loops of the mesh follow it
    merged,     ///< a loop of the mesh follows it and others, or what it encloses is within a larger part of the shape
    dropped,    ///< gone, and the shape with it
    filled      ///< a hole that is a part of the shape now
  };
  State state = State::kept;
  std::vector<std::int32_t> tags; ///< of the loops of the mesh that follow it: that with most of it first
  geometry::Vec2 place;           ///< its first vertex
  std::int32_t part = 0;          ///< index into Boundary::part_names: that of its first piece
  double area = 0;                ///< that it encloses; 0 for a band
  double length = 0;
  double remaining_length = 0;  ///< of the curves of the mesh that follow it, at most `length`
  double largest_deviation = 0; ///< of these from the given boundary, over the size that was asked for

  bool is_lost() const { return state == State::merged || state == State::dropped || state == State::filled; }
};

/// "kept", "simplified", ...
const char* to_string(LoopFate::State state);

} // namespace trime::boundary
