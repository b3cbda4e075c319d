// SPDX-License-Identifier: BSD-3-Clause
// Lists the places of bad triangles, selects those that the clean-up tries next, and limits how many sites it may add
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
  geometry::Vec2 place; ///< place inside the container, not its periodic image
  double size = 0;      ///< h
  double alpha = 0;     ///< alpha of its worst triangle
  bool obtuse = false;  ///< whether one of its triangles is obtuse
};

/// Returns a hash of a place; the value is the same on any number of ranks.
std::uint64_t hash_of(geometry::Vec2 place, int salt);

/// @brief The candidates among the sites that this rank owns, by place. If no change at a place improved its triangles
/// in a stage (1, 2, ...), the place is settled: it is not listed again in that stage.
class CleanupCandidates {
public:
  /// @pre the grid outlives the object
  explicit CleanupCandidates(const mesh::TileGrid& grid) : grid_(grid) {}

  /// Adds or replaces a candidate; a place that was settled stays settled.
  void set(const Candidate& candidate);
  /// Removes a place whose site is gone or no longer has a bad triangle.
  void drop(geometry::Vec2 place);
  /// Marks a place as settled in this stage if it is in the list.
  void settle(geometry::Vec2 place, int stage);

  /// @brief Marks a place whose surroundings have too many sites for a patch. If the place is in the list, it is
  /// settled in this stage, and its alpha is set to CleanupRules::bad_alpha, so that all other candidates come before
  /// it.
  void give_up(geometry::Vec2 place, int stage);

  /// Returns the largest alpha of all candidates, or 1 if there are no candidates.
  double worst() const;

  /// Selects the candidates that may contend in a round.
  struct ContenderRule {
    int stage;                ///< places that were settled in this stage or a later one are left out
    double above;             ///< candidates have an alpha above this
    double separation;        ///< [h] see Contender
    double most_separation;   ///< largest separation in domain units; candidates that need more are left out
    int round;                ///< each round has a different order
    bool only_obtuse = false; ///< only candidates with an obtuse triangle contend
  };
  /// @brief Returns the worst candidate of each cell of a few h, and the first one by place if several are equally bad;
  /// sorted by place. Cost: O(candidates).
  std::vector<Contender> contenders(const ContenderRule& rule);

private:
  struct Entry {
    Candidate candidate; // its alpha is 0 if the site is no longer a candidate
    int settled = 0;     // last stage in which the place was settled
    std::uint64_t cell = 0;
  };
  std::uint64_t cell_key(geometry::Vec2 p, double h) const;
  void forget_the_good();

  const mesh::TileGrid& grid_;
  std::vector<Entry> entries_;
  std::unordered_map<std::uint64_t, std::uint32_t> entry_at_; // index of the entry by hash of the place
};

/// @brief The number of sites over all ranks and its limits. The number never exceeds the largest one allowed, and
/// never falls below the number at the beginning by more than CleanupRules::largest_loss. All ranks have the same
/// numbers.
class CleanupLimits {
public:
  /// @param sites number over all ranks @param most_points largest number; 0 means CleanupRules::largest_loss above
  /// `sites`, and CleanupRules::inserted_per_inner_edge more for each edge on a curve inside
  /// @param inner_edges number of edges on curves inside
  CleanupLimits(GlobalId sites, GlobalId most_points, GlobalId inner_edges = 0);

  /// Returns how many sites each patch of a round may add and remove within the limits.
  PatchBudget budget(int stage, double again_alpha) const;

  /// @brief Number of sites that patches add, and number that they remove.
  struct Gains {
    std::int64_t added = 0, taken = 0;
  };
  static Gains gains_of(std::span<const PatchResult> results);

  /// @brief Counts the sites after a round. If all edits together would exceed the limits, it drops the edits of some
  /// patches: those at the worst places are kept first, and a patch may add sites if others remove as many. A patch
  /// whose edits were dropped may be tried again. Collective only if edits are dropped.
  /// @param all gains over all ranks @param chosen the contenders of this rank, in the order of `results`
  void count(const comm::Communicator& comm, const Gains& all, std::span<const ChosenContender> chosen,
             std::vector<PatchResult>& results);

private:
  GlobalId room(int stage) const;

  GlobalId most_points_, least_sites_, wanted_sites_, sites_, for_last_stage_;
};

} // namespace trime::cleanup
