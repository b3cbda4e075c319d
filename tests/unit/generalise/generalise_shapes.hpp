// SPDX-License-Identifier: BSD-3-Clause
// Random shapes of several classes with narrow parts, in the unit square. No boundary crosses or touches itself.
#pragma once

#include "core/random.hpp"
#include "support/boundary_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace trime::generalise {

using geometry::Boundary;
using geometry::Loop;
using geometry::Vec2;
using testing::boundary_of;
using testing::polygon_loop;

/// A sequence of random numbers from a seed.
class Draws {
public:
  explicit Draws(std::uint64_t seed) : seed_(seed) {}
  double unit() { return random_unit(seed_, RandomPurpose::test, next_++, 0); }
  double between(double low, double high) { return low + (high - low) * unit(); }
  double log_between(double low, double high) { return low * std::pow(high / low, unit()); }
  int whole(int low, int high) { return low + static_cast<int>(unit() * (high - low + 1)); }

private:
  std::uint64_t seed_, next_ = 0;
};

inline std::vector<Vec2> reversed(std::vector<Vec2> ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

/// Returns fractal noise around 0 at n places on a circle, by midpoint displacement with decreasing amplitude.
inline std::vector<double> fractal_noise(Draws& draws, std::size_t n, double roughness) {
  std::vector<double> noise(n);
  double height = 1;
  for (std::size_t step = n / 2; step >= 1; step /= 2, height *= roughness)
    for (std::size_t k = 0; k < n; k += 2 * step)
      if (k + step < n)
        noise[k + step] = 0.5 * (noise[k] + noise[(k + 2 * step) % n]) + height * draws.between(-0.5, 0.5);
  return noise;
}

/// Returns a polygon around a centre; its radii are between a third of `radius` and `radius`.
inline std::vector<Vec2> rough_ring(Draws& draws, Vec2 center, double radius, std::size_t n, double roughness) {
  const std::vector<double> noise = fractal_noise(draws, n, roughness);
  std::vector<Vec2> ring;
  for (std::size_t k = 0; k < n; ++k) {
    const SinCos turn = sin_cos(2 * pi * static_cast<double>(k) / static_cast<double>(n));
    const double r = radius * std::clamp(0.7 + 0.4 * noise[k], 0.34, 1.0);
    ring.push_back(center + r * Vec2{turn.cos, turn.sin});
  }
  return ring;
}

/// Returns a square with a kinked crack that begins at its right side.
inline Boundary crack(Draws& draws) {
  const double width = draws.log_between(1e-7, 1e-2);
  const int kinks = draws.whole(0, 4);
  std::vector<Vec2> low, ring{{0.1, 0.1}, {0.9, 0.1}};
  double y = 0.5;
  for (int k = 0; k <= kinks + 1; ++k) {
    low.push_back({0.9 - 0.5 * k / (kinks + 1), y});
    y += draws.between(-0.05, 0.05);
  }
  ring.insert(ring.end(), low.begin(), low.end());
  for (auto p = low.rbegin(); p != low.rend(); ++p)
    ring.push_back(*p + Vec2{0, width});
  ring.insert(ring.end(), {{0.9, 0.9}, {0.1, 0.9}});
  return boundary_of({polygon_loop(ring)});
}

inline Boundary blunt_tip(Draws& draws) {
  const double blunt = draws.log_between(1e-8, 1e-3), reach = draws.between(0.7, 0.9);
  return boundary_of({polygon_loop({{0.1, 0.1},
                                    {0.6, 0.1},
                                    {0.6, 0.4},
                                    {reach, 0.5 - blunt},
                                    {reach + 0.4 * blunt, 0.5},
                                    {reach, 0.5 + blunt},
                                    {0.6, 0.6},
                                    {0.6, 0.9},
                                    {0.1, 0.9}})});
}

/// Returns a bar with teeth; some gaps between teeth are narrow, others wide.
inline Boundary comb(Draws& draws) {
  std::vector<Vec2> ring{{0.05, 0.1}, {0.95, 0.1}};
  std::vector<Vec2> top;
  for (double x = 0.05; x < 0.85;) {
    const double tooth = draws.log_between(1e-4, 0.06), gap = draws.log_between(1e-4, 0.06);
    const double height = draws.between(0.4, 0.9);
    top.insert(top.end(), {{x, 0.3}, {x, height}, {x + tooth, height}, {x + tooth, 0.3}});
    x += tooth + gap;
  }
  ring.push_back({0.95, 0.3});
  for (auto p = top.rbegin(); p != top.rend(); ++p)
    ring.push_back(*p);
  return boundary_of({polygon_loop(ring)});
}

/// Returns a rough coast with straight spits and inlets.
inline Boundary spits(Draws& draws) {
  const std::size_t n = std::size_t{1} << draws.whole(6, 9);
  std::vector<Vec2> ring = rough_ring(draws, {0.5, 0.5}, 0.35, n, draws.between(0.4, 0.65));
  for (std::size_t k = 4; k + 8 < n; k += static_cast<std::size_t>(draws.whole(8, 30))) {
    const double factor = draws.unit() < 0.5 ? draws.between(1.1, 1.25) : draws.between(0.5, 0.9);
    ring[k] = Vec2{0.5, 0.5} + factor * (ring[k] - Vec2{0.5, 0.5});
    if (draws.unit() < 0.6) // not sharp
      ring[k + 1] = Vec2{0.5, 0.5} + factor * (ring[k + 1] - Vec2{0.5, 0.5});
  }
  return boundary_of({polygon_loop(ring)});
}

/// Returns a box with chambers separated by thin walls.
inline Boundary thin_walls(Draws& draws) {
  std::vector<Loop> loops{polygon_loop({{0.05, 0.05}, {0.95, 0.05}, {0.95, 0.95}, {0.05, 0.95}})};
  const int n = draws.whole(2, 5);
  const double side = 0.8 / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec2 a{0.1 + side * i, 0.1 + side * j};
      const auto inset = [&] { return draws.log_between(1e-6, 0.2 * side); };
      loops.push_back(
          polygon_loop(reversed({a + Vec2{inset(), inset()}, a + Vec2{side - inset(), inset()},
                                 a + Vec2{side - inset(), side - inset()}, a + Vec2{inset(), side - inset()}}),
                       static_cast<int>(loops.size()) + 1));
    }
  return boundary_of(std::move(loops));
}

/// Returns a row of islands that nearly touch; some have lakes with thin rims.
inline Boundary islands(Draws& draws) {
  std::vector<Loop> loops;
  for (double y = 0.2; y < 0.9; y += 0.3)
    for (double x = 0.05; x < 0.9;) {
      const double radius = draws.log_between(2e-3, 0.12);
      const Vec2 center{x + radius, y};
      if (center.x + radius > 0.97)
        break;
      const std::size_t n = std::size_t{1} << draws.whole(3, 7);
      loops.push_back(polygon_loop(rough_ring(draws, center, radius, n, 0.5), static_cast<int>(loops.size()) + 1));
      if (draws.unit() < 0.5) {
        // The lake is a smaller copy of the island.
        std::vector<Vec2> lake;
        const double share = 1 - draws.log_between(1e-4, 0.5);
        for (const geometry::Piece& piece : loops.back().pieces)
          lake.push_back(center + share * (piece.start - center));
        loops.push_back(polygon_loop(reversed(lake), static_cast<int>(loops.size()) + 1));
      }
      x += 2 * radius + draws.log_between(1e-6, 0.02);
    }
  return boundary_of(std::move(loops));
}

inline Boundary rough_coast(Draws& draws) {
  const std::size_t n = std::size_t{1} << draws.whole(6, 11);
  return boundary_of({polygon_loop(rough_ring(draws, {0.5, 0.5}, 0.45, n, draws.between(0.45, 0.8)))});
}

/// Returns a rough coast on which some vertices have a second vertex at a distance of 1e-7.
inline Boundary near_vertices(Draws& draws) {
  std::vector<Vec2> ring;
  const std::vector<Vec2> single = rough_ring(draws, {0.5, 0.5}, 0.45, std::size_t{1} << draws.whole(5, 9), 0.5);
  for (std::size_t k = 0; k < single.size(); ++k) {
    ring.push_back(single[k]);
    const Vec2 along = single[(k + 1) % single.size()] - single[k];
    if (draws.unit() < 0.5)
      ring.push_back(single[k] + (draws.between(0.2e-7, 1e-7) / length(along)) * along);
  }
  return boundary_of({polygon_loop(ring)});
}

/// Returns a square with a row of round holes, bounded by arcs, with thin bridges between them.
inline Boundary round_holes(Draws& draws) {
  std::vector<Loop> loops{polygon_loop({{0.05, 0.05}, {0.95, 0.05}, {0.95, 0.95}, {0.05, 0.95}})};
  for (double y = 0.3; y < 0.8; y += 0.4)
    for (double x = 0.05 + draws.log_between(1e-4, 0.1); x < 0.7;) {
      const double radius = draws.log_between(5e-3, 0.1);
      loops.push_back(testing::circle_loop({x + radius, y}, radius, true, 4, static_cast<int>(loops.size()) + 1));
      x += 2 * radius + draws.log_between(1e-4, 0.05);
    }
  return boundary_of(std::move(loops));
}

/// A class of random shapes, with its name.
struct ShapeClass {
  const char* name;
  std::function<Boundary(Draws&)> make;
};

inline const std::vector<ShapeClass>& shape_classes() {
  static const std::vector<ShapeClass> classes{
      {"crack", crack},       {"blunt tip", blunt_tip},         {"comb", comb},
      {"spits", spits},       {"thin walls", thin_walls},       {"islands", islands},
      {"coast", rough_coast}, {"near vertices", near_vertices}, {"round holes", round_holes}};
  return classes;
}

} // namespace trime::generalise
