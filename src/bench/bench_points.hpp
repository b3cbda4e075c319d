// SPDX-License-Identifier: BSD-3-Clause
// Makes sets of n points in the unit square for benchmarks.
#pragma once

#include "core/angle.hpp"
#include "core/random.hpp"
#include "mesh/binned_points.hpp"
#include "trime/geometry/lattice.hpp"

#include <cmath>
#include <vector>

namespace trime::bench {

inline const geometry::Box unit_square{{0, 0}, {1, 1}};

/// Returns the edge length of equilateral triangles with n vertices that fill the unit square.
inline double spacing_of(std::int64_t n) {
  return std::sqrt(1 / (0.8660254037844386 * static_cast<double>(n)));
}

inline double noise(std::uint64_t key, std::uint64_t slot) {
  return 2 * random_unit(7, RandomPurpose::test, key, slot) - 1;
}

/// Returns a hexagonal lattice with every point moved by up to `jitter` spacings along each axis. With 0.15 it
/// resembles a relaxed mesh.
inline mesh::SiteList jittered_lattice(std::int64_t n, double jitter) {
  const geometry::Lattice lattice(unit_square);
  const double h = spacing_of(n);
  mesh::SiteList sites;
  for (int row = 0; (row + 0.5) * 0.8660254037844386 * h < 1; ++row)
    for (int column = 0; (column + 0.25 + 0.5 * (row & 1)) * h < 1; ++column) {
      const geometry::Vec2 p{(column + 0.25 + 0.5 * (row & 1) + jitter * noise(sites.size(), 0)) * h,
                             ((row + 0.5) * 0.8660254037844386 + jitter * noise(sites.size(), 1)) * h};
      if (unit_square.contains(p))
        sites.push_back({lattice.snap(p)});
    }
  return sites;
}

/// Returns uniform random points.
inline mesh::SiteList random_points(std::int64_t n) {
  const geometry::Lattice lattice(unit_square);
  mesh::SiteList sites;
  for (std::int64_t i = 0; i < n; ++i) {
    const std::uint64_t key = static_cast<std::uint64_t>(i);
    sites.push_back({lattice.snap(geometry::Vec2{0.5 + 0.5 * noise(key, 2), 0.5 + 0.5 * noise(key, 3)})});
  }
  return sites;
}

/// Returns the element size for graded_points. The size grows with the distance from a point inside the square; the
/// densities of points differ by a factor of 900.
inline double graded_size(geometry::Vec2 p) {
  return 0.001 + 0.03 * geometry::length(p - geometry::Vec2{0.4, 0.45});
}

/// Returns random points with a density proportional to graded_size^-2. The sample is stratified, so the number of
/// points equals its expected value.
inline mesh::SiteList graded_points(std::int64_t n) {
  const geometry::Lattice lattice(unit_square);
  mesh::SiteList sites;
  for (std::uint64_t key = 0; static_cast<std::int64_t>(sites.size()) < n; ++key) {
    // A log-uniform radius around the centre approximates the density h^-2; rejection of some points makes it exact.
    const double reach = 0.8, core = 0.001 / 0.03;
    const double r = core * (std::exp(std::log(1 + reach / core) * (0.5 + 0.5 * noise(key, 2))) - 1);
    const SinCos turn = sin_cos(pi * noise(key, 3));
    const geometry::Vec2 p = geometry::Vec2{0.4, 0.45} + r * geometry::Vec2{turn.cos, turn.sin};
    // The radial density of the proposed points is 1/(core + r), and the wanted one is r/(core + r)^2.
    if (unit_square.contains(p) && 0.5 + 0.5 * noise(key, 4) < r / (core + r))
      sites.push_back({lattice.snap(p)});
  }
  return sites;
}

/// Returns the factor of graded_size for which n points fill the square: n = integral of 1 / (0.866 h^2).
inline double graded_factor(std::int64_t n) {
  double sum = 0;
  constexpr int cells = 1000;
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      const double s = graded_size({(x + 0.5) / cells, (y + 0.5) / cells});
      sum += 1 / (0.8660254037844386 * s * s * cells * cells);
    }
  return std::sqrt(sum / static_cast<double>(n));
}

} // namespace trime::bench
