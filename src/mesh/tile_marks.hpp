// SPDX-License-Identifier: BSD-3-Clause
// A mark of each tile that a rank knows.
#pragma once

#include "trime/core/types.hpp"

#include <cstdint>
#include <vector>

namespace trime::mesh {

/// @brief For each known tile, by its number in KnownBins, a mark that its owner sets. Other ranks that know the tile
/// get it with the places of its sites; until then they take it as set. What it means is the affair of who sets it.
class TileMarks {
public:
  bool of(LocalIndex tile) const { return marks_[static_cast<std::size_t>(tile)] != 0; }
  void set(LocalIndex tile, bool mark) { marks_[static_cast<std::size_t>(tile)] = mark; }

  /// After sites were sorted: all marks are set. @param tiles the owned ones
  void forget(LocalIndex tiles) { marks_.assign(static_cast<std::size_t>(tiles), 1); }
  /// Sets how many tiles are known, and marks the new ones.
  void make_room(LocalIndex tiles) { marks_.resize(static_cast<std::size_t>(tiles), 1); }

private:
  std::vector<std::uint8_t> marks_;
};

} // namespace trime::mesh
