// SPDX-License-Identifier: BSD-3-Clause
// The data of one stage of a run: the size of the triangles, the sites on the boundary, and the sites inside.
#pragma once

#include "polygon/boundary_guard.hpp"
#include "polygon/polygon.hpp"
#include "polygon/simplification.hpp"
#include "sites/site_state.hpp"
#include "sites/stage_view.hpp"
#include "sizing/lowered_size.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>

namespace trime::sites {

/// @brief All that the sweeps of a stage start from. Only `state` differs from rank to rank.
///
/// h has three ages, each made of the one before it. `asked_size` is the relative size of the user times the factor
/// that yields the points, within the least and the largest size. `lowered_size` is that, lowered around places where
/// the boundary needs smaller triangles. `size` is that times `coarsening`; this stage uses it.
struct Stage {
  double coarsening = 1;                             ///< h of this stage over that of the last
  double typical_size = 1;                           ///< edge length of as many equal triangles
  std::unique_ptr<sizing::ScaledSize> asked_size;    ///< of the last stage
  std::unique_ptr<sizing::LoweredSize> lowered_size; ///< of the last stage; null if nothing lowers the size
  std::unique_ptr<sizing::SizeField> size;           ///< of this stage
  std::shared_ptr<const geometry::Boundary> curves;  ///< on which these lie; null: those of the shape
  polygon::Simplification simplified;                ///< how they came from those
  polygon::BoundarySites polygon;                    ///< the sites on the boundary; only the clean-up edits them
  std::unique_ptr<polygon::BoundaryGuard> guard;     ///< guard of their chords; holds a copy of them
  std::unique_ptr<SiteState> state;

  GlobalId fixed_inside = 0; ///< fixed points that are not on the boundary

  /// Sites that have their place before all others: those on the boundary, and the fixed ones inside.
  GlobalId placed_first() const { return static_cast<GlobalId>(polygon.sites.size()) + fixed_inside; }

  /// @param fixed points that must be vertices, in lexicographic order
  StageView view(const geometry::Lattice& lattice, std::span<const geometry::Vec2> fixed = {}) const {
    return {*state, polygon, *size, lattice, fixed};
  }
};

} // namespace trime::sites
