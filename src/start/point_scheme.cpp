// SPDX-License-Identifier: BSD-3-Clause
#include "start/point_scheme.hpp"

#include "fitting/expected_points.hpp"
#include "fitting/points_of_length.hpp"
#include "fitting/rules.hpp"
#include "placing/work_share.hpp"
#include "start/density_changes.hpp"
#include "start/refinement.hpp"
#include "start/rules.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace trime::start {
namespace {

// [stages] A bound on the run where a mesh has too few triangles for the points to be inserted.
constexpr int most_insertions = 64;

// [points] From here on the start has a quarter of the points and all edges are divided once. A coarser start would
// starve narrow parts. One division at 1e4 points: mean alpha 1.017, in place of 1.025 without.
constexpr double one_division = 3000;

// [points] From here on the start has 1/16 of the points. Measured with 2e4: two divisions 1.0153, one 1.0165.
constexpr double two_divisions = 20000;

// [points] From here on the start has 1/64 of the points: with less than about 5e4 three divisions starve narrow
// parts.
constexpr double three_divisions = 400000;

// [1] The integral that fits the size of an insertion run uses cells that are wider by this factor, at most.
constexpr double coarsest_integral = 8;

// [points asked for] If at most this share is missing after a division, no sites are inserted: new sites disturb the
// order.
constexpr double small_shortage = 0.01;

// [1] Where fixed points take sites away, more are placed, up to this number times those wanted: a bound for shapes
// that are full of fixed points.
constexpr double most_replaced = 4;

// [points expected] A coarse start of a shape with curves inside has at most this many points. Where arcs are shorter
// than the coarse edges, there are more points than expected; each division multiplies the surplus. The last stage
// removes it along the arcs, and the mesh becomes irregular there. Measured with 1e6 points: 1000 grains took 13 s with
// 1.05 times the expected points and one division, and 29 s with 1.43 times and three; the mean alpha was 1.0107 and
// 1.0182. 500 discs took 7.1 s with 1.08 times and two divisions, and 10.5 s with 1.26 times and three.
constexpr double most_crowded = 1.1;

// [stages] Divisions where the size is limited to the growth that triangles can follow: the sizes of the coarser stage
// grow by twice as much.
constexpr int divisions_of_steep_sizes = 1;

// [stages] Most stages in which the points of an old mesh are thinned and refilled. Each of them makes up to four times
// as many.
constexpr int most_density_stages = 12;

// [1] Where there are too few points, the program tries a number that is larger by this factor each time, until one is
// large enough; then it tries the geometric mean of the last two.
constexpr double enough_step = 2;

// [trials] Largest number of such trials.
constexpr int enough_trials = 8;

using sites::Stage;
using sites::StageView;

int divisions_for(double points) {
  return points < one_division ? 0 : points < two_divisions ? 1 : points < three_divisions ? 2 : 3;
}

} // namespace

PointScheme::PointScheme(const fitting::LayoutContext& context, const StartOptions& options)
    : given_(context), fit_(context), options_(options), asked_points_(fitting::expected_points(context)) {
  choose();
}

/// Points that are left to the clean-up: for smaller triangles where the boundary is ragged, for the middle of small
/// components, and for curves inside. Their number follows from the pieces, components and curves, and is a share of
/// the points at most.
GlobalId PointScheme::reserve() const {
  double pieces = 0;
  for (const geometry::Loop& loop : given_.given_boundary.loops)
    pieces += static_cast<double>(loop.pieces.size());
  if (!given_.options.points || !options_.cleanup)
    return 0;
  const double points = static_cast<double>(*given_.options.points), components = given_.given_boundary.components();
  return static_cast<GlobalId>(
      std::fmin(StartRules::reserved_share * points, StartRules::reserved_per_piece * pieces) +
      std::fmin(StartRules::reserved_for_components * points, StartRules::reserved_per_component * (components - 1)) +
      static_cast<double>(fitting::reserved_for_curves(given_)));
}

double PointScheme::expected_points() const {
  return asked_points_ - static_cast<double>(reserve());
}

/// By the options and the size.
void PointScheme::choose() {
  const bool uniform = given_.relative_size.is_uniform();
  const Start start = options_.start;
  const double fraction = options_.initial_fraction.value_or(1);
  if (options_.old) {
    scheme_ = Scheme::old_mesh;
    last_stage_ = 1; // at least
    reason_ = "the points of " + options_.old->name;
  } else if (options_.initial_fraction && fraction < 1) {
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
    reason_ = "all points at once, along the Hilbert curve with the wanted density (asked for)";
  } else {
    choose_divisions();
  }
}

void PointScheme::choose_divisions() {
  scheme_ = Scheme::coarse_to_fine;
  last_stage_ = divisions_for(expected_points());
}

PointScheme::First PointScheme::first_or_few() {
  First made = first_of_scheme();
  if (std::holds_alternative<fitting::TooFewPoints>(made) && !given_.options.features.keep_all) {
    fit_.cut_thin_components();
    last_stage_ = 0;
    choose();
    made = first_of_scheme();
  }
  return made;
}

/// Returns a number of points at which the search succeeds: at most 1.5 times a number at which it does not succeed;
/// 0 if none of a few numbers is large enough. Collective. @param fewest as far as known
double PointScheme::enough_points(double fewest) const {
  fitting::FitOptions options = given_.options;
  const auto suffice = [&](double points) {
    options.points = static_cast<GlobalId>(points);
    const fitting::LayoutContext larger{given_.comm, given_.domain, given_.relative_size, options,
                                        given_.log,  given_.timers, given_.fixed};
    try {
      return std::holds_alternative<Stage>(PointScheme(larger, options_).first_or_few());
    } catch (const GeometryError&) { // no boundary at this size: all ranks throw it together
      return false;
    }
  };
  double few = std::fmax(fewest, static_cast<double>(*options.points)), enough = few;
  for (int trial = 0; trial < enough_trials; ++trial) {
    enough = fitting::rounded_up(enough_step * few);
    if (suffice(enough))
      break;
    if (trial + 1 == enough_trials)
      return 0;
    few = enough;
  }
  const double between = fitting::rounded_up(std::sqrt(few * enough));
  return between < enough && suffice(between) ? between : enough;
}

Stage PointScheme::first() {
  First made = first_or_few();
  if (const fitting::TooFewPoints* few = std::get_if<fitting::TooFewPoints>(&made)) { // on all ranks together
    const double enough = few->fewest > 0 && !given_.domain.curves().empty() ? enough_points(few->fewest) : 0;
    throw ConfigError(enough > 0 ? fmt::format("{}; {:.0f} points are enough", few->reason, enough) : few->reason);
  }
  Stage& stage = std::get<Stage>(made);
  if (const std::optional<fitting::TooFewPoints> thin =
          fitting::too_thin(given_, is_last() || inserts() ? stage : laid_last_))
    throw ConfigError(thin->reason);
  return std::move(stage);
}

PointScheme::First PointScheme::first_of_scheme() {
  return scheme_ == Scheme::lattice     ? first_of_lattice()
         : scheme_ == Scheme::insertion ? first_of_insertion()
         : scheme_ == Scheme::old_mesh  ? first_of_old_mesh()
                                        : first_of_divisions();
}

PointScheme::First PointScheme::first_of_lattice() {
  if (!fit_.context().raised.empty())
    return first_of_graded_size();
  std::variant<fitting::LatticeFit, fitting::TooFewPoints> found = fit_.find_lattice();
  if (fitting::TooFewPoints* few = std::get_if<fitting::TooFewPoints>(&found))
    return std::move(*few);
  fitting::LatticeFit& fit = std::get<fitting::LatticeFit>(found);
  if ((given_.options.features.refine_narrow && fit_.needs_lowering(fit.stage)) || fit_.raise_at_short_edges(fit.stage))
    return first_of_graded_size();
  shortage_ = std::move(fit.shortage);
  const auto time = given_.timers.scope("start");
  const placing::LatticeStart start(given_.given_boundary, *fit.stage.guard, given_.lattice);
  share_runs(start, fit);
  if (given_.options.point_limit)
    fitting::check_point_limit(given_.options,
                               static_cast<double>(given_.comm.sum(fit.runs.count()) + fit.stage.placed_first()));
  fit_.place_sites(fit.stage, start.sites(fit.runs, static_cast<std::size_t>(fit.stage.placed_first())));
  return std::move(fit.stage);
}

/// Makes the start for a uniform size that the boundary lowers or raises at some places.
PointScheme::First PointScheme::first_of_graded_size() {
  fit_.lower_uniform();
  choose_divisions();
  std::variant<fitting::StageFit, fitting::TooFewPoints> found = find_last();
  if (fitting::TooFewPoints* few = std::get_if<fitting::TooFewPoints>(&found))
    return std::move(*few);
  fitting::StageFit& fit = std::get<fitting::StageFit>(found);
  std::optional<fitting::ZonedLattice> lattice = fit_.find_zoned_lattice(fit, expected_points());
  if (!lattice)
    return first_of_divisions(std::move(fit));
  shortage_ = std::move(fit.shortage);
  return first_of_zoned_lattice(std::move(*lattice));
}

/// Places the sites of a lattice and those in the zones.
PointScheme::First PointScheme::first_of_zoned_lattice(fitting::ZonedLattice found) {
  scheme_ = Scheme::lattice;
  last_stage_ = 0;
  Stage& stage = found.stage;
  const placing::LatticeStart start(given_.given_boundary, *stage.guard, given_.lattice, found.zones.get());
  const std::int64_t on_lattice = given_.comm.sum(found.runs.count());
  reason_ = fmt::format("hexagonal lattice, and along the Hilbert curve {:.2g} % of the points in zones where the "
                        "boundary needs smaller triangles, all points at once: the size is uniform elsewhere",
                        100 * static_cast<double>(found.in_zones) /
                            std::fmax(1, static_cast<double>(found.in_zones + on_lattice)));
  fitting::check_point_limit(given_.options, static_cast<double>(on_lattice + found.in_zones + stage.placed_first()));
  const mesh::SiteList in_zones = sites_along_curve(stage, static_cast<double>(found.in_zones), *found.along_curve);
  const auto time = given_.timers.scope("start");
  mesh::SiteList sites = start.sites(found.runs, in_zones.size() + static_cast<std::size_t>(stage.placed_first()));
  sites.insert(sites.end(), in_zones.begin(), in_zones.end());
  fit_.place_sites(stage, std::move(sites));
  return std::move(stage);
}

/// Returns the runs of this rank, after all of them are distributed evenly: the density gave only an estimate of their
/// number.
void PointScheme::share_runs(const placing::LatticeStart& start, fitting::LatticeFit& fit) const {
  if (fit.runs.of_tile.empty())
    fit.runs = start.runs(placing::own_share(fit.stage), fit.spacing);
  for (bool shared = given_.comm.size() == 1; !shared;) {
    shared = placing::share_by_count(fit.stage, fit.runs.counts());
    fit.runs = start.runs(placing::own_share(fit.stage), fit.runs.spacing);
  }
}

PointScheme::First PointScheme::first_of_insertion() {
  const double coarsening = std::sqrt(expected_points() / points_now_);
  std::variant<fitting::StageFit, fitting::TooFewPoints> found =
      fit_.find_density(expected_points(), std::fmin(coarsening, coarsest_integral));
  if (fitting::TooFewPoints* few = std::get_if<fitting::TooFewPoints>(&found))
    return std::move(*few);
  fitting::StageFit& fit = std::get<fitting::StageFit>(found);
  fitting::check_point_limit(given_.options, fit.inner + static_cast<double>(fit.stage.placed_first()));
  shortage_ = std::move(fit.shortage);
  Stage stage = fit_.lay(coarsening, points_now_);
  if (const double held = static_cast<double>(stage.placed_first()); points_now_ < 2 * held) {
    points_now_ = std::min(expected_points(), 2 * held); // a stage of boundary alone has no order to pass on
    stage = fit_.lay(std::sqrt(expected_points() / points_now_), points_now_);
    reason_ +=
        fmt::format("; the first share of the points was raised to {:.3g}, because the boundary alone takes half of it",
                    points_now_ / expected_points());
  }
  const double inner = points_now_ - static_cast<double>(stage.placed_first());
  fit_.place_sites(stage, sites_along_curve(stage, inner, *along_curve(stage, inner, 1)));
  return stage;
}

PointScheme::First PointScheme::first_of_divisions() {
  std::variant<fitting::StageFit, fitting::TooFewPoints> found = find_last();
  if (fitting::TooFewPoints* few = std::get_if<fitting::TooFewPoints>(&found))
    return std::move(*few);
  return first_of_divisions(std::move(std::get<fitting::StageFit>(found)));
}

/// Fits the factor for the final mesh, by a coarse integral if divisions lead to it.
std::variant<fitting::StageFit, fitting::TooFewPoints> PointScheme::find_last() {
  return fit_.find_density(
      expected_points(),
      last_stage_ == 0 ? 1 : std::fmax(fitting::LayoutRules::coarse_integral, std::ldexp(1.0, last_stage_)));
}

/// Takes the coarsest start that still has as many sites inside as on the boundary: a boundary full of corners does not
/// become coarser with the size.
/// @param fit of the final mesh
PointScheme::First PointScheme::first_of_divisions(fitting::StageFit fit) {
  shortage_ = std::move(fit.shortage);
  const double points = fit.inner + static_cast<double>(fit.stage.placed_first());
  fitting::check_point_limit(given_.options, points);
  Stage stage;
  std::unique_ptr<const placing::HilbertStart> start;
  double inner = 0;
  const double on_boundary = static_cast<double>(fit.stage.polygon.sites.size());
  if (!fit_.steep().limits.empty())
    last_stage_ = std::min(last_stage_, divisions_of_steep_sizes);
  while (last_stage_ > 0 && std::ldexp(fit.inner, -2 * last_stage_) < std::ldexp(on_boundary, -last_stage_))
    --last_stage_; // the share of the strip and of corners only grows
  for (;; --last_stage_) {
    const double expected = std::ldexp(points, -2 * last_stage_);
    stage = lay_division(fit.stage, expected);
    start = along_curve(stage, expected, last_stage_ > 0 ? StartRules::coarse_start : 1);
    inner = start->wanted();
    const double on_curves = static_cast<double>(stage.placed_first());
    const bool is_crowded = !stage.polygon.inner.empty() && inner + on_curves > most_crowded * expected;
    if (last_stage_ == 0 || (inner >= on_curves && !is_crowded))
      break;
  }
  if (scheme_ == Scheme::coarse_to_fine)
    reason_ = reason_of_divisions();
  if (last_stage_ == 0 && given_.options.points && shortage_.empty())
    inner = expected_points() - static_cast<double>(stage.placed_first());
  laid_last_ = std::move(fit.stage);
  fit_.place_sites(stage, sites_along_curve(stage, inner, *start));
  return stage;
}

/// For coarse to fine, once the number of divisions is known.
std::string PointScheme::reason_of_divisions() const {
  if (last_stage_ == 0)
    return "all points at once, along the Hilbert curve with the wanted density: too few points lie inside to divide a "
           "coarser mesh";
  return fmt::format("coarse to fine, the edges of a mesh with 1/{} of the points are divided {}: {}",
                     1 << (2 * last_stage_), last_stage_ == 1 ? "once" : fmt::format("{} times", last_stage_),
                     options_.start == Start::coarse_to_fine ? "asked for" : "the size is graded");
}

/// The present stage of divisions. @param last the last of them, which was laid for the fit and becomes this one if it
/// is the last
Stage PointScheme::lay_division(Stage& last, double expected) {
  const double coarsening = std::ldexp(1.0, last_stage_ - stage_);
  if (coarsening == 1)
    return fit_.lay_again(std::move(last), expected);
  return fit_.lay(coarsening, expected);
}

std::unique_ptr<const placing::HilbertStart> PointScheme::along_curve(const Stage& stage, double expected,
                                                                      double coarsening) const {
  const auto time = given_.timers.scope("start");
  return std::make_unique<const placing::HilbertStart>(given_.comm, placing::own_share(stage), *stage.guard,
                                                       *stage.size, given_.lattice, expected, coarsening);
}

mesh::SiteList PointScheme::sites_along_curve(const Stage& stage, double inner,
                                              const placing::HilbertStart& start) const {
  const auto time = given_.timers.scope("start");
  const auto wanted = std::max<std::int64_t>(0, std::llround(inner));
  mesh::SiteList placed = start.sites(wanted, options_.seed);
  if (!given_.fixed.inside().empty()) { // those too near to a fixed point will go, so more are placed
    const std::int64_t clear = given_.comm.sum(given_.fixed.count_clear(placed, *stage.size));
    if (clear > 0 && clear < wanted) {
      placed =
          start.sites(std::llround(static_cast<double>(wanted) *
                                   std::fmin(most_replaced, static_cast<double>(wanted) / static_cast<double>(clear))),
                      options_.seed);
      std::erase_if(placed, [&](const mesh::Site& site) {
        return given_.fixed.count_clear(std::span(&site, 1), *stage.size) == 0;
      });
      trim(given_.comm, stage, wanted, placed);
    }
  }
  return placed;
}

Stage PointScheme::last_from(Stage first) {
  if (is_last())
    return first;
  return scheme_ == Scheme::insertion ? fit_.lay(1, expected_points()) : std::move(laid_last_);
}

Stage PointScheme::next(Stage& previous, const delaunay::StarBuilder* builder) {
  ++stage_;
  if (scheme_ == Scheme::old_mesh)
    return follow_density(std::move(previous), builder);
  return scheme_ == Scheme::insertion ? insert(previous) : divide(previous);
}

void PointScheme::visit(StateFields& fields) {
  fields.field("stage", stage_);
  fields.field("last_stage", last_stage_);
  fields.field("points_now", points_now_);
  fields.field("expected", expected_);
  if (scheme_ != Scheme::old_mesh)
    return;
  fields.field("old_kept", changes_.kept);
  fields.field("old_removed", changes_.removed);
  fields.field("old_inserted", changes_.inserted);
  reason_ = changes_.text(*options_.old);
}

Stage PointScheme::lay_again_from(Stage first) {
  return stage_ == 0                    ? std::move(first)
         : scheme_ == Scheme::insertion ? lay_insertion()
         : scheme_ == Scheme::old_mesh  ? fit_.lay_again(std::move(first), expected_)
                                        : lay_division(laid_last_, expected_);
}

/// A stage of insertions after the first.
Stage PointScheme::lay_insertion() {
  const double coarsening = is_last() ? 1 : std::fmax(1, std::sqrt(expected_points() / points_now_));
  return fit_.lay(coarsening, points_now_);
}

/// The last stage of a new mesh, with the number of its inner sites.
std::variant<fitting::StageFit, fitting::TooFewPoints> PointScheme::lay_last() {
  if (given_.relative_size.is_uniform() && fit_.context().raised.empty()) {
    std::variant<fitting::LatticeFit, fitting::TooFewPoints> found = fit_.find_lattice();
    if (fitting::TooFewPoints* few = std::get_if<fitting::TooFewPoints>(&found))
      return std::move(*few);
    fitting::LatticeFit& fit = std::get<fitting::LatticeFit>(found);
    if (!(given_.options.features.refine_narrow && fit_.needs_lowering(fit.stage)) &&
        !fit_.raise_at_short_edges(fit.stage)) {
      const auto time = given_.timers.scope("start");
      share_runs(placing::LatticeStart(given_.given_boundary, *fit.stage.guard, given_.lattice), fit);
      return fitting::StageFit{std::move(fit.stage), static_cast<double>(given_.comm.sum(fit.runs.count())),
                               std::move(fit.shortage)};
    }
  }
  if (given_.relative_size.is_uniform())
    fit_.lower_uniform();
  return fit_.find_density(expected_points(), fitting::LayoutRules::coarse_integral);
}

/// The old points in the shape, at the size of the final mesh.
PointScheme::First PointScheme::first_of_old_mesh() {
  std::variant<fitting::StageFit, fitting::TooFewPoints> found = lay_last();
  if (fitting::TooFewPoints* few = std::get_if<fitting::TooFewPoints>(&found))
    return std::move(*few);
  fitting::StageFit& fit = std::get<fitting::StageFit>(found);
  shortage_ = std::move(fit.shortage);
  const auto on_curves = static_cast<double>(fit.stage.placed_first());
  fitting::check_point_limit(given_.options, fit.inner + on_curves);
  wanted_inner_ = given_.options.points && shortage_.empty() ? expected_points() - on_curves : fit.inner;
  const auto time = given_.timers.scope("start");
  mesh::SiteList sites = sites_of(*options_.old, given_.domain.frame());
  const std::int64_t all = given_.comm.sum(static_cast<std::int64_t>(sites.size()));
  clear_strip(fit.stage, sites);
  changes_ = {.all = all, .kept = given_.comm.sum(static_cast<std::int64_t>(sites.size()))};
  if (changes_.kept == 0)
    throw ConfigError(no_point_of(*options_.old, all));
  expected_ = static_cast<double>(changes_.kept) + on_curves;
  Stage stage = fit_.lay_again(std::move(fit.stage), expected_);
  fit_.place_sites(stage, std::move(sites));
  return stage;
}

/// Thins and refills the sites of a stage of an old mesh.
Stage PointScheme::follow_density(Stage previous, const delaunay::StarBuilder* builder) {
  const comm::Communicator& comm = given_.comm;
  const StageView old = previous.view(given_.lattice);
  const auto time = given_.timers.scope("start");
  DensityChanges made = changes_for_density(old, previous, wanted_inner_);
  changes_.add(made);
  if (made.is_finished || stage_ == most_density_stages)
    last_stage_ = stage_;
  else
    last_stage_ = stage_ + 1;
  if (builder && are_edits(previous, made)) {
    edit_for_density(previous, std::move(made), *builder);
    reason_ = changes_.text(*options_.old);
    return previous;
  }
  mesh::SiteList sites = sites_after(*previous.state, made);
  if (given_.options.points && is_last()) {
    const std::int64_t most = std::max<std::int64_t>(0, *given_.options.points - reserve() - previous.placed_first());
    changes_.removed += trim(comm, previous, most, sites);
    const std::int64_t missing = most - comm.sum(static_cast<std::int64_t>(sites.size()));
    if (shortage_.empty() &&
        static_cast<double>(missing) > small_shortage * static_cast<double>(*given_.options.points))
      insert_in_triangles(old, previous, missing, sites);
  }
  reason_ = changes_.text(*options_.old);
  expected_ = static_cast<double>(comm.sum(static_cast<std::int64_t>(sites.size())) + previous.placed_first());
  Stage stage = fit_.lay_again(std::move(previous), expected_);
  fit_.place_sites(stage, std::move(sites));
  return stage;
}

/// Are the changes so few that the stage can stay as it is laid, and is nothing else to be done? Collective.
bool PointScheme::are_edits(const Stage& stage, const DensityChanges& made) const {
  const std::int64_t all = given_.comm.sum(std::int64_t{stage.state->points().owned()});
  if (static_cast<double>(made.removed + made.inserted) > StartRules::edited_share * static_cast<double>(all) ||
      !given_.fixed.inside().empty())
    return false;
  if (!given_.options.points || !is_last())
    return true;
  const std::int64_t missing = *given_.options.points - reserve() - (all - made.removed + made.inserted);
  return missing >= 0 && (!shortage_.empty() ||
                          static_cast<double>(missing) <= small_shortage * static_cast<double>(*given_.options.points));
}

Stage PointScheme::divide(const Stage& previous) {
  const comm::Communicator& comm = given_.comm;
  const StageView old = previous.view(given_.lattice);
  const GlobalId before = comm.sum(std::int64_t{previous.state->points().owned()});
  expected_ = 4 * static_cast<double>(before);
  Stage stage = lay_division(laid_last_, expected_);
  const auto time = given_.timers.scope("start");
  mesh::SiteList sites = split_edges(old);
  clear_strip(stage, sites);
  if (given_.options.points && is_last()) {
    const std::int64_t most = std::max<std::int64_t>(0, *given_.options.points - reserve() - stage.placed_first());
    trim(comm, stage, most, sites);
    const std::int64_t missing = most - comm.sum(static_cast<std::int64_t>(sites.size()));
    if (shortage_.empty() &&
        static_cast<double>(missing) > small_shortage * static_cast<double>(*given_.options.points))
      insert_in_triangles(old, stage, missing, sites); // narrow parts that the coarse mesh has starved
  }
  fit_.place_sites(stage, std::move(sites));
  return stage;
}

Stage PointScheme::insert(const Stage& previous) {
  const comm::Communicator& comm = given_.comm;
  const StageView old = previous.view(given_.lattice);
  const GlobalId before = comm.sum(std::int64_t{previous.state->points().owned()});
  const double grown = std::floor(StartRules::growth * static_cast<double>(before)), all = expected_points();
  if (is_last() && 2 * grown < all && stage_ < most_insertions)
    ++last_stage_; // too few triangles for the rest: the boundary took the points of the first stages
  points_now_ = is_last() ? all : std::min(all, std::max(grown, std::floor(StartRules::growth * points_now_)));
  Stage stage = lay_insertion();
  const auto time = given_.timers.scope("start");
  mesh::SiteList sites = inner_sites(*previous.state);
  clear_strip(stage, sites);
  const std::int64_t most = std::max<std::int64_t>(0, std::llround(points_now_) - stage.placed_first());
  insert_in_triangles(old, stage, most - comm.sum(static_cast<std::int64_t>(sites.size())), sites);
  if (given_.options.points)
    trim(comm, stage, most, sites);
  fit_.place_sites(stage, std::move(sites));
  return stage;
}

} // namespace trime::start
