// SPDX-License-Identifier: BSD-3-Clause
// Point sets of the benchmarks: the unit square filled with n points.
#pragma once

#include "trime/core/random.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/mesh/binned_points.hpp"

#include <cmath>
#include <vector>

namespace trime::bench {

inline const geometry::Box unit_square{{0, 0}, {1, 1}};

/// Edge length of n equilateral triangles' vertices in the unit square.
inline double spacing_of(std::int64_t n) {
  return std::sqrt(1 / (0.8660254037844386 * static_cast<double>(n)));
}

inline double noise(std::uint64_t key, std::uint64_t slot) {
  return 2 * random_unit(7, RandomPurpose::test, key, slot) - 1;
}

/// Hexagonal lattice, every point moved by up to `jitter` spacings along each axis: like a relaxed mesh at 0.15.
inline std::vector<mesh::Site> jittered_lattice(std::int64_t n, double jitter) {
  const geometry::Lattice lattice(unit_square);
  const double h = spacing_of(n);
  std::vector<mesh::Site> sites;
  for (int row = 0; (row + 0.5) * 0.8660254037844386 * h < 1; ++row)
    for (int column = 0; (column + 0.25 + 0.5 * (row & 1)) * h < 1; ++column) {
      const geometry::Vec2 p{(column + 0.25 + 0.5 * (row & 1) + jitter * noise(sites.size(), 0)) * h,
                             ((row + 0.5) * 0.8660254037844386 + jitter * noise(sites.size(), 1)) * h};
      if (unit_square.contains(p))
        sites.push_back({lattice.snap(p)});
    }
  return sites;
}

/// Uniform random points.
inline std::vector<mesh::Site> random_points(std::int64_t n) {
  const geometry::Lattice lattice(unit_square);
  std::vector<mesh::Site> sites;
  for (std::int64_t i = 0; i < n; ++i) {
    const std::uint64_t key = static_cast<std::uint64_t>(i);
    sites.push_back({lattice.snap(geometry::Vec2{0.5 + 0.5 * noise(key, 2), 0.5 + 0.5 * noise(key, 3)})});
  }
  return sites;
}

} // namespace trime::bench
