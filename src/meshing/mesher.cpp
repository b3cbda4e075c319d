// SPDX-License-Identifier: BSD-3-Clause
#include "trime/meshing/mesher.hpp"

#include "meshing/boundary_treatment.hpp"
#include "meshing/extraction.hpp"
#include "meshing/site_state.hpp"
#include "meshing/stopping.hpp"
#include "trime/comm/agree.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/meshing/boundary_guard.hpp"
#include "trime/meshing/boundary_sites.hpp"
#include "trime/meshing/start.hpp"
#include "trime/meshing/update_rule.hpp"

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

constexpr double row_height = 0.8660254037844386;
constexpr double cap_in_sizes = 2.5;  // circumradius that counts, in h: a relaxed mesh has 0.6, a start up to 1.5
constexpr GlobalId few_points = 2000; // below, the cap is the whole container
constexpr double default_tolerance = 0.04;
constexpr int settle_rounds = 12, settle_pushes = 8;
constexpr int spacing_rounds = 12;

/// Edge length of n nearly equilateral triangles' vertices on area A inside perimeter P: from V = (T + B)/2 + 1 with
/// T = A / (sqrt(3)/4 h^2) and B = P/h.
double estimated_size(double area, double perimeter, double n) {
  const double a = 2 * area / std::sqrt(3.0), b = perimeter / 2;
  return (b + std::sqrt(b * b + 4 * a * n)) / (2 * n);
}

} // namespace

class Mesher::Implementation {
public:
  Implementation(const comm::Communicator& comm, const geometry::Boundary& boundary, const sizing::SizeField& size,
                 const MeshOptions& options, Log& log, TimerTable& timers)
      : comm_(comm), boundary_(boundary), relative_size_(size), options_(options), log_(log), timers_(timers),
        lattice_(options.container) {}

  MeshResult run() {
    lay_boundary();
    place_sites();
    relax();
    settle();
    complete_stars();
    return extract();
  }

private:
  // --- set-up -------------------------------------------------------------------------------------------------------

  /// Finds the size of the triangles and puts the sites on the boundary.
  void lay_boundary() {
    const auto time = timers_.scope("boundary");
    comm::run_agreed(comm_, [&] {
      const double n = options_.points ? static_cast<double>(*options_.points) : 0;
      set_size(options_.edge_length ? *options_.edge_length
                                    : estimated_size(boundary_.area, boundary_.length(), std::max(3.0, n)));
      if (options_.points && *options_.points < static_cast<GlobalId>(boundary_sites_.sites.size()))
        throw ConfigError(
            fmt::format("points = {} are too few: the boundary alone needs {} (each corner, and each place "
                        "where the boundary comes near itself, takes its own); ask for more points",
                        *options_.points, boundary_sites_.sites.size()));
    });
    log_.info("boundary: {} loops, {} sites, {} corners, h = {:.6g}", boundary_.loops.size(),
              boundary_sites_.sites.size(), boundary_sites_.corners, reference_size_);
  }

  void set_size(double h) {
    reference_size_ = h;
    size_ = std::make_unique<sizing::ScaledSize>(relative_size_, h);
    boundary_sites_ = make_boundary_sites(boundary_, *size_, lattice_, options_.corner_angle);
    guard_ = std::make_unique<BoundaryGuard>(boundary_sites_, lattice_);
  }

  void place_sites() {
    const auto time = timers_.scope("start");
    mesh::GridOptions grid_options{options_.cells_x, options_.cells_y, reference_size_};
    state_ = std::make_unique<SiteState>(comm_, options_.container, grid_options);
    const mesh::TileGrid& grid = state_->grid();
    const decomposition::Partition even(grid.tile_count(), comm_.size());
    const TileRange mine{grid, even.first_tile(comm_.rank()), even.last_tile(comm_.rank())};
    std::vector<mesh::Site> sites = inner_sites(mine);
    for (std::size_t b = 0; b < boundary_sites_.sites.size(); ++b) {
      const LocalIndex tile = grid.place(boundary_sites_.sites[b].position).tile;
      if (tile >= mine.first && tile < mine.last)
        sites.push_back({boundary_sites_.sites[b].position, static_cast<std::int32_t>(b)});
    }
    state_->distribute(std::move(sites));
    const GlobalId placed = comm_.sum(std::int64_t{state_->points().owned()});
    make_builder(placed);
    log_.info("start: {} points in {} tiles ({} x {} cells)", placed, grid.tile_count(), grid.cells_x(),
              grid.cells_y());
  }

  std::vector<mesh::Site> inner_sites(const TileRange& tiles) {
    const bool lattice_start =
        options_.start == Start::lattice || (options_.start == Start::automatic && relative_size_.is_uniform());
    const GlobalId on_boundary = static_cast<GlobalId>(boundary_sites_.sites.size());
    if (lattice_start) {
      const LatticeStart start(boundary_, *guard_, lattice_);
      return start.sites(tiles, options_.points ? fitting_spacing(start, tiles, *options_.points - on_boundary)
                                                : reference_size_);
    }
    const double n = options_.points ? static_cast<double>(*options_.points - on_boundary)
                                     : boundary_.area / (row_height * reference_size_ * reference_size_) -
                                           0.5 * static_cast<double>(on_boundary);
    return hilbert_start(comm_, tiles, *guard_, *size_, lattice_, std::max<std::int64_t>(0, std::llround(n)),
                         options_.seed);
  }

  /// @brief The smallest spacing found whose lattice has at most `wanted` sites. The count falls like the inverse
  /// square of the spacing, in jumps where whole rows go: secant steps inside a bracket. All ranks take the same steps.
  double fitting_spacing(const LatticeStart& start, const TileRange& tiles, GlobalId wanted) {
    const double none = 4 * (options_.container.width() + options_.container.height()); // no site fits at all
    double low = 0, high = none, spacing = reference_size_;
    GlobalId best = 0;
    for (int round = 0; round < spacing_rounds && wanted - best > wanted / 5000; ++round) {
      const GlobalId count = comm_.sum(start.count(tiles, spacing));
      if (count > wanted) {
        low = spacing;
      } else if (count >= best) {
        high = spacing;
        best = count;
      }
      const double guess =
          spacing * std::sqrt((static_cast<double>(count) + 0.5) / (static_cast<double>(wanted) + 0.25));
      spacing = guess > low && guess < high ? guess : 0.5 * (low + std::min(high, 2 * low + reference_size_));
    }
    return high;
  }

  void make_builder(GlobalId points) {
    const double largest = std::max(options_.container.width(), options_.container.height());
    cap_ = points < few_points ? largest : std::min(largest, cap_in_sizes * reference_size_);
    builder_ = std::make_unique<delaunay::StarBuilder>(lattice_, cap_);
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
      moved = move_by_rule(*state_, rule, context());
    }
  }

  delaunay::StarPass stars(Wanted wanted) {
    const auto time = timers_.scope("stars");
    return state_->compute_stars(*builder_, wanted);
  }

  MoveContext context() const { return {*guard_, *size_, lattice_}; }

  /// One packed reduction: quality, sums for the rule, and what the last move did.
  SweepSums record_sweep(const delaunay::StarPass& pass, const MoveCounts& moved) {
    const auto time = timers_.scope("measure");
    SweepSums sums = measure({state_->points(), state_->stars(), *size_}, reference_size_);
    const auto l = sums.squared_length_ratio.split(), s = sums.squared_size_ratio.split(),
               a = sums.excess_alpha.split();
    std::array<std::int64_t, 12> packed{l.low,        l.high,       s.low,          s.high,
                                        a.low,        a.high,       sums.triangles, state_->points().owned(),
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
    const std::int64_t inner = record.points - static_cast<std::int64_t>(boundary_sites_.sites.size());
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
      const MoveCounts counts = settle_round(*state_, context(), round >= settle_pushes);
      if (comm_.sum(counts.pushed + counts.deleted) == 0)
        return;
    }
  }

  // --- the mesh -----------------------------------------------------------------------------------------------------

  ExtractionContext extraction() const { return {*state_, boundary_sites_, *size_, lattice_, *builder_}; }

  /// Stars of all sites. Where a fan is not closed the cap was too low (a void): it is doubled, up to the container.
  void complete_stars() {
    const double largest = std::max(options_.container.width(), options_.container.height());
    stars(Wanted::all_sites);
    while (comm_.sum(count_incomplete_fans(extraction())) > 0 && cap_ < largest) { // at most log2(largest / h) times
      cap_ = std::min(largest, 2 * cap_);
      builder_ = std::make_unique<delaunay::StarBuilder>(lattice_, cap_);
      for (LocalIndex i = 0; i < state_->points().owned(); ++i)
        state_->stars().set_certain(i, inside_fan(extraction(), i).closed && inside_fan(extraction(), i).complete);
      stars(Wanted::all_sites);
    }
  }

  MeshResult extract() {
    const auto time = timers_.scope("extract");
    state_->release_work_space();
    const ExtractionContext context = extraction();
    const decomposition::Numbering numbering =
        decomposition::canonical_numbering(comm_, state_->points(), state_->halo());
    MeshResult result;
    result.components = boundary_.components();
    result.holes = boundary_.holes();
    result.checks = certify(context, numbering, {result.components, result.holes});
    result.quality = measure_quality(context, numbering);
    result.mesh = extract_mesh(context, numbering);
    result.history = std::move(history_);
    result.stop_reason = stop_reason_;
    result.requested_points = options_.points.value_or(0);
    result.edge_length = reference_size_;
    result.corners = boundary_sites_.corners;
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
  double reference_size_ = 1; // factor of the relative size: for a uniform field, h itself
  std::unique_ptr<sizing::ScaledSize> size_;
  BoundarySites boundary_sites_;
  std::unique_ptr<BoundaryGuard> guard_;
  std::unique_ptr<SiteState> state_;
  double cap_ = 0;
  std::unique_ptr<delaunay::StarBuilder> builder_;
  std::vector<SweepRecord> history_;
  StopReason stop_reason_ = StopReason::sweep_cap;
};

Mesher::Mesher(const comm::Communicator& comm, const geometry::Boundary& boundary, const sizing::SizeField& size,
               const MeshOptions& options, Log& log, TimerTable& timers)
    : implementation_(std::make_unique<Implementation>(comm, boundary, size, options, log, timers)) {}
Mesher::~Mesher() = default;

MeshResult Mesher::run() {
  return implementation_->run();
}

} // namespace trime::meshing
