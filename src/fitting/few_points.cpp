// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/few_points.hpp"

#include "fitting/points_of_length.hpp"
#include "fitting/rules.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace trime::fitting {
namespace {

// [points] If more are asked for and the count jumps past them, that is an error; with fewer the nearest count is
// taken.
constexpr double many_points = 64;

// [points asked for] If the count jumps and a trial has less than this share, there is no mesh with this number of
// points, which is an error.
constexpr double least_of_jump = 0.5;

// [area of the shape] If the simplified curves enclose a larger area, the mesh would not be of this shape at all.
// Wedges and walls are widened up to about 2000 times their area.
constexpr double largest_growth = 1e4;

// [width of the shape] A size that is larger than this everywhere is not the reason for too many points.
constexpr double small_share = 0.01;

// [width of the shape] Triangles of this size are not widened.
constexpr double fitting_size = 2;

} // namespace

using sites::Stage;

bool is_jump(double points, double wanted) {
  return wanted > many_points && points < least_of_jump * wanted;
}

void Fewest::consider(const Stage& stage, double trial_points, bool all_counted) {
  if (trial_points >= points)
    return;
  points = trial_points;
  counted = all_counted && !stage.polygon.overfull;
  double least = INFINITY;
  const auto look = [&](const geometry::Segment& chord, bool is_inside) {
    if (const double length = geometry::length(chord.b - chord.a); length < least) {
      least = length;
      shortest = chord;
      inside = is_inside;
    }
  };
  for (LocalIndex k = 0; k < std::ssize(stage.polygon.sites); ++k)
    look(stage.polygon.chord(k), false);
  for (const polygon::InnerChord& chord : stage.polygon.inner.chords)
    look(chord.ends, true);
}

TooFewPoints too_few_points(const LayoutContext& context, double fewest, bool counted) {
  const GlobalId points = context.options.points.value_or(0);
  if (context.options.max_size)
    return {fmt::format("points = {} are too few for max_size = {}: expected {}; use more points or a larger max_size",
                        points, *context.options.max_size,
                        std::isfinite(fewest) ? fmt::format("{} {:.0f}", counted ? "at least" : "far more than", fewest)
                                              : "more points than numbers can express")};
  if (const std::size_t inside = context.fixed.inside().size(); inside > 0)
    return {fmt::format("points = {} are too few for this shape: the {} fixed points inside and {:.0f} on "
                        "its boundary add up to {:.0f}. Each corner takes a point, and so does each place "
                        "where the boundary comes near itself; use more points, or fewer fixed points",
                        points, inside, fewest - static_cast<double>(inside), fewest)};
  return {fmt::format("points = {} are too few for this shape: its boundary alone needs {:.0f} (each corner takes one, "
                      "and so does each place where the boundary comes near itself); use more points",
                      points, fewest)};
}

TooFewPoints too_few_points(const LayoutContext& context, const Fewest& fewest) {
  if (context.options.max_size || context.fixed.inside().size() > 0)
    return too_few_points(context, fewest.points, fewest.counted);
  const geometry::Vec2 place = 0.5 * (fewest.shortest.a + fewest.shortest.b);
  const double least = std::isfinite(fewest.points) ? fewest.points : 0;
  return {fmt::format(
              "points = {} are too few for this shape: {} needs {}{:.0f}. Each corner takes a point, and so "
              "does each place where the boundary comes near itself; the shortest {}edge, {:.3g} long, is at {}; use "
              "more points, or simplify the shape there",
              *context.options.points,
              fewest.inside ? "its boundary with the curves and interfaces inside" : "its boundary alone",
              fewest.counted ? "" : "more than ", fewest.points, fewest.inside ? "" : "boundary ",
              geometry::length(fewest.shortest.b - fewest.shortest.a), Place(place, 6)),
          least};
}

std::optional<TooFewPoints> too_small_size(const LayoutContext& context, std::span<const sizing::SizeLimit> places) {
  const geometry::Box box = context.given_boundary.bounding_box();
  const double width = std::fmax(box.width(), box.height());
  const auto least = std::ranges::min_element(places, {}, &sizing::SizeLimit::size);
  if (least == places.end() || least->size > small_share * width)
    return std::nullopt;
  return TooFewPoints{fmt::format(
      "points = {} are too few for this size: near {} it is {:.3g} of the width of the shape even where the largest "
      "triangles are as wide as the shape, and it grows by at most {:g} per length. Use more points, a size with a "
      "larger smallest value, or min_size in [sizing]; 'gradation = none' uses the size as it is",
      *context.options.points, Place(least->place, 4), least->size / width, *context.options.gradation)};
}

std::optional<TooFewPoints> too_thin(const LayoutContext& context, const Stage& stage) {
  const geometry::Boundary& given = context.given_boundary;
  if (!stage.curves || !(stage.curves->area > largest_growth * given.area))
    return std::nullopt;
  const double width = 2 * given.area / given.length(), size = fitting_size * width;
  const std::string growth = fmt::format("for this shape, which is {:.3g} wide on average: with triangles of this size "
                                         "it would cover {:.3g} times its area",
                                         width, stage.curves->area / given.area);
  if (context.options.points)
    return TooFewPoints{
        fmt::format("points = {} are too few {}; expected at least about {:.0f} points; use more points, or make the "
                    "shape wider (are the coordinates in the same unit?)",
                    *context.options.points, growth, rounded_up(points_of_length(given, size)))};
  return TooFewPoints{fmt::format("edge_length = {} is too long {}; expected at most about {:.2g}; make it shorter, or "
                                  "make the shape wider (are the coordinates in the same unit?)",
                                  *context.options.edge_length, growth, size)};
}

void check_edge_length(const FitOptions& options) {
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

} // namespace trime::fitting
