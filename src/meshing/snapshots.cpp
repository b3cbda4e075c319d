// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/snapshots.hpp"

#include "decomposition/numbering.hpp"
#include "extraction/extraction.hpp"

namespace trime::meshing {

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
  const extraction::Extraction made = extraction::extract_mesh(view, numbering, *stage.asked_size);
  const std::vector<polygon::LoopSummary> loops = boundary_.loops(stage.polygon);
  observer_({triangulations_, run_.timers.total(), made.mesh, made.quality, loops});
}

} // namespace trime::meshing
