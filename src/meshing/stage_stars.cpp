// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/stage_stars.hpp"

#include "core/angle.hpp"
#include "core/thread_loop.hpp"
#include "decomposition/numbering.hpp"
#include "extraction/extraction.hpp"
#include "meshing/rules.hpp"
#include "polygon/region_finder.hpp"
#include "sites/fan.hpp"
#include "sweep/star_certifier.hpp"
#include "trime/core/error.hpp"

#include <cmath>
#include <limits>

namespace trime::meshing {
namespace {

using delaunay::StarBuilder;
using sites::count_incomplete_fans;
using sites::inside_fan;
using sites::SiteState;
using sites::Stage;
using sites::StageView;
using sites::Wanted;
using sweep::LemmaReach;

constexpr std::ptrdiff_t sites_in_a_row = 4096; // by one thread

/// Sites inside whose stars are not certain, over all ranks. Collective.
std::int64_t count_uncertain(const SiteState& state) {
  const std::uint64_t uncertain = thread_sum(static_cast<std::size_t>(state.points().owned()), [&](std::size_t i) {
    const auto site = static_cast<LocalIndex>(i);
    return std::uint64_t{state.points().boundary(site) < 0 && !state.stars().certain(site)};
  });
  return state.comm().sum(static_cast<std::int64_t>(uncertain));
}

/// Only the stars with complete fans stay certain.
void doubt_incomplete(const StageView& view, SiteState& state) {
  thread_loop(state.points().owned(), sites_in_a_row, [&](std::ptrdiff_t item, int) {
    const auto i = static_cast<LocalIndex>(item);
    state.stars().set_certain(i, inside_fan(view, i).complete);
  });
}

} // namespace

void StageStars::begin_stage(GlobalId points) {
  points_ = points;
  set_cap(points < MeshingRules::few_points ? std::numeric_limits<double>::infinity() : MeshingRules::cap);
}

bool StageStars::is_usual() const {
  return cap_factor_ == MeshingRules::cap && points_ > 2 * MeshingRules::few_points;
}

void StageStars::set_cap(double factor) {
  cap_factor_ = factor;
  builder_ = std::make_unique<StarBuilder>(run_.lattice, factor, run_.side());
}

delaunay::StarPass StageStars::compute(Stage& stage, Wanted wanted) const {
  const auto time = run_.timers.scope("stars");
  return stage.state->compute_stars(*builder_, *stage.size, wanted);
}

LemmaReach StageStars::allowed(LemmaReach reach) const {
  return run_.sweeps.star_tests.by_emptiness ? LemmaReach::nowhere : reach;
}

void StageStars::certify(Stage& stage, LemmaReach reach) const {
  const auto time = run_.timers.scope("stars");
  if (count_uncertain(*stage.state) == 0)
    return;
  certify_all(stage, reach);
}

void StageStars::certify_all(Stage& stage, LemmaReach reach) const {
  stage.state->refresh(*stage.size);
  sweep::StarCertifier(*stage.state, *builder_, sweep::move_context(stage, run_.lattice), allowed(reach)).certify_all();
}

void StageStars::complete(Stage& stage, LemmaReach reach) {
  {
    const auto time = run_.timers.scope("stars");
    if (static_cast<double>(count_uncertain(*stage.state)) > MeshingRules::few_stars * static_cast<double>(points_))
      certify_all(stage, reach);
  }
  compute(stage, Wanted::all_sites);
  const StageView view = stage.view(run_.lattice);
  for (int doubling = 0; doubling < MeshingRules::cap_doublings && std::isfinite(cap_factor_); ++doubling) {
    if (run_.comm.sum(count_incomplete_fans(view)) == 0)
      return;
    set_cap(2 * cap_factor_);
    doubt_incomplete(view, *stage.state);
    compute(stage, Wanted::all_sites);
  }
  if (run_.given_boundary.periods.any())
    check_periods(stage);
}

/// The ids do not distinguish triangles that reach around a periodic container.
void StageStars::check_periods(const Stage& stage) const {
  const double limit = StarBuilder::largest_cap(run_.given_boundary.periods);
  if (builder_->cap(stage.typical_size) < limit || run_.comm.sum(count_incomplete_fans(stage.view(run_.lattice))) == 0)
    return;
  const double size = limit / MeshingRules::largest_circumradius;
  throw GeometryError(
      fmt::format("the triangles are too large for the periodic container: their circumradii must be below a quarter "
                  "of the period, which takes about three edges per period. Found an element size of {:.3g} in a "
                  "period of {:.3g}; about {} points are enough",
                  stage.typical_size, 4 * limit,
                  static_cast<GlobalId>(std::ceil(run_.given_boundary.area / (row_height * size * size)))));
}

bool Snapshots::is_wanted() const {
  const int interval = run_.options.snapshot_interval;
  if (!observer_ || interval == 0)
    return false;
  return triangulations_ == 1 || (interval > 0 && triangulations_ % interval == 0);
}

void Snapshots::take(const sites::Stage& stage) {
  ++triangulations_;
  if (!is_wanted())
    return;
  const auto time = run_.timers.scope("snapshots");
  sites::SiteState shown(*stage.state); // the sites of the sweeps are not sorted, and some of their stars not certain
  shown.compute_stars(stars_.builder(), *stage.size, sites::Wanted::all_sites);
  const decomposition::Numbering numbering =
      decomposition::canonical_numbering(run_.comm, shown.points(), shown.halo());
  const sites::StageView view{shown, stage.polygon, *stage.size, run_.lattice, boundary_.fixed().all()};
  const extraction::Extraction made = extraction::extract_mesh(
      view, numbering, stage.asked_size(), polygon::RegionFinder(stage.polygon, run_.domain.regions(), run_.lattice));
  const std::vector<polygon::LoopSummary> loops = boundary_.loops(stage.polygon);
  observer_({triangulations_, run_.timers.total(), made.mesh, made.quality, loops});
}

} // namespace trime::meshing
