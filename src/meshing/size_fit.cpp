// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/size_fit.hpp"

#include "meshing/count_estimate.hpp"
#include "trime/comm/agree.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace trime::meshing {
namespace {

constexpr double row_height = 0.8660254037844386;
constexpr int boundary_rounds = 3, spacing_rounds = 12, density_rounds = 40, saturated_rounds = 8;
constexpr double same_spacing = 0.02;
constexpr double close_enough = 0.004;     // of the points asked for
constexpr double reference_spacing = 0.25; // of the size of a uniform mesh
constexpr double reference_coarsening = 4; // of the integral, at least
constexpr int estimate_rounds = 6;
constexpr double estimate_precision = 0.02; // of the factor
constexpr double near_factor = 0.1;         // in logarithms: no rough trials any more
constexpr double crowded_power = -0.5;      // of the factor, that the points follow where limits hold many of them
constexpr double many_points = 64, least_share = 0.5; // the latter of the points asked for

/// The boundary takes too many points at one size, and at the next larger there are less than half of those asked for:
/// that is no mesh of so many points.
bool is_jump(double points, double wanted) {
  return wanted > many_points && points < least_share * wanted;
}

/// The boundary that takes the fewest points among those tried, and where it takes most of them.
struct Fewest {
  double points = INFINITY;
  bool counted = true; ///< to the end; else there would be more
  geometry::Segment shortest{};

  void consider(const Layout& layout, double trial_points) {
    if (trial_points >= points)
      return;
    points = trial_points;
    counted = !layout.boundary.overfull;
    double least = INFINITY;
    for (LocalIndex k = 0; k < std::ssize(layout.boundary.sites); ++k) {
      const geometry::Segment chord = layout.boundary.chord(k);
      if (const double length = geometry::length(chord.b - chord.a); length < least) {
        least = length;
        shortest = chord;
      }
    }
  }
};

[[noreturn]] void fail_for_few_points(const LayoutContext& context, double fewest) {
  const GlobalId points = context.options.points.value_or(0);
  if (context.options.max_size)
    throw ConfigError(fmt::format("points = {} are too few for max_size = {}: expected at least {:.0f}; ask for more "
                                  "points or a larger max_size",
                                  points, *context.options.max_size, fewest));
  if (const std::size_t inside = context.fixed.inside().size(); inside > 0)
    throw ConfigError(
        fmt::format("points = {} are too few for this shape: the {} fixed points inside and {:.0f} on its "
                    "boundary (every corner, and every place where the boundary comes near itself, takes "
                    "its own) make {:.0f}; ask for more, or for fewer fixed points",
                    points, inside, fewest - static_cast<double>(inside), fewest));
  throw ConfigError(
      fmt::format("points = {} are too few for this shape: its boundary alone needs {:.0f} (every corner, and "
                  "every place where the boundary comes near itself, takes its own); ask for more",
                  points, fewest));
}

[[noreturn]] void fail_for_few_points(const LayoutContext& context, const Fewest& fewest) {
  if (context.options.max_size || context.fixed.inside().size() > 0)
    fail_for_few_points(context, fewest.points);
  const geometry::Vec2 place = 0.5 * (fewest.shortest.a + fewest.shortest.b);
  throw ConfigError(fmt::format(
      "points = {} are too few for this shape: its boundary alone needs {}{:.0f} (every corner, and every place where "
      "the boundary comes near itself, takes its own; the shortest segment, {:.3g} long, is at ({:.6g}, {:.6g})); ask "
      "for more, or simplify the shape there",
      *context.options.points, fewest.counted ? "" : "more than ", fewest.points,
      geometry::length(fewest.shortest.b - fewest.shortest.a), place.x, place.y));
}

/// Bounds that the edge length itself breaks cannot be met.
void check_edge_length(const MeshOptions& options) {
  if (!options.edge_length)
    return;
  const auto check = [&](const std::optional<double>& bound, bool broken, const char* name, const char* relation) {
    if (broken)
      throw ConfigError(fmt::format("edge_length = {} and {} = {}: expected an edge_length of at {} {}",
                                    *options.edge_length, name, *bound, relation, name));
  };
  check(options.min_size, options.min_size && *options.min_size > *options.edge_length, "min_size", "least");
  check(options.max_size, options.max_size && *options.max_size < *options.edge_length, "max_size", "most");
}

// --- uniform size
// -----------------------------------------------------------------------------------------------------

/// @brief Sites on the boundary at size h, or at the next larger size at which they are not more than the points asked
/// for. Nothing if there is none, or only one that is too large for so many points.
std::optional<Layout> lay_affordable_boundary(const LayoutContext& context, double h, double expected, Fewest& fewest) {
  constexpr int growth_rounds = 24;
  constexpr double growth = 1.3;
  for (int round = 0; round < growth_rounds; ++round) {
    Layout layout = try_boundary(context, h, {}, expected);
    const double held = static_cast<double>(layout.placed_first());
    if (!context.options.points || layout.placed_first() <= *context.options.points) {
      const double size = layout.size->size({}), area = context.boundary.area + layout.boundary.dropped.change;
      if (round > 0 && is_jump(held + area / (row_height * size * size), expected))
        break;
      return layout;
    }
    fewest.consider(layout, held);
    h *= growth;
  }
  return std::nullopt;
}

/// @brief The smallest spacing found whose lattice has at most the wanted number of sites. The count falls like the
/// inverse square of the spacing, in jumps where whole rows go: secant steps inside a bracket. All ranks take the
/// same steps.
double fitting_spacing(const LayoutContext& context, const Layout& layout) {
  const auto time = context.timers.scope("start");
  const double h = layout.size->size({});
  const LatticeStart start(context.boundary, *layout.guard, context.lattice);
  const TileRange tiles = even_share(layout, context.comm);
  const GlobalId wanted = *context.options.points - layout.placed_first();
  const geometry::Box& container = context.options.container;
  const double none = 4 * (container.width() + container.height()); // no site fits at all
  // The discs of the boundary may leave no room at all, however fine the lattice (thin shapes, few points): nothing
  // below half the size of the boundary's segments is tried.
  double low = 0.5 * h, high = none, spacing = h;
  GlobalId best = 0;
  double stride = 0.002; // least relative step while no spacing is known that is large enough; doubles each time
  for (int round = 0; round < spacing_rounds && wanted - best > wanted / 5000; ++round) {
    const GlobalId count =
        context.comm.sum(context.fixed.inside().empty()
                             ? start.count(tiles, spacing)
                             : context.fixed.count_clear(start.sites(tiles, spacing), sizing::UniformSize(h)));
    if (count > wanted) {
      low = spacing;
    } else if (count >= best) {
      high = spacing;
      best = count;
    }
    const double guess = spacing * std::sqrt((static_cast<double>(count) + 0.5) / (static_cast<double>(wanted) + 0.25));
    if (high == none) {
      spacing = std::max(guess, spacing * (1 + stride));
      stride *= 2;
    } else { // not too near an end of the bracket: the count jumps, and a secant alone would creep
      const double margin = 0.1 * (high - low);
      spacing = std::clamp(guess, low + margin, high - margin);
    }
  }
  return high;
}

// --- any size
// ---------------------------------------------------------------------------------------------------------

/// Smallest relative size at some places around the shape: on its boundary and on a grid over it. Bad values are found
/// elsewhere: the grid covers places outside the shape.
double smallest_sampled(const LayoutContext& context) {
  constexpr int per_side = 33;
  constexpr std::size_t most_pieces = 4096;
  double smallest = INFINITY;
  const auto sample = [&](geometry::Vec2 p) {
    const double s = context.relative_size.size(context.boundary.periods.wrap(p));
    if (sizing::is_valid_size(s) && s < smallest)
      smallest = s;
  };
  std::size_t pieces = 0;
  for (const geometry::Loop& loop : context.boundary.loops)
    pieces += loop.pieces.size();
  const std::size_t stride = pieces / most_pieces + 1;
  for (const geometry::Loop& loop : context.boundary.loops)
    for (std::size_t k = 0; k < loop.pieces.size(); k += stride) {
      sample(loop.pieces[k].start);
      sample(loop.pieces[k].point(0.5 * loop.pieces[k].length()));
    }
  const geometry::Box box =
      context.boundary.periods.any() ? context.options.container : context.boundary.bounding_box();
  for (int j = 0; j < per_side; ++j)
    for (int i = 0; i < per_side; ++i)
      sample({box.min.x + (i + 0.5) / per_side * box.width(), box.min.y + (j + 0.5) / per_side * box.height()});
  if (!(smallest < INFINITY))
    throw GeometryError("the size field is positive nowhere near the shape: expected a positive size everywhere");
  return smallest;
}

class DensitySolver {
public:
  DensitySolver(const LayoutContext& context, double points, double coarsening)
      : context_(context), points_(points), coarsening_(coarsening) {}

  DensityFit solve() {
    const geometry::Boundary& boundary = context_.boundary;
    const double uniform = context_.options.points ? estimated_size(boundary.area, boundary.length(), points_)
                                                   : *context_.options.edge_length;
    double smallest = 0;
    comm::run_agreed(context_.comm, [&] { smallest = smallest_sampled(context_); });
    return context_.options.points ? for_points(uniform, smallest) : for_edge_length(uniform / smallest);
  }

private:
  struct Trial {
    DensityFit fit;
    DensityTotals totals;
    double points = 0;
  };

  /// @brief The limits of the size are looked for anew: those of another factor would keep corners that this one leaves
  /// out.
  /// @param rough one round of looking for limits may do
  Trial try_factor(double factor, bool rough = false) const {
    Trial trial;
    trial.fit.layout = try_boundary(context_, factor, {most_lowering_rounds, rough}, points_, coarsening_);
    if (!trial.fit.layout.boundary.overfull) {
      trial.totals = wanted_inside(context_, trial.fit.layout, coarsening_);
      trial.fit.inner = std::floor(trial.totals.sites);
    }
    trial.points = trial.fit.inner + static_cast<double>(trial.fit.layout.placed_first());
    return trial;
  }

  /// @brief A factor not far from the result, without layouts. From above: large factors make few
  /// points, so no round costs more than the last.
  double estimated_factor(double uniform, double factor) {
    const CountEstimate estimate(context_, points_, reference_spacing * uniform,
                                 std::fmax(coarsening_, reference_coarsening));
    double last = 0, last_factor = 0;
    for (int round = 0; round < estimate_rounds; ++round) {
      const std::optional<double> points = estimate.points(factor);
      if (!points || !(*points > 0))
        return factor;
      const double guess = next_factor(factor, *points, last_factor, last);
      if (std::fabs(guess / factor - 1) < estimate_precision) {
        power_ = -2;
        return guess * estimate.crowding(guess);
      }
      last = *points;
      last_factor = factor;
      factor = guess;
    }
    power_ = -2;
    return factor;
  }

  /// A factor to go on from, and what came of it, if that is known.
  struct Approach {
    double factor;
    std::optional<Trial> trial;
  };
  /// @brief Where limits lower the size much, they hold many points that no estimate knows of: rough trials until the
  /// factor is near the result.
  Approach approached(double factor) {
    constexpr int rough_rounds = 6;
    constexpr double growth = 1.05; // of the points, by the rounds of looking for limits that a rough trial spares
    double last = 0, last_factor = 0;
    for (int round = 0; round < rough_rounds; ++round) {
      Trial trial = try_factor(factor, true);
      if (trial.fit.layout.lowered_enough || trial.fit.layout.boundary.overfull)
        return {factor, std::move(trial)};
      if (round == 0)
        power_ = crowded_power;
      const double points = growth * trial.points, guess = next_factor(factor, points, last_factor, last);
      last = points;
      last_factor = factor;
      factor = guess;
      if (std::fabs(std::log(guess / last_factor)) < near_factor)
        break;
    }
    return {factor, std::nullopt};
  }

  /// @param uniform size of a uniform mesh of so many points
  /// @param smallest size for a factor of 1: where even that is far larger than the container, nothing will change
  DensityFit for_points(double uniform, double smallest) {
    Approach approach = approached(estimated_factor(uniform, uniform / smallest));
    double factor = approach.factor;
    const geometry::Box& container = context_.options.container;
    const double extent = std::max(container.width(), container.height()); // no site fits into such sizes
    const double largest = 64 * (container.width() + container.height()) / smallest;
    double low = 0, high = INFINITY, last = 0, last_factor = 0;
    Fewest fewest;
    int saturated = 0; // rounds in a row that changed nothing; the first ones may be too coarse for a site inside
    Trial best;
    for (int round = 0; round < density_rounds; ++round) {
      Trial trial = approach.trial ? *std::exchange(approach.trial, std::nullopt) : try_factor(factor);
      const double points = trial.points;
      const bool trial_overfull = trial.fit.layout.boundary.overfull;
      if (points > points_)
        fewest.consider(trial.fit.layout, points);
      const bool same = high < INFINITY && low == 0 && std::fabs(points - last) < 1e-3 * last;
      saturated = same ? saturated + 1 : 0;
      const double guess = next_factor(factor, points, last_factor, last);
      last = points;
      last_factor = factor;
      if (points > points_) {
        low = factor;
      } else if (factor <= high) {
        high = factor;
        best = std::move(trial);
        if (points >= (1 - close_enough) * points_ || points > points_ - 2)
          return std::move(best.fit);
      }
      if (low * smallest > extent || saturated == saturated_rounds)
        break; // finer does not help: min_size, or the discs of the boundary fill the shape
      if (high < INFINITY && low > (1 - 1e-4) * high)
        break;
      if (high == INFINITY) {
        factor = std::max(guess, (trial_overfull ? 1.5 : 1.002) * factor);
        if (factor > largest)
          fail_for_few_points(context_, fewest);
      } else if (low == 0) {
        factor = std::min(guess, 0.998 * factor);
      } else {
        const double margin = 0.1 * (high - low);
        factor = std::clamp(guess, low + margin, high - margin);
      }
    }
    if (!(high < INFINITY) || (low > 0 && is_jump(best.points, points_)))
      fail_for_few_points(context_, fewest);
    if (best.points < 0.98 * points_)
      best.fit.shortage = context_.options.min_size
                              ? fmt::format("min_size = {:g} leaves no room for more", *context_.options.min_size)
                              : "the discs of the boundary segments leave no room for more";
    return std::move(best.fit);
  }

  /// The count falls like a power of the factor, which the last two trials tell.
  double next_factor(double factor, double points, double last_factor, double last) {
    constexpr double flattest = -0.15, steepest = -3, farthest = 4;
    const double goal = (1 - 0.4 * close_enough) * points_;
    if (last_factor > 0 && factor != last_factor && points > 0 && last > 0)
      power_ = std::clamp(std::log(points / last) / std::log(factor / last_factor), steepest, flattest);
    return factor * std::clamp(std::pow(goal / points, 1 / power_), 1 / farthest, farthest);
  }

  DensityFit for_edge_length(double factor) {
    constexpr int rounds = 12;
    const double wanted = *context_.options.edge_length;
    Trial trial = try_factor(factor);
    for (int round = 0;; ++round) {
      const double ratio = trial.totals.mean_size > 0 ? wanted / trial.totals.mean_size : 1;
      if (std::fabs(ratio - 1) < close_enough)
        break;
      if (round == rounds) {
        context_.log.warning(
            "edge_length = {} is not met: the mean size of the fitted field is {:.6g}; bounds near the "
            "edge length, or jumps of the size, leave no better factor",
            *context_.options.edge_length, trial.totals.mean_size);
        break;
      }
      factor *= ratio;
      trial = try_factor(factor);
    }
    return std::move(trial.fit);
  }

  const LayoutContext& context_;
  double points_, coarsening_;
  double power_ = -2; // of the factor, that the number of points follows; less where corners hold many of them
};

} // namespace

LatticeFit fit_lattice(const LayoutContext& context) {
  const MeshOptions& options = context.options;
  const bool by_points = options.points.has_value();
  check_edge_length(options);
  double relative = 0;
  comm::run_agreed(context.comm, [&] { relative = sizing::checked_size(context.relative_size, {}); });
  const double expected = by_points ? static_cast<double>(std::max<GlobalId>(3, *options.points)) : 0;
  double h =
      by_points ? estimated_size(context.boundary.area, context.boundary.length(), expected) : *options.edge_length;
  LatticeFit fit;
  for (int round = 0;; ++round) {
    if (by_points && options.max_size && h > *options.max_size) {
      const double most = *options.max_size;
      fail_for_few_points(context,
                          context.boundary.area / (row_height * most * most) + 0.5 * context.boundary.length() / most);
    }
    const double points = by_points ? expected : context.boundary.area / (row_height * h * h);
    Fewest fewest;
    std::optional<Layout> layout = lay_affordable_boundary(context, h / relative, points, fewest);
    if (!layout && round == 0)
      fail_for_few_points(context, fewest);
    if (!layout) { // at this spacing the lattice fits into the layout of the round before
      fit.spacing = h;
      break;
    }
    fit.layout = std::move(*layout);
    const double laid = fit.spacing = fit.layout.size->size({});
    if (!by_points)
      break;
    if (options.min_size && laid > h) {
      fit.shortage = fmt::format("min_size = {:g} leaves no room for more", *options.min_size);
      break;
    }
    const double spacing = fitting_spacing(context, fit.layout);
    const bool comparable = spacing < 2 * laid; // else so few sites are wanted that it means nothing
    if (round + 1 == boundary_rounds || !comparable || std::abs(spacing / laid - 1) < same_spacing) {
      fit.spacing = spacing;
      break;
    }
    h = spacing;
  }
  return fit;
}

DensityFit fit_density(const LayoutContext& context, double points, double coarsening) {
  check_edge_length(context.options);
  return DensitySolver(context, points, coarsening).solve();
}

DensityTotals wanted_inside(const LayoutContext& context, const Layout& layout, double coarsening) {
  const auto time = context.timers.scope("start");
  const TileRange tiles = even_share(layout, context.comm);
  return integrate_density(context.comm, tiles,
                           DensitySampler(tiles.grid, *layout.guard, *layout.size, context.lattice, coarsening));
}

} // namespace trime::meshing
