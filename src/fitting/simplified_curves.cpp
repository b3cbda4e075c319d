// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/simplified_curves.hpp"

#include "boundary/rules.hpp"
#include "comm/agree.hpp"
#include "comm/asleep.hpp"
#include "core/thread_loop.hpp"
#include "fitting/rules.hpp"
#include "generalise/generalised_bytes.hpp"
#include "sizing/lowered_size.hpp"
#include "sizing/remembered_size.hpp"
#include "trime/geometry/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace trime::fitting {
namespace {

using boundary::BoundaryRules;
using geometry::Boundary;
using geometry::Vec2;
using sizing::CurveDistance;
using sizing::SizeLimit;

/// Where curves lie too far from those of the shape.
std::vector<CurveDistance> places_too_far(const Boundary& curves, const geometry::PieceTree& given,
                                          const sizing::SizeField& asked, double within) {
  std::vector<CurveDistance> found;
  for (const geometry::Loop& loop : curves.loops) {
    std::vector<std::array<CurveDistance, 2>> distances(loop.pieces.size());
    thread_loop(std::ssize(loop.pieces), 256, [&](std::ptrdiff_t k, int) {
      const auto piece = static_cast<std::size_t>(k);
      distances[piece] = sizing::curve_distances(loop.pieces[piece], given, asked, curves.periods);
    });
    for (const auto& of_piece : distances)
      for (const CurveDistance& one : of_piece)
        if (one.in_sizes() > within)
          found.push_back(one);
  }
  return found;
}

bool serve(const CurvesAtSize& curves, double factor) {
  return curves.held || (curves.factor <= (1 + LayoutRules::same_curves) * factor &&
                         curves.factor >= (1 - LayoutRules::finer_curves) * factor);
}

} // namespace

generalise::Choice generalise_choice(const LayoutContext& context) {
  return {context.options.features.narrow == boundary::NarrowOutside::close,
          context.options.features.connect == boundary::Connections::keep, context.cuts_thin_components,
          geometry::Frame(context.domain.frame().container()).inner()};
}

bool generalises(const LayoutContext& context) {
  return !context.options.features.keep_all && context.options.features.within > 0;
}

sizing::ScaledSize generalised_size(const LayoutContext& context, const sizing::SizeField& asked) {
  return {asked, context.options.features.within / generalise::reference_distance};
}

namespace {

std::unique_ptr<generalise::Generalised> generalised(const LayoutContext& context, const Boundary& from,
                                                     const sizing::SizeField& h) {
  return generalise::generalise(from, h, context.lattice, generalise_choice(context), context.fixed.held());
}

/// Thins the given boundary for this factor and larger ones, unless it was for about this one.
/// @param size by whose shares the boundary is simplified
void thin_ahead(const LayoutContext& context, const sizing::SizeField& size, double factor, CurvesAtSize& curves) {
  constexpr double ahead = LayoutRules::thinned_ahead;
  if (curves.thinned_factor * ahead <= factor && factor <= curves.thinned_factor * ahead * ahead)
    return;
  curves.thinned_factor = factor / ahead;
  curves.thinned.reset(); // before there is another one
  curves.thinned = generalise::thinned(context.fixed.cornered_boundary(), sizing::ScaledSize(size, 1 / ahead),
                                       context.lattice, context.fixed.held());
}

/// @brief Simplifies with smaller sizes where the curves came too far from the given ones. Null if they still do after
/// some rounds. @param found what came of the first round; null stays null
/// @param curves without `thinned` if one round did not do
std::unique_ptr<generalise::Generalised> brought_near(const LayoutContext& context, const sizing::SizeField& asked,
                                                      std::unique_ptr<generalise::Generalised> found,
                                                      CurvesAtSize& curves) {
  const Boundary& given = context.fixed.cornered_boundary();
  const sizing::ScaledSize size = generalised_size(context, asked);
  const double within = (1 - LayoutRules::distance_slack) * context.options.features.within;
  std::vector<SizeLimit> limits;
  std::unique_ptr<const sizing::LoweredSize> lowered; // of the last round
  for (int round = 0; found; ++round) {
    const std::vector<CurveDistance> far = places_too_far(found->boundary, *curves.given, asked, within);
    if (far.empty())
      break;
    curves.thinned = nullptr;
    for (const CurveDistance& one : far)
      if (const Vec2 p = given.periods.wrap(one.place); sizing::is_valid_size(one.size))
        limits.push_back({p, (lowered ? lowered->size(p) : size.size(p)) * (within / one.in_sizes())});
    if (round == LayoutRules::nearer_rounds || limits.empty())
      return nullptr;
    lowered = std::make_unique<sizing::LoweredSize>(
        size, std::initializer_list<sizing::GradedLimits>{{limits, context.narrow_gradation()}}, given.periods);
    found = generalised(context, given, *lowered);
  }
  return found;
}

} // namespace

void simplify_curves(const LayoutContext& context, const sizing::SizeField& asked, double factor,
                     CurvesAtSize& curves) {
  if (serve(curves, factor))
    return;
  const Boundary& given = context.fixed.cornered_boundary();
  sizing::RememberedSize known(asked); // both steps ask for the size at each vertex that is given
  const sizing::ScaledSize size = generalised_size(context, known);
  generalise::remember_at_vertices(given, known);
  thin_ahead(context, size, factor, curves);
  curves.factor = factor;
  curves.samples = nullptr;
  curves.found.reset();
  std::unique_ptr<generalise::Generalised> found = generalised(context, curves.thinned ? *curves.thinned : given, size);
  if (!found && curves.thinned)
    found = std::make_unique<generalise::Generalised>(generalise::Generalised{*curves.thinned, {}});
  if (found && !curves.given)
    curves.given = std::make_shared<geometry::PieceTree>(given);
  found = brought_near(context, known, std::move(found), curves);
  if (found && curves.thinned)
    found->counts.thinned += polygon::piece_count(given) - polygon::piece_count(*curves.thinned);
  if (found)
    found->counts.widest_severed *= context.options.features.within / generalise::reference_distance;
  curves.found = std::move(found);
}

namespace {

/// The places at which the user wants vertices, in lexicographic order.
std::vector<Vec2> kept_places(const LayoutContext& context) {
  std::vector<Vec2> kept(context.fixed.on_curves().begin(), context.fixed.on_curves().end());
  for (const geometry::FixedPoint& point : context.domain.fixed_points())
    kept.push_back(context.lattice.snap(point.position));
  std::sort(kept.begin(), kept.end(), geometry::lexicographically_less);
  return kept;
}

} // namespace

const geometry::InnerCurves& inner_curves(const LayoutContext& context, const sizing::SizeField& asked,
                                          const Boundary& boundary, CurvesAtSize& curves) {
  const geometry::InnerCurves& given = context.domain.curves();
  if (given.empty() || !generalises(context) || boundary.periods.any())
    return given;
  if (!curves.inner || curves.inner_factor != curves.factor) {
    const std::vector<Vec2> kept = kept_places(context);
    const sizing::ScaledSize size = generalised_size(context, asked);
    generalise::Partition made =
        generalise::simplify_partition(given, boundary, {size, context.lattice, kept}, context.domain.regions().pairs);
    curves.inner = std::make_shared<geometry::InnerCurves>(std::move(made.curves));
    curves.joined = made.joined;
    curves.relabelled = made.is_relabelled ? std::make_shared<geometry::Boundary>(std::move(made.boundary)) : nullptr;
    curves.inner_factor = curves.factor;
    curves.samples = nullptr;
  }
  return *curves.inner;
}

bool one_rank_simplifies(const LayoutContext& context) {
  return context.comm.size() > 1 && generalises(context) &&
         polygon::piece_count(context.fixed.cornered_boundary()) >= LayoutRules::many_pieces;
}

void share_simplified_curves(const LayoutContext& context, const sizing::SizeField& asked, double factor,
                             CurvesAtSize& curves) {
  if (!one_rank_simplifies(context) || serve(curves, factor))
    return;
  const bool is_root = context.comm.is_root();
  std::vector<std::byte> bytes;
  const std::optional<Error> error = comm::error_of([&] {
    if (!is_root)
      return;
    simplify_curves(context, asked, factor, curves);
    if (curves.found)
      bytes = generalise::to_bytes(*curves.found);
  });
  comm::barrier_asleep(context.comm);
  comm::agree(context.comm, error);
  bytes = context.comm.broadcast(std::move(bytes));
  comm::run_agreed(context.comm, [&] {
    if (is_root)
      return;
    curves.factor = factor;
    curves.samples = nullptr;
    curves.found.reset();
    if (!bytes.empty())
      curves.found = std::make_shared<generalise::Generalised>(
          generalise::generalised_of_bytes(std::move(bytes), context.fixed.cornered_boundary()));
  });
}

} // namespace trime::fitting
