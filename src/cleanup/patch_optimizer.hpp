// SPDX-License-Identifier: BSD-3-Clause
// The surroundings of bad triangles and the changes that are tried there. One thread; knows nothing of ranks.
#pragma once

#include "cleanup/known_alphas.hpp"
#include "cleanup/patch_contest.hpp"
#include "cleanup/patch_report.hpp"
#include "cleanup/patch_worst.hpp"

#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief Improves all triangles around a place: first by moves of the sites of bad ones, then, from the worst one on,
/// by insertions and deletions followed by such moves; where nothing else helps, by smaller triangles. Sites on the
/// boundary that are no corners take part: they slide along their curve, come and go.
///
/// Moves alone would only spread what is wrong around a very bad triangle over many others. There an insertion or a
/// deletion comes first if with moves it is better than the same moves alone.
///
/// The rules are those of PatchContest, PatchMover and PatchChords. Only + - * / sqrt and exact predicates inside: the
/// result is a pure function of the sites.
class PatchOptimizer {
public:
  /// See PatchStart.
  PatchOptimizer(const polygon::BoundarySites& boundary, const polygon::BoundaryCurve& curve,
                 const geometry::Lattice& lattice, const PatchOptions& options)
      : options_(options), start_(boundary, curve, lattice), chords_(start_), mover_(start_, chords_),
        worst_(start_, rests_), contest_(start_, chords_, mover_, options), report_(start_, rests_),
        now_(start_.patch()), best_(start_.patch()) {}
  PatchOptimizer(const PatchOptimizer&) = delete; // its parts refer to each other
  PatchOptimizer& operator=(const PatchOptimizer&) = delete;

  /// @brief Tries everything once.
  /// @param size h at the center
  /// @param sites in lexicographic order, all different; all that lie within CleanupRules::reach times `size` of
  ///        `center`
  /// @param patch a number that no other patch has: new sites on the boundary are called after it
  PatchResult improve(geometry::Vec2 center, double size, std::span<const PatchSite> sites, const PatchBudget& budget,
                      std::uint64_t patch = 0);

private:
  PatchResult give_up(std::span<const PatchSite> sites) const;
  void operate_first(const PatchBudget& budget);
  void operate(const PatchBudget& budget);
  bool try_at(const Corners& worst, const PatchBudget& budget, PatchContest::Turn turn);
  bool is_settled(const Corners& corners) const;
  void let_failures_rest();
  void move_bad_sites();
  bool list_movers(AlphaScore& score);
  bool mark_bad(AlphaScore& score);

  PatchOptions options_;
  PatchStart start_;
  PatchChords chords_;
  PatchMover mover_;
  PatchRests rests_;
  PatchWorst worst_;
  PatchContest contest_;
  PatchReport report_;
  Patch now_, best_;
  KnownAlphas alphas_;
  std::vector<std::uint8_t> mark_; // by vertex
  std::vector<LocalIndex> movers_; // sites of bad triangles, and their neighbours
};

} // namespace trime::cleanup
