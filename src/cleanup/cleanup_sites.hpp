// SPDX-License-Identifier: BSD-3-Clause
// The sites during the clean-up: those of the state, with the edits since the beginning.
#pragma once

#include "cleanup/cleanup_boundary.hpp"
#include "cleanup/patch_data.hpp"
#include "sites/site_state.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::cleanup {

/// All sites in a disc, or in a smaller disc around the same place.
struct Surroundings {
  /// Returns the radius after this number of narrowings, with the same bits on all ranks.
  static double radius(double widest, int narrowings) {
    for (int k = 0; k < narrowings; ++k)
      widest *= CleanupRules::narrowing_factor;
    return widest;
  }

  int narrowings = 0; ///< above the limit if even the narrowest disc holds too many sites; then none is listed
  std::vector<PatchSite> sites; ///< at their images in the disc, in no particular order
  bool is_crowded() const { return narrowings > CleanupRules::most_narrowings; }
};

/// The sites that a patch reads, by its number among the patches of its rank.
struct PatchDisc {
  sites::Disc disc;
  std::int32_t rank, number;
};

/// @brief The owned sites of a state that does not change meanwhile: which of them are still in place, and which were
/// added. The cost of an edit grows only with what it touches; the state gets all edits at the end. A site belongs to
/// the owner of the tile in which it lies.
class CleanupSites {
public:
  /// The arguments must outlive the object. @pre sizes of the owned sites are known
  CleanupSites(const sites::SiteState& state, CleanupBoundary& boundary);

  /// Returns the other ranks with tiles that a disc meets, in ascending order. @pre in a periodic container, the radius
  /// is below the period
  std::vector<int> ranks_near(const sites::Disc& disc) const;
  int owner(geometry::Vec2 p) const { return state_.partition().owner(state_.grid().place(p).tile); }

  /// @brief Returns all sites in each disc or, if these are more than `most`, in the largest of the narrowed discs that
  /// holds no more. The result is the same on any number of ranks. Each rank examines O(most) sites per disc. Partners
  /// exchange a message.
  /// @param own discs of this rank, by number @param near discs of other ranks that meet tiles of this rank
  /// @param partners ranks from which `near` comes, and ranks with tiles that `own` meets; these have this rank among
  /// their partners
  std::vector<Surroundings> around(std::span<const PatchDisc> own, std::span<const PatchDisc> near,
                                   std::span<const int> partners, std::size_t most) const;

  /// Applies edits at canonical places, as far as they concern owned sites, and then the links.
  void apply(std::span<const SiteEdit> edits, std::span<const BoundaryLink> links);

  /// Sets whether it is known that nothing helps at an owned site.
  void set_rest(geometry::Vec2 p, bool rests);

  /// @brief Notes that nothing helps at the owned sites of a disc. O(these sites).
  /// @return their canonical places
  std::vector<geometry::Vec2> let_rest(const sites::Disc& disc);

  /// Applies all edits to the state by SiteState::edit_sites. Collective. @pre CleanupBoundary::finish was called
  void finish(sites::SiteState& state, const delaunay::StarBuilder& builder) const;

private:
  struct Added {
    geometry::Vec2 position;
    double size;
    BoundaryName boundary;
    bool rests = false;
  };
  enum class SiteStatus : std::uint8_t { gone, in_place, rests };
  template <class Visit>
  void for_each_tile(const sites::Disc& disc, const Visit& visit) const;
  void list_sites(const sites::Disc& disc, std::size_t most, std::vector<PatchSite>& sites) const;
  void narrow_down(const sites::Disc& widest, std::size_t most, Surroundings& own) const;
  static void merge(Surroundings& all, const sites::Disc& widest, std::size_t most, std::span<const PatchSite> more,
                    int narrowings);
  LocalIndex find_in_state(geometry::Vec2 p) const;
  Added& find_added(geometry::Vec2 p);
  void take_out(geometry::Vec2 p);
  std::vector<Added>& added_in(LocalIndex tile) {
    return added_[static_cast<std::size_t>(tile - state_.points().first_tile())];
  }
  const std::vector<Added>& added_in(LocalIndex tile) const {
    return added_[static_cast<std::size_t>(tile - state_.points().first_tile())];
  }

  bool owns(geometry::Vec2 p) const { return owner(p) == state_.comm().rank(); }

  const sites::SiteState& state_;
  CleanupBoundary& boundary_;
  std::vector<SiteStatus> status_;        // by owned site
  std::vector<std::vector<Added>> added_; // added sites by owned tile
};

} // namespace trime::cleanup
