// SPDX-License-Identifier: BSD-3-Clause
// The contest of the operations at a bad triangle: which are tried how far, and which one is kept.
#pragma once

#include "cleanup/patch.hpp"
#include "cleanup/patch_mover.hpp"
#include "cleanup/patch_operations.hpp"

#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief The AlphaScore over the triangles near a place. For trials most of the sum is known: a trial shares most of
/// its triangles with the patch that it was copied from.
class PatchScore {
public:
  explicit PatchScore(double bad_alpha) : bad_alpha_(bad_alpha) {}

  /// @brief From now on the triangles near this place count, and trials are compared with this patch.
  /// @return the score of the patch. Its list of changed triangles is emptied.
  AlphaScore begin(Patch& now, const BadPlace& place);

  /// Vertices that may move in the last sweeps of a trial, and those that may in the first.
  std::span<const LocalIndex> near() const { return near_; }
  std::span<const LocalIndex> nearest() const { return nearest_; }

  /// @brief The sum of a trial, fast. It does not see when a chord that has come or gone turns a triangle with three
  /// vertices on the boundary inside out; score() has the last word.
  double sum(const Patch& now, const Patch& trial);
  AlphaScore score(const Patch& trial) const;

private:
  struct Term { // what a triangle of the patch adds to the sum
    Corners vertex;
    LocalIndex triangle;
    double value;
  };
  void list_near(const Patch& now, const BadPlace& place);
  bool is_near(const Corners& corners) const {
    const auto counts = [&](LocalIndex v) { return at(v) >= in_score_.size() || in_score_[at(v)]; };
    return counts(corners[0]) || counts(corners[1]) || counts(corners[2]);
  }
  void mark_moved(const Patch& now, const Patch& trial);
  double sum_of_unchanged(const Patch& trial);
  void list_changed(const Patch& trial);

  double bad_alpha_;
  std::vector<LocalIndex> near_, nearest_;
  std::vector<std::uint8_t> in_score_; // by vertex of the patch
  std::vector<Term> terms_;
  std::vector<std::uint8_t> has_term_;  // by triangle of the patch
  std::vector<std::uint8_t> has_moved_; // by vertex of a trial
  std::vector<LocalIndex> changed_;     // triangles of a trial that the patch has not
};

/// @brief Tries operations, each on a copy of the patch and followed by moves. Few of them get a second sweep, fewer
/// the last ones. An operation is better if the sum of the AlphaScore near it falls by CleanupRules::least_gain and the
/// largest alpha does not rise. Where the triangle is bad enough, smaller triangles are tried, too: they are more, so
/// only the largest alpha decides; its excess has to fall by CleanupRules::refine_gain.
class PatchContest {
public:
  /// References must outlive the object.
  PatchContest(const PatchStart& start, PatchChords& chords, PatchMover& mover, const PatchOptions& options);

  /// When a contest is held: before all moves, or after them.
  enum class Turn { before_moves, after_moves };
  /// @brief Holds the contest at a triangle of the patch. @return whether something was better; then it is in `now`
  bool hold(Patch& now, const Corners& worst, const PatchBudget& budget, Turn turn);

  /// After a contest that something has won: the patch as it was before, and the sites that took part.
  const Patch& before() const { return best_; }
  std::span<const LocalIndex> near() const { return score_.near(); }

private:
  struct Runner { // a trial that is still in the contest
    Patch patch;
    double sum = 0, handicap = 1; // sum: infinite if there is no trial here
  };
  /// The requirements for a trial.
  struct Bar {
    double first;   // sum that it has to fall below at first
    double least;   // the same since the best trial
    double before;  // largest alpha at the beginning
    double largest; // largest alpha since the best trial
    bool found = false;
  };
  BadPlace place_of(const Patch& now, const Corners& worst) const;
  bool is_worth(const Patch& now, const BadPlace& place, double largest_near, const PatchBudget& budget) const;
  bool set_bar_by_moves(const Patch& now, Bar& bar);
  std::span<Runner> best_of(std::vector<Runner>& all, std::size_t few) const;
  void try_operations(const Patch& now, const BadPlace& place, const PatchBudget& budget, Bar& bar);
  bool is_within(GlobalId may_insert, const PatchBudget& budget) const;
  void relax_near(const Patch& now, Patch& trial, std::span<const LocalIndex> near);
  void run(const Patch& now, Patch& trial, double handicap, double hopeless_sum, std::span<Runner> list);
  static void enter(std::span<Runner> list, Patch& trial, double sum, double handicap);
  int strain_added(const Patch& now, const PatchOperation& operation);
  double last_sweeps(const Patch& now, const Runner& finalist, Patch& trial, double hopeless_sum);
  void finish(const Patch& now, Runner& finalist, Bar& bar);
  void try_refining(const Patch& now, const BadPlace& place, const PatchBudget& budget, Bar& bar);

  double operate_alpha_;
  PatchChords& chords_;
  PatchMover& mover_;
  PatchEditor editor_;
  PatchRefiner refiner_;
  PatchOperations operations_;
  PatchScore score_;
  Patch trial_, best_;
  std::vector<Runner> runners_, finalists_; // by sum
  bool is_thorough_ = false;                // the triangle is bad enough for many trials that run to their end
  std::vector<LocalIndex> ring_, touched_;  // vertices: work space
};

} // namespace trime::cleanup
