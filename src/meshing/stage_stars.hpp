// SPDX-License-Identifier: BSD-3-Clause
// Computes the stars of a stage before and after its sweeps. During the sweeps, the module sweep updates them.
#pragma once

#include "delaunay/star_builder.hpp"
#include "meshing/run_context.hpp"
#include "sites/stage.hpp"
#include "sweep/site_classes.hpp"

#include <memory>

namespace trime::meshing {

/// @brief Builds, certifies and completes stars. Owns the cap: the largest circumradius of the first search for
/// triangles. All calls are collective, except begin_stage.
class StageStars {
public:
  explicit StageStars(const RunContext& run) : run_(run) {}

  /// @param points points of the stage, over all ranks
  void begin_stage(GlobalId points);
  const delaunay::StarBuilder& builder() const { return *builder_; }

  delaunay::StarPass compute(sites::Stage& stage, sites::Wanted wanted) const;
  /// Certifies the stars of the inner sites. Most of them have not changed in the last moves.
  /// @param reach limits the sites whose stars may certify a star, because the clean-up may have moved boundary sites
  /// into discs of chords
  void certify(sites::Stage& stage, sweep::LemmaReach reach) const;
  /// @brief Computes the stars of all sites. If few are uncertain, it uses the empty-circumcircle test, otherwise the
  /// lemma for most of them. If a fan is incomplete, the cap may have been too low (next to a void), so it is doubled
  /// for these sites a few times. The certificate finds fans that are still incomplete. @param reach as in certify
  /// @throws GeometryError on all ranks if triangles reach around a periodic container
  void complete(sites::Stage& stage, sweep::LemmaReach reach);

  /// Returns `reach`, or LemmaReach::nowhere if the options forbid that stars certify each other.
  sweep::LemmaReach allowed(sweep::LemmaReach reach) const;

private:
  void certify_all(sites::Stage& stage, sweep::LemmaReach reach) const;
  void set_cap(double factor);
  void raise_cap(sites::Stage& stage);
  void check_periods(const sites::Stage& stage) const;

  const RunContext& run_;
  GlobalId points_ = 0;   // number at the beginning of the stage
  double cap_factor_ = 0; // cap over h
  std::unique_ptr<delaunay::StarBuilder> builder_;
};

} // namespace trime::meshing
