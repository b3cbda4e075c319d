// SPDX-License-Identifier: BSD-3-Clause
// The data of sites: a site as ranks exchange it, the identifier of a bin, the places of sites after their next move,
// and the target edge length h at sites.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace trime::mesh {

/// Values of Site::boundary for sites that are not on the boundary: sites that move, and fixed points of the user.
inline constexpr std::int32_t free_site = -1, fixed_site = -2;

/// A site with all data that move with it to another rank.
struct Site {
  geometry::Vec2 position;
  std::int32_t boundary = free_site; ///< index among the boundary sites; free_site or fixed_site for other sites
  std::int32_t pushes = 0;           ///< how often the site was pushed out of the diametral circle of a boundary edge
  geometry::Vec2
      lead{}; ///< momentum part of the last step, by which an accelerated update rule moves the site beyond its iterate
};

/// A list of unsorted sites. Elements made without a value, for example by resize, are uninitialised (they do not have
/// the defaults of Site), because threads fill them in large numbers.
using SiteList = UnsetVector<Site>;

/// The data of a site that its owner sends to ranks with a copy of it: 24 bytes.
struct Ghost {
  geometry::Vec2 position;
  std::int32_t boundary = -1;
  std::int32_t unused = 0; ///< fills up the struct, so that a message has no undefined byte
};

/// A bin of a tile, or of a periodic image of a tile (see TileGrid).
struct BinRef {
  LocalIndex tile;
  std::int32_t bin;
  std::int32_t image = 0;
  friend auto operator<=>(const BinRef&, const BinRef&) = default;
};

/// @brief The positions that sites take at the next BinnedPoints::advance, and their leads if they have leads. Indexed
/// by local index; the caller sets them after BinnedPoints::prepare_advance.
class NextPlaces {
public:
  std::span<geometry::Vec2> positions() { return positions_; }
  std::span<const geometry::Vec2> positions() const { return positions_; }
  /// Returns the leads (momentum parts of the steps); empty if sites have no leads.
  std::span<geometry::Vec2> leads() { return leads_; }
  std::span<const geometry::Vec2> leads() const { return leads_; }

private:
  friend class BinnedPoints;
  UnsetVector<geometry::Vec2> positions_, leads_;
};

/// The target edge length h of the sites: one number if h is the same everywhere, otherwise one number for each site.
/// Empty until computed.
class LocalSizes {
public:
  LocalSizes() = default;
  explicit LocalSizes(double uniform) : uniform_(uniform) {}
  explicit LocalSizes(std::vector<double> values) : values_(std::move(values)) {}

  /// Returns whether the size of site i has been computed since the sites last changed.
  bool known(LocalIndex i) const { return uniform_ > 0 || static_cast<std::size_t>(i) < values_.size(); }
  bool is_uniform() const { return uniform_ > 0; }
  /// Returns h at site i in domain units.
  /// @pre known(i)
  double operator[](LocalIndex i) const { return uniform_ > 0 ? uniform_ : values_[static_cast<std::size_t>(i)]; }

  const std::vector<double>& values() const { return values_; }
  /// Returns the values by local index for the caller to fill. The values are not used if the size is uniform.
  std::vector<double>& values() { return values_; }
  /// Forgets all sizes after the sites have changed.
  void forget() {
    uniform_ = 0;
    values_.clear();
  }

private:
  double uniform_ = 0; // the size if it is uniform, otherwise 0
  std::vector<double> values_;
};

} // namespace trime::mesh
