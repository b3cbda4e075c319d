// SPDX-License-Identifier: BSD-3-Clause
// A site as it is sent between ranks, and the name of a bin.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <compare>
#include <cstdint>

namespace trime::mesh {

/// Values of Site::boundary for inner sites that move, and for fixed points of the user.
inline constexpr std::int32_t free_site = -1, fixed_site = -2;

/// A site with all data that travel with it to another rank.
struct Site {
  geometry::Vec2 position;
  std::int32_t boundary = free_site; ///< index among the boundary sites; free_site or fixed_site for inner sites
  std::int32_t pushes = 0;           ///< how often it was pushed out of the disc of a boundary edge
  geometry::Vec2 lead{};             ///< the step by which an accelerated update runs ahead of its last iterate
};

/// Sites that are not sorted yet. Elements made without a value, as by resize, are not set, not even to the defaults of
/// Site, because threads fill them in large numbers.
using SiteList = UnsetVector<Site>;

/// A site as its owner sends it to ranks that hold a copy: 24 bytes.
struct Ghost {
  geometry::Vec2 position;
  std::int32_t boundary = -1;
  std::int32_t unused = 0; ///< makes every byte of a message defined
};

/// A bin of a tile, or of an image of a tile (see TileGrid).
struct BinRef {
  LocalIndex tile;
  std::int32_t bin;
  std::int32_t image = 0;
  friend auto operator<=>(const BinRef&, const BinRef&) = default;
};

} // namespace trime::mesh
