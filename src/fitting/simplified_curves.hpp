// SPDX-License-Identifier: BSD-3-Clause
// The curves of the shape at the resolution of a size, as near to them as the certificate wants.
#pragma once

#include "boundary/boundary_sizes.hpp"
#include "fitting/layout_context.hpp"
#include "generalise/generalise.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/piece_tree.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>

namespace trime::fitting {

/// The boundary at the resolution of a size, and what belongs to it.
struct CurvesAtSize {
  double factor = 0;                                    ///< of the relative size
  std::shared_ptr<const generalise::Generalised> found; ///< null: nothing was narrower
  std::shared_ptr<const boundary::SizeSamples> samples; ///< of the relative size on it; made when they are needed
  bool held = false;                                    ///< at other factors, too

  // Of the ranks that simplify, see share_simplified_curves.
  double thinned_factor = 0;                           ///< at which the next one was made
  std::shared_ptr<const geometry::Boundary> thinned{}; ///< the boundary without what is far below smaller sizes, null
                                                       ///< if that is nothing: each trial begins with it
  std::shared_ptr<const geometry::PieceTree> given{};  ///< over the boundary of the shape; made when it is needed
};

/// How much the boundary is simplified.
generalise::Choice generalise_choice(const LayoutContext& context);

/// Is it at all?
bool generalises(const LayoutContext& context);

/// The h by whose shares that is done: the one asked for, unless the user wants another distance than the usual.
sizing::ScaledSize generalised_size(const LayoutContext& context, const sizing::SizeField& asked);

/// @brief Simplifies the boundary for a size, unless it was for about the same factor, or is held. The result may lie
/// farther from the shape than the certificate allows, where sizes fall steeply on the way that a curve moves. Then it
/// is made again with smaller sizes around these places; after some rounds nothing is simplified. Local: all ranks do
/// the same. O(n log n) for n pieces.
/// @param asked the size, `factor` times the relative one
/// @throws GeometryError if a size is not positive and finite
void simplify_curves(const LayoutContext& context, const sizing::SizeField& asked, double factor, CurvesAtSize& curves);

/// Does rank 0 simplify the boundary for all ranks, since it has many pieces? The same on all ranks.
bool one_rank_simplifies(const LayoutContext& context);

/// @brief If one rank simplifies for all, it does so here, and sends the result: the others need neither the memory nor
/// the caches of their node for that. simplify_curves then finds it done. Else nothing happens. Collective.
/// @throws GeometryError on all ranks, as simplify_curves does
void share_simplified_curves(const LayoutContext& context, const sizing::SizeField& asked, double factor,
                             CurvesAtSize& curves);

} // namespace trime::fitting
