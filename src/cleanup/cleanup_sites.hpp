// SPDX-License-Identifier: BSD-3-Clause
// The sites while the clean-up edits some: those of the state, and what has become of them since.
#pragma once

#include "cleanup/cleanup_boundary.hpp"
#include "cleanup/patch_data.hpp"
#include "sites/site_state.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::cleanup {

/// The sites that were read in a disc: all of them, or all in a smaller disc around the same place.
struct Surroundings {
  /// Returns the radius of the disc that is read, after this number of reductions, with the same bits on all ranks.
  static double radius(double widest, int narrowings) {
    for (int k = 0; k < narrowings; ++k)
      widest *= CleanupRules::narrowing_factor;
    return widest;
  }

  int narrowings = 0; ///< above the limit: even the narrowest disc holds too many, and none of them are listed
  std::vector<PatchSite> sites; ///< at the images that lie there, in no particular order
  bool is_crowded() const { return narrowings > CleanupRules::most_narrowings; }
};

/// The sites that a patch reads, by its number among the patches of its rank.
struct PatchDisc {
  sites::Disc disc;
  std::int32_t rank, number;
};

/// @brief Owned sites of a state that stays as it is: which are still in place, and those that have come since. Edits
/// cost what they touch; the state learns of them at the end. Sites belong to the owner of the tile they lie in.
class CleanupSites {
public:
  /// References must outlive the object. @pre sizes of the owned sites are known
  CleanupSites(const sites::SiteState& state, CleanupBoundary& boundary);

  /// The other ranks with tiles that a disc meets, ascending. @pre in a periodic container: the radius below the period
  std::vector<int> ranks_near(const sites::Disc& disc) const;
  int owner(geometry::Vec2 p) const { return state_.partition().owner(state_.grid().place(p).tile); }

  /// @brief All sites in each disc or, where these are more than `most`, in the largest of its narrowings that holds no
  /// more: the same on any number of ranks. Each rank looks at O(most) sites a disc. The partners exchange a message.
  /// @param own by number @param near of other ranks: those that meet tiles of this one
  /// @param partners ranks that `near` comes from, and all those with tiles that own discs meet; these have this rank
  ///        among their partners, too
  std::vector<Surroundings> around(std::span<const PatchDisc> own, std::span<const PatchDisc> near,
                                   std::span<const int> partners, std::size_t most) const;

  /// Carries out edits in canonical places: what concerns the owned sites. Then the links.
  void apply(std::span<const SiteEdit> edits, std::span<const BoundaryLink> links);

  /// Is it known that nothing helps at an owned site?
  void set_rest(geometry::Vec2 p, bool rests);

  /// @brief Nothing helps at the owned sites of a disc. O(those sites).
  /// @return their canonical places
  std::vector<geometry::Vec2> let_rest(const sites::Disc& disc);

  /// Carries all edits over to the state: SiteState::edit_sites. Collective. @pre CleanupBoundary::finish
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
  std::vector<std::vector<Added>> added_; // by owned tile
};

} // namespace trime::cleanup
