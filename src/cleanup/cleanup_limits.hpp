// SPDX-License-Identifier: BSD-3-Clause
// Lists the places of bad triangles, chooses those that the clean-up tries next, and limits how many sites it may add
// and remove.
#pragma once

#include "cleanup/cleanup_choice.hpp"
#include "cleanup/patch_data.hpp"
#include "mesh/tile_grid.hpp"
#include "trime/comm/communicator.hpp"

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace trime::cleanup {

/// A site that has a bad triangle.
struct Candidate {
  geometry::Vec2 place; ///< canonical
  double size = 0;      ///< h
  double alpha = 0;     ///< alpha of its worst triangle
  bool obtuse = false;  ///< whether one of its triangles is obtuse
};

/// Returns a hash of a place, the same on any number of ranks.
std::uint64_t hash_of(geometry::Vec2 place, int salt);

/// @brief The candidates among the owned sites of a rank, by place. If nothing helped at a place in a stage (1, 2,
/// ...), it is not listed again in that stage.
class CleanupCandidates {
public:
  /// @pre the grid outlives the object
  explicit CleanupCandidates(const mesh::TileGrid& grid) : grid_(grid) {}

  /// Adds or replaces a candidate; keeps the stage in which nothing helped there.
  void set(const Candidate& candidate);
  /// Removes a place whose site is gone or no longer has a bad triangle.
  void drop(geometry::Vec2 place);
  /// Notes that nothing helps at a place in this stage, if the place is listed.
  void settle(geometry::Vec2 place, int stage);

  /// @brief Notes that a patch cannot hold all sites around a place. If the place is listed, it now counts as just bad
  /// enough to be listed, and as settled in this stage.
  void give_up(geometry::Vec2 place, int stage);

  /// Returns the largest alpha, or 1 if the list is empty.
  double worst() const;

  /// Which candidates may contend in a round.
  struct ContenderRule {
    int stage;                ///< places that were settled in this stage or a later one are left out
    double above;             ///< candidates have an alpha above this
    double separation;        ///< [h] see Contender
    double most_separation;   ///< largest separation in domain units; candidates that need more are left out
    int round;                ///< each round has a different order
    bool only_obtuse = false; ///< only candidates with an obtuse triangle contend
  };
  /// @brief Returns the worst candidate of each cell of a few h, and the first place of equally bad ones; sorted by
  /// place. O(candidates).
  std::vector<Contender> contenders(const ContenderRule& rule);

private:
  struct Entry {
    Candidate candidate; // alpha is 0 if it is no longer a candidate
    int settled = 0;     // last stage in which nothing helped
    std::uint64_t cell = 0;
  };
  std::uint64_t cell_key(geometry::Vec2 p, double h) const;
  void forget_the_good();

  const mesh::TileGrid& grid_;
  std::vector<Entry> entries_;
  std::unordered_map<std::uint64_t, std::uint32_t> entry_at_; // index of the entry by hash of the place
};

/// @brief The number of sites over all ranks and its limits. It never exceeds the largest allowed number, and never
/// falls below the first number by more than CleanupRules::largest_loss. All ranks have the same numbers.
class CleanupLimits {
public:
  /// @param number of sites over all ranks @param most_points largest number; 0 means CleanupRules::largest_loss above
  /// `sites`
  CleanupLimits(GlobalId sites, GlobalId most_points);

  /// Returns what each patch of a round may do within the limits.
  PatchBudget budget(int stage, double again_alpha) const;

  /// @brief Numbers of sites that patches add, and that patches remove.
  struct Gains {
    std::int64_t added = 0, taken = 0;
  };
  static Gains gains_of(std::span<const PatchResult> results);

  /// @brief Counts the sites of a round. If the patches together would exceed the limits, it drops the edits of some:
  /// the worst places come first, and a patch may add sites that others remove. Patches that are put off may try again.
  /// Collective only if edits are dropped.
  /// @param all gains over all ranks @param chosen the patches of this rank, with their results
  void count(const comm::Communicator& comm, const Gains& all, std::span<const ChosenContender> chosen,
             std::vector<PatchResult>& results);

private:
  GlobalId room(int stage) const;

  GlobalId most_points_, least_sites_, wanted_sites_, sites_;
};

} // namespace trime::cleanup
