// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/layout.hpp"

#include "boundary/boundary_refiner.hpp"
#include "boundary/rules.hpp"
#include "boundary/size_limits.hpp"
#include "comm/agree.hpp"
#include "core/angle.hpp"
#include "fitting/rules.hpp"
#include "placing/work_share.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trime::fitting {
namespace {

// [area of the shape] The grid covers so much of the container with cells as small as the triangles. In an emptier
// container cells are larger, since each costs memory.
constexpr double emptiest_grid = 64;

// [points asked for] A trial whose boundary takes more sites than this is given up before it is laid to its end.
constexpr double affordable_growth = 1.5;

// [sites] A boundary with so few sites is always laid to its end: that takes no time.
constexpr double always_affordable = 1000;

// [samples] Smallest number in which steep places of a size are looked for. Bands of 0.004 of the width are found.
constexpr double steep_samples = 192 * 192;

// [1] Steep places that were found for a factor serve a factor that is larger by this, at most: the size then is too
// steep at more places.
constexpr double most_steepness = 1.05;

// [1] They serve a factor that is smaller by this, at most: the places then lie farther apart than they should.
constexpr double least_steepness = 0.7;

// [1] Places at which a steep size is limited, for each point asked for, over the gradation, and at least one for each
// point: with more of them the mesh would have too many points. The places are about a third of a size apart, so a side
// of a boundary with edges as long as h has 0.4 / gradation points for each of them.
constexpr double steep_places_per_point = 6;

// [places] So few of them never mean that there are too many points.
constexpr double few_steep_places = 4096;

// [places] Largest number if the number of points is not given.
constexpr double all_steep_places = 1 << 24;

// [1] If an edge length is given, the number of points is only an estimate, and this many times as many places may be
// limited. Without this bound, an edge length of a quarter of a shape with a slit took over 500 s, at factors far from
// the result.
constexpr double unknown_points = 16;

using boundary::BoundaryRefiner;
using boundary::BoundaryRules;
using boundary::BoundarySizes;
using boundary::FeatureRule;
using boundary::make_boundary_sites;
using boundary::size_limits;
using boundary::SizeSamples;
using polygon::BoundaryGuard;
using polygon::BoundarySite;
using polygon::BoundarySites;
using sites::SiteState;
using sites::Stage;

/// The part of the container grid around the shape: what lies beyond holds no site. One whole period along periodic
/// axes. Cells that were given keep about their size.
std::unique_ptr<SiteState> make_state(const LayoutContext& context, const BoundarySites& boundary, double spacing) {
  const FitOptions& options = context.options;
  const geometry::Box& container = context.domain.frame().container();
  geometry::Box around;
  for (const BoundarySite& site : boundary.sites)
    around.include(site.position);
  double h = spacing;
  geometry::Box box{{std::max(container.min.x, around.min.x - h), std::max(container.min.y, around.min.y - h)},
                    {std::min(container.max.x, around.max.x + h), std::min(container.max.y, around.max.y + h)}};
  const geometry::Periods& periods = context.given_boundary.periods;
  if (periods.x > 0) {
    box.min.x = periods.min.x;
    box.max.x = periods.min.x + periods.x;
  }
  if (periods.y > 0) {
    box.min.y = periods.min.y;
    box.max.y = periods.min.y + periods.y;
  }
  // Of a shape that is nearly nothing but boundary, most cells hold no site.
  if (context.given_boundary.area > 0)
    h = std::max(h, h * std::sqrt(box.width() * box.height() / (emptiest_grid * context.given_boundary.area)));
  const auto cells = [](const std::optional<int>& given, double share) -> std::optional<int> {
    if (!given)
      return given;
    return std::max(1, static_cast<int>(std::lround(*given * share)));
  };
  return std::make_unique<SiteState>(context.comm, box,
                                     mesh::GridOptions{cells(options.cells_x, box.width() / container.width()),
                                                       cells(options.cells_y, box.height() / container.height()), h,
                                                       periods});
}

/// Returns how many steep places are looked for. @param points about the number of points of the mesh
double most_steep_places(const FitOptions& options, double points) {
  const auto places = [&](double n) {
    return std::fmax(few_steep_places, std::fmax(1, steep_places_per_point * *options.gradation) * n);
  };
  if (options.points)
    return places(static_cast<double>(*options.points));
  return options.absolute ? all_steep_places : std::fmin(all_steep_places, unknown_points * places(points));
}

/// Looks for places where the size of this factor is too steep, unless they are known for about the same factor.
/// Collective.
void find_steep_places(const LayoutContext& context, const Stage& stage, FittedSize& fitted) {
  const std::optional<double>& gradation = context.options.gradation;
  const sizing::ScaledSize& asked = *stage.scaled_size;
  SteepPlaces& steep = fitted.steep;
  if (!gradation || asked.factor() * context.relative_size.largest_growth() <= *gradation) {
    steep.limits.clear();
    steep.is_full = false;
    return;
  }
  if (asked.factor() > most_steepness * steep.factor || asked.factor() < least_steepness * steep.factor) {
    const double points = context.given_boundary.area / (row_height * stage.typical_size * stage.typical_size);
    if (!steep.sizes)
      steep.sizes = std::make_shared<sizing::SteepSizes>(context.comm, context.relative_size, context.given_boundary,
                                                         context.lattice, std::fmax(steep_samples, 0.5 * points));
    sizing::SteepSizes::Limits found =
        steep.sizes->limits(asked, *gradation, most_steep_places(context.options, points));
    steep.is_full = found.is_full;
    steep.is_capped = found.is_capped || (found.is_full && !context.options.points);
    steep.limits = std::move(found.limits);
    steep.gradation = found.gradation;
    steep.steepest = found.steepest;
    steep.factor = asked.factor();
  }
  comm::run_agreed(context.comm, [&] { // a size of the user may throw on one rank
    for (sizing::SizeLimit& limit : steep.limits)
      limit.size = asked.size(limit.place);
  });
}

/// The sizes of a stage from what `fitted` says and its coarsening. Collective.
void set_sizes(const LayoutContext& context, FittedSize& fitted, Stage& stage) {
  using Sets = std::initializer_list<sizing::GradedLimits>;
  const geometry::Periods& periods = context.given_boundary.periods;
  stage.scaled_size = std::make_unique<sizing::ScaledSize>(context.asked_size(fitted.factor));
  stage.limited_size.reset();
  stage.raised_size.reset();
  stage.lowered_size.reset();
  find_steep_places(context, stage, fitted);
  if (const SteepPlaces& steep = fitted.steep; !steep.limits.empty())
    stage.limited_size =
        std::make_unique<sizing::LoweredSize>(*stage.scaled_size, Sets{{steep.limits, steep.gradation}}, periods);
  if (!context.raised.empty())
    stage.raised_size =
        std::make_unique<sizing::RaisedSize>(stage.growing_size(), context.raised, context.narrow_gradation(), periods);
  const sizing::SizeField* last = &stage.asked_size();
  if (!fitted.limits.empty()) {
    stage.lowered_size =
        std::make_unique<sizing::LoweredSize>(*last, Sets{{fitted.limits, context.narrow_gradation()}}, periods);
    last = stage.lowered_size.get();
  }
  stage.size = std::make_unique<sizing::ScaledSize>(*last, stage.coarsening);
}

/// Notes the size for which the boundary or the curves inside were simplified, over the fitted one; at least 1.
void note_coarseness(const FittedSize& fitted, Stage& stage) {
  if (stage.curves || fitted.curves.inner)
    stage.simplified.coarseness = std::fmax(1, fitted.curves.factor / fitted.factor);
}

/// The curves on which the sites of a stage lie: those of the shape, without what is narrower than its last size, or
/// than a larger one if they are held.
const geometry::Boundary& generalised_curves(const LayoutContext& context, FittedSize& fitted, Stage& stage) {
  const geometry::Boundary& given = context.fixed.cornered_boundary();
  CurvesAtSize& curves = fitted.curves;
  if (!generalises(context))
    return given;
  simplify_curves(context, stage.asked_size(), fitted.factor, curves);
  if (!curves.found)
    return given;
  stage.curves = {curves.found, &curves.found->boundary};
  stage.simplified = curves.found->counts;
  return curves.found->boundary;
}

/// Makes the object that lays the sites of a stage. The sizes must outlive it. Local.
/// @param asked the size asked for in the stage
std::unique_ptr<BoundaryRefiner> make_refiner(const LayoutContext& context, std::size_t affordable,
                                              const sizing::ScaledSize& asked, FittedSize& fitted, Stage& stage) {
  const bool keeps_all = context.options.features.keep_all;
  const FeatureRule rule{
      keeps_all ? 0 : context.options.features.tolerance, keeps_all ? 0 : BoundaryRules::least_perimeter,
      context.options.features.components, context.options.features.component_place,
      generalises(context) && !context.given_boundary.periods.any() ? context.options.features.tolerance : 0};
  const geometry::Boundary& boundary = generalised_curves(context, fitted, stage);
  const geometry::InnerCurves& inner = inner_curves(context, stage.asked_size(), boundary, fitted.curves);
  if (fitted.curves.relabelled)
    stage.curves = fitted.curves.relabelled;
  note_coarseness(fitted, stage);
  const auto curves = std::make_shared<const boundary::LaidCurves>(stage.curves ? *stage.curves : boundary, inner,
                                                                   context.fixed.on_curves());
  const auto make = [&](const BoundarySizes& sizes) {
    return std::make_unique<BoundaryRefiner>(curves, sizes, context.lattice,
                                             boundary::LayoutRequest{context.options.features.corner_angle,
                                                                     context.fixed.inside(), context.fixed.held(), rule,
                                                                     affordable});
  };
  if (stage.size->is_uniform() || stage.limited_size ||
      stage.raised_size) // samples of a steep size would lie too far apart
    return make({*stage.size, asked});
  const bool depends = stage.curves || fitted.curves.inner; // the curves are others at another factor
  std::shared_ptr<const SizeSamples>& samples = depends ? fitted.curves.samples : fitted.samples;
  if (!samples || !samples->serve(fitted.factor))
    samples = std::make_shared<SizeSamples>(curves->all(), context.relative_size, *stage.scaled_size);
  return make({*stage.size, asked, {*samples, *stage.scaled_size, stage.lowered_size.get(), stage.coarsening}});
}

/// Returns the edge length of equal triangles with `expected` vertices that fill the shape, without its boundary.
double typical_size(const LayoutContext& context, double expected) {
  return std::sqrt(context.given_boundary.area / (row_height * std::max(1.0, expected)));
}

/// Lays only the sites.
/// @param affordable largest number of sites
Stage lay_bare(const LayoutContext& context, FittedSize& fitted, double coarsening, double expected,
               std::size_t affordable) {
  const auto time = context.timers.scope("boundary");
  Stage stage;
  stage.coarsening = coarsening;
  stage.typical_size = typical_size(context, expected);
  set_sizes(context, fitted, stage);
  if (fitted.steep.is_full && context.options.points) {
    stage.polygon.overfull = true;
    return stage;
  }
  const sizing::ScaledSize asked(stage.asked_size(), coarsening);
  share_simplified_curves(context, stage.asked_size(), fitted.factor, fitted.curves);
  stage.polygon = make_boundary_sites(context.comm, [&] {
    if (stage.asked_size().is_uniform())
      stage.typical_size = coarsening * sizing::checked_size(stage.asked_size(), {});
    return make_refiner(context, affordable, asked, fitted, stage);
  });
  stage.fixed_inside = static_cast<GlobalId>(context.fixed.inside().size());
  return stage;
}

constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

} // namespace

Stage lay_stage(const LayoutContext& context, FittedSize& fitted, double coarsening, double expected) {
  Stage laid = lay_bare(context, fitted, coarsening, expected, unlimited);
  complete(context, laid);
  return laid;
}

Stage lay_again(const LayoutContext& context, Stage stage, double expected) {
  const auto time = context.timers.scope("boundary");
  if (!stage.asked_size().is_uniform())
    stage.typical_size = typical_size(context, expected);
  stage.state = make_state(context, stage.polygon, stage.typical_size);
  placing::share_by_density(stage, *stage.size, context.lattice, 1);
  return stage;
}

Stage lay_reference(const LayoutContext& context, BoundarySites polygon, double expected, double grid_coarsening) {
  Stage stage;
  stage.polygon = std::move(polygon);
  stage.typical_size = typical_size(context, expected);
  comm::run_agreed(context.comm,
                   [&] { stage.guard = std::make_unique<BoundaryGuard>(stage.polygon, context.lattice); });
  stage.state = make_state(context, stage.polygon, grid_coarsening * stage.typical_size);
  return stage;
}

Stage try_boundary(const LayoutContext& context, FittedSize& fitted, double expected) {
  const std::optional<GlobalId>& points = context.options.points;
  const std::size_t affordable =
      points ? static_cast<std::size_t>(std::max(always_affordable, affordable_growth * static_cast<double>(*points)))
             : unlimited;
  return lay_bare(context, fitted, 1, expected, affordable);
}

std::vector<sizing::SizeLimit> further_limits(const LayoutContext& context, const Stage& trial) {
  const auto time = context.timers.scope("boundary");
  if (trial.asked_size().is_uniform() || trial.polygon.overfull)
    return {};
  std::vector<sizing::SizeLimit> limits =
      size_limits(context.comm, trial.polygon, *trial.size, trial.asked_size(), context.narrow_gradation());
  std::erase_if(limits, [&](sizing::SizeLimit& limit) {
    limit.size = std::fmax(limit.size, context.options.least_lowered);
    return limit.size >= trial.size->size(limit.place);
  });
  return limits;
}

bool needs_lowering(const LayoutContext& context, const Stage& laid) {
  const auto time = context.timers.scope("boundary");
  bool needed = false;
  for (const sizing::SizeLimit& limit :
       size_limits(context.comm, laid.polygon, *laid.size, laid.asked_size(), context.narrow_gradation()))
    needed |= limit.size < LayoutRules::lowering_pays * laid.size->size(limit.place);
  return needed;
}

namespace {

/// Throws if a site of a curve lies outside: the boundary was simplified across it.
void check_curves_inside(const LayoutContext& context, const Stage& laid) {
  for (const polygon::InnerChord& chord : laid.polygon.inner.chords) {
    const geometry::Vec2 middle =
        context.given_boundary.periods.wrap(context.lattice.snap(0.5 * (chord.ends.a + chord.ends.b)));
    if (laid.guard->inside(middle))
      continue;
    throw GeometryError(
        fmt::format("the {} leaves the meshed shape at {}, where the boundary is simplified: expected a line "
                    "inside; use more points, or keep_features = true, or set meshing.components so that the part of "
                    "the shape with the curve is meshed",
                    context.domain.line_name(chord.curve, chord.left, chord.right), Place(middle, 10)));
  }
}

} // namespace

void complete(const LayoutContext& context, Stage& trial, double grid_coarsening) {
  const auto time = context.timers.scope("boundary");
  if (trial.polygon.overfull)
    return;
  comm::run_agreed(context.comm, [&] {
    trial.guard = std::make_unique<BoundaryGuard>(trial.polygon, context.lattice);
    context.fixed.check_inside(*trial.guard, trial.polygon.dropped.other_loops);
    check_curves_inside(context, trial);
  });
  trial.state = make_state(context, trial.polygon, grid_coarsening * trial.typical_size);
  placing::share_by_density(trial, *trial.size, context.lattice, grid_coarsening);
}

void rescale(const LayoutContext& context, FittedSize& fitted, Stage& laid, double scale) {
  const auto time = context.timers.scope("boundary");
  fitted.factor *= scale;
  for (sizing::SizeLimit& limit : fitted.limits)
    limit.size *= scale;
  set_sizes(context, fitted, laid);
  note_coarseness(fitted, laid);
}

namespace {

/// Removes the fixed points and the sites on curves of an earlier stage. Each stage places its own.
void remove_fixed(mesh::SiteList& sites) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < sites.size(); ++k)
    if (sites[k].boundary != mesh::fixed_site)
      sites[kept++] = sites[k];
  sites.resize(kept);
}

/// Adds the sites on curves that lie in the tiles.
void place_on_curves(const Stage& stage, const mesh::TileRange& tiles, mesh::SiteList& sites) {
  for (const geometry::Vec2 p : stage.polygon.inner.sites) {
    const LocalIndex tile = tiles.grid.place(p).tile;
    if (tile >= tiles.first && tile < tiles.last)
      sites.push_back({p, mesh::fixed_site});
  }
}

} // namespace

void place_sites(const LayoutContext& context, Stage& stage, mesh::SiteList inner) {
  const mesh::TileRange tiles = placing::own_share(stage);
  if (context.given_boundary.periods.any())
    for (mesh::Site& site : inner)
      site.position = context.given_boundary.periods.wrap(site.position);
  const auto on_boundary = std::ssize(stage.polygon.sites), ranks = std::ptrdiff_t{context.comm.size()};
  for (std::ptrdiff_t b = on_boundary * context.comm.rank() / ranks;
       b < on_boundary * (context.comm.rank() + 1) / ranks; ++b)
    inner.push_back({stage.polygon.sites[static_cast<std::size_t>(b)].position, static_cast<std::int32_t>(b)});
  if (!context.fixed.empty() || !stage.polygon.inner.empty()) {
    remove_fixed(inner);
    place_on_curves(stage, tiles, inner);
  }
  comm::run_agreed(context.comm, [&] { context.fixed.place_among(inner, tiles, *stage.size); });
  stage.state->distribute(std::move(inner));
}

} // namespace trime::fitting
