// SPDX-License-Identifier: BSD-3-Clause
// One mark for each tile that a rank knows.
#pragma once

#include "trime/core/types.hpp"

#include <cstdint>
#include <vector>

namespace trime::mesh {

/// @brief A mark of each known tile, by its number in KnownBins, that its owner sets. Other ranks that know the tile
/// receive the mark with the places of its sites; until then they treat it as set. The code that sets a mark decides
/// what it means.
class TileMarks {
public:
  bool of(LocalIndex tile) const { return marks_[static_cast<std::size_t>(tile)] != 0; }
  void set(LocalIndex tile, bool mark) { marks_[static_cast<std::size_t>(tile)] = mark; }

  /// Sets all marks after sites were sorted. @param tiles number of owned tiles
  void forget(LocalIndex tiles) { marks_.assign(static_cast<std::size_t>(tiles), 1); }
  /// Sets how many tiles are known, and marks the new ones.
  void make_room(LocalIndex tiles) { marks_.resize(static_cast<std::size_t>(tiles), 1); }

private:
  std::vector<std::uint8_t> marks_;
};

} // namespace trime::mesh
