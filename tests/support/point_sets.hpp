// SPDX-License-Identifier: BSD-3-Clause
// Sets of points for the tests, regular and difficult ones, all on the coordinate lattice of the unit square.
#pragma once

#include "core/random.hpp"
#include "core/thread_loop.hpp"
#include "mesh/binned_points.hpp"
#include "support/boundary_shapes.hpp"

#include <cmath>
#include <vector>

namespace trime::testing {

/// Sets the number of threads of loops as long as this object exists.
class OnThreads {
public:
  explicit OnThreads(int threads) : before_(thread_count()) { set_thread_count(threads); }
  ~OnThreads() { set_thread_count(before_); }
  OnThreads(const OnThreads&) = delete;
  OnThreads& operator=(const OnThreads&) = delete;

private:
  int before_;
};

/// Returns a random point, uniform in the unit square, rounded to its lattice.
inline geometry::Vec2 random_vec2(std::uint64_t seed, std::uint64_t key) {
  return unit_lattice().snap(geometry::Vec2{random_unit(seed, RandomPurpose::test, key, 0), //
                                            random_unit(seed, RandomPurpose::test, key, 1)});
}

inline mesh::SiteList random_sites(std::size_t n, std::uint64_t seed) {
  mesh::SiteList sites;
  for (std::size_t k = 0; k < n; ++k)
    sites.push_back({random_vec2(seed, k)});
  return sites;
}

/// Returns n x n sites on a square lattice. The four corners of each cell lie on a circle.
inline mesh::SiteList square_lattice(int n, double spacing, geometry::Vec2 origin = {0.125, 0.125}) {
  mesh::SiteList sites;
  const double step = unit_lattice().snap(spacing);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      sites.push_back(
          {unit_lattice().snap(origin) + step * geometry::Vec2{static_cast<double>(i), static_cast<double>(j)}});
  return sites;
}

/// Returns n rows of n sites on a hexagonal lattice.
inline mesh::SiteList hexagonal_lattice(int n, double spacing, geometry::Vec2 origin = {0.125, 0.125}) {
  mesh::SiteList sites;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      sites.push_back({unit_lattice().snap(
          origin + spacing * geometry::Vec2{i + 0.5 * (j & 1), 0.8660254037844386 * static_cast<double>(j)})});
  return sites;
}

/// Returns n sites spread about evenly on a circle, and one in its centre, which has n neighbours.
inline mesh::SiteList wheel(int n, geometry::Vec2 center, double radius) {
  mesh::SiteList sites{{unit_lattice().snap(center)}};
  for (int k = 0; k < n; ++k) {
    const SinCos direction = sin_cos(2 * pi * k / n);
    sites.push_back({unit_lattice().snap(center + radius * geometry::Vec2{direction.cos, direction.sin})});
  }
  return sites;
}

/// Returns sites that lie exactly on two circles: the 36 integer points of the circle of radius 65, and the same at
/// half the size.
inline mesh::SiteList cocircular_rings() {
  mesh::SiteList sites;
  const double unit = 2 * unit_lattice().snap(0.0025); // half of the unit is on the lattice too
  for (const double scale : {unit, 0.5 * unit})
    for (int x = -65; x <= 65; ++x)
      for (int y = -65; y <= 65; ++y)
        if (x * x + y * y == 65 * 65)
          sites.push_back({geometry::Vec2{0.5 + scale * x, 0.5 + scale * y}});
  return sites;
}

/// Returns two dense clusters of sites, and a few sites far away.
inline mesh::SiteList clusters(std::size_t n, std::uint64_t seed) {
  mesh::SiteList sites;
  for (std::size_t k = 0; k < n; ++k) {
    const geometry::Vec2 p = random_vec2(seed, k);
    const double size = k % 10 == 0 ? 1 : k % 2 == 0 ? 1e-3 : 1e-6;
    const geometry::Vec2 at = k % 10 == 0  ? geometry::Vec2{0, 0}
                              : k % 2 == 0 ? geometry::Vec2{0.3, 0.7}
                                           : geometry::Vec2{0.3005, 0.7};
    sites.push_back({unit_lattice().snap(at + size * p)});
  }
  return sites;
}

/// Returns random sites; most of them have another site at a distance of 1e-12 (about nine lattice steps).
inline mesh::SiteList near_duplicates(std::size_t n, std::uint64_t seed) {
  mesh::SiteList sites = random_sites(n, seed);
  for (std::size_t k = 0; k < n; ++k)
    if (k % 4 != 0)
      sites.push_back(
          {unit_lattice().snap(sites[k].position + 1e-12 * (random_vec2(seed + 1, k) - geometry::Vec2{0.5, 0.5}))});
  return sites;
}

/// Returns random sites whose density decreases with the square of the distance from the origin, by a factor of 1000
/// over the unit square.
inline mesh::SiteList graded_sites(std::size_t n, std::uint64_t seed) {
  mesh::SiteList sites;
  for (std::uint64_t k = 0; sites.size() < n; ++k) {
    const geometry::Vec2 u = random_vec2(seed, k);
    const double r = 0.045 * (std::exp(3.5 * u.x) - 1); // up to 1.45
    const SinCos turn = sin_cos(0.5 * pi * u.y);
    const geometry::Vec2 p = unit_lattice().snap(r * geometry::Vec2{turn.cos, turn.sin});
    if (p.x < 1 && p.y < 1)
      sites.push_back({p});
  }
  return sites;
}

/// Returns n sites on one line, which have no triangles.
inline mesh::SiteList collinear(int n) {
  mesh::SiteList sites;
  const double step = unit_lattice().snap(0.01);
  for (int k = 0; k < n; ++k)
    sites.push_back({geometry::Vec2{0.25 + step * k, 0.125 + 0.5 * step * k}});
  return sites;
}

} // namespace trime::testing
