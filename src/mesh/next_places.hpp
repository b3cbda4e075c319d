// SPDX-License-Identifier: BSD-3-Clause
// Where sites go at their next move, while they still stand where they are.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstddef>
#include <span>

namespace trime::mesh {

/// @brief The places, and the leads where sites have leads, that sites take at the next BinnedPoints::advance. By local
/// index; to be filled by the caller after BinnedPoints::prepare_advance.
class NextPlaces {
public:
  std::span<geometry::Vec2> positions() { return positions_; }
  std::span<const geometry::Vec2> positions() const { return positions_; }
  /// Empty where sites have no leads.
  std::span<geometry::Vec2> leads() { return leads_; }
  std::span<const geometry::Vec2> leads() const { return leads_; }

private:
  friend class BinnedPoints;
  UnsetVector<geometry::Vec2> positions_, leads_;
};

} // namespace trime::mesh
