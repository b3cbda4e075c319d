// SPDX-License-Identifier: BSD-3-Clause
// The boundary that is meshed: that of the shape, with what the run adds to it and takes from it.
#pragma once

#include "boundary/fixed_points.hpp"
#include "meshing/run_context.hpp"
#include "polygon/polygon.hpp"
#include "trime/polygon/loop_summary.hpp"

#include <memory>
#include <vector>

namespace trime::meshing {

/// Owns the boundary of a run. Fixed points on it become corners, and loops for which the mesh is too coarse are
/// dropped.
class MeshedBoundary {
public:
  /// @throws GeometryError, see FixedPoints
  explicit MeshedBoundary(const RunContext& run);

  /// Records that a stage was laid out on `curves` (null: those of the shape) without the loops in `dropped`.
  void follow(std::shared_ptr<const geometry::Boundary> curves, const polygon::DroppedLoops& dropped);

  /// Returns the curves on which the boundary sites of the stage lie.
  const geometry::Boundary& curves() const { return drops_loops_ ? remaining_ : laid(); }
  const boundary::FixedPoints& fixed() const { return fixed_; }
  /// Returns the loops of a mesh whose boundary is this polygon.
  std::vector<polygon::LoopSummary> loops(const polygon::BoundarySites& polygon) const;

private:
  const geometry::Boundary& laid() const { return laid_ ? *laid_ : fixed_.cornered_boundary(); }

  boundary::FixedPoints fixed_;
  std::shared_ptr<const geometry::Boundary>
      laid_;                     // null if the curves are those of the shape, with corners at fixed points
  geometry::Boundary remaining_; // the curves without the dropped loops; unused if none was dropped
  bool drops_loops_ = false;
};

} // namespace trime::meshing
