// SPDX-License-Identifier: BSD-3-Clause
// The sites during the clean-up: those of the state with all edits since the clean-up began.
#pragma once

#include "cleanup/cleanup_boundary.hpp"
#include "cleanup/patch_data.hpp"
#include "sites/site_state.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::cleanup {

/// All sites in a disc, or in a smaller disc around the same place if there are too many.
struct Surroundings {
  /// Returns the radius after this number of reductions, with the same bits on all ranks.
  static double radius(double widest, int narrowings) {
    for (int k = 0; k < narrowings; ++k)
      widest *= CleanupRules::narrowing_factor;
    return widest;
  }

  int narrowings = 0; ///< how often the radius was reduced; above CleanupRules::most_narrowings if even the smallest
                      ///< disc holds too many sites: then `sites` is empty
  std::vector<PatchSite> sites; ///< at their periodic images in the disc, in no particular order
  bool is_crowded() const { return narrowings > CleanupRules::most_narrowings; }
};

/// The disc of sites that a patch reads, with the rank of the patch and its number among the patches of that rank.
struct PatchDisc {
  sites::Disc disc;
  std::int32_t rank, number;
};

/// @brief The sites of a state that this rank owns: which of them are still in place, and which were added. The state
/// does not change until finish(), so an edit costs only as much as it has sites. A site belongs to the owner of the
/// tile in which it lies.
class CleanupSites {
public:
  /// The arguments must outlive the object. @pre sizes of the owned sites are known
  CleanupSites(const sites::SiteState& state, CleanupBoundary& boundary);

  /// Returns the other ranks with tiles that a disc overlaps, in ascending order. @pre in a periodic container, the
  /// radius is less than the period
  std::vector<int> ranks_near(const sites::Disc& disc) const;
  int owner(geometry::Vec2 p) const { return state_.partition().owner(state_.grid().place(p).tile); }

  /// @brief Returns all sites in each disc. If these are more than `most`, it returns the sites of a reduced disc: the
  /// largest one that holds at most `most` sites. The result is the same on any number of ranks. Each rank examines
  /// O(most) sites per disc. Partners exchange a message.
  /// @param own discs of this rank, by number @param near discs of other ranks that overlap tiles of this rank
  /// @param partners ranks that own a disc in `near`, and ranks with tiles that a disc in `own` overlaps; if rank a is
  /// a partner of rank b, then b is a partner of a
  std::vector<Surroundings> around(std::span<const PatchDisc> own, std::span<const PatchDisc> near,
                                   std::span<const int> partners, std::size_t most) const;

  /// Applies those edits that concern sites of this rank, and then the links. @pre the places lie inside the container
  void apply(std::span<const SiteEdit> edits, std::span<const BoundaryLink> links);

  /// Sets whether a site of this rank rests: no change around it has improved its triangles.
  void set_rest(geometry::Vec2 p, bool rests);

  /// @brief Lets all sites of this rank in a disc rest. Cost: O(these sites).
  /// @return their places inside the container
  std::vector<geometry::Vec2> let_rest(const sites::Disc& disc);

  /// Applies all edits to the state with SiteState::edit_sites. Collective. @pre CleanupBoundary::finish was called
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
  std::vector<SiteStatus> status_;        // by site that this rank owns
  std::vector<std::vector<Added>> added_; // by tile that this rank owns: sites that were added
};

} // namespace trime::cleanup
