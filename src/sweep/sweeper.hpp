// SPDX-License-Identifier: BSD-3-Clause
// Runs the sweeps of a stage: each sweep certifies the stars and moves the sites. A schedule decides when sites are
// sorted into bins and when the size field h is evaluated again.
#pragma once

#include "core/state_fields.hpp"
#include "mesh/drifts.hpp"
#include "sweep/move_outcomes.hpp"
#include "sweep/rules.hpp"
#include "sweep/star_certifier.hpp"
#include "sweep/sweep_sums.hpp"
#include "sweep/tile_activity.hpp"
#include "sweep/update_rule.hpp"

#include <vector>

namespace trime::sweep {

/// @brief Decides in which sweeps the sites are sorted into bins. Between two sortings the bins stay, and searches in
/// them go farther by the distance that sites may have moved (BinnedPoints::for_each_near). The size field h is
/// evaluated again every few sweeps. All numbers are upper bounds over all ranks, so all ranks make the same decision.
class SortSchedule {
public:
  /// @param distance upper bound on the move of any site
  /// @param ratio upper bound on the move of any site, divided by its h
  /// @param drift_in_tiles how far any site has moved since the last sorting, including this move, divided by the side
  /// of the narrowest tile nearby
  void add_move(double distance, double ratio, double drift_in_tiles) {
    drift_.distance += distance * SweepRules::drift_rounding;
    drift_.in_sides = drift_in_tiles * SweepRules::drift_rounding;
    drift_in_sizes_ += ratio;
    ++moves_since_sort_;
  }
  /// Returns true if sites may have moved so far that they must be sorted again.
  bool is_sort_due() const {
    return drift_in_sizes_ > SweepRules::drift_in_sizes || drift_.in_sides > SweepRules::drift_in_tiles;
  }
  /// Returns true if sites marked for deletion have waited long enough for a sorting.
  bool may_sort_to_delete() const { return moves_since_sort_ >= SweepRules::sweeps_of_a_sort; }
  /// Returns how far any site may have moved since the last sorting.
  const mesh::DriftBound& drift() const { return drift_; }
  /// Notes a move without sorting. Returns true if the size field h must be evaluated at the new places.
  bool advance() {
    if (++age_of_sizes_ < SweepRules::sweeps_of_a_size)
      return false;
    age_of_sizes_ = 0;
    return true;
  }
  /// Visits the members that are stored in a checkpoint.
  void visit(StateFields& fields) {
    fields.field("drift", drift_.distance);
    fields.field("drift_in_sides", drift_.in_sides);
    fields.field("drift_in_sizes", drift_in_sizes_);
    fields.field("age_of_sizes", age_of_sizes_);
    fields.field("moves_since_sort", moves_since_sort_);
  }
  /// Notes that sites have been sorted and that h was evaluated at them.
  void reset() { *this = {}; }

private:
  mesh::DriftBound drift_;
  double drift_in_sizes_ = 0;
  int age_of_sizes_ = 0, moves_since_sort_ = 0; // in sweeps
};

/// Says whether tiles and sites without movement are skipped.
enum class Sleep { never, where_nothing_moves };

/// @brief Moves the inner sites, sweep by sweep. `prepare` certifies every star at the present places of the sites and
/// computes their next places; `commit` moves the sites there.
///
/// A vector kernel passes over the sites of a tile, certifies their stars by the Delaunay lemma and computes their
/// moves. StarCertifier certifies the sites that the kernel leaves; these sites are moved one by one, and near the
/// boundary they may be pushed or deleted. Tiles in which nothing moves are skipped (TileActivity), and so are resting
/// sites in other tiles (SiteActivity). In a periodic container sites are sorted after every move, which puts them back
/// into the container; otherwise SortSchedule decides when they are sorted.
class Sweeper {
public:
  Sweeper(const Sweeper&) = delete; // its parts refer to each other
  /// Takes the arguments of StarCertifier.
  /// @pre each star of an inner site was certain before the last moves, or its list of neighbours is empty; h is known
  /// at all sites; all arguments outlive this object
  /// @param sleep `never` is slow and serves tests
  Sweeper(sites::SiteState& state, const delaunay::StarBuilder& builder, const MoveContext& context,
          LemmaReach reach = LemmaReach::up_to_chords, Sleep sleep = Sleep::where_nothing_moves);

  /// The counts of one sweep, summed over all ranks.
  struct Counts {
    std::int64_t rebuilt = 0; ///< stars that changed, including stars next to borders that had to be built again;
                              ///< depends on the number of ranks
    std::int64_t moving = 0, pushed = 0, deleted = 0;
    double max_move = 0; ///< largest ratio of a move to h
    FixedSum power;      ///< power of the moves, as in SweepSums

    /// Adds the counts of a later sweep; `moving`, `max_move` and `power` are then those of the later sweep.
    void follow_by(Counts later);
  };

  /// @brief Certifies the stars, and computes the next places by the update rule. If two sites have come to the same
  /// place, all sites are sorted before, which drops one of the two. Collective.
  /// @param wish a number from this rank, such as a request for a checkpoint; afterwards largest_wish() returns the
  /// maximum over all ranks
  void prepare(const UpdateRule& rule, int wish = 0);
  int largest_wish() const { return largest_wish_; }
  bool is_prepared() const { return prepared_; }
  /// Discards the next places, but keeps the stars.
  void discard();
  /// Moves the sites to the places that `prepare` computed. Collective. @pre is_prepared()
  Counts commit();
  /// @brief Sorts the sites into bins if they have moved since the last sorting. Afterwards bins are up to date, lists
  /// of neighbours are kept, and all stars count as uncertain. Must be called before code other than the sweeps uses
  /// the state. Collective.
  void sort();

  /// Returns the sums over the stars of the inner sites of this rank.
  SweepSums measure(double reference_size);
  /// @brief Visits the members that are stored in a checkpoint between commit() and the next prepare(): numbers, and
  /// data of each owned tile. The checkpoint also stores the sites.
  void visit(StateFields& fields);
  std::vector<std::uint64_t> saved_activity() const;
  /// Restores the stored state. Sorts the sites if two of them have the same place, as prepare() does. Collective.
  /// @param activity the stored activity of all tiles of the container
  /// @pre prepare() was not called yet
  void restore(StateFields& fields, std::span<const std::uint64_t> activity);
  /// Compares all stars with newly computed ones, see StarCertifier::verify. Collective.
  void verify() const { certifier_.verify(); }
  /// Compares the result of measure() with one that no earlier measure was used for. Throws InternalError on all ranks
  /// if they differ. Slow; serves tests. Collective.
  void verify_measures(double reference_size);

private:
  void reset();
  void certify_and_place(const UpdateRule& rule);
  void run_kernel(const UpdateRule& rule, TilePlace which);
  void count_sites(TilePlace which, std::int64_t awake) const;
  struct TileLeftovers;
  void sweep_tile(const SweepTask& task, std::size_t t, TileLeftovers& mine);
  void stay(const SweepTask& task, std::size_t t);
  bool treat_guarded(std::span<const LocalIndex> sites);
  bool may_move(LocalIndex i, std::size_t t) const;
  void move_others(const UpdateRule& rule);
  void move_one_by_one(const UpdateRule& rule, std::span<const LocalIndex> sites);
  StarCertifier::Open sum_over_ranks();
  bool must_sort() const;
  void finish_move();
  void note_pushes();
  void note_restless();
  void sort_here();
  void move_and_sort(std::vector<std::uint8_t> deleted);

  sites::SiteState& state_;
  const delaunay::StarBuilder& builder_;
  const MoveContext context_;
  const Sleep sleep_;
  StarCertifier certifier_;
  TileActivity activity_;
  SiteActivity site_activity_;
  MoveOutcomes outcomes_;
  StarMeasures measures_;
  SortSchedule schedule_;
  std::vector<LocalIndex> irregular_; // sites with certified stars whose move was too long for the kernel
  Counts counts_;
  double largest_distance_ =
      0; // largest drift since the last sorting including this move, divided by the side of a tile, over all ranks
  double drift_in_tiles_ = 0;   // drift in tiles after this move, over all ranks
  std::int64_t coincident_ = 0; // stars in the last pass at whose places two sites lie, over all ranks
  std::int64_t moving_ = 0;     // number of sites of this rank that move in this sweep
  int moves_ = 0;
  int wish_ = 0, largest_wish_ = 0; // number given by this rank, and largest number of all ranks
  bool sorted_ = true, prepared_ = false, under_way_ = false;
};

} // namespace trime::sweep
