// SPDX-License-Identifier: BSD-3-Clause
// The sweeps of a stage: stars certified and sites moved in one pass, in place.
#pragma once

#include "sweep/move_outcomes.hpp"
#include "sweep/sort_schedule.hpp"
#include "sweep/star_certifier.hpp"
#include "sweep/star_measures.hpp"
#include "sweep/tile_activity.hpp"
#include "sweep/update_rule.hpp"

#include <vector>

namespace trime::sweep {

/// The choice of tiles and sites that may sleep.
enum class Sleep { never, where_nothing_moves };

/// @brief Moves the inner sites, sweep by sweep. `prepare` certifies every star at the present places and computes the
/// next ones; `commit` goes there.
///
/// A kernel passes over the sites of a tile, certifies their stars by the Delaunay lemma and moves them. What it leaves
/// is certified by emptiness (StarCertifier) and moved one by one, with all that can happen to a site near the
/// boundary. Tiles where nothing moves sleep (TileActivity), and in the other tiles sites do (SiteActivity). In a
/// periodic container sites are sorted after every move, so that they are in it; else when it is due (SortSchedule).
class Sweeper {
public:
  Sweeper(const Sweeper&) = delete; // its parts refer to each other
  /// Takes the arguments of StarCertifier. @pre each star of an inner site was certain before the last moves, or its
  /// ring is empty; h is known at all sites; all arguments outlive this object
  /// @param sleep `never` is slow, for tests
  Sweeper(sites::SiteState& state, const delaunay::StarBuilder& builder, const MoveContext& context,
          LemmaReach reach = LemmaReach::up_to_chords, Sleep sleep = Sleep::where_nothing_moves);

  /// The result of one sweep, over all ranks.
  struct Counts {
    std::int64_t rebuilt = 0; ///< stars that were no longer right, and lost ones next to borders; depends on the ranks
    std::int64_t moving = 0, pushed = 0, deleted = 0;
    double max_move = 0; ///< over h
    FixedSum power;      ///< see SweepSums

    /// Counts of both; the rest is that of the later sweep.
    void follow_by(Counts later);
  };

  /// @brief Certifies the stars and finds where the sites go by `rule`. Collective.
  /// @param wish of this rank; its largest value over all ranks is largest_wish() from then on
  void prepare(const UpdateRule& rule, int wish = 0);
  int largest_wish() const { return largest_wish_; }
  bool is_prepared() const { return prepared_; }
  /// Forgets the moves; the stars stay.
  void discard();
  /// Moves the sites to where `prepare` found that they go. Collective. @pre is_prepared()
  Counts commit();
  /// @brief Sorts the sites if they were moved since: then bins are right again, rings stay, and all stars count as
  /// uncertain. Without it the state has bins that are too old for others. Collective.
  void sort();

  /// Sums over the stars of the inner owned sites, of this rank.
  SweepSums measure(double reference_size);
  /// @brief Visits the state that a checkpoint keeps between commit() and the next prepare(), in addition to the sites:
  /// numbers, and data of each owned tile.
  void visit(StateFields& fields);
  std::vector<std::uint64_t> saved_activity() const;
  /// Goes on from there. @param activity of all tiles of the container @pre nothing was prepared yet
  void restore(StateFields& fields, std::span<const std::uint64_t> activity);
  /// See StarCertifier::verify. Collective.
  void verify() const { certifier_.verify(); }

private:
  void reset();
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
  std::vector<LocalIndex> irregular_; // stars are right, but the kernel has not made the move
  Counts counts_;
  double largest_distance_ = 0; // of this sweep, over all ranks
  double drift_in_tiles_ = 0;   // with it, over all ranks
  std::int64_t moving_ = 0;     // of this sweep and rank
  int moves_ = 0;
  int wish_ = 0, largest_wish_ = 0; // of this rank, and over all ranks
  bool sorted_ = true, prepared_ = false, under_way_ = false;
};

} // namespace trime::sweep
