// SPDX-License-Identifier: BSD-3-Clause
// The parts of a shape in which the boundary lowers a uniform size.
#pragma once

#include "placing/rules.hpp"
#include "sizing/lowered_size.hpp"
#include "trime/geometry/lattice.hpp"

namespace trime::placing {

/// @brief The places at which a size that is uniform elsewhere is lowered noticeably. There sites are placed along the
/// Hilbert curve; elsewhere a lattice has the right density. Immutable, thread-safe.
class LoweredZones {
public:
  /// @param size the lowered size; it must outlive this object @param uniform the size before it is lowered
  /// @param gradation growth of the lowered size per length
  LoweredZones(const sizing::LoweredSize& size, double uniform, double gradation)
      : size_(size), below_(PlacingRules::hardly_lowered * uniform), gradation_(gradation) {}

  /// Returns true if p lies in a zone. Takes about 60 ns for a thousand limits of the size.
  bool hold(geometry::Vec2 p) const { return size_.lowered(p, below_) < below_; }
  /// Returns false only if no place within `reach` of p lies in a zone.
  bool may_touch(geometry::Vec2 p, double reach) const {
    const double limit = below_ + gradation_ * reach;
    return size_.lowered(p, limit) < limit;
  }

private:
  const sizing::LoweredSize& size_;
  double below_, gradation_;
};

} // namespace trime::placing
