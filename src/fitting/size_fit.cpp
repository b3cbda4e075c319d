// SPDX-License-Identifier: BSD-3-Clause
// The uniform size. See density_fit.cpp for any other.
#include "fitting/size_fit.hpp"

#include "comm/agree.hpp"
#include "core/angle.hpp"
#include "fitting/few_points.hpp"
#include "fitting/rules.hpp"
#include "placing/lattice_start.hpp"
#include "placing/work_share.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace trime::fitting {
namespace {

using sites::Stage;

/// @brief Sites on the boundary at size h, or at the next larger size at which they are not more than the points asked
/// for. Nothing if there is none, or only one that is too large for so many points.
std::optional<Stage> lay_affordable_boundary(const LayoutContext& context, double h, double expected, Fewest& fewest) {
  for (int round = 0; round < FitRules::growth_rounds; ++round) {
    Stage stage = try_boundary(context, {h, {}}, expected).stage;
    const double held = static_cast<double>(stage.placed_first());
    if (!context.options.points || stage.placed_first() <= *context.options.points) {
      const double size = stage.size->size({}), area = context.given_boundary.area + stage.polygon.dropped.change;
      if (round > 0 && context.options.features.keep_all && is_jump(held + area / (row_height * size * size), expected))
        break;
      complete(context, stage);
      return stage;
    }
    fewest.consider(stage, held);
    h *= FitRules::size_growth;
  }
  return std::nullopt;
}

/// @brief The runs of the smallest spacing found whose lattice has at most the wanted number of sites. The count falls
/// like the inverse square of the spacing, in jumps where whole rows go: secant steps inside a bracket. All ranks take
/// the same steps.
placing::LatticeRuns fitting_runs(const LayoutContext& context, const Stage& stage) {
  const auto time = context.timers.scope("start");
  const double h = stage.size->size({});
  const placing::LatticeStart start(context.given_boundary, *stage.guard, context.lattice);
  const mesh::TileRange tiles = placing::own_share(stage);
  const GlobalId wanted = *context.options.points - stage.placed_first();
  const geometry::Box& container = context.domain.frame().container();
  const double none = 4 * (container.width() + container.height()); // no site fits at all
  // The discs of the boundary may leave no room at all, however fine the lattice (thin shapes, few points): nothing
  // below half the size of the chords is tried.
  double low = 0.5 * h, high = none, spacing = h;
  GlobalId best = 0;
  placing::LatticeRuns fitting{high, {}};
  double stride =
      FitRules::least_step; // least relative step while no spacing is known that is large enough; doubles each time
  for (int round = 0; round < FitRules::spacing_rounds && wanted - best > wanted / FitRules::spacing_precision;
       ++round) {
    placing::LatticeRuns runs = start.runs(tiles, spacing);
    const GlobalId count = context.comm.sum(context.fixed.inside().empty()
                                                ? runs.count()
                                                : context.fixed.count_clear(start.sites(runs), sizing::UniformSize(h)));
    if (count > wanted) {
      low = spacing;
    } else if (count >= best) {
      high = spacing;
      best = count;
      fitting = std::move(runs);
    }
    const double guess = spacing * std::sqrt((static_cast<double>(count) + 0.5) / (static_cast<double>(wanted) + 0.25));
    if (high == none) {
      spacing = std::max(guess, spacing * (1 + stride));
      stride *= 2;
    } else { // not too near an end of the bracket: the count jumps, and a secant alone would creep
      const double margin = FitRules::bracket_margin * (high - low);
      spacing = std::clamp(guess, low + margin, high - margin);
    }
  }
  return fitting;
}

} // namespace

LatticeFit fit_lattice(const LayoutContext& context) {
  const FitOptions& options = context.options;
  const bool by_points = options.points.has_value();
  check_edge_length(options);
  double relative = 0;
  comm::run_agreed(context.comm, [&] { relative = sizing::checked_size(context.relative_size, {}); });
  const double expected = by_points ? static_cast<double>(std::max<GlobalId>(3, *options.points)) : 0;
  double h = by_points ? estimated_size(context.given_boundary.area, context.given_boundary.length(), expected)
                       : *options.edge_length;
  LatticeFit fit;
  for (int round = 0;; ++round) {
    if (by_points && options.max_size && h > *options.max_size) {
      const double most = *options.max_size;
      fail_for_few_points(context, context.given_boundary.area / (row_height * most * most) +
                                       0.5 * context.given_boundary.length() / most);
    }
    const double points = by_points ? expected : context.given_boundary.area / (row_height * h * h);
    Fewest fewest;
    std::optional<Stage> stage = lay_affordable_boundary(context, h / relative, points, fewest);
    if (!stage && round == 0)
      fail_for_few_points(context, fewest);
    if (!stage) { // at this spacing the lattice fits into the stage of the round before
      fit.spacing = h;
      break;
    }
    fit.stage = std::move(*stage);
    fit.runs = {};
    const double laid = fit.spacing = fit.stage.size->size({});
    if (!by_points)
      break;
    if (options.min_size && laid > h) {
      fit.shortage = fmt::format("min_size = {:g} leaves no room for more", *options.min_size);
      break;
    }
    fit.runs = fitting_runs(context, fit.stage);
    const double spacing = fit.runs.spacing;
    const bool comparable =
        spacing < FitRules::comparable_spacing * laid; // else so few sites are wanted that it means nothing
    if (round + 1 == FitRules::boundary_rounds || !comparable ||
        std::abs(spacing / laid - 1) < FitRules::same_spacing) {
      fit.spacing = spacing;
      break;
    }
    h = spacing;
  }
  return fit;
}

} // namespace trime::fitting
