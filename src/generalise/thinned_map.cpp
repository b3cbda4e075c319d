// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/thinned_map.hpp"

#include "polygon/polygon.hpp"

namespace trime::generalise {

ThinnedMap thinned_map(const geometry::Boundary& boundary, const sizing::SizeField& size,
                       const geometry::Lattice& lattice, std::span<const geometry::Vec2> inside,
                       std::span<const ThinningTrial> trials) {
  ThinnedMap made;
  double share_before = 0;
  std::int64_t pieces_before = 0;
  for (const auto& [share, thinning] : trials) {
    made.map.reset(); // before the curves that it refers to
    made.thinned = without_ragged_runs(boundary, size, share, thinning);
    if (!made.thinned)
      break;
    const std::int64_t pieces = polygon::piece_count(*made.thinned);
    const bool are_the_same = share == share_before && pieces == pieces_before; // no loop was dense
    share_before = share;
    pieces_before = pieces;
    if (are_the_same)
      continue;
    made.map.emplace(*made.thinned, size, lattice, inside);
    if (made.map->is_valid())
      return made;
  }
  made.map.reset();
  made.thinned = nullptr;
  return made;
}

} // namespace trime::generalise
