// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/expected_points.hpp"

#include "comm/agree.hpp"
#include "core/angle.hpp"
#include "fitting/count_estimate.hpp"
#include "fitting/points_of_length.hpp"
#include "fitting/rules.hpp"
#include "sizing/size_blocks.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace trime::fitting {
namespace {

// [samples] Number along each side of the box around the shape, for the first guess.
constexpr int samples_per_side = 64;

// [rounds] Largest number of integrals. Each of them assumes the number of points that the last one found.
constexpr int sizes_rounds = 6;

// [1] If the number of points changes by a smaller factor than this, the integral that found it was fine enough.
constexpr double same_number = 2;

// [1] The next guess, if the shape is smaller than the spacing that belongs to this one.
constexpr double finer_guess = 16;

// [points] Estimates end there: no mesh has more points.
constexpr double most_points = 1e11;

// [sites] More are not possible on the boundary, since each rank holds all of them, with about 100 bytes each.
constexpr double most_on_boundary = 5e7;

// [samples] Number along the boundary, for the same check.
constexpr double boundary_samples = 4096;

/// Sizes in another unit than the coordinates may ask for an absurd number of points, and counting these would take
/// hours. Local.
/// @throws ConfigError
void check_boundary_sizes(const LayoutContext& context) {
  const double spacing = context.given_boundary.length() / boundary_samples;
  std::vector<geometry::Vec2> places;
  double ahead = 0.5 * spacing; // of the start of the piece lies the next sample
  for (const geometry::Loop& loop : context.given_boundary.loops)
    for (const geometry::Piece& piece : loop.pieces) {
      for (; ahead < piece.length(); ahead += spacing)
        places.push_back(context.given_boundary.periods.wrap(piece.point(ahead)));
      ahead -= piece.length();
    }
  double sites = 0, smallest = INFINITY;
  for (const double h : sizing::sizes_at(context.asked_size(1), places))
    if (sizing::is_valid_size(h)) {
      sites += spacing / h;
      smallest = std::fmin(smallest, h);
    }
  if (sites > most_on_boundary)
    throw ConfigError(fmt::format("the sizes in [sizing], down to {:.3g}, ask for about {:.2g} points on the boundary "
                                  "alone, whose length is {:.6g}; at most {:.0e} are possible there. Sizes have the "
                                  "unit of the coordinates; use larger sizes",
                                  smallest, sites, context.given_boundary.length(), most_on_boundary));
}

/// Assumes that the size is distributed in the shape as in the box around it. Local.
double guessed_points(const LayoutContext& context) {
  const sizing::ScaledSize size = context.asked_size(1);
  const geometry::Box box = context.given_boundary.bounding_box();
  std::vector<geometry::Vec2> places;
  for (int j = 0; j < samples_per_side; ++j)
    for (int i = 0; i < samples_per_side; ++i)
      places.push_back(context.given_boundary.periods.wrap({box.min.x + box.width() * (i + 0.5) / samples_per_side,
                                                            box.min.y + box.height() * (j + 0.5) / samples_per_side}));
  double density = 0;
  int count = 0;
  for (const double h : sizing::sizes_at(size, places)) {
    if (!sizing::is_valid_size(h))
      continue;
    density += 1 / (row_height * h * h);
    ++count;
  }
  return std::clamp(context.given_boundary.area * density / std::max(1, count), 3.0, most_points);
}

double points_of_sizes(const LayoutContext& context) {
  double points = 0;
  comm::run_agreed(context.comm, [&] {
    check_boundary_sizes(context);
    points = guessed_points(context);
  });
  for (int round = 0; round < sizes_rounds; ++round) {
    const double uniform = estimated_size(context.given_boundary.area, context.given_boundary.length(), points);
    CountEstimate estimate(context, points, FitRules::reference_spacing * uniform, FitRules::reference_coarsening);
    const std::optional<double> found = estimate.points(1);
    const double next = std::clamp(found.value_or(finer_guess * points), 3.0, most_points);
    const bool same = found && next < same_number * points && next > points / same_number;
    points = next;
    if (same)
      break;
  }
  return points;
}

} // namespace

double expected_points(const LayoutContext& context) {
  const FitOptions& options = context.options;
  if (options.points)
    return static_cast<double>(*options.points);
  return options.absolute ? points_of_sizes(context) : points_of_length(context.given_boundary, *options.edge_length);
}

GlobalId reserved_for_curves(const LayoutContext& context) {
  if (!context.options.points)
    return 0;
  double length = 0, ends = 0;
  for (const geometry::InnerArc& arc : context.domain.curves().arcs) {
    ends += arc.closed ? 0 : 2;
    for (const geometry::Piece& piece : arc.pieces)
      length += piece.length();
  }
  const double points = static_cast<double>(*context.options.points);
  const double edge = std::sqrt(context.given_boundary.area / (row_height * points));
  return static_cast<GlobalId>(
      std::fmin(FitRules::reserved_for_inner_edges * points,
                FitRules::reserved_per_inner_edge * length / edge + FitRules::reserved_per_inner_end * ends));
}

void check_point_limit(const FitOptions& options, double points) {
  if (options.point_limit && points > static_cast<double>(*options.point_limit))
    throw ConfigError(
        fmt::format("points = {} is the limit, because the sizes are absolute, but these sizes take about "
                    "{:.0f} points; set 'points' to more than that, or make the sizes larger",
                    *options.point_limit, points));
}

} // namespace trime::fitting
