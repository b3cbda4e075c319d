// SPDX-License-Identifier: BSD-3-Clause
// The data of one stage of a run: the size of the triangles, the sites on the boundary, and the sites inside; and a
// view of a stage that only reads.
#pragma once

#include "polygon/boundary_guard.hpp"
#include "polygon/polygon.hpp"
#include "sites/site_state.hpp"
#include "sizing/lowered_size.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>
#include <span>

namespace trime::sites {

/// @brief The sites of a stage, or of a copy of its state, with size and boundary. Everything except the state is
/// replicated. Keeps references.
struct StageView {
  const SiteState& state;
  const polygon::BoundarySites& polygon;
  const sizing::SizeField& size;
  const geometry::Lattice& lattice;
  std::span<const geometry::Vec2> fixed = {}; ///< points that must be vertices, in lexicographic order
};

/// @brief All data from which the sweeps of a stage start. Only `state` differs between ranks.
///
/// h is made in three steps. `asked_size` is the relative size of the user times the factor that yields the number of
/// points, within the smallest and the largest size. `lowered_size` is `asked_size`, lowered around places where the
/// boundary needs smaller triangles. `size` is `lowered_size` times `coarsening`; this stage uses it.
struct Stage {
  double coarsening = 1;                             ///< h of this stage over h of the last stage
  double typical_size = 1;                           ///< edge length of equal triangles, if there were as many
  std::unique_ptr<sizing::ScaledSize> asked_size;    ///< size asked for in the last stage
  std::unique_ptr<sizing::LoweredSize> lowered_size; ///< lowered size of the last stage; null if nothing lowers it
  std::unique_ptr<sizing::SizeField> size;           ///< size of this stage
  std::shared_ptr<const geometry::Boundary> curves;  ///< curves on which boundary sites lie; null: those of the shape
  polygon::Simplification simplified;                ///< how the curves differ from those of the shape
  polygon::BoundarySites polygon;                    ///< the sites on the boundary; only the clean-up edits them
  std::unique_ptr<polygon::BoundaryGuard> guard; ///< guard of the chords between boundary sites; holds a copy of them
  std::unique_ptr<SiteState> state;

  GlobalId fixed_inside = 0; ///< fixed points that are not on the boundary

  /// Number of sites that get their places before all others: those on the boundary, and the fixed points inside.
  GlobalId placed_first() const { return static_cast<GlobalId>(polygon.sites.size()) + fixed_inside; }

  /// @param fixed points that must be vertices, in lexicographic order
  StageView view(const geometry::Lattice& lattice, std::span<const geometry::Vec2> fixed = {}) const {
    return {*state, polygon, *size, lattice, fixed};
  }
};

} // namespace trime::sites
