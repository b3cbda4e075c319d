// SPDX-License-Identifier: BSD-3-Clause
// Decides for which sites the local Delaunay condition (the Delaunay lemma) is
// enough to certify the triangles around a site. The answer depends on nearby boundary edges and ghosts, and on the
// tiles next to the tiles of a rank.
#pragma once

#include "mesh/binned_points.hpp"
#include "sites/site_state.hpp"
#include "sweep/guard_treatment.hpp"
#include "sweep/sweep_kernel.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::sweep {

/// Where an owned tile lies. An inner tile has only tiles of this rank around it, so it can be swept while the ghosts
/// are still being received.
enum class TilePlace : std::uint8_t { inner, at_border };

/// @brief Holds for each owned tile the tiles around it, including the tile itself, by the numbers of KnownBins. Tiles
/// on the other side of a periodic border are left out. Valid until sites are sorted again.
///
/// The distance between two tiles that are not next to each other is at least narrowest() of either of them.
class TilesAround {
public:
  TilesAround() = default;
  /// @pre in each tile next to an owned one, at least one bin is known, unless the owned tile is at a periodic border
  explicit TilesAround(const mesh::BinnedPoints& points);

  std::size_t size() const { return places_.size(); }
  /// Returns the tiles around the t-th owned tile.
  std::span<const LocalIndex> of(std::size_t t) const {
    return std::span(tiles_).subspan(first_[t], first_[t + 1] - first_[t]);
  }
  TilePlace place(std::size_t t) const { return places_[t]; }
  /// Returns the shortest side of the t-th owned tile and of the tiles around it, in domain units.
  double narrowest(std::size_t t) const { return narrowest_[t]; }

private:
  std::vector<std::size_t>
      first_; // by owned tile: index in tiles_ at which its surrounding tiles begin; the last entry is the end
  std::vector<LocalIndex> tiles_;
  std::vector<TilePlace> places_;
  std::vector<double> narrowest_;
};

/// The stars that may be certified by the Delaunay lemma, that is, by tests of their own triangles alone; other stars
/// need the empty-circumcircle test. `nowhere` is slow and serves tests; `up_to_chords` requires that no boundary site
/// is in the diametral circle of a boundary edge.
enum class LemmaReach { nowhere, inside, up_to_chords };

/// @brief Knows the class of each owned site, which depends on the site's star and place. Also knows the tiles in which
/// boundary edges are certainly edges of the Delaunay triangulation. StarCertifier explains the reasons.
class SiteClasses {
public:
  /// @pre all arguments, and the objects to which `context` refers, outlive this object
  SiteClasses(const sites::SiteState& state, const delaunay::StarBuilder& builder, const MoveContext& context,
              LemmaReach reach)
      : state_(state), builder_(builder), context_(context), reach_(reach) {}

  /// Classifies all sites. Must be called after each sorting of the sites.
  void reset();
  SiteClass operator[](LocalIndex i) const { return classes_[static_cast<std::size_t>(i)]; }
  const SiteClass* data() const { return classes_.data(); }
  /// Computes the class of site i again after a possible change of its star. Threads may classify different sites
  /// concurrently.
  SiteClass update(LocalIndex i, LocalIndex tile);

  /// Returns the tiles around each owned tile.
  const TilesAround& around() const { return around_; }
  /// Returns the lowest class of sites in a tile for which the Delaunay lemma is enough. `tile` is the tile's number in
  /// the container.
  SiteClass least_certified(LocalIndex tile) const;
  /// Stores whether some site of owned tile t may be in the diametral circle of a boundary edge.
  void set_encroached(std::size_t t, bool encroached) { encroached_[t] = encroached; }
  bool is_encroached(std::size_t t) const { return encroached_[t] != 0; }

private:
  SiteClass class_of(LocalIndex i, LocalIndex tile) const;
  bool vouches_for(LocalIndex neighbour, LocalIndex i) const;
  bool owner_vouches_for(LocalIndex ghost, LocalIndex i) const;
  bool may_be_bordered(LocalIndex i, LocalIndex tile) const;
  bool is_chord_within_reach(LocalIndex from, LocalIndex to, LocalIndex tile) const;
  void find_encroached_tiles();

  const sites::SiteState& state_;
  const delaunay::StarBuilder& builder_;
  const MoveContext context_;
  const LemmaReach reach_;
  std::vector<SiteClass> classes_; // by owned site
  TilesAround around_;
  std::vector<std::uint8_t>
      encroached_; // by owned tile: 1 if some of its sites may be in the diametral circle of a boundary edge
};

/// Returns the number, in the whole container, of the tile that holds an owned site. Cost: O(log(tiles)).
LocalIndex tile_of_site(const mesh::BinnedPoints& points, LocalIndex i);

} // namespace trime::sweep
