// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/checkpoint_writer.hpp"

namespace trime::meshing {

RunPoint point_of(const SavedRun& saved) {
  RunPoint point = RunPoint::moved;
  StateFields::restoring(saved.state.numbers).field("point", point);
  return point;
}

void CheckpointWriter::write(RunPoint point, int wish, RunState state, const sites::SiteState& sites,
                             std::span<const std::uint64_t> activity) const {
  const auto time = run_.timers.scope("checkpoint");
  StateFields fields = StateFields::keeping(state.numbers);
  fields.field("point", point);
  visit_run_(fields);
  checkpoints_->write(static_cast<CheckpointWish>(wish), state, sites, activity);
}

} // namespace trime::meshing
