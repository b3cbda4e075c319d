// SPDX-License-Identifier: BSD-3-Clause
// A site, as it travels between ranks, and the name of a bin.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <compare>
#include <cstdint>

namespace trime::mesh {

/// Values of Site::boundary for sites inside: those that move, and those that stay where a user wants them.
inline constexpr std::int32_t free_site = -1, fixed_site = -2;

/// A site with all that travels with it when it changes its owner.
struct Site {
  geometry::Vec2 position;
  std::int32_t boundary = free_site; ///< index of the boundary site that it is; inside free_site or fixed_site
  std::int32_t pushes = 0;           ///< times that it was pushed out of a boundary disc
  geometry::Vec2 lead{};             ///< the step by which an accelerated update runs ahead of its last iterate
};

/// Sites in no order yet. Elements made without a value (resize, a list of a given size) are not set, not even to the
/// defaults of Site: threads fill them in large numbers.
using SiteList = UnsetVector<Site>;

/// A site of another rank, as it is sent: 24 bytes.
struct Ghost {
  geometry::Vec2 position;
  std::int32_t boundary = -1;
  std::int32_t unused = 0; ///< no byte of a message is left to chance
};

/// A bin of a tile, or of an image of a tile (see TileGrid).
struct BinRef {
  LocalIndex tile;
  std::int32_t bin;
  std::int32_t image = 0;
  friend auto operator<=>(const BinRef&, const BinRef&) = default;
};

} // namespace trime::mesh
