// SPDX-License-Identifier: BSD-3-Clause
// Compares operations at a bad triangle: it decides how far each operation is tried, and which one is kept.
#pragma once

#include "cleanup/patch.hpp"
#include "cleanup/patch_mover.hpp"
#include "cleanup/patch_operations.hpp"

#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief The AlphaScore over the triangles near a place. Most of the sum of a trial is already known, because a trial
/// is a copy of the patch and most of its triangles are unchanged.
class PatchScore {
public:
  explicit PatchScore(double bad_alpha) : bad_alpha_(bad_alpha) {}

  /// @brief Makes the triangles near this place count, and this patch the one with which trials are compared.
  /// @param obtuse_weight see PatchBudget
  /// @return the score of the patch, whose list of changed triangles is emptied
  AlphaScore begin(Patch& now, const BadPlace& place, double obtuse_weight);

  /// Return the vertices that may move in the last sweeps of a trial, and those that may move in the first sweeps.
  std::span<const LocalIndex> near() const { return near_; }
  std::span<const LocalIndex> nearest() const { return nearest_; }

  /// @brief Returns the sum of a trial quickly. If a boundary edge was added or removed, a triangle with three vertices
  /// on the boundary may change from inside to outside the shape; this function ignores such a change, score() does
  /// not.
  double sum(const Patch& now, const Patch& trial);
  AlphaScore score(const Patch& trial) const;

private:
  struct Term { // the term of one triangle of the patch in the sum
    Corners vertex;
    LocalIndex triangle;
    double value;
  };
  void list_near(const Patch& now, const BadPlace& place);
  bool is_near(const Corners& corners) const {
    const auto counts = [&](LocalIndex v) { return at(v) >= in_score_.size() || in_score_[at(v)]; };
    return counts(corners[0]) || counts(corners[1]) || counts(corners[2]);
  }
  void add(AlphaScore& score, const Patch& patch, const Corners& corners) const;
  void mark_moved(const Patch& now, const Patch& trial);
  double sum_of_unchanged(const Patch& trial);
  void list_changed(const Patch& trial);

  double bad_alpha_, obtuse_weight_ = 0;
  std::vector<LocalIndex> near_, nearest_;
  std::vector<std::uint8_t> in_score_; // by vertex of the patch: whether its triangles count
  std::vector<Term> terms_;
  std::vector<std::uint8_t> has_term_;  // by triangle of the patch: whether it has a term
  std::vector<std::uint8_t> has_moved_; // by vertex of a trial: whether the vertex has moved
  std::vector<LocalIndex> changed_;     // triangles of a trial that are not triangles of the patch
};

/// @brief Tries operations, each on a copy of the patch, followed by sweeps that move sites. Few trials get a second
/// sweep, and fewer get the last sweeps. An operation is better than no operation if the sum of the AlphaScore near it
/// falls by CleanupRules::least_gain and the largest alpha does not rise. At a very bad triangle, division into smaller
/// triangles is tried, too. It gives more triangles, so there only the largest alpha is compared: its excess over 1
/// must fall by CleanupRules::refine_gain.
class PatchContest {
public:
  /// The arguments must outlive the object.
  PatchContest(const PatchStart& start, PatchChords& chords, PatchMover& mover, const PatchOptions& options);

  /// Says whether the operations are compared before all moves or after them.
  enum class Turn { before_moves, after_moves };
  /// @brief Compares operations at a triangle of the patch. @return true if one was better than no operation; then
  /// `now` is its result
  bool hold(Patch& now, const Corners& worst, const PatchBudget& budget, Turn turn);

  /// After hold() has returned true: the patch before the operation, and the sites that took part.
  const Patch& before() const { return best_; }
  std::span<const LocalIndex> near() const { return score_.near(); }

private:
  struct Runner { // a trial that is still compared
    Patch patch;
    double sum = 0, handicap = 1; // the sum is infinite if this entry holds no trial
  };
  /// The values that a trial must reach.
  struct Bar {
    double first;   // the sum must be below this at the beginning
    double least;   // the sum must be below this after the best trial so far
    double before;  // largest alpha at the beginning
    double largest; // largest alpha since the best trial
    double obtuse;  // what obtuse triangles add to the sum at the beginning
    bool found = false;
  };
  BadPlace place_of(const Patch& now, const Corners& worst) const;
  bool is_worth(const Patch& now, const BadPlace& place, double largest_near, const PatchBudget& budget) const;
  bool set_bar_by_moves(const Patch& now, Bar& bar);
  static std::span<Runner> best_of(std::vector<Runner>& all, std::size_t most);
  void try_operations(const Patch& now, const BadPlace& place, const PatchBudget& budget, Bar& bar);
  bool is_within(GlobalId may_insert, const PatchBudget& budget) const;
  void relax_near(const Patch& now, Patch& trial, std::span<const LocalIndex> near);
  void run(const Patch& now, Patch& trial, double handicap, double hopeless_sum, std::span<Runner> list);
  static void enter(std::span<Runner> list, Patch& trial, double sum, double handicap);
  int strain_added(const Patch& now, const PatchOperation& operation);
  double last_sweeps(const Patch& now, const Runner& finalist, Patch& trial, double hopeless_sum);
  void finish(const Patch& now, Runner& finalist, Bar& bar);
  void try_pairs(const BadPlace& place, const PatchBudget& budget, Bar& bar);
  void try_refining(const Patch& now, const BadPlace& place, const PatchBudget& budget, Bar& bar);

  double operate_alpha_;
  PatchChords& chords_;
  PatchMover& mover_;
  PatchEditor editor_;
  PatchRefiner refiner_;
  PatchOperations operations_;
  PatchScore score_;
  Patch trial_, best_;
  std::vector<Patch> first_of_two_;         // results of first operations, to which second ones are added
  std::vector<Runner> runners_, finalists_; // ordered by sum
  bool is_thorough_ = false;                // true if the triangle is bad enough for many complete trials
  bool is_against_obtuse_ = false;
  std::vector<LocalIndex> ring_, touched_; // vertices: work space
};

} // namespace trime::cleanup
