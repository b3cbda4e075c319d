// SPDX-License-Identifier: BSD-3-Clause
// Holds the places to which sites will move, while they are still at their present places.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstddef>
#include <span>

namespace trime::mesh {

/// @brief Places, and leads if sites have leads, that sites take at the next BinnedPoints::advance. They are indexed by
/// local index, and the caller sets them after BinnedPoints::prepare_advance.
class NextPlaces {
public:
  std::span<geometry::Vec2> positions() { return positions_; }
  std::span<const geometry::Vec2> positions() const { return positions_; }
  /// The leads; empty if sites have no leads.
  std::span<geometry::Vec2> leads() { return leads_; }
  std::span<const geometry::Vec2> leads() const { return leads_; }

private:
  friend class BinnedPoints;
  UnsetVector<geometry::Vec2> positions_, leads_;
};

} // namespace trime::mesh
