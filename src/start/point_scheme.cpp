// SPDX-License-Identifier: BSD-3-Clause
#include "start/point_scheme.hpp"

#include "fitting/points_of_length.hpp"
#include "fitting/rules.hpp"
#include "fitting/size_fit.hpp"
#include "placing/work_share.hpp"
#include "start/refinement.hpp"
#include "start/rules.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace trime::start {
namespace {

using sites::Stage;
using sites::StageView;

int divisions_for(double points) {
  return points < StartRules::one_division      ? 0
         : points < StartRules::two_divisions   ? 1
         : points < StartRules::three_divisions ? 2
                                                : 3;
}

} // namespace

PointScheme::PointScheme(const fitting::LayoutContext& context, const StartOptions& options)
    : level_(context.relative_size),
      given_context_(context), level_context_{context.comm,    context.domain, level_,
                                              context.options, context.log,    context.timers,
                                              context.fixed,   false,          true},
      context_(&given_context_), fit_(context.options), options_(options) {
  choose();
}

/// Points that are left to the clean-up, for smaller triangles where the boundary is ragged, and for the middle of
/// small components: a share of the number of pieces and of components, and of the points at most.
GlobalId PointScheme::reserve() const {
  double pieces = 0;
  for (const geometry::Loop& loop : context_->given_boundary.loops)
    pieces += static_cast<double>(loop.pieces.size());
  if (!fit_.points || !options_.cleanup)
    return 0;
  const double points = static_cast<double>(*fit_.points), components = context_->given_boundary.components();
  return static_cast<GlobalId>(
      std::fmin(StartRules::reserved_share * points, StartRules::reserved_per_piece * pieces) +
      std::fmin(StartRules::reserved_for_components * points, StartRules::reserved_per_component * (components - 1)));
}

double PointScheme::expected_points() const {
  if (fit_.points)
    return static_cast<double>(*fit_.points - reserve());
  return fitting::points_of_length(context_->given_boundary, *fit_.edge_length);
}

/// By the options and the size.
void PointScheme::choose() {
  const bool uniform = context_->relative_size.is_uniform();
  const Start start = options_.start;
  const double fraction = options_.initial_fraction.value_or(1);
  if (options_.initial_fraction && fraction < 1) {
    scheme_ = Scheme::insertion;
    points_now_ = std::max(3.0, std::ceil(fraction * expected_points()));
    for (double points = points_now_; points < expected_points(); points *= StartRules::growth)
      ++last_stage_;
    reason_ = fmt::format("{:g} of the points first, the others in {} insertions or more (initial_fraction is given)",
                          fraction, last_stage_);
  } else if (start == Start::lattice || (start == Start::automatic && uniform)) {
    scheme_ = Scheme::lattice;
    reason_ = start == Start::lattice ? "hexagonal lattice, all points at once (asked for)"
                                      : "hexagonal lattice, all points at once: the size is uniform";
  } else if (start == Start::hilbert || options_.initial_fraction) {
    scheme_ = Scheme::hilbert;
    reason_ = "quantiles of the density, all points at once (asked for)";
  } else {
    scheme_ = Scheme::coarse_to_fine;
    last_stage_ = divisions_for(expected_points());
  }
}

Stage PointScheme::first() {
  try {
    return first_of_scheme();
  } catch (const ConfigError&) { // too few points, on all ranks together
    if (fit_.features.keep_all)
      throw;
  }
  given_context_.cuts_thin_components = level_context_.cuts_thin_components = true;
  context_ = &given_context_;
  last_stage_ = 0;
  choose();
  return first_of_scheme();
}

Stage PointScheme::first_of_scheme() {
  return scheme_ == Scheme::lattice     ? first_of_lattice()
         : scheme_ == Scheme::insertion ? first_of_insertion()
                                        : first_of_divisions();
}

Stage PointScheme::first_of_lattice() {
  fitting::LatticeFit fit = fitting::fit_lattice(*context_);
  if (fit_.features.refine_narrow && fitting::needs_lowering(*context_, fit.stage)) {
    context_ = &level_context_;
    scheme_ = Scheme::coarse_to_fine;
    last_stage_ = divisions_for(expected_points());
    return first_of_divisions();
  }
  shortage_ = std::move(fit.shortage);
  const auto time = context_->timers.scope("start");
  const placing::LatticeStart start(context_->given_boundary, *fit.stage.guard, context_->lattice);
  share_runs(start, fit);
  fitting::place_sites(*context_, fit.stage, start.sites(fit.runs, static_cast<std::size_t>(fit.stage.placed_first())));
  return std::move(fit.stage);
}

/// Returns the runs of this rank, after all of them are distributed evenly: the density gave only an estimate of their
/// number.
void PointScheme::share_runs(const placing::LatticeStart& start, fitting::LatticeFit& fit) const {
  if (fit.runs.of_tile.empty())
    fit.runs = start.runs(placing::own_share(fit.stage), fit.spacing);
  for (bool shared = context_->comm.size() == 1; !shared;) {
    shared = placing::share_by_count(fit.stage, fit.runs.counts());
    fit.runs = start.runs(placing::own_share(fit.stage), fit.runs.spacing);
  }
}

Stage PointScheme::first_of_insertion() {
  const double coarsening = std::sqrt(expected_points() / points_now_);
  fitting::DensityFit fit =
      fitting::fit_density(*context_, expected_points(), std::fmin(coarsening, StartRules::coarsest_integral));
  shortage_ = std::move(fit.shortage);
  fitted_ = std::move(fit.laid.fitted);
  Stage stage = lay_coarsened(coarsening, points_now_);
  if (const double held = static_cast<double>(stage.placed_first()); points_now_ < 2 * held) {
    points_now_ = std::min(expected_points(), 2 * held); // a stage of boundary alone has no order to pass on
    stage = lay_coarsened(std::sqrt(expected_points() / points_now_), points_now_);
    reason_ += fmt::format("; the first share was raised to {:.3g}, since the boundary alone takes half of it",
                           points_now_ / expected_points());
  }
  const double inner = points_now_ - static_cast<double>(stage.placed_first());
  place_along_curve(stage, inner, *along_curve(stage, inner, 1));
  return stage;
}

/// The factor is fitted for the final mesh, by a coarse integral. Then the coarsest start is taken that still has as
/// many sites inside as on the boundary: a boundary full of corners does not become coarser with the size.
Stage PointScheme::first_of_divisions() {
  fitting::DensityFit fit = fitting::fit_density(
      *context_, expected_points(),
      last_stage_ == 0 ? 1 : std::fmax(fitting::LayoutRules::coarse_integral, std::ldexp(1.0, last_stage_)));
  shortage_ = std::move(fit.shortage);
  const double points = fit.inner + static_cast<double>(fit.laid.stage.placed_first());
  fitted_ = std::move(fit.laid.fitted);
  Stage stage;
  std::unique_ptr<const placing::HilbertStart> start;
  double inner = 0;
  const double on_boundary = static_cast<double>(fit.laid.stage.polygon.sites.size());
  while (last_stage_ > 0 && std::ldexp(fit.inner, -2 * last_stage_) < std::ldexp(on_boundary, -last_stage_))
    --last_stage_; // the share of the strip and of corners only grows
  for (;; --last_stage_) {
    const double expected = std::ldexp(points, -2 * last_stage_);
    stage = lay_division(fit.laid.stage, expected);
    start = along_curve(stage, expected, last_stage_ > 0 ? StartRules::coarse_start : 1);
    inner = start->wanted();
    if (last_stage_ == 0 || inner >= static_cast<double>(stage.placed_first()))
      break;
  }
  if (scheme_ == Scheme::coarse_to_fine)
    reason_ =
        last_stage_ == 0
            ? "quantiles of the density, all points at once: too few of them lie inside to divide a coarser mesh"
            : fmt::format("coarse to fine, the edges of a mesh of 1/{} of the points are divided {}: {}",
                          1 << (2 * last_stage_), last_stage_ == 1 ? "once" : fmt::format("{} times", last_stage_),
                          options_.start == Start::coarse_to_fine ? "asked for" : "the size is graded");
  if (last_stage_ == 0 && fit_.points && shortage_.empty())
    inner = expected_points() - static_cast<double>(stage.placed_first());
  laid_last_ = std::move(fit.laid.stage);
  place_along_curve(stage, inner, *start);
  return stage;
}

/// A stage whose size is `coarsening` times that of the last.
Stage PointScheme::lay_coarsened(double coarsening, double expected) {
  fitting::FittedStage laid = fitting::lay_stage(*context_, fitted_, coarsening, expected);
  fitted_ = std::move(laid.fitted);
  return std::move(laid.stage);
}

/// The present stage of divisions. @param last the last of them, which was laid for the fit and becomes this one if it
/// is the last
Stage PointScheme::lay_division(Stage& last, double expected) {
  const double coarsening = std::ldexp(1.0, last_stage_ - stage_);
  if (coarsening == 1)
    return fitting::lay_again(*context_, std::move(last), expected);
  return lay_coarsened(coarsening, expected);
}

std::unique_ptr<const placing::HilbertStart> PointScheme::along_curve(const Stage& stage, double expected,
                                                                      double coarsening) const {
  const auto time = context_->timers.scope("start");
  return std::make_unique<const placing::HilbertStart>(context_->comm, placing::own_share(stage), *stage.guard,
                                                       *stage.size, context_->lattice, expected, coarsening);
}

void PointScheme::place_along_curve(Stage& stage, double inner, const placing::HilbertStart& start) const {
  const auto time = context_->timers.scope("start");
  const auto wanted = std::max<std::int64_t>(0, std::llround(inner));
  mesh::SiteList placed = start.sites(wanted, options_.seed);
  if (!context_->fixed.inside().empty()) { // those too near to a fixed point will go, so more are placed
    const std::int64_t clear = context_->comm.sum(context_->fixed.count_clear(placed, *stage.size));
    if (clear > 0 && clear < wanted) {
      placed = start.sites(
          std::llround(static_cast<double>(wanted) *
                       std::fmin(StartRules::most_replaced, static_cast<double>(wanted) / static_cast<double>(clear))),
          options_.seed);
      std::erase_if(placed, [&](const mesh::Site& site) {
        return context_->fixed.count_clear(std::span(&site, 1), *stage.size) == 0;
      });
      trim(context_->comm, stage, wanted, placed);
    }
  }
  fitting::place_sites(*context_, stage, std::move(placed));
}

Stage PointScheme::next(const Stage& previous) {
  ++stage_;
  return scheme_ == Scheme::insertion ? insert(previous) : divide(previous);
}

void PointScheme::visit(StateFields& fields) {
  fields.field("stage", stage_);
  fields.field("last_stage", last_stage_);
  fields.field("points_now", points_now_);
  fields.field("expected", expected_);
}

Stage PointScheme::lay_again_from(Stage first) {
  return stage_ == 0                    ? std::move(first)
         : scheme_ == Scheme::insertion ? lay_insertion()
                                        : lay_division(laid_last_, expected_);
}

/// A stage of insertions after the first.
Stage PointScheme::lay_insertion() {
  const double coarsening = is_last() ? 1 : std::fmax(1, std::sqrt(expected_points() / points_now_));
  return lay_coarsened(coarsening, points_now_);
}

Stage PointScheme::divide(const Stage& previous) {
  const comm::Communicator& comm = context_->comm;
  const StageView old = previous.view(context_->lattice);
  const GlobalId before = comm.sum(std::int64_t{previous.state->points().owned()});
  expected_ = 4 * static_cast<double>(before);
  Stage stage = lay_division(laid_last_, expected_);
  const auto time = context_->timers.scope("start");
  mesh::SiteList sites = split_edges(old);
  clear_strip(stage, sites);
  if (fit_.points && is_last()) {
    const std::int64_t most = std::max<std::int64_t>(0, *fit_.points - reserve() - stage.placed_first());
    trim(comm, stage, most, sites);
    const std::int64_t missing = most - comm.sum(static_cast<std::int64_t>(sites.size()));
    if (shortage_.empty() &&
        static_cast<double>(missing) > StartRules::small_shortage * static_cast<double>(*fit_.points))
      insert_in_triangles(old, stage, missing, sites); // narrow parts that the coarse mesh has starved
  }
  fitting::place_sites(*context_, stage, std::move(sites));
  return stage;
}

Stage PointScheme::insert(const Stage& previous) {
  const comm::Communicator& comm = context_->comm;
  const StageView old = previous.view(context_->lattice);
  const GlobalId before = comm.sum(std::int64_t{previous.state->points().owned()});
  const double grown = std::floor(StartRules::growth * static_cast<double>(before)), all = expected_points();
  if (is_last() && 2 * grown < all && stage_ < StartRules::most_insertions)
    ++last_stage_; // too few triangles for the rest: the boundary took the points of the first stages
  points_now_ = is_last() ? all : std::min(all, std::max(grown, std::floor(StartRules::growth * points_now_)));
  Stage stage = lay_insertion();
  const auto time = context_->timers.scope("start");
  mesh::SiteList sites = inner_sites(*previous.state);
  clear_strip(stage, sites);
  const std::int64_t most = std::max<std::int64_t>(0, std::llround(points_now_) - stage.placed_first());
  insert_in_triangles(old, stage, most - comm.sum(static_cast<std::int64_t>(sites.size())), sites);
  if (fit_.points)
    trim(comm, stage, most, sites);
  fitting::place_sites(*context_, stage, std::move(sites));
  return stage;
}

} // namespace trime::start
