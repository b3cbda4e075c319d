// SPDX-License-Identifier: BSD-3-Clause
// The lists of sites that SiteOrder can sort: a list, or the sites of a rank at their next places. A site is sorted
// into the tile and bin of its home. The home is the site's position, except when a checkpoint is restored.
#pragma once

#include "mesh/binned_points.hpp"

#include <span>

namespace trime::mesh {

/// The sites of a list.
class ListedSites {
public:
  static constexpr bool drops_equal = true; ///< if several sites lie at one place, only one is kept
  explicit ListedSites(std::span<const Site> sites) : sites_(sites) {}
  LocalIndex size() const { return static_cast<LocalIndex>(sites_.size()); }
  bool stays(LocalIndex) const { return true; }
  geometry::Vec2 position(LocalIndex i) const { return sites_[at(i)].position; }
  geometry::Vec2 home(LocalIndex i) const { return position(i); }
  std::int32_t boundary(LocalIndex i) const { return sites_[at(i)].boundary; }
  std::int32_t pushes(LocalIndex i) const { return sites_[at(i)].pushes; }
  geometry::Vec2 lead(LocalIndex i) const { return sites_[at(i)].lead; }

private:
  std::span<const Site> sites_;
};

/// A list of sites that have moved since they were sorted into tiles, and that return to these tiles. If two sites have
/// met since then, both are kept, because an uninterrupted run drops one of them only at its next sorting.
class HomedSites : public ListedSites {
public:
  static constexpr bool drops_equal = false;
  /// @param homes for each site, a point in the tile to which it belongs
  HomedSites(std::span<const Site> sites, std::span<const geometry::Vec2> homes) : ListedSites(sites), homes_(homes) {}
  geometry::Vec2 home(LocalIndex i) const { return homes_[at(i)]; }

private:
  std::span<const geometry::Vec2> homes_;
};

/// The owned sites at their next places, except removed ones, followed by new sites.
class MovedSites {
public:
  static constexpr bool drops_equal = true;
  /// @param gone 1 for each owned site that is removed, by local index; empty if no site is removed
  MovedSites(const BinnedPoints& points, std::span<const std::uint8_t> gone, std::span<const Site> more)
      : points_(points), next_positions_(points.next().positions()), next_leads_(points.next().leads()), gone_(gone),
        more_(more), owned_(points.owned()), has_leads_(points.has_leads()) {}
  LocalIndex size() const { return owned_ + more_.size(); }
  bool stays(LocalIndex i) const { return i >= owned_ || gone_.empty() || !gone_[at(i)]; }
  geometry::Vec2 position(LocalIndex i) const {
    return i < owned_ ? next_positions_[at(i)] : more_.position(i - owned_);
  }
  geometry::Vec2 home(LocalIndex i) const { return position(i); }
  std::int32_t boundary(LocalIndex i) const { return i < owned_ ? points_.boundary(i) : more_.boundary(i - owned_); }
  std::int32_t pushes(LocalIndex i) const { return i < owned_ ? points_.pushes(i) : more_.pushes(i - owned_); }
  geometry::Vec2 lead(LocalIndex i) const {
    if (!has_leads_)
      return {};
    return i < owned_ ? next_leads_[at(i)] : more_.lead(i - owned_);
  }

private:
  const BinnedPoints& points_;
  std::span<const geometry::Vec2> next_positions_, next_leads_;
  std::span<const std::uint8_t> gone_;
  ListedSites more_;
  LocalIndex owned_;
  bool has_leads_;
};

} // namespace trime::mesh
