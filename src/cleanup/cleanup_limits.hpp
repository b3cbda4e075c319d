// SPDX-License-Identifier: BSD-3-Clause
// Which places of bad triangles the clean-up tries next, and how many sites it may add and take.
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
  double alpha = 0;     ///< of the worst triangle
};

/// A hash of a place, the same on any number of ranks.
std::uint64_t hash_of(geometry::Vec2 place, int salt);

/// @brief The candidates among the owned sites of a rank, by place. Where nothing helped in a stage (1, 2, ...) none is
/// listed again in that stage.
class CleanupCandidates {
public:
  /// @pre the grid outlives the object
  explicit CleanupCandidates(const mesh::TileGrid& grid) : grid_(grid) {}

  /// Replaces what is known of a place; keeps the stage in which nothing helped there.
  void set(const Candidate& candidate);
  /// Notes that the site has gone, or no longer has a bad triangle.
  void drop(geometry::Vec2 place);
  /// Nothing helps at a place, if it is one of the list, in this stage.
  void settle(geometry::Vec2 place, int stage);

  /// @brief Too many sites crowd around a place for a patch to hold them. If it is one of the list, it counts as just
  /// bad enough to be listed, and nothing helps in this stage.
  void give_up(geometry::Vec2 place, int stage);

  /// The largest alpha, or 1.
  double worst() const;

  /// The candidates that may contend.
  struct ContenderRule {
    int stage;              ///< places that are settled in it, or a later one, are left out
    double above;           ///< alpha
    double separation;      ///< in sizes
    double most_separation; ///< larger ones than that find no room
    int round;              ///< another order in each
  };
  /// @brief The worst candidate of each cell of a few h, and of equally bad ones the first place; sorted by place.
  /// O(candidates).
  std::vector<Contender> contenders(const ContenderRule& rule);

private:
  struct Entry {
    Candidate candidate; // alpha 0: no longer a candidate
    int settled = 0;     // the last stage in which nothing helped
    std::uint64_t cell = 0;
  };
  std::uint64_t cell_key(geometry::Vec2 p, double h) const;
  void forget_the_good();

  const mesh::TileGrid& grid_;
  std::vector<Entry> entries_;
  std::unordered_map<std::uint64_t, std::uint32_t> entry_at_; // by hash of the place
};

/// @brief The number of sites over all ranks and its limits: never above what is allowed, and at most
/// CleanupRules::largest_loss below that of the beginning. All ranks have the same numbers.
class CleanupLimits {
public:
  /// @param sites over all ranks @param most_points 0: CleanupRules::largest_loss above `sites`
  CleanupLimits(GlobalId sites, GlobalId most_points);

  /// Returns what each patch of a round may do within the limits.
  PatchBudget budget(int stage, double again_alpha) const;

  /// @brief Sites that patches add and take: of those that gain sites, and of those that lose some.
  struct Gains {
    std::int64_t added = 0, taken = 0;
  };
  static Gains gains_of(std::span<const PatchResult> results);

  /// @brief Counts the sites of a round. Takes the edits back where the patches would leave the limits together: the
  /// worst places come first, and a patch that adds may where another one takes. Those that are put off may try again.
  /// Collective only where edits are taken back.
  /// @param all gains over all ranks @param chosen the own patches, with their results
  void count(const comm::Communicator& comm, const Gains& all, std::span<const ChosenContender> chosen,
             std::vector<PatchResult>& results);

private:
  GlobalId room(int stage) const;

  GlobalId most_points_, least_sites_, wanted_sites_, sites_;
};

} // namespace trime::cleanup
