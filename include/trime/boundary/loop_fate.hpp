// SPDX-License-Identifier: BSD-3-Clause
// Part of the result: what happened to each loop of the given boundary.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <vector>

namespace trime::boundary {

/// A loop of the shape and the loops of the mesh that follow it.
struct LoopFate {
  enum class State {
    kept, ///< the curve is unchanged, bit for bit; chords may still leave corners out, see FeatureOptions::tolerance
    simplified, ///< one loop of the mesh follows it and no other
    split,      ///< several loops of the mesh follow it
    merged,     ///< a loop of the mesh follows it and others, or a larger part of the shape covers what it enclosed
    dropped,    ///< the loop and the part of the shape in it are gone
    filled      ///< a hole that now belongs to the shape
  };
  State state = State::kept;
  std::vector<std::int32_t>
      tags;              ///< tags of the mesh loops that follow it, beginning with the one that follows most of it
  geometry::Vec2 place;  ///< its first vertex
  std::int32_t part = 0; ///< part of its first piece, as an index into Boundary::part_names
  double area = 0;       ///< area that it encloses; 0 for a band
  double length = 0;
  double remaining_length = 0; ///< length of the mesh curves that follow it, at most `length`
  double largest_deviation =
      0; ///< distance of these curves from the given boundary, divided by the size that was asked for

  bool is_lost() const { return state == State::merged || state == State::dropped || state == State::filled; }
};

/// Returns "kept", "simplified", ...
const char* to_string(LoopFate::State state);

} // namespace trime::boundary
