// SPDX-License-Identifier: BSD-3-Clause
// The parts of a shape in which the boundary lowers a uniform size.
#pragma once

#include "sizing/lowered_size.hpp"
#include "trime/geometry/lattice.hpp"

namespace trime::placing {

/// @brief The places at which a size that is uniform elsewhere is lowered noticeably. There sites are placed along the
/// Hilbert curve; elsewhere a lattice has the right density. Immutable, thread-safe.
class LoweredZones {
public:
  /// [1] A zone is where the size is lowered to a smaller share of the uniform size than this. Values from 0.8 to 0.99
  /// gave the same mean alpha, to 0.0003, on coasts of 2e4 points and more.
  static constexpr double hardly_lowered = 0.97;

  /// @param size the lowered size; it must outlive this object @param uniform the size before it is lowered
  /// @param gradation growth of the lowered size per length
  LoweredZones(const sizing::LoweredSize& size, double uniform, double gradation)
      : size_(size), below_(hardly_lowered * uniform), gradation_(gradation) {}

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
