// SPDX-License-Identifier: BSD-3-Clause
// Edges as the triangles of a mesh have them, and sets that are joined step by step.
#pragma once

#include "mesh.hpp"

#include <cstdint>
#include <vector>

namespace trime_check {

/// An edge as one triangle has it.
struct Side {
  std::int64_t low, high;
  std::uint32_t triangle; // its number; larger meshes do not fit on one machine
  std::uint8_t corner;    // opposite to it
  bool forward;           // the triangle runs from low to high

  bool is_same_edge(const Side& other) const { return low == other.low && high == other.high; }
  /// Returns the edge in the direction in which the triangle lies on its left.
  Facet directed() const { return forward ? Facet{low, high} : Facet{high, low}; }
};

/// Returns the sides of all triangles, sorted by their points: those of one edge follow each other.
std::vector<Side> sides_of(const Mesh& mesh);

/// A union-find of numbers.
class Components {
public:
  explicit Components(std::size_t count);
  std::int64_t root(std::int64_t i) {
    while (of(i) != i)
      i = of(i) = of(of(i));
    return i;
  }
  void join(std::int64_t a, std::int64_t b) { of(root(a)) = root(b); }

private:
  std::int64_t& of(std::int64_t i) { return parent_[static_cast<std::size_t>(i)]; }
  std::vector<std::int64_t> parent_;
};

} // namespace trime_check
