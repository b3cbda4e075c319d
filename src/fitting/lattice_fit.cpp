// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/lattice_fit.hpp"

#include "comm/agree.hpp"
#include "core/angle.hpp"
#include "fitting/expected_points.hpp"
#include "fitting/factor_search.hpp"
#include "fitting/layout.hpp"
#include "fitting/points_of_length.hpp"
#include "fitting/rules.hpp"
#include "placing/work_share.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace trime::fitting {
namespace {

// [rounds] How often the boundary of a lattice start is laid, each time with the spacing found for the one before.
constexpr int boundary_rounds = 3;

// [rounds] Largest number of rounds that find the spacing of a lattice for one boundary.
constexpr int spacing_rounds = 12;

// [1] If the spacing differs from that of the boundary by a smaller share, the boundary is not laid again.
constexpr double same_spacing = 0.02;

// [points] The search for the spacing ends when fewer than one in this number of sites is missing.
constexpr std::int64_t spacing_precision = 5000;

// [rounds] Largest number of rounds in which a uniform size grows until the boundary has no more sites than asked for.
constexpr int growth_rounds = 24;

// [1] Factor by which that size grows in a round.
constexpr double size_growth = 1.3;

// [h] A lattice with a larger spacing has so few sites that its spacing says nothing about h.
constexpr double comparable_spacing = 2;

using sites::Stage;

/// @brief Returns the sites on the boundary at size h, or at the next larger size at which they are at most the points
/// asked for. Returns nothing if no such size exists, or it is too large for that number of points, or so large that
/// regions and curves inside would go.
/// @param fitted becomes that size, and what was made for it
std::optional<Stage> lay_affordable_boundary(const LayoutContext& context, double h, double expected,
                                             FittedSize& fitted, Fewest& fewest) {
  const double largest =
      generalises(context) && !context.domain.curves().empty() ? FitRules::coarsest_partition * h : INFINITY;
  for (int round = 0; round < growth_rounds && h <= largest; ++round) {
    fitted.factor = h;
    Stage stage = try_boundary(context, fitted, expected);
    const double held = static_cast<double>(stage.placed_first());
    if (!stage.polygon.overfull && stage.placed_first() <= *context.options.points) {
      const double size = stage.size->size({}), area = context.given_boundary.area + stage.polygon.dropped.change;
      if (round > 0 && context.options.features.keep_all && is_jump(held + area / (row_height * size * size), expected))
        break;
      complete(context, stage);
      return stage;
    }
    fewest.consider(stage, held);
    h *= size_growth;
  }
  return std::nullopt;
}

/// @brief Steps to the smallest spacing whose lattice has at most the wanted number of sites. The count falls like the
/// inverse square of the spacing, in jumps where whole rows go: secant steps inside a bracket.
class SpacingSearch {
public:
  /// @param none a spacing at which no site fits at all
  SpacingSearch(GlobalId wanted, double h, double none)
      : wanted_(wanted), none_(none), low_(0.5 * h), high_(none), spacing_(h) {}

  double spacing() const { return spacing_; }
  /// No spacing is likely to have noticeably more sites.
  bool is_over() const { return wanted_ - best_ <= wanted_ / spacing_precision; }
  /// Takes the number of sites at the present spacing, and goes to the next spacing. Returns true if this one is the
  /// best so far.
  bool step(GlobalId count) {
    const bool better = count <= wanted_ && count >= best_;
    if (count > wanted_) {
      low_ = spacing_;
    } else if (better) {
      high_ = spacing_;
      best_ = count;
    }
    const double guess =
        spacing_ * std::sqrt((static_cast<double>(count) + 0.5) / (static_cast<double>(wanted_) + 0.25));
    if (high_ == none_) {
      spacing_ = std::max(guess, spacing_ * (1 + stride_));
      stride_ *= 2;
    } else { // not too near an end of the bracket: the count jumps, and a secant alone would creep
      const double margin = FitRules::bracket_margin * (high_ - low_);
      spacing_ = std::clamp(guess, low_ + margin, high_ - margin);
    }
    return better;
  }

private:
  GlobalId wanted_, best_ = 0;
  // The discs of the boundary may leave no room at all, however fine the lattice (thin shapes, few points): nothing
  // below half the size of the chords is tried.
  double none_, low_, high_, spacing_;
  double stride_ = FitRules::least_step; // relative, while no spacing is known that is large enough
};

} // namespace

placing::LatticeRuns fitting_runs(const LayoutContext& context, const Stage& stage, const placing::LatticeStart& start,
                                  double h, GlobalId wanted) {
  const auto time = context.timers.scope("start");
  const mesh::TileRange tiles = placing::own_share(stage);
  const geometry::Box& container = context.domain.frame().container();
  const double none = 4 * (container.width() + container.height());
  SpacingSearch search(wanted, h, none);
  placing::LatticeRuns fitting{none, {}};
  for (int round = 0; round < spacing_rounds && !search.is_over(); ++round) {
    placing::LatticeRuns runs = start.runs(tiles, search.spacing());
    const GlobalId count = context.comm.sum(context.fixed.inside().empty()
                                                ? runs.count()
                                                : context.fixed.count_clear(start.sites(runs), sizing::UniformSize(h)));
    if (search.step(count))
      fitting = std::move(runs);
  }
  return fitting;
}

namespace {

/// The runs of a lattice in the whole shape that fills up the number of points.
placing::LatticeRuns runs_everywhere(const LayoutContext& context, const Stage& stage) {
  return fitting_runs(context, stage, placing::LatticeStart(context.given_boundary, *stage.guard, context.lattice),
                      stage.size->size({}),
                      *context.options.points - reserved_for_curves(context) - stage.placed_first());
}

/// @param relative size
LatticeFit fit_edge_length(const LayoutContext& context, double relative) {
  const double h = *context.options.edge_length;
  FittedSize fitted{h / relative};
  LatticeFit fit;
  fit.stage = try_boundary(context, fitted, context.given_boundary.area / (row_height * h * h));
  complete(context, fit.stage);
  fit.spacing = fit.stage.size->size({});
  return fit;
}

/// Returns about how many points are needed so that no triangle is larger than `most`.
double points_of_largest(const LayoutContext& context, double most) {
  return context.given_boundary.area / (row_height * most * most) + 0.5 * context.given_boundary.length() / most;
}

/// Will the size be lowered along simplified curves, so that no lattice fits?
bool is_of_no_use(const LayoutContext& context, const Stage& laid) {
  return laid.curves && context.options.features.refine_narrow && needs_lowering(context, laid);
}

/// @param relative size
std::variant<LatticeFit, TooFewPoints> fit_points(const LayoutContext& context, double relative) {
  const FitOptions& options = context.options;
  const double expected = static_cast<double>(std::max<GlobalId>(3, *options.points));
  double h = estimated_size(context.given_boundary.area, context.given_boundary.length(), expected);
  LatticeFit fit;
  for (int round = 0;; ++round) {
    if (options.max_size && h > *options.max_size)
      return too_few_points(context, points_of_largest(context, *options.max_size));
    Fewest fewest;
    FittedSize trial = fit.fitted; // a failed trial leaves the fit of the round before as it is
    std::optional<Stage> stage = lay_affordable_boundary(context, h / relative, expected, trial, fewest);
    if (!stage && round == 0)
      return too_few_points(context, fewest);
    if (!stage) { // at this spacing the lattice fits into the stage of the round before
      fit.spacing = h;
      return fit;
    }
    fit.stage = std::move(*stage);
    fit.fitted = std::move(trial);
    fit.runs = {};
    const double laid = fit.spacing = fit.stage.size->size({});
    if (options.min_size && laid > h) {
      fit.shortage = fmt::format("with min_size = {:g} no more points fit", *options.min_size);
      return fit;
    }
    fit.runs = runs_everywhere(context, fit.stage);
    const double spacing = fit.runs.spacing;
    if (is_of_no_use(context, fit.stage)) {
      const double share = static_cast<double>(fit.stage.placed_first()) / expected;
      fit.fitted.factor = larger_for_limits(FitRules::limits_on_ragged, share) * spacing / relative;
      return fit;
    }
    const bool comparable = spacing < comparable_spacing * laid; // else so few sites are wanted that it means nothing
    if (round + 1 == boundary_rounds || !comparable || std::abs(spacing / laid - 1) < same_spacing) {
      fit.spacing = spacing;
      return fit;
    }
    h = spacing;
  }
}

} // namespace

std::variant<LatticeFit, TooFewPoints> fit_lattice(const LayoutContext& context) {
  check_edge_length(context.options);
  double relative = 0;
  comm::run_agreed(context.comm, [&] { relative = sizing::checked_size(context.relative_size, {}); });
  if (context.options.points)
    return fit_points(context, relative);
  return fit_edge_length(context, relative);
}

} // namespace trime::fitting
