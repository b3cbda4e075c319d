// SPDX-License-Identifier: BSD-3-Clause
// Decides when the sweeps sort their sites, and when they evaluate h again.
#pragma once

#include "core/state_fields.hpp"
#include "mesh/drifts.hpp"
#include "sweep/rules.hpp"

namespace trime::sweep {

/// @brief Sites are not sorted in every sweep: bins stay as they are, and searches go farther by as much as sites have
/// moved (BinnedPoints::for_each_near), until that is too much. h is evaluated again every few sweeps. All numbers are
/// bounds over all ranks, so all ranks make the same decision.
class SortSchedule {
public:
  /// @param distance, ratio bounds on the move of any site, and on its move over h
  /// @param drift_in_tiles how far any site has moved since the last sorting, with this move, over the narrowest tile
  /// near its own
  void add_move(double distance, double ratio, double drift_in_tiles) {
    drift_.distance += distance * SweepRules::drift_rounding;
    drift_.in_sides = drift_in_tiles * SweepRules::drift_rounding;
    drift_in_sizes_ += ratio;
    ++moves_since_sort_;
  }
  /// Returns true if sites may have moved too far for their bins.
  bool is_sort_due() const {
    return drift_in_sizes_ > SweepRules::drift_in_sizes || drift_.in_sides > SweepRules::drift_in_tiles;
  }
  /// Returns true if sites marked for deletion have waited long enough.
  bool may_sort_to_delete() const { return moves_since_sort_ >= SweepRules::sweeps_of_a_sort; }
  /// Returns how far any site may have moved since the last sorting.
  const mesh::DriftBound& drift() const { return drift_; }
  /// Notes a move without sorting. Returns true if h must be evaluated at the new places.
  bool advance() {
    if (++age_of_sizes_ < SweepRules::sweeps_of_a_size)
      return false;
    age_of_sizes_ = 0;
    return true;
  }
  /// Visits the members that a checkpoint keeps.
  void visit(StateFields& fields) {
    fields.field("drift", drift_.distance);
    fields.field("drift_in_sides", drift_.in_sides);
    fields.field("drift_in_sizes", drift_in_sizes_);
    fields.field("age_of_sizes", age_of_sizes_);
    fields.field("moves_since_sort", moves_since_sort_);
  }
  /// Notes that sites have been sorted and h was evaluated.
  void reset() { *this = {}; }

private:
  mesh::DriftBound drift_;
  double drift_in_sizes_ = 0;
  int age_of_sizes_ = 0, moves_since_sort_ = 0; // in sweeps
};

} // namespace trime::sweep
