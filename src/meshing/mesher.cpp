// SPDX-License-Identifier: BSD-3-Clause
#include "trime/meshing/mesher.hpp"

#include "boundary/feature_report.hpp"
#include "certificate/certificate.hpp"
#include "cleanup/cleanup.hpp"
#include "cleanup/rules.hpp"
#include "comm/agree.hpp"
#include "core/free_memory.hpp"
#include "core/thread_loop.hpp"
#include "extraction/extraction.hpp"
#include "meshing/plan.hpp"
#include "meshing/plan_start.hpp"
#include "meshing/rules.hpp"
#include "polygon/chord_curve.hpp"
#include "sites/site_state.hpp"
#include "start/layout.hpp"
#include "start/point_scheme.hpp"
#include "start/size_warnings.hpp"
#include "sweep/guard_treatment.hpp"
#include "sweep/stopping.hpp"
#include "sweep/sweep_record.hpp"
#include "sweep/sweeper.hpp"
#include "sweep/update_rule.hpp"
#include "trime/core/error.hpp"
#include "trime/geometry/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trime::meshing {
using boundary::boundary_without;
using boundary::describe;
using boundary::FeatureReport;
using boundary::FixedPoints;
using boundary::report_features;
using certificate::certify;
using cleanup::CleanupCounts;
using cleanup::CleanupRules;
using cleanup::CleanupTask;
using cleanup::mend;
using extraction::extract_mesh;
using extraction::Extraction;
using polygon::DroppedLoops;
using polygon::LoopSummary;
using polygon::summarize_loops;
using sites::count_incomplete_fans;
using sites::inside_fan;
using sites::SiteState;
using sites::Stage;
using sites::StageView;
using sites::view_of;
using sites::Wanted;
using start::LayoutContext;
using start::PointScheme;
using start::StartOptions;
using start::warn_of_fine_features;
using start::warn_of_steep_sizes;
using sweep::LemmaReach;
using sweep::MoveContext;
using sweep::Mover;
using sweep::settle_sites;
using sweep::StarCertifier;
using sweep::StopReason;
using sweep::StopRules;
using sweep::summarize_sweep;
using sweep::SweepControl;
using sweep::SweepDecision;
using sweep::Sweeper;
using sweep::SweepOptions;
using sweep::SweepRecord;
using sweep::SweepSummary;
using sweep::SweepSums;
using sweep::to_string;

class Mesher::Implementation {
public:
  Implementation(const comm::Communicator& comm, const geometry::Boundary& boundary, const sizing::SizeField& size,
                 const MeshOptions& options, Log& log, TimerTable& timers)
      : comm_(comm), given_boundary_(boundary), relative_size_(size), options_(options),
        start_options_(plan_start(options)), sweep_options_(sweep_options(options)), log_(log), timers_(timers),
        lattice_(options.container) {}

  MeshResult run() {
    SweepControl control(sweep_options_, history_);
    for (begin();; advance()) {
      relax(control);
      if (scheme_->is_last())
        break;
    }
    settle();
    const bool mended = clean_up();
    settle(); // chords that the clean-up has moved, where sizes are steep
    complete_stars(mended ? LemmaReach::inside : LemmaReach::up_to_chords);
    return extract();
  }

  SnapshotObserver observer;

private:
  LayoutContext layout_context() const {
    return {comm_, given_boundary_, relative_size_, start_options_, lattice_, log_, timers_, *fixed_};
  }

  void begin() {
    fixed_ = std::make_unique<FixedPoints>(given_boundary_, options_.container, options_.fixed_points, lattice_, log_);
    context_ = std::make_unique<LayoutContext>(layout_context());
    scheme_ = std::make_unique<PointScheme>(*context_);
    Stage first = scheme_->first(); // decides, so that the reason is known
    log_.info("points: {}", scheme_->reason());
    set_up(std::move(first));
  }

  void advance() {
    complete_stars(LemmaReach::up_to_chords);
    set_up(scheme_->next(stage_));
  }

  void set_up(Stage stage) {
    stage_ = std::move(stage);
    return_free_memory();
    if (dropped().any())
      kept_boundary_ = boundary_without(fixed_->cornered_boundary(), dropped());
    placed_ = comm_.sum(std::int64_t{state().points().owned()});
    const mesh::TileGrid& grid = state().grid();
    make_builder(placed_);
    const int components = meshed_boundary().components(), holes = meshed_boundary().holes();
    log_.info("boundary: {} component{}, {} hole{}, {} sites, {} corners", components, components == 1 ? "" : "s",
              holes, holes == 1 ? "" : "s", stage_.boundary.sites.size(), stage_.boundary.corners);
    log_.info("start: {} points in {} tiles ({} x {} cells), mean edge about {:.6g}", placed_, grid.tile_count(),
              grid.cells().x, grid.cells().y, stage_.typical_size);
    if (scheme_->is_last()) {
      features_ = report_features(stage_.boundary, scheme_->limits(), *stage_.asked_size);
      for (const std::string& line : describe(features_))
        log_.info("boundary: {}", line);
      comm::run_agreed(comm_, [this] { // they ask the size field, which may be a user's
        warn_of_fine_features(stage_, log_);
        warn_of_steep_sizes(stage_, given_boundary_, lattice_, log_);
        if (!fixed_->empty())
          fixed_->warn_of_close_ones(*stage_.guard, *stage_.size, log_);
      });
    }
  }

  const DroppedLoops& dropped() const { return stage_.boundary.dropped; }

  void make_builder(GlobalId points) {
    const double largest = std::max(options_.container.width(), options_.container.height());
    cap_factor_ = points < MeshingRules::few_points ? std::numeric_limits<double>::infinity() : MeshingRules::cap;
    builder_ = std::make_unique<delaunay::StarBuilder>(lattice_, cap_factor_, largest);
  }

  // --- sweeps -------------------------------------------------------------------------------------------------------

  /// Sweeps until the stop rule ends the stage, at the sweep cap at the latest; then sorts.
  void relax(SweepControl& control) {
    control.begin_stage(scheme_->inserts(), scheme_->is_last());
    Sweeper::Counts counts; // since the last record
    counts.rebuilt = comm_.sum(stars(Wanted::inner_sites).rebuilt);
    Sweeper sweeper(state(), *builder_, move_context(), allowed(LemmaReach::up_to_chords));
    SweepSums sums = record_sweep(sweeper, counts);
    show_snapshot();
    begun_.reset();
    std::optional<StopReason> end = go_on(control);
    while (!end) {
      counts = {};
      do {
        counts.follow_by(sweep(sweeper, control, sums));
        show_snapshot();
      } while (sweeps_ - history_.back().sweep < StopRules::measuring_interval && sweeps_ < sweep_options_.max_sweeps);
      sums = record_sweep(sweeper, counts);
      end = go_on(control);
    }
    stop_reason_ = *end;
    const auto time = timers_.scope("sort");
    sweeper.sort();
    state().points().release_leads();
  }

  LemmaReach allowed(LemmaReach reach) const { return sweep_options_.stars_by_emptiness ? LemmaReach::nowhere : reach; }

  /// Certifies the stars of the inner sites, most of which are as they were before the last moves.
  /// @param reach the clean-up may have moved boundary sites into discs of chords
  void mend_stars(LemmaReach reach) {
    const auto time = timers_.scope("stars");
    const std::uint64_t uncertain = thread_sum(static_cast<std::size_t>(state().points().owned()), [&](std::size_t i) {
      const auto site = static_cast<LocalIndex>(i);
      return std::uint64_t{state().points().boundary(site) < 0 && !state().stars().certain(site)};
    });
    if (comm_.sum(static_cast<std::int64_t>(uncertain)) == 0)
      return;
    state().refresh(*stage_.size);
    StarCertifier(state(), *builder_, move_context(), allowed(reach)).certify_all();
  }

  /// Moves the sites by the rule and certifies the stars at the new places. That is one pass with the search for the
  /// places after these, which is made anew if the rule changes.
  Sweeper::Counts sweep(Sweeper& sweeper, SweepControl& control, SweepSums& sums) {
    const auto time = timers_.scope("sweeps");
    if (begun_ != control.mover()) {
      begun_ = control.mover();
      control.rule().begin_sweep(sums);
      sweeper.discard();
    }
    if (!sweeper.is_prepared())
      sweeper.prepare(control.rule());
    const Sweeper::Counts moved = sweeper.commit();
    ++sweeps_;
    sums.power = moved.power;
    control.rule().begin_sweep(sums);
    sweeper.prepare(control.rule());
    if (sweep_options_.verify_stars)
      sweeper.verify();
    return moved;
  }

  /// Carries out what the control decides after a record: switches the rule if it says so, and writes the line of the
  /// log. Returns why the stage ends, if it does.
  std::optional<StopReason> go_on(SweepControl& control) {
    const SweepDecision decision = control.decide();
    if (decision.next)
      control.switch_to(*decision.next);
    history_.back().by_bars = control.mover() == Mover::bars;
    log_sweep(decision.stop && scheme_->is_last());
    return decision.stop;
  }

  /// Shows the present triangulation to the observer, if the options ask for it; the run goes on as without that.
  void show_snapshot() {
    const int retriangulation = ++triangulations_, interval = options_.snapshot_interval;
    if (!observer || interval == 0 || !(retriangulation == 1 || (interval > 0 && retriangulation % interval == 0)))
      return;
    const auto time = timers_.scope("snapshots");
    SiteState shown(state()); // the sites of the sweeps are not sorted, and some of their stars not certain
    shown.compute_stars(*builder_, *stage_.size, Wanted::all_sites);
    const decomposition::Numbering numbering = decomposition::canonical_numbering(comm_, shown.points(), shown.halo());
    const Extraction made = extract_mesh(view_of(shown), numbering);
    const std::vector<LoopSummary> loops = summarize_loops(meshed_boundary(), stage_.boundary);
    observer({retriangulation, timers_.total(), made.mesh, made.quality, loops});
  }

  delaunay::StarPass stars(Wanted wanted) {
    const auto time = timers_.scope("stars");
    return state().compute_stars(*builder_, *stage_.size, wanted);
  }

  /// What the sites are laid on: the shape's boundary with fixed points as corners, without the loops that are dropped.
  const geometry::Boundary& meshed_boundary() const {
    return dropped().any() ? kept_boundary_ : fixed_->cornered_boundary();
  }
  SiteState& state() { return *stage_.state; }
  const SiteState& state() const { return *stage_.state; }
  MoveContext move_context() const { return {*stage_.guard, *stage_.size, lattice_}; }

  SweepSums record_sweep(Sweeper& sweeper, const Sweeper::Counts& counts) {
    const auto time = timers_.scope("measure");
    SweepSummary summary = summarize_sweep(state(), sweeper, counts, stage_.typical_size, stage_.placed_first());
    summary.record.sweep = sweeps_;
    summary.record.stage = scheme_->stage();
    summary.record.seconds = timers_.total();
    history_.push_back(summary.record);
    return summary.sums;
  }

  void log_sweep(bool last) {
    const SweepRecord& record = history_.back();
    log_.progress(record.sweep, to_string(record), last || record.sweep == 0);
  }

  /// Empties the diametral discs of all boundary segments: pushes first, then deletes.
  void settle() {
    const auto time = timers_.scope("settle");
    settle_sites(state(), move_context(), stage_.typical_size);
  }

  /// Mends the worst triangles, patch by patch. True if it changed anything: sites of the boundary may have moved.
  bool clean_up() {
    if (!options_.cleanup || history_.empty())
      return false;
    mend_stars(LemmaReach::up_to_chords);
    const auto time = timers_.scope("clean-up");
    const CleanupTask task{state(),  stage_.boundary, *stage_.guard, meshed_boundary(),
                           lattice_, *builder_,       *stage_.size,  *stage_.asked_size};
    cleanup_ =
        mend(comm_, task, {options_.points.value_or(0), options_.keep_features ? 0 : options_.feature_tolerance});
    log_.info("clean-up: {} of {} patches better; {} sites moved, {} inserted, {} deleted; nothing helped at {} "
              "places with alpha above {}",
              cleanup_.better, cleanup_.patches, cleanup_.moved, cleanup_.inserted, cleanup_.deleted, cleanup_.left,
              CleanupRules::bad_alpha);
    return cleanup_.better > 0;
  }

  // --- the mesh -----------------------------------------------------------------------------------------------------

  StageView view() const { return view_of(state()); }
  StageView view_of(const SiteState& state) const {
    return {state, stage_.boundary, *stage_.size, lattice_, fixed_->all()};
  }

  /// Throws if triangles of a periodic container reach around it: then their ids do not tell them apart.
  void check_periods() {
    const geometry::Periods& periods = given_boundary_.periods;
    const double limit = delaunay::StarBuilder::largest_cap(periods);
    if (builder_->cap(stage_.typical_size) < limit || comm_.sum(count_incomplete_fans(view())) == 0)
      return;
    const double size = limit / 1.5; // circumradii stay below 1.5 h
    throw GeometryError(fmt::format(
        "the periodic container needs triangles with circumradii below a quarter of its period, which takes a period "
        "of "
        "about three edges; found an element size of {:.3g} in a period of {:.3g}; about {} points are enough",
        stage_.typical_size, 4 * limit,
        static_cast<GlobalId>(std::ceil(given_boundary_.area / (0.866 * size * size)))));
  }

  /// Stars of all sites. Where a fan is not complete the cap may have been too low (a void): it is doubled for these
  /// sites, a few times; the certificate tells of what remains.
  /// @param lemma up to which sites the stars around one may certify it
  void complete_stars(LemmaReach lemma) {
    const double largest = std::max(options_.container.width(), options_.container.height());
    mend_stars(lemma);
    stars(Wanted::all_sites);
    for (int doubling = 0; doubling < MeshingRules::cap_doublings && std::isfinite(cap_factor_); ++doubling) {
      if (comm_.sum(count_incomplete_fans(view())) == 0)
        return;
      cap_factor_ *= 2;
      builder_ = std::make_unique<delaunay::StarBuilder>(lattice_, cap_factor_, largest);
      thread_loop(state().points().owned(), 4096, [&](std::ptrdiff_t item, int) {
        const auto i = static_cast<LocalIndex>(item);
        state().stars().set_certain(i, inside_fan(view(), i).complete);
      });
      stars(Wanted::all_sites);
    }
    if (given_boundary_.periods.any())
      check_periods();
  }

  MeshResult extract() {
    const auto time = timers_.scope("extract");
    const StageView context = view();
    const decomposition::Numbering numbering =
        decomposition::canonical_numbering(comm_, state().points(), state().halo());
    state().release_work_space();
    MeshResult result;
    result.components = meshed_boundary().components();
    result.holes = meshed_boundary().holes();
    result.loops = summarize_loops(meshed_boundary(), stage_.boundary);
    Extraction made = extract_mesh(context, numbering);
    result.quality = std::move(made.quality);
    result.mesh = std::move(made.mesh);
    const double side = std::max(options_.container.width(), options_.container.height());
    result.checks = certify(context, numbering, {given_boundary_, meshed_boundary(), side}, result.mesh);
    result.history = std::move(history_);
    result.triangulations = triangulations_;
    result.stop_reason = stop_reason_;
    result.cleanup = cleanup_;
    result.requested_points = options_.points.value_or(0);
    result.edge_length = relative_size_.is_uniform() ? stage_.size->size({}) : stage_.typical_size;
    result.start_reason = scheme_->reason();
    result.count_reason = count_reason(result.mesh.point_slab.total);
    if (static_cast<double>(result.mesh.point_slab.total) <
        MeshingRules::shortage_warning * static_cast<double>(result.requested_points))
      log_.warning("{} points were asked for, {} made: {}", result.requested_points, result.mesh.point_slab.total,
                   result.count_reason);
    result.corners = stage_.boundary.corners;
    result.shape_area = meshed_boundary().area;
    result.features = std::move(features_);
    return result;
  }

  /// Why there are fewer points than asked for; empty if there are nearly as many.
  std::string count_reason(GlobalId points) const {
    if (!options_.points ||
        static_cast<double>(points) >
            MeshingRules::shortage_note * static_cast<double>(*options_.points) - MeshingRules::shortage_slack)
      return {};
    if (!scheme_->shortage().empty())
      return scheme_->shortage();
    return fmt::format("{} points came too near to the boundary or to each other and were taken out; the start left "
                       "out the rest",
                       placed_ + cleanup_.inserted - cleanup_.deleted - points);
  }

  const comm::Communicator& comm_;
  const geometry::Boundary& given_boundary_;
  const sizing::SizeField& relative_size_;
  const MeshOptions options_;
  const StartOptions start_options_;
  const SweepOptions sweep_options_;
  Log& log_;
  TimerTable& timers_;

  geometry::Lattice lattice_;
  std::unique_ptr<FixedPoints> fixed_;
  Stage stage_;
  geometry::Boundary
      kept_boundary_; // the cornered one of fixed_ without the loops that were dropped; unused if none was
  FeatureReport features_;
  double cap_factor_ = 0; // of h
  std::unique_ptr<delaunay::StarBuilder> builder_;
  std::unique_ptr<LayoutContext> context_;
  std::unique_ptr<PointScheme> scheme_;
  std::vector<SweepRecord> history_;
  GlobalId placed_ = 0;        // points at the beginning of the stage
  int sweeps_ = 0;             // moves made
  int triangulations_ = 0;     // the first of each stage, and one for each move
  std::optional<Mover> begun_; // the rule that knows the sums for the next move
  CleanupCounts cleanup_;
  StopReason stop_reason_ = StopReason::sweep_cap;
};

Mesher::Mesher(const comm::Communicator& comm, const geometry::Boundary& boundary, const sizing::SizeField& size,
               const MeshOptions& options, Log& log, TimerTable& timers)
    : implementation_(std::make_unique<Implementation>(comm, boundary, size, options, log, timers)) {}
Mesher::~Mesher() = default;

void Mesher::on_snapshot(SnapshotObserver observer) {
  implementation_->observer = std::move(observer);
}

MeshResult Mesher::run() {
  return implementation_->run();
}

} // namespace trime::meshing
