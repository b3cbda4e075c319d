// SPDX-License-Identifier: BSD-3-Clause
// For which stars the Delaunay lemma may do: what the sweeps know of chords and ghosts, and of the tiles next to the
// tiles of a rank.
#pragma once

#include "mesh/binned_points.hpp"
#include "sites/site_state.hpp"
#include "sweep/guard_treatment.hpp"
#include "sweep/sweep_kernel.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::sweep {

/// Where an owned tile lies. Inner tiles have only tiles of this rank around them, so they can be swept while the
/// ghosts are on their way.
enum class TilePlace : std::uint8_t { inner, at_border };

/// @brief Holds for each owned tile the tiles around it, including itself, by the numbers of KnownBins. Tiles across a
/// periodic border do not count. Valid until sites are sorted.
///
/// Two tiles that are not next to each other are at least as far apart as the narrowest() of either.
class TilesAround {
public:
  TilesAround() = default;
  /// @pre some bin of each tile next to an owned one is known, unless the owned one is at a periodic border
  explicit TilesAround(const mesh::BinnedPoints& points);

  std::size_t size() const { return places_.size(); }
  /// Returns the tiles around the t-th owned tile.
  std::span<const LocalIndex> of(std::size_t t) const {
    return std::span(tiles_).subspan(first_[t], first_[t + 1] - first_[t]);
  }
  TilePlace place(std::size_t t) const { return places_[t]; }
  /// Returns the shortest side of these tiles in domain units.
  double narrowest(std::size_t t) const { return narrowest_[t]; }

private:
  std::vector<std::size_t> first_; // by owned tile, where its tiles begin in tiles_; then the end
  std::vector<LocalIndex> tiles_;
  std::vector<TilePlace> places_;
  std::vector<double> narrowest_;
};

/// The stars for which the Delaunay lemma may suffice; the others need the empty-circumcircle test. `nowhere` is slow
/// and for tests; `up_to_chords` requires that no boundary site is in the disc of a chord.
enum class LemmaReach { nowhere, inside, up_to_chords };

/// @brief The class of each owned site, which depends on its star and its place, and the tiles in which chords of the
/// boundary are certainly edges of the triangulation. StarCertifier explains the reasons.
class SiteClasses {
public:
  /// @pre all arguments and the references of the context outlive this object
  SiteClasses(const sites::SiteState& state, const delaunay::StarBuilder& builder, const MoveContext& context,
              LemmaReach reach)
      : state_(state), builder_(builder), context_(context), reach_(reach) {}

  /// Classifies all sites. Must be called after sites were sorted.
  void reset();
  SiteClass operator[](LocalIndex i) const { return classes_[static_cast<std::size_t>(i)]; }
  const SiteClass* data() const { return classes_.data(); }
  /// Computes the class of site i again, since its star may have changed. Threads may classify different sites
  /// concurrently.
  SiteClass update(LocalIndex i, LocalIndex tile);

  /// The surroundings of the owned tiles.
  const TilesAround& around() const { return around_; }
  /// The lowest class for which the lemma does in a tile of the container.
  SiteClass least_certified(LocalIndex tile) const;
  /// Some site of owned tile t may be in the disc of a chord, or none is.
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
  std::vector<std::uint8_t> encroached_; // by owned tile: 1 if some site of it may be in the disc of a chord
};

/// Returns the number in the container of the tile of an owned site. O(log(tiles)).
LocalIndex tile_of_site(const mesh::BinnedPoints& points, LocalIndex i);

} // namespace trime::sweep
