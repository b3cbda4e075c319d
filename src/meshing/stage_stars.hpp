// SPDX-License-Identifier: BSD-3-Clause
// The stars of a stage before and after its sweeps; the sweeps keep them right themselves.
#pragma once

#include "delaunay/star_builder.hpp"
#include "meshing/run_context.hpp"
#include "sites/stage.hpp"
#include "sweep/site_classes.hpp"

#include <memory>

namespace trime::meshing {

/// @brief Builds, certifies and completes stars. Owns the cap: the circumradius up to which triangles are searched
/// first. All calls are collective, except begin_stage.
class StageStars {
public:
  explicit StageStars(const RunContext& run) : run_(run) {}

  /// @param points of the stage, over all ranks
  void begin_stage(GlobalId points);
  const delaunay::StarBuilder& builder() const { return *builder_; }

  delaunay::StarPass compute(sites::Stage& stage, sites::Wanted wanted) const;
  /// Certifies the stars of the inner sites. Most of them are as they were before the last moves.
  /// @param reach up to which sites the stars around one may certify it: the clean-up may have moved boundary sites
  /// into discs of chords
  void certify(sites::Stage& stage, sweep::LemmaReach reach) const;
  /// @brief Stars of all sites; where few are not certain, by emptiness, else most of them by the lemma. Where a fan is
  /// not complete the cap may have been too low (a void): it is doubled for these sites, a few times. The certificate
  /// finds fans that are not complete even then. @param reach as for certify
  /// @throws GeometryError on all ranks if triangles of a periodic container reach around it
  void complete(sites::Stage& stage, sweep::LemmaReach reach);

  /// Up to where stars may be certified by those around them: as far as `reach`, or nowhere if the options say so.
  sweep::LemmaReach allowed(sweep::LemmaReach reach) const;

private:
  void certify_all(sites::Stage& stage, sweep::LemmaReach reach) const;
  void set_cap(double factor);
  void raise_cap(sites::Stage& stage);
  void check_periods(const sites::Stage& stage) const;

  const RunContext& run_;
  GlobalId points_ = 0;   // at the beginning of the stage
  double cap_factor_ = 0; // of h
  std::unique_ptr<delaunay::StarBuilder> builder_;
};

} // namespace trime::meshing
