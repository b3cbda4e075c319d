// SPDX-License-Identifier: BSD-3-Clause
// Finds the triangles of a star that lie inside the shape. Together they are called the fan of the site.
#pragma once

#include "decomposition/numbering.hpp"
#include "sites/stage.hpp"
#include "trime/core/types.hpp"

#include <cstdint>
#include <span>

namespace trime::sites {

/// @brief The fan of a site: the part of its ring of neighbours whose consecutive pairs form the triangles inside the
/// shape. For an inner site this is the whole ring (`closed`); for a boundary site it runs from the next to the
/// previous boundary neighbour. `complete` is false if a triangle or a boundary edge is missing.
struct Fan {
  std::span<const LocalIndex> ring;
  std::size_t first = 0, triangles = 0;
  bool closed = false, complete = false;

  /// Returns the k-th neighbour of the fan.
  /// @pre k <= triangles + 1
  LocalIndex neighbour(std::size_t k) const {
    const std::size_t at = first + k;
    return ring[at < ring.size() ? at : at - ring.size()];
  }
  /// Returns the number of edges at the site: one for each triangle, and one more if the fan is not closed.
  std::size_t edges() const { return closed ? triangles : triangles + 1; }
};
Fan inside_fan(const StageView& view, LocalIndex i);

/// Counts the owned sites of this rank whose fan is incomplete.
std::int64_t count_incomplete_fans(const StageView& view);

/// @brief The fan of a site as arrays of the vertices and positions of its neighbours. Triangle k has the neighbours k
/// and k + 1; a closed fan repeats its first two neighbours at the end.
class FlatFan {
public:
  FlatFan(const StageView& view, const decomposition::Numbering& numbering) : view_(view), numbering_(numbering) {}

  void load(LocalIndex site);
  /// Returns the triangles whose two other vertices both have higher places than `own`, ordered by the place of the
  /// first of the two.
  std::span<const std::uint32_t> triangles_above(LocalIndex own);

  bool closed = false, complete = false;
  std::size_t triangles = 0, edges = 0;    ///< edges is 0 if the fan is incomplete
  UnsetVector<LocalIndex> vertices, place; ///< place: order of the vertices, see Numbering::place
  UnsetVector<geometry::Vec2> positions;

private:
  const StageView& view_;
  const decomposition::Numbering& numbering_;
  UnsetVector<std::uint32_t> above_;
};

} // namespace trime::sites
