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

/// Owner of the boundary of a run: fixed points on it become corners, loops that the mesh is too coarse for go.
class MeshedBoundary {
public:
  /// @throws GeometryError as FixedPoints
  explicit MeshedBoundary(const RunContext& run);

  /// A stage was laid out on these curves, null for those of the shape, and these loops of them were dropped for it.
  void follow(std::shared_ptr<const geometry::Boundary> curves, const polygon::DroppedLoops& dropped);

  /// The curves on which the boundary sites of the stage lie.
  const geometry::Boundary& curves() const { return drops_loops_ ? remaining_ : laid(); }
  const boundary::FixedPoints& fixed() const { return fixed_; }
  /// The loops of a mesh whose boundary is this polygon.
  std::vector<polygon::LoopSummary> loops(const polygon::BoundarySites& polygon) const;

private:
  const geometry::Boundary& laid() const { return laid_ ? *laid_ : fixed_.cornered_boundary(); }

  boundary::FixedPoints fixed_;
  std::shared_ptr<const geometry::Boundary> laid_; // null: the cornered boundary
  geometry::Boundary remaining_;                   // that without the dropped loops; unused if none was dropped
  bool drops_loops_ = false;
};

} // namespace trime::meshing
