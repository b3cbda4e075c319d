// SPDX-License-Identifier: BSD-3-Clause
// Sites: a site as it travels between ranks, the name of a bin, where sites go at their next move, and the element
// size h at them.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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

/// @brief Places, and leads if sites have leads, that sites take at the next BinnedPoints::advance. They are indexed by
/// local index, and the caller sets them after BinnedPoints::prepare_advance.
class NextPlaces {
public:
  std::span<geometry::Vec2> positions() { return positions_; }
  std::span<const geometry::Vec2> positions() const { return positions_; }
  /// The leads; empty if sites have no leads.
  std::span<geometry::Vec2> leads() { return leads_; }
  std::span<const geometry::Vec2> leads() const { return leads_; }

private:
  friend class BinnedPoints;
  UnsetVector<geometry::Vec2> positions_, leads_;
};

/// Holds one number if h is the same everywhere, otherwise one for each site, or none before they are computed.
class LocalSizes {
public:
  LocalSizes() = default;
  explicit LocalSizes(double uniform) : uniform_(uniform) {}
  explicit LocalSizes(std::vector<double> values) : values_(std::move(values)) {}

  /// Returns false if the size of site i has not been computed since the sites changed.
  bool known(LocalIndex i) const { return uniform_ > 0 || static_cast<std::size_t>(i) < values_.size(); }
  bool is_uniform() const { return uniform_ > 0; }
  /// Returns h at site i in domain units. @pre known(i)
  double operator[](LocalIndex i) const { return uniform_ > 0 ? uniform_ : values_[static_cast<std::size_t>(i)]; }

  const std::vector<double>& values() const { return values_; }
  /// Returns the values by local index, which the caller fills. They are not used while the size is uniform.
  std::vector<double>& values() { return values_; }
  /// Forgets all sizes after the sites have changed.
  void forget() {
    uniform_ = 0;
    values_.clear();
  }

private:
  double uniform_ = 0; // 0: not uniform
  std::vector<double> values_;
};

} // namespace trime::mesh
