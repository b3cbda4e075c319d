// SPDX-License-Identifier: BSD-3-Clause
// The data of one stage of a run: the size of the triangles, the sites on the boundary, and the sites inside. Also a
// read-only view of a stage.
#pragma once

#include "polygon/boundary_guard.hpp"
#include "polygon/polygon.hpp"
#include "sites/site_state.hpp"
#include "sizing/lowered_size.hpp"
#include "sizing/raised_size.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>
#include <span>

namespace trime::sites {

/// @brief A read-only view of the sites of a stage, or of a copy of them, with size and boundary. All members except
/// `state` are the same on every rank. Keeps references.
struct StageView {
  const SiteState& state;
  const polygon::BoundarySites& polygon;
  const sizing::SizeField& size;
  const geometry::Lattice& lattice;
  std::span<const geometry::Vec2> fixed = {}; ///< points that must be vertices, in lexicographic order
};

/// @brief All data from which the sweeps of a stage start. Only `state` differs between ranks.
///
/// The target edge length h is computed in steps. `scaled_size` is the user's relative size times the factor that
/// yields the requested number of points, kept between the smallest and the largest size. asked_size() is
/// `scaled_size`, lowered where it grows too fast. Then it is raised where edges would be too short. `lowered_size` is
/// asked_size(), lowered around places where the boundary needs smaller triangles. `size` is `lowered_size` times
/// `coarsening`; this stage uses it.
struct Stage {
  double coarsening = 1;   ///< h of this stage divided by h of the last stage
  double typical_size = 1; ///< edge length of equilateral triangles that would fill the shape with as many points
  std::unique_ptr<sizing::ScaledSize> scaled_size;   ///< size before it is lowered, for the last stage
  std::unique_ptr<sizing::LoweredSize> limited_size; ///< scaled_size with limited growth; null if it grows slowly
  std::unique_ptr<sizing::RaisedSize> raised_size;   ///< raised around short edges; null if it is raised nowhere
  std::unique_ptr<sizing::LoweredSize>
      lowered_size;                        ///< lowered size, for the last stage; null if it is lowered nowhere
  std::unique_ptr<sizing::SizeField> size; ///< size of this stage
  std::shared_ptr<const geometry::Boundary>
      curves;                         ///< curves on which the boundary sites lie; null: the curves of the shape
  polygon::Simplification simplified; ///< how the curves were simplified
  polygon::BoundarySites polygon; ///< the boundary sites; after the start of the stage only the clean-up changes them
  std::unique_ptr<polygon::BoundaryGuard>
      guard; ///< answers queries about the chords between boundary sites; holds a copy of them
  std::unique_ptr<SiteState> state;

  GlobalId fixed_inside = 0; ///< number of fixed points that are not on the boundary

  /// Returns the size that the user asks for, with limited growth and long enough edges, for the last stage.
  const sizing::SizeField& asked_size() const { return raised_size ? *raised_size : growing_size(); }
  /// Returns the size that the user asks for, with limited growth, before it is raised.
  const sizing::SizeField& growing_size() const {
    return limited_size ? static_cast<const sizing::SizeField&>(*limited_size) : *scaled_size;
  }
  /// Returns the number of sites that are placed before all others: boundary sites, sites on
  /// curves inside, and fixed points inside.
  GlobalId placed_first() const {
    return static_cast<GlobalId>(polygon.sites.size() + polygon.inner.sites.size()) + fixed_inside;
  }

  /// @param fixed points that must be vertices of the mesh, in lexicographic order
  StageView view(const geometry::Lattice& lattice, std::span<const geometry::Vec2> fixed = {}) const {
    return {*state, polygon, *size, lattice, fixed};
  }
};

} // namespace trime::sites
