// SPDX-License-Identifier: BSD-3-Clause
// The fan of a site: which triangles of its star lie inside the shape.
#pragma once

#include "decomposition/numbering.hpp"
#include "sites/stage_view.hpp"
#include "trime/core/types.hpp"

#include <cstdint>
#include <span>

namespace trime::sites {

/// @brief The inside fan of a site: the run of ring entries whose consecutive pairs are the triangles inside the shape.
/// For an inner site the whole ring (`closed`); for a boundary site from its next to its previous boundary neighbour.
/// `complete` is false if a triangle or a chord is missing.
struct Fan {
  std::span<const LocalIndex> ring;
  std::size_t first = 0, triangles = 0;
  bool closed = false, complete = false;

  /// @pre k <= triangles + 1
  LocalIndex neighbour(std::size_t k) const {
    const std::size_t at = first + k;
    return ring[at < ring.size() ? at : at - ring.size()];
  }
  /// Number of edges from the site: triangles, plus one for an open fan.
  std::size_t edges() const { return closed ? triangles : triangles + 1; }
};
Fan inside_fan(const StageView& view, LocalIndex i);

/// Owned sites whose fan is not complete, on this rank.
std::int64_t count_incomplete_fans(const StageView& view);

/// @brief The inside fan of a site as flat lists: vertex and position of its neighbours. Triangle k has the neighbours
/// k and k + 1; a closed fan ends with its first two neighbours again.
class FlatFan {
public:
  FlatFan(const StageView& view, const decomposition::Numbering& numbering) : view_(view), numbering_(numbering) {}

  void load(LocalIndex site);
  /// Triangles whose other vertices have higher places than `own`, by the place of the first of these.
  std::span<const std::uint32_t> triangles_above(LocalIndex own);

  bool closed = false, complete = false;
  std::size_t triangles = 0, edges = 0;    ///< edges: of complete fans, else 0
  UnsetVector<LocalIndex> vertices, place; ///< place: see Numbering
  UnsetVector<geometry::Vec2> positions;

private:
  const StageView& view_;
  const decomposition::Numbering& numbering_;
  UnsetVector<std::uint32_t> above_;
};

} // namespace trime::sites
