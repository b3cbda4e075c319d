// SPDX-License-Identifier: BSD-3-Clause
// Says which area a region of a shape loses to another region in the mesh, and for which reason.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace trime::geometry {

/// The reason for which an area belongs to another region in the mesh than in the shape as it was given.
enum class LossReason : std::int32_t {
  crumb,       ///< a part of a region with a short perimeter
  sliver,      ///< a part of a region that is narrower than the triangles
  pinch_out,   ///< the tip of a wedge between two interfaces
  close_nodes, ///< nodes of interfaces have become one
  thinning,    ///< the interface is a simpler curve
  chords       ///< edges of the mesh are straight where the interface is round or has a small turn
};

/// Returns the word for a reason in tables.
constexpr std::string_view name_of(LossReason reason) {
  constexpr std::array<std::string_view, 6> names{"crumb", "sliver", "pinch-out", "close nodes", "thinning", "chords"};
  return names[static_cast<std::size_t>(reason)];
}

/// An area that one region loses to another one, for one reason.
struct RegionLoss {
  int loser = 0, winner = 0; ///< indices into Regions::names
  LossReason reason = LossReason::crumb;
  double area = 0;
  std::int64_t count = 0; ///< number of places
  double largest = 0;     ///< largest of the areas that add up to `area`
  Vec2 place;             ///< where the largest one is
};

} // namespace trime::geometry
