// SPDX-License-Identifier: BSD-3-Clause
#include "trime/meshing/mesher.hpp"

#include "boundary/changed_bodies.hpp"
#include "boundary/feature_report.hpp"
#include "certificate/certificate.hpp"
#include "certificate/region_proof.hpp"
#include "cleanup/rules.hpp"
#include "comm/agree.hpp"
#include "core/processors.hpp"
#include "extraction/extraction.hpp"
#include "extraction/short_edges.hpp"
#include "fitting/expected_points.hpp"
#include "fitting/layout_context.hpp"
#include "fitting/raised_places.hpp"
#include "fitting/size_warnings.hpp"
#include "meshing/checkpoint_writer.hpp"
#include "meshing/meshed_boundary.hpp"
#include "meshing/outlook.hpp"
#include "meshing/region_losses.hpp"
#include "meshing/relaxation.hpp"
#include "meshing/rules.hpp"
#include "meshing/same_input.hpp"
#include "polygon/region_finder.hpp"
#include "splitting/split_curves.hpp"
#include "start/point_scheme.hpp"
#include "sweep/guard_treatment.hpp"
#include "trime/core/timer.hpp"
#include "trime/shape/traced_part.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace trime::meshing {
namespace {

// [length] The ends of an edge lie no farther from its middle than half its length, except for rounding.
constexpr double short_edge_slack = 1e-6;

using cleanup::CleanupCounts;
using cleanup::CleanupRules;
using sites::Stage;
using sweep::LemmaReach;

/// A run from the boundary and the size to the mesh. Each step works on the stage: its sites, their stars, their h.
class Run {
public:
  /// @param saved where to go on; null: from the start
  /// @param raised where the size must be larger, because an earlier run has made too short edges there
  Run(const RunContext& run, const SnapshotObserver& observer, Checkpoints* checkpoints, const SavedRun* saved,
      std::vector<sizing::LeastSize> raised)
      : run_(run), saved_(saved), input_(check_same_input(run.domain, run.relative_size, run.comm)),
        boundary_(run), layout_{.comm = run.comm,
                                .domain = run.domain,
                                .relative_size = run.relative_size,
                                .options = run.fit,
                                .log = run.log,
                                .timers = run.timers,
                                .fixed = boundary_.fixed(),
                                .raised = std::move(raised)},
        scheme_(layout_, start_options(run.options, run.old)), stars_(run),
        snapshots_(run, boundary_, stars_, observer),
        checkpoints_(run, checkpoints, [this](StateFields& fields) { visit(fields); }),
        relaxation_(run, stars_, snapshots_, checkpoints_) {}

  /// Makes the mesh, or nothing if edges are too short and larger sizes around them may help; then take_raised() says
  /// where. @param trial number of this run, from 1 @param may_raise whether another run may follow
  std::optional<MeshResult> make(int trial, bool may_raise) {
    if (saved_) {
      go_on_from(*saved_);
    } else {
      start_first_stage();
      relax();
    }
    while (!scheme_.is_last()) {
      start_next_stage();
      relax();
    }
    const bool stands = saved_ && point_of(*saved_) == RunPoint::relaxed;
    if (const int wish = checkpoints_.wish_before_cleanup(stands); wish > 0)
      checkpoints_.write(RunPoint::relaxed, wish, relaxation_.state(), *stage_.state, quiet_tiles());
    empty_discs();
    const bool mended = clean_up();
    empty_discs(); // of chords that the clean-up has moved, where sizes are steep
    stars_.complete(stage_, mended ? LemmaReach::inside : LemmaReach::up_to_chords);
    if (may_raise && raise_at_short_edges(trial))
      return std::nullopt;
    MeshResult result = extract();
    split(result);
    return result;
  }
  std::vector<sizing::LeastSize> take_raised() { return std::move(raised_); }

private:
  bool raise_at_short_edges(int trial);
  void start_first_stage();
  void start_next_stage();
  void relax();
  void go_on_from(const SavedRun& saved);
  void check_input(const SavedRun& saved) const;
  void visit(StateFields& fields);
  StageNumber number() const {
    return {scheme_.relaxed_stage(), scheme_.inserts(), scheme_.is_last(), scheme_.last_relaxed_stage(),
            scheme_.is_nearly_relaxed()};
  }
  std::vector<std::uint64_t> quiet_tiles() const;
  void begin(Stage stage);
  void begin_sweeps();
  void count_replicated() const;
  void report_boundary();
  void warn_of_joined_lines(const fitting::JoinedLines& lines);
  void empty_discs();
  bool clean_up();
  MeshResult extract();
  void judge_bodies();
  void tell_of_regions(const certificate::RegionProof& proof, MeshResult& result) const;
  void split(MeshResult& result) const;
  void promise_shortest_edge(double least, MeshResult& result) const;
  std::string reason_for_short_edge(const mesh::QualitySummary& quality) const;
  void tell_of_run(MeshResult& result);
  void tell_of_start(MeshResult& result) const;
  std::string count_reason(GlobalId points) const;

  const RunContext& run_;
  const SavedRun* saved_;
  InputHashes input_;
  MeshedBoundary boundary_;
  const fitting::LayoutContext layout_;
  start::PointScheme scheme_;
  Stage stage_; // the present one
  StageStars stars_;
  Snapshots snapshots_;
  CheckpointWriter checkpoints_;
  Relaxation relaxation_;
  boundary::FeatureReport features_;
  std::vector<sizing::LeastSize> raised_; // where the size must be larger in the next run
  GlobalId placed_ = 0;                   // points at the beginning of the stage
  CleanupCounts cleanup_;
};

void Run::start_first_stage() {
  Stage first = scheme_.first(); // decides, so that the reason is known
  run_.log.info("points: {}", scheme_.reason());
  begin(std::move(first));
}

void Run::start_next_stage() {
  stars_.complete(stage_, LemmaReach::up_to_chords);
  begin(scheme_.next(stage_, stars_.is_usual() ? &stars_.builder() : nullptr));
}

/// Makes the sweeps of the stage, or only its triangles if it needs none.
void Run::relax() {
  if (scheme_.relaxes())
    relaxation_.relax(stage_, number());
  else
    stars_.compute(stage_, sites::Wanted::inner_sites);
}

void Run::begin(Stage stage) {
  stage_ = std::move(stage);
  return_free_memory();
  placed_ = run_.comm.sum(std::int64_t{stage_.state->points().owned()});
  begin_sweeps();
}

/// @pre the stage has its sites, and it is known how many there were at its beginning
void Run::begin_sweeps() {
  boundary_.follow(stage_.curves, stage_.polygon.dropped);
  stars_.begin_stage(placed_);
  count_replicated();
  const int components = boundary_.curves().components(), holes = boundary_.curves().holes();
  run_.log.info("boundary: {} component{}, {} hole{}, {} sites, {} corners", components, components == 1 ? "" : "s",
                holes, holes == 1 ? "" : "s", stage_.polygon.sites.size(), stage_.polygon.corners);
  const mesh::TileGrid& grid = stage_.state->grid();
  run_.log.info("start: {} points in {} tiles ({} x {} cells), mean edge about {:.6g}", placed_, grid.tile_count(),
                grid.cells().x, grid.cells().y, stage_.typical_size);
  if (scheme_.is_last())
    report_boundary();
}

/// Visits the members of the run that a checkpoint keeps.
void Run::visit(StateFields& fields) {
  scheme_.visit(fields);
  snapshots_.visit(fields);
  fields.field("placed", placed_);
  fields.field("shape_hash", input_.shape);
  fields.field("size_hash", input_.sizes);
}

/// Returns the activity of the owned tiles for a checkpoint if nothing was moved since they were sorted: zeros.
std::vector<std::uint64_t> Run::quiet_tiles() const {
  const mesh::BinnedPoints& points = stage_.state->points();
  return std::vector<std::uint64_t>(static_cast<std::size_t>(points.last_tile() - points.first_tile()), 0);
}

/// Throws on all ranks unless the saved run had the same boundary and sizes.
void Run::check_input(const SavedRun& saved) const {
  StateFields fields = StateFields::restoring(saved.state.numbers);
  InputHashes then;
  fields.field("shape_hash", then.shape);
  fields.field("size_hash", then.sizes);
  const auto check = [](std::int64_t kept, std::int64_t now, const char* what) {
    if (kept != now)
      throw FileError(fmt::format("the checkpoint comes from a run with another {}: expected the hash {:016x}, found "
                                  "{:016x}; an input file or the program has changed since; start from the beginning",
                                  what, static_cast<std::uint64_t>(kept), static_cast<std::uint64_t>(now)));
  };
  check(then.shape, input_.shape, "shape or with other fixed points");
  check(then.sizes, input_.sizes, "size");
}

/// Lays the first stage out as at the start of the run, from that the present one, and fetches its sites.
void Run::go_on_from(const SavedRun& saved) {
  check_input(saved);
  Stage first = scheme_.first();
  const InputHashes now = input_;
  StateFields fields = StateFields::restoring(saved.state.numbers);
  visit(fields);
  input_ = now;
  stage_ = scheme_.lay_again_from(std::move(first));
  return_free_memory();
  stage_.state->restore(saved.tiles, saved.load, *stage_.size);
  run_.log.info("restart: {} points, stage {}, after sweep {}",
                run_.comm.sum(std::int64_t{stage_.state->points().owned()}), scheme_.stage(),
                std::get<std::int64_t>(saved.state.numbers.at("sweeps")));
  begin_sweeps();
  relaxation_.resume(stage_, number(), saved);
}

/// Notes the memory of tables that every rank holds completely: the boundary and the size.
void Run::count_replicated() const {
  const std::size_t boundary =
      static_cast<std::size_t>(polygon::piece_count(boundary_.curves())) * sizeof(geometry::Piece) +
      stage_.polygon.sites.capacity() * sizeof(polygon::BoundarySite) + stage_.guard->memory_bytes();
  const std::size_t size =
      run_.relative_size.memory_bytes() + (stage_.lowered_size ? stage_.lowered_size->memory_bytes() : 0);
  run_.comm.counters().note(Counter::boundary_bytes, static_cast<std::int64_t>(boundary));
  run_.comm.counters().note(Counter::size_bytes, static_cast<std::int64_t>(size));
}

/// Collects the report on small features, and on what the user may want to change. Collective.
void Run::report_boundary() {
  features_ = boundary::report_features(stage_.polygon, scheme_.limits(), stage_.asked_size());
  features_.absolute_sizes = run_.options.absolute_sizes;
  comm::run_agreed(run_.comm, [this] { // this and the warnings ask the size field, which may be a user's
    boundary::report_losses(boundary_.fixed().cornered_boundary(), boundary_.curves(), stage_.simplified,
                            stage_.polygon.dropped, stage_.asked_size(), run_.lattice, features_);
    boundary::measure_bodies(boundary_.curves(), stage_.polygon, stage_.asked_size(), features_);
  });
  for (const PlacedText& line : describe(features_))
    run_.log.info("boundary: {}", line.formatted());
  if (const PlacedText warning = loss_warning(features_); !warning.text().empty())
    run_.log.warning("{}", warning.formatted());
  if (const PlacedText warning = body_warning(features_, run_.given_boundary.part_names); !warning.text().empty())
    run_.log.warning("{}", warning.formatted());
  if (const std::int64_t joined = stage_.polygon.inner.joined_nodes; joined > 0)
    run_.log.summary(
        "{} place{} where curves or interfaces meet {} joined with another one, since the edge between them "
        "is shorter than 0.1 h; keep_features = true keeps all",
        joined, joined == 1 ? "" : "s", joined == 1 ? "is" : "are");
  warn_of_joined_lines(scheme_.joined_lines());
  comm::run_agreed(run_.comm, [this] {
    fitting::warn_of_fine_features(stage_, run_.options.min_size.has_value(), run_.log);
    if (run_.fit.gradation && !run_.relative_size.jumps())
      fitting::warn_of_lowered_growth(scheme_.steep(), *run_.fit.gradation, run_.log);
    fitting::warn_of_steep_sizes(stage_, run_.given_boundary, run_.lattice, run_.log);
    if (!boundary_.fixed().empty())
      boundary_.fixed().warn_of_close_ones(*stage_.guard, *stage_.size, run_.log);
  });
}

/// Says which curves are one line with others.
void Run::warn_of_joined_lines(const fitting::JoinedLines& lines) {
  if (lines.vertices > 0)
    run_.log.warning(
        "curves and interfaces that follow each other are one line at {} {}, where they were nearer than "
        "the triangles can show; the largest distance was {:.3g}, at {}; keep_features = true keeps both lines",
        lines.vertices, lines.vertices == 1 ? "vertex" : "vertices", lines.farthest, Place(lines.place, 6));
  const auto warn = [this](const fitting::JoinedParts& parts, std::string_view other, std::string_view effect) {
    if (parts.length > 0)
      run_.log.warning(
          "curves that follow {}, or end just before it, nearer than the triangles can show belong to it over a length "
          "of {:.3g} in total; the edges there {}; the largest distance was {:.3g}, at {}; keep_features = "
          "true keeps both lines",
          other, parts.length, effect, parts.farthest, Place(parts.place, 6));
  };
  warn(lines.rim, "the boundary", "have only the name of the boundary");
  warn(lines.lines, "another curve", "have only the name of that curve");
  warn(lines.interfaces, "an interface",
       "are those of the interface, with the name of the first curve that follows most of it there");
  if (lines.loose_ends > 0)
    run_.log.summary(
        "{} end{} of curves beyond other curves or interfaces {} left out, because {} shorter than 0.1 h; the "
        "longest has a length of {:.3g}; keep_features = true keeps all",
        lines.loose_ends, lines.loose_ends == 1 ? "" : "s", lines.loose_ends == 1 ? "is" : "are",
        lines.loose_ends == 1 ? "it is" : "they are", lines.longest_end);
}

/// Empties the diametral discs of all chords: pushes first, then deletes.
void Run::empty_discs() {
  const auto time = run_.timers.scope("settle");
  sweep::settle_sites(*stage_.state, sweep::move_context(stage_, run_.lattice), stage_.typical_size);
}

/// Improves the worst triangles, patch by patch. Returns true if it changed anything: sites of the boundary may have
/// moved.
bool Run::clean_up() {
  if (!run_.options.cleanup)
    return false;
  stars_.certify(stage_, LemmaReach::up_to_chords);
  const auto time = run_.timers.scope("clean-up");
  cleanup::CleanupOptions options = cleanup_options(run_.options);
  if (scheme_.is_nearly_relaxed())
    options.bad_alpha = CleanupRules::bad_alpha_of_old;
  cleanup_ = cleanup::mend(stage_, boundary_.curves(), run_.lattice, stars_.builder(), options);
  run_.log.info("clean-up: {} of {} patches better; {} sites moved, {} inserted, {} deleted; nothing helped at {} "
                "places with alpha above {}",
                cleanup_.better, cleanup_.patches, cleanup_.moved, cleanup_.inserted, cleanup_.deleted, cleanup_.left,
                options.bad_alpha);
  return cleanup_.better > 0;
}

/// Lists where the size must be larger so that no edge is too short. Returns false if that is nowhere. Collective.
bool Run::raise_at_short_edges(int trial) {
  const double shortest = run_.options.shortest_edge.value_or(0);
  const auto time = run_.timers.scope("measure");
  const std::vector<geometry::ShortEdge> edges = extraction::short_edges(stage_.view(run_.lattice), shortest);
  std::vector<sizing::LeastSize> more;
  comm::run_agreed(run_.comm, [&] { more = fitting::raised_around(edges, stage_, run_.fit, trial); });
  if (more.empty())
    return false;
  run_.log.info("shortest_edge: {} edges are shorter than {:g}; the mesh is made again with larger sizes around them",
                edges.size(), shortest);
  raised_ = scheme_.raised();
  raised_.insert(raised_.end(), more.begin(), more.end());
  return true;
}

/// Sets the tables of the regions, and says which of them are too small for the triangles.
void Run::tell_of_regions(const certificate::RegionProof& proof, MeshResult& result) const {
  const geometry::Regions& given = run_.domain.regions();
  for (std::size_t k = 0; k < proof.areas.size(); ++k) {
    if (proof.triangles[k] == 0 && k > 0)
      run_.log.warning("the region '{}', of area {:.6g}, has no triangles: all of it is smaller or narrower than the "
                       "triangles and belongs to the regions around it; use more points, or keep_features = true in "
                       "[meshing]",
                       given.names[k], given.areas[k]);
    result.regions.push_back({proof.triangles[k], proof.areas[k], given.areas[k]});
  }
  if (proof.areas.empty())
    return;
  std::vector<geometry::RegionLoss> losses = given.absorbed.faces;
  std::ranges::copy(stage_.polygon.inner.losses, std::back_inserter(losses));
  result.region_losses = summed_losses(std::move(losses), given);
}

/// The arrays that are written, with their quality and the certificate.
MeshResult Run::extract() {
  const sites::StageView view = stage_.view(run_.lattice, boundary_.fixed().all());
  const polygon::RegionFinder regions(stage_.polygon, run_.domain.regions(), run_.lattice);
  MeshResult result;
  decomposition::Numbering numbering;
  {
    const auto time = run_.timers.scope("extract");
    numbering = decomposition::canonical_numbering(run_.comm, stage_.state->points(), stage_.state->halo());
    run_.comm.counters().add(Counter::sites_extracted, numbering.owned());
    stage_.state->release_work_space();
    result.loops = boundary_.loops(stage_.polygon);
    extraction::Extraction made = extraction::extract_mesh(view, numbering, stage_.asked_size(), regions);
    result.quality = std::move(made.quality);
    result.mesh = std::move(made.mesh);
  }
  {
    const auto time = run_.timers.scope("certificate");
    result.checks = certificate::certify(view, numbering,
                                         {run_.given_boundary, boundary_.curves(), stage_.asked_size(), run_.side(),
                                          stage_.simplified.coarseness, run_.options.features.within,
                                          boundary::changes_topology(features_), run_.options.features.corner_angle},
                                         result.mesh);
    certificate::RegionProof proof = certificate::prove_regions(view, numbering, regions, result.mesh);
    std::ranges::copy(proof.checks, std::back_inserter(result.checks));
    tell_of_regions(proof, result);
  }
  result.checks.push_back(extraction::worst_alpha_check(result.quality, run_.options.worst_alpha));
  if (run_.fit.gradation || run_.relative_size.is_uniform()) // else the size may jump from point to point
    result.checks.push_back(extraction::longest_edge_check(result.quality));
  if (const std::optional<double>& least = run_.options.shortest_edge) {
    comm::run_agreed(run_.comm, [&] { fitting::warn_of_raised_sizes(stage_, scheme_.raised(), *least, run_.log); });
    promise_shortest_edge(*least, result);
  }
  if (const std::optional<double>& most = run_.options.features.max_loss)
    result.checks.push_back({"lost_area", *most, features_.lost_share, features_.lost_share <= *most,
                             "share of the area of the given shape that is lost: at most max_loss"});
  judge_bodies();
  tell_of_run(result);
  return result;
}

/// Splits the curves that the config asks to split. From here on the mesh is no longer that of the certificate.
void Run::split(MeshResult& result) const {
  const std::vector<geometry::CurveKind>& kinds = run_.domain.curves().kinds;
  if (!splitting::any_split(kinds))
    return;
  const auto time = run_.timers.scope("split");
  const splitting::SplitLoops split = splitting::split_curves(
      run_.comm,
      {kinds, static_cast<std::int32_t>(run_.given_boundary.part_names.size()), stage_.asked_size(), result.loops},
      result.mesh);
  result.loops = split.loops;
  for (boundary::LoopFate& fate : result.features.loops) {
    std::vector<std::int32_t> tags;
    for (const std::int32_t tag : fate.tags)
      if (const auto found = split.new_tags.find(tag); found != split.new_tags.end())
        tags.insert(tags.end(), found->second.begin(), found->second.end());
      else
        tags.push_back(tag);
    fate.tags = std::move(tags);
  }
  const auto is_outer = [](const polygon::LoopSummary& loop) { return loop.kind == polygon::LoopSummary::Kind::outer; };
  result.components = static_cast<int>(std::ranges::count_if(result.loops, is_outer));
  result.holes = static_cast<int>(std::ssize(result.loops)) - result.components;
  result.checks.push_back(splitting::split_check(result.mesh, result.loops));
  run_.log.info("split: {} pairs of points on both sides of curves; {} component{}, {} boundary loops",
                result.mesh.split_slab.total, result.components, result.components == 1 ? "" : "s",
                result.loops.size());
}

/// Adds the check that the shortest edge is long enough, and says what keeps it short if it is not.
void Run::promise_shortest_edge(double least, MeshResult& result) const {
  const mesh::Check& check = result.checks.emplace_back(extraction::shortest_edge_check(result.quality, least));
  if (!check.passed)
    run_.log.warning("the shortest edge is {:.6g} long, at {}, but shortest_edge = {:g} in [sizing]: {}",
                     result.quality.shortest_edge, Place(result.quality.shortest_place, 10), least,
                     reason_for_short_edge(result.quality));
}

/// Says what lies at the ends of the shortest edge.
std::string Run::reason_for_short_edge(const mesh::QualitySummary& quality) const {
  const double reach = (1 + short_edge_slack) * 0.5 * quality.shortest_edge;
  const auto is_at_end = [&](geometry::Vec2 p) { return geometry::length(p - quality.shortest_place) <= reach; };
  if (std::ranges::any_of(boundary_.fixed().all(), is_at_end))
    return "a fixed point lies there, too near to the boundary or to another point. Take it out, or set a smaller "
           "shortest_edge";
  if (run_.options.features.keep_all)
    return "keep_features = true in [meshing] keeps everything that is smaller. Without it the shape is simplified";
  if (std::ranges::any_of(stage_.polygon.sites,
                          [&](const polygon::BoundarySite& site) { return site.corner && is_at_end(site.position); }))
    return "the shape has a corner there that larger triangles around it do not remove. Simplify the shape there, or "
           "set a larger corner_angle in [meshing] or a smaller shortest_edge";
  return "larger triangles around it have not helped. Simplify the shape there, or set a larger min_size or a smaller "
         "shortest_edge";
}

/// Compares the loops of the shape with the final edges, which the clean-up may have moved. Collective.
void Run::judge_bodies() {
  const std::vector<std::string>& names = run_.given_boundary.part_names;
  const bool warned = !body_warning(features_, names).text().empty();
  comm::run_agreed(run_.comm, [this] {
    boundary::measure_bodies(boundary_.curves(), stage_.polygon, stage_.asked_size(), features_);
  });
  if (const PlacedText warning = body_warning(features_, names); !warned && !warning.text().empty())
    run_.log.warning("{}", warning.formatted());
}

/// Sets the other facts of the report about the mesh. @pre the mesh is in the result
void Run::tell_of_run(MeshResult& result) {
  result.components = boundary_.curves().components();
  result.holes = boundary_.curves().holes();
  result.history = relaxation_.take_history();
  result.triangulations = snapshots_.triangulations();
  result.stop_reason = relaxation_.stop_reason();
  result.cleanup = cleanup_;
  result.corners = stage_.polygon.corners;
  result.shape_area = boundary_.curves().area;
  result.features = std::move(features_);
  tell_of_start(result);
}

/// Sets what was asked for and how the start met it. @pre the mesh is in the result
void Run::tell_of_start(MeshResult& result) const {
  result.requested_points = run_.fit.points.value_or(0);
  result.edge_length = run_.relative_size.is_uniform() ? stage_.growing_size().size({}) : stage_.typical_size;
  result.start_reason = scheme_.reason();
  const GlobalId points = result.mesh.point_slab.total;
  result.count_reason = count_reason(points);
  if (static_cast<double>(points) < MeshingRules::shortage_warning * static_cast<double>(result.requested_points))
    run_.log.warning("{} points were asked for, but the mesh has {}{}{}", result.requested_points, points,
                     result.count_reason.empty() ? "" : ": ", result.count_reason);
}

/// Why there are fewer points than asked for; empty if there are nearly as many.
std::string Run::count_reason(GlobalId points) const {
  const std::optional<GlobalId>& asked = run_.fit.points;
  if (!asked)
    return {};
  const double made = static_cast<double>(points), wanted = static_cast<double>(*asked);
  const bool is_warned = made < MeshingRules::shortage_warning * wanted;
  if (!is_warned && made > MeshingRules::shortage_note * wanted - MeshingRules::shortage_slack)
    return {};
  if (!scheme_.shortage().empty())
    return scheme_.shortage();
  const GlobalId removed = placed_ + cleanup_.inserted - cleanup_.deleted - points;
  if (removed <= 0)
    return "so few triangles leave no room for more points inside the shape";
  return fmt::format("{} points were removed because they came too near to the boundary or to each other; the "
                     "remaining ones were left out at the start",
                     removed);
}

} // namespace

class Mesher::Implementation {
public:
  RunContext run;
  OldPoints old{};
  SnapshotObserver observer;
  Checkpoints* checkpoints = nullptr;
  const SavedRun* saved = nullptr;
};

Mesher::Mesher(const comm::Communicator& comm, const geometry::Domain& domain, const sizing::SizeField& size,
               const MeshOptions& options, Log& log, TimerTable& timers)
    : implementation_(new Implementation{{comm, domain, size, options, log, timers}, {}, {}, nullptr, nullptr}) {}
Mesher::~Mesher() = default;

void Mesher::on_snapshot(SnapshotObserver observer) {
  implementation_->observer = std::move(observer);
}

void Mesher::keep_checkpoints(Checkpoints& checkpoints) {
  implementation_->checkpoints = &checkpoints;
}

void Mesher::go_on_from(const SavedRun& saved) {
  implementation_->saved = &saved;
}

void Mesher::start_from(OldPoints old) {
  start::check_periods(old, implementation_->run.domain.frame().periods());
  implementation_->old = std::move(old);
  implementation_->run.old = &implementation_->old;
}

MeshResult Mesher::run() {
  const Implementation& its = *implementation_;
  const SnapshotObserver nobody;
  std::optional<MeshResult> result;
  std::vector<sizing::LeastSize> raised;
  const int trials = its.run.options.shortest_edge ? MeshingRules::most_trials : 1;
  for (int trial = 1; !result; ++trial) { // snapshots and checkpoints are those of the first trial
    const bool first = trial == 1;
    Run run(its.run, first ? its.observer : nobody, first ? its.checkpoints : nullptr, first ? its.saved : nullptr,
            std::move(raised));
    result = run.make(trial, trial < trials);
    raised = run.take_raised();
  }
  return std::move(*result);
}

double Mesher::expected_points() const {
  const RunContext& run = implementation_->run;
  const MeshedBoundary boundary(run);
  return fitting::expected_points(
      {run.comm, run.domain, run.relative_size, run.fit, run.log, run.timers, boundary.fixed()});
}

Outlook Mesher::outlook(Advice advice) const {
  return look_ahead(implementation_->run, advice);
}

using sweep::StopReason;

MeshResult make_mesh(const comm::Communicator& comm, const geometry::Domain& domain, const sizing::SizeField& size,
                     const MeshOptions& options, Log& log) {
  TimerTable timers; // leaves the counters to the caller
  return Mesher(comm, domain, size, options, log, timers).run();
}

MeshResult make_mesh(const comm::Communicator& comm, const shape::RegionShape& shape, const sizing::SizeField& size,
                     const MeshOptions& options, Log& log) {
  return make_mesh(comm, shape.domain(), size, options, log);
}

geometry::Domain traced_domain(const comm::Communicator& comm, const tracing::Shape& shape,
                               const geometry::Frame& frame) {
  std::optional<geometry::Domain> traced;
  comm::run_agreed(comm, [&] {
    std::vector<shape::Part> parts{shape::traced_part("shape", shape, frame)};
    traced.emplace(shape::domain_of(std::move(parts), "shape", frame));
  });
  return std::move(*traced);
}

bool is_complete(const MeshResult& result) {
  return result.stop_reason != StopReason::sweep_cap && mesh::all_passed(result.checks);
}

} // namespace trime::meshing
