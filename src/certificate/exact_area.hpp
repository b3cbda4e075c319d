// SPDX-License-Identifier: BSD-3-Clause
// Adds areas so that the sum does not depend on order, threads and ranks.
#pragma once

#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <array>
#include <cstdint>

namespace trime::certificate {

__extension__ using Int128 = __int128;

/// Twice an area in squared lattice steps. It is an integer, which ranks exchange in three parts of 40 bits and a rest.
struct ExactArea {
  Int128 twice = 0;

  /// Adds the exact area of a triangle. @pre the vertices lie on the lattice
  void add_triangle(geometry::Vec2 p, geometry::Vec2 q, geometry::Vec2 r, const geometry::Lattice& lattice) {
    const Int128 ux = lattice.steps(q.x - p.x), uy = lattice.steps(q.y - p.y);
    const Int128 vx = lattice.steps(r.x - p.x), vy = lattice.steps(r.y - p.y);
    twice += ux * vy - uy * vx;
  }
  /// Adds any area, rounded to half a squared step, which is at most 2^-86 of the area of the container.
  void add(double area, const geometry::Lattice& lattice) {
    twice += static_cast<Int128>(2 * area * lattice.inverse_step() * lattice.inverse_step());
  }
  void add(const ExactArea& other) { twice += other.twice; }

  std::array<std::int64_t, 3> split() const {
    constexpr Int128 mask = (Int128{1} << 40) - 1;
    return {static_cast<std::int64_t>(twice & mask), static_cast<std::int64_t>((twice >> 40) & mask),
            static_cast<std::int64_t>(twice >> 80)};
  }
  static ExactArea join(const std::array<std::int64_t, 3>& parts) {
    return {(Int128{parts[2]} << 80) + (Int128{parts[1]} << 40) + parts[0]};
  }
  double value(const geometry::Lattice& lattice) const {
    return 0.5 * static_cast<double>(twice) * lattice.step() * lattice.step();
  }
};

} // namespace trime::certificate
