// SPDX-License-Identifier: BSD-3-Clause
// A read-only view of a stage.
#pragma once

#include "polygon/polygon.hpp"
#include "sites/site_state.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

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

} // namespace trime::sites
