// SPDX-License-Identifier: BSD-3-Clause
#include "trime/meshing/mesher.hpp"

#include "meshing/boundary_treatment.hpp"
#include "meshing/extraction.hpp"
#include "meshing/layout.hpp"
#include "meshing/site_state.hpp"
#include "meshing/stopping.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/meshing/update_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trime::meshing {
namespace {

constexpr double cap_in_sizes = 2.5;  // circumradius that counts, in h: a relaxed mesh has 0.6, a start up to 1.5
constexpr GlobalId few_points = 2000; // below, the cap is the whole container
constexpr double default_tolerance = 0.04;
constexpr int cap_doublings = 3;
constexpr int settle_rounds = 12, settle_pushes = 8;

} // namespace

class Mesher::Implementation {
public:
  Implementation(const comm::Communicator& comm, const geometry::Boundary& boundary, const sizing::SizeField& size,
                 const MeshOptions& options, Log& log, TimerTable& timers)
      : comm_(comm), boundary_(boundary), relative_size_(size), options_(options), log_(log), timers_(timers),
        lattice_(options.container) {}

  MeshResult run() {
    set_up();
    relax();
    settle();
    complete_stars();
    return extract();
  }

  SnapshotObserver observer;

private:
  void set_up() {
    layout_ = lay_out({comm_, boundary_, relative_size_, options_, lattice_, log_, timers_});
    const GlobalId placed = comm_.sum(std::int64_t{state().points().owned()});
    const mesh::TileGrid& grid = state().grid();
    make_builder(placed);
    log_.info("start: {} points in {} tiles ({} x {} cells)", placed, grid.tile_count(), grid.cells_x(),
              grid.cells_y());
  }

  void make_builder(GlobalId points) {
    const double largest = std::max(options_.container.width(), options_.container.height());
    cap_factor_ = points < few_points ? std::numeric_limits<double>::infinity() : cap_in_sizes;
    builder_ = std::make_unique<delaunay::StarBuilder>(lattice_, cap_factor_, largest);
  }

  // --- sweeps -------------------------------------------------------------------------------------------------------

  void relax() {
    DistMeshRule rule;
    const StopRule stop(options_.max_sweeps, options_.stop_tolerance.value_or(default_tolerance));
    MoveCounts moved;
    for (std::optional<StopReason> reason; !reason;) { // ends at the sweep cap at the latest
      const delaunay::StarPass pass = stars(Wanted::inner_sites);
      const SweepSums sums = record_sweep(pass, moved);
      reason = stop.decide(history_);
      log_sweep(reason.has_value());
      if (reason) {
        stop_reason_ = *reason;
        return;
      }
      const auto time = timers_.scope("move");
      rule.begin_sweep(sums);
      moved = move_by_rule(state(), rule, context());
    }
  }

  delaunay::StarPass stars(Wanted wanted) {
    const auto time = timers_.scope("stars");
    return state().compute_stars(*builder_, *layout_.size, wanted);
  }

  SiteState& state() { return *layout_.state; }
  const SiteState& state() const { return *layout_.state; }
  MoveContext context() const { return {*layout_.guard, *layout_.size, lattice_}; }

  /// One packed reduction: quality, sums for the rule, and what the last move did.
  SweepSums record_sweep(const delaunay::StarPass& pass, const MoveCounts& moved) {
    const auto time = timers_.scope("measure");
    SweepSums sums = measure({state().points(), state().stars(), *layout_.size, &state().sizes()}, layout_.edge_length);
    const auto l = sums.squared_length_ratio.split(), s = sums.squared_size_ratio.split(),
               a = sums.excess_alpha.split();
    std::array<std::int64_t, 12> packed{l.low,        l.high,       s.low,          s.high,
                                        a.low,        a.high,       sums.triangles, state().points().owned(),
                                        pass.rebuilt, moved.moving, moved.pushed,   moved.deleted};
    comm_.sum(packed);
    std::array<double, 2> largest{sums.max_alpha, moved.max_move};
    comm_.max(largest);
    sums.squared_length_ratio = FixedSum::join({packed[0], packed[1]});
    sums.squared_size_ratio = FixedSum::join({packed[2], packed[3]});
    sums.excess_alpha = FixedSum::join({packed[4], packed[5]});
    sums.triangles = packed[6];

    SweepRecord record;
    record.sweep = static_cast<int>(history_.size());
    record.points = packed[7];
    record.mean_alpha = 1 + (sums.triangles > 0 ? sums.excess_alpha.value() / static_cast<double>(sums.triangles) : 0);
    record.max_alpha = largest[0];
    record.max_move = largest[1];
    const std::int64_t inner = record.points - static_cast<std::int64_t>(layout_.boundary.sites.size());
    record.moving_share = history_.empty() ? 1
                          : inner > 0      ? static_cast<double>(packed[9]) / static_cast<double>(inner)
                                           : 0;
    record.rebuilt_stars = packed[8];
    record.pushed = packed[10];
    record.deleted = packed[11];
    record.seconds = timers_.total();
    history_.push_back(record);
    return sums;
  }

  void log_sweep(bool last) {
    const SweepRecord& r = history_.back();
    log_.progress(r.sweep,
                  fmt::format("sweep {:4d}  points {:9d}  mean alpha {:.5f}  max alpha {:8.4f}  moving {:6.2f} %  "
                              "max move {:.3f} h  rebuilt {:8d}  {:8.2f} s",
                              r.sweep, r.points, r.mean_alpha, r.max_alpha, 100 * r.moving_share, r.max_move,
                              r.rebuilt_stars, r.seconds),
                  last || r.sweep == 0);
  }

  /// Empties the diametral discs of all boundary segments: pushes first, then deletes.
  void settle() {
    const auto time = timers_.scope("settle");
    for (int round = 0; round < settle_rounds; ++round) {
      const MoveCounts counts = settle_round(state(), context(), round >= settle_pushes);
      if (comm_.sum(counts.pushed + counts.deleted) == 0)
        return;
    }
  }

  // --- the mesh -----------------------------------------------------------------------------------------------------

  ExtractionContext extraction() const { return {state(), layout_.boundary, *layout_.size, lattice_}; }

  /// Stars of all sites. Where a fan is not complete the cap may have been too low (a void): it is doubled for these
  /// sites, a few times; the certificate tells of what remains.
  void complete_stars() {
    const double largest = std::max(options_.container.width(), options_.container.height());
    stars(Wanted::all_sites);
    for (int doubling = 0; doubling < cap_doublings && std::isfinite(cap_factor_); ++doubling) {
      if (comm_.sum(count_incomplete_fans(extraction())) == 0)
        return;
      cap_factor_ *= 2;
      builder_ = std::make_unique<delaunay::StarBuilder>(lattice_, cap_factor_, largest);
      for (LocalIndex i = 0; i < state().points().owned(); ++i)
        state().stars().set_certain(i, inside_fan(extraction(), i).complete);
      stars(Wanted::all_sites);
    }
  }

  MeshResult extract() {
    const auto time = timers_.scope("extract");
    state().release_work_space();
    const ExtractionContext context = extraction();
    const decomposition::Numbering numbering =
        decomposition::canonical_numbering(comm_, state().points(), state().halo());
    MeshResult result;
    result.components = boundary_.components();
    result.holes = boundary_.holes();
    result.quality = measure_quality(context, numbering);
    result.mesh = extract_mesh(context, numbering);
    result.checks = certify(context, numbering, {boundary_.euler_characteristic(), boundary_.periods}, result.mesh);
    result.history = std::move(history_);
    result.stop_reason = stop_reason_;
    result.requested_points = options_.points.value_or(0);
    result.edge_length = layout_.edge_length;
    result.corners = layout_.boundary.corners;
    result.shape_area = boundary_.area;
    return result;
  }

  const comm::Communicator& comm_;
  const geometry::Boundary& boundary_;
  const sizing::SizeField& relative_size_;
  const MeshOptions options_;
  Log& log_;
  TimerTable& timers_;

  geometry::Lattice lattice_;
  Layout layout_;
  double cap_factor_ = 0; // of h
  std::unique_ptr<delaunay::StarBuilder> builder_;
  std::vector<SweepRecord> history_;
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
