// SPDX-License-Identifier: BSD-3-Clause
// Simplifies the curves of the shape to the resolution of a size, so little that the certificate accepts their distance
// from the shape.
#pragma once

#include "boundary/boundary_sizes.hpp"
#include "fitting/layout_context.hpp"
#include "generalise/generalise.hpp"
#include "generalise/thin_inner_curves.hpp"
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
  std::shared_ptr<const geometry::InnerCurves> inner;   ///< the curves inside, simplified; null if they are not
  std::shared_ptr<const geometry::Boundary> relabelled; ///< the boundary with other regions along it, where `inner` has
                                                        ///< given parts of regions away; null if it is as before
  generalise::JoinedLines joined;                       ///< curves that were joined with interfaces in `inner`
  double inner_factor = 0;                              ///< the value of `factor` for which `inner` was made
  bool held = false;                                    ///< if true, the curves are also used at other factors

  // Only on ranks that simplify, see share_simplified_curves.
  double thinned_factor = 0; ///< factor at which `thinned` was made
  std::shared_ptr<const geometry::Boundary>
      thinned{}; ///< the boundary with which each trial begins, without features that are far smaller than the sizes of
                 ///< the next trials; null if it has no such features
  std::shared_ptr<const geometry::PieceTree> given{}; ///< tree over the boundary of the shape; made when needed
};

/// Returns the options of the simplification.
generalise::Choice generalise_choice(const LayoutContext& context);

/// Returns whether this run simplifies the boundary.
bool generalises(const LayoutContext& context);

/// Returns the h to which the simplification refers: the h asked for, scaled if the user has set another distance than
/// the default.
sizing::ScaledSize generalised_size(const LayoutContext& context, const sizing::SizeField& asked);

/// @brief Simplifies the boundary for a size, unless it was simplified for about the same factor, or `curves` is held.
/// A curve that moves to places with much smaller sizes may lie farther from the shape than the certificate allows.
/// Then the boundary is simplified again with smaller sizes around these places; after a few rounds nothing is
/// simplified. Local: all ranks get the same result. Cost: O(n log n) for n pieces.
/// @param asked the size: the relative size times `factor`
/// @throws GeometryError if a size is not positive and finite
void simplify_curves(const LayoutContext& context, const sizing::SizeField& asked, double factor, CurvesAtSize& curves);

/// @brief Returns the curves inside the shape at the resolution of the size for which the boundary was simplified.
/// Sets CurvesAtSize::relabelled. Local: all ranks get the same result. @pre simplify_curves was called
/// @param boundary the boundary that is meshed
const geometry::InnerCurves& inner_curves(const LayoutContext& context, const sizing::SizeField& asked,
                                          const geometry::Boundary& boundary, CurvesAtSize& curves);

/// Returns whether rank 0 simplifies the boundary for all ranks because it has many pieces. All ranks return the same.
bool one_rank_simplifies(const LayoutContext& context);

/// @brief If rank 0 simplifies for all ranks, it does so here and sends the result, so that the other ranks save memory
/// and the shared caches of their node. A later simplify_curves then has nothing to do. Otherwise this function does
/// nothing. Collective.
/// @throws GeometryError on all ranks in the same cases as simplify_curves
void share_simplified_curves(const LayoutContext& context, const sizing::SizeField& asked, double factor,
                             CurvesAtSize& curves);

} // namespace trime::fitting
