// SPDX-License-Identifier: BSD-3-Clause
// Simplifies the curves of the shape to the resolution of a size, as near to them as the certificate requires.
#pragma once

#include "boundary/boundary_sizes.hpp"
#include "fitting/layout_context.hpp"
#include "generalise/generalise.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/piece_tree.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>

namespace trime::fitting {

/// The boundary at the resolution of a size, with data that belong to it.
struct CurvesAtSize {
  double factor = 0;                                    ///< factor of the relative size
  std::shared_ptr<const generalise::Generalised> found; ///< null if nothing was simplified
  std::shared_ptr<const boundary::SizeSamples> samples; ///< samples of the relative size on it; made when needed
  bool held = false;                                    ///< if true, the curves are used at other factors, too

  // Only on ranks that simplify, see share_simplified_curves.
  double thinned_factor = 0;                           ///< factor at which the next member was made
  std::shared_ptr<const geometry::Boundary> thinned{}; ///< the boundary without features far below smaller sizes, with
                                                       ///< which each trial begins; null if it has no such features
  std::shared_ptr<const geometry::PieceTree> given{};  ///< tree over the boundary of the shape; made when needed
};

/// Returns how much the boundary is simplified.
generalise::Choice generalise_choice(const LayoutContext& context);

/// Returns whether the boundary is simplified.
bool generalises(const LayoutContext& context);

/// Returns the h that limits the simplification: h asked for, scaled if the user has set another distance than the
/// default.
sizing::ScaledSize generalised_size(const LayoutContext& context, const sizing::SizeField& asked);

/// @brief Simplifies the boundary for a size, unless it was simplified for about the same factor, or is held. Where a
/// curve moves to places with much smaller sizes, it may lie farther from the shape than the certificate allows. Then
/// the boundary is simplified again with smaller sizes around these places; after a few rounds nothing is simplified.
/// Local: all ranks do the same. O(n log n) for n pieces.
/// @param asked the size, `factor` times the relative one
/// @throws GeometryError if a size is not positive and finite
void simplify_curves(const LayoutContext& context, const sizing::SizeField& asked, double factor, CurvesAtSize& curves);

/// Returns whether rank 0 simplifies the boundary for all ranks because it has many pieces. The result is the same on
/// all ranks.
bool one_rank_simplifies(const LayoutContext& context);

/// @brief If one rank simplifies for all, it does so here and sends the result, so that the others need neither the
/// memory nor the caches of their node. simplify_curves then finds the work done. Otherwise does nothing. Collective.
/// @throws GeometryError on all ranks, as simplify_curves does
void share_simplified_curves(const LayoutContext& context, const sizing::SizeField& asked, double factor,
                             CurvesAtSize& curves);

} // namespace trime::fitting
