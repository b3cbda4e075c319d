// SPDX-License-Identifier: BSD-3-Clause
// The boundary that is meshed: the boundary of the shape, with fixed points as corners and without dropped loops.
#pragma once

#include "boundary/fixed_points.hpp"
#include "meshing/run_context.hpp"
#include "polygon/polygon.hpp"
#include "trime/polygon/loop_summary.hpp"

#include <memory>
#include <vector>

namespace trime::meshing {

/// Owns the boundary of a run. Fixed points on the boundary become corners, and loops that are too small for the
/// triangles are dropped.
class MeshedBoundary {
public:
  /// Makes the boundary.
  /// @throws GeometryError under the conditions of the constructor of FixedPoints
  explicit MeshedBoundary(const RunContext& run);

  /// Notes that a stage has placed its sites on `curves` (null: the curves of the shape) without the loops in
  /// `dropped`.
  void follow(std::shared_ptr<const geometry::Boundary> curves, const polygon::DroppedLoops& dropped);

  /// Returns the curves on which the boundary sites of the stage lie.
  const geometry::Boundary& curves() const { return drops_loops_ ? remaining_ : laid(); }
  const boundary::FixedPoints& fixed() const { return fixed_; }
  /// Returns the loops of a mesh whose boundary sites are `polygon`.
  std::vector<polygon::LoopSummary> loops(const polygon::BoundarySites& polygon) const;

private:
  const geometry::Boundary& laid() const { return laid_ ? *laid_ : fixed_.cornered_boundary(); }

  boundary::FixedPoints fixed_;
  std::shared_ptr<const geometry::Boundary>
      laid_;                     // null if the curves are those of the shape with corners at fixed points
  geometry::Boundary remaining_; // the curves without the dropped loops; unused if no loop was dropped
  bool drops_loops_ = false;
};

} // namespace trime::meshing
