// SPDX-License-Identifier: BSD-3-Clause
// How good the triangles near the place of a contest are, in the patch and in its trials.
#pragma once

#include "cleanup/patch.hpp"

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

} // namespace trime::cleanup
