// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/boundary_layout.hpp"

#include "boundary/loop_stretches.hpp"
#include "boundary/rules.hpp"
#include "boundary/site_path.hpp"
#include "core/thread_loop.hpp"
#include "polygon/polygon.hpp"

#include "core/angle.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace trime::boundary {

using geometry::Vec2;

namespace {

// [extent of a loop] No corner is left out farther from its chord: small loops keep their shape.
constexpr double most_of_extent = 0.1;

double extent_of(const geometry::Loop& loop) {
  geometry::Box box;
  for (const geometry::Piece& piece : loop.pieces)
    box.include(piece.start);
  return std::fmax(box.width(), box.height());
}

/// Returns the work of a ragged stretch, in sites of a plain stretch: it grows with the junctions and places that are
/// examined.
std::int64_t work_of_ragged(const LoopMetric& metric, const Stretch& stretch) {
  const auto junctions_before = [&](double t) {
    const bool round = t >= metric.total();
    return metric.first_junction_from(round ? t - metric.total() : t) + (round ? std::ssize(metric.loop().pieces) : 0);
  };
  return 1 + BoundaryRules::work_of_place * (std::lround((stretch.to - stretch.from) / BoundaryRules::place_spacing) +
                                             junctions_before(stretch.to) - junctions_before(stretch.from));
}

/// Sites of a stretch that one thread lays in a row, all of them if they are chosen.
struct Job {
  const Stretch* stretch;
  std::int64_t first, last;
};
constexpr std::int64_t sites_in_a_row = 256;
// The first site already reports an absurd size, before memory or bits run out.
constexpr std::int64_t most_jobs = 1024;                  // of a stretch
constexpr std::int64_t most_work = std::int64_t{1} << 48; // of a stretch

/// Appends the sites of a stretch to a list.
class Layouter {
public:
  Layouter(const LoopMetric& metric, const geometry::Lattice& lattice, double corner_angle,
           const FeatureTolerance& tolerance, std::vector<LoopSite>& sites)
      : metric_(metric), lattice_(lattice), tolerance_(tolerance), corner_angle_(corner_angle), sites_(sites) {}

  /// Sites [first, last) of a stretch. The first is its start; its end is not among them.
  void add_plain(const Stretch& stretch, std::int64_t first, std::int64_t last) {
    if (first == 0)
      add_start(stretch);
    for (std::int64_t j = std::max<std::int64_t>(1, first); j < last; ++j)
      add_site(stretch.from +
               (stretch.to - stretch.from) * (static_cast<double>(j) / static_cast<double>(stretch.intervals)));
  }
  /// All sites of a stretch on which they are chosen.
  void add_ragged(const Stretch& stretch, bool closed) {
    add_start(stretch);
    add_chosen(stretch, closed);
  }

private:
  void add_start(const Stretch& stretch) {
    if (stretch.at == nullptr)
      return add_site(stretch.from);
    sites_.push_back(
        {stretch.from, stretch.at->position, stretch.at->sharp ? SiteKind::sharp_corner : SiteKind::corner});
  }

  void add_site(double t) {
    t = t >= metric_.total() ? t - metric_.total() : t;
    const Vec2 p = metric_.point(t);
    check_size(t, p);
    sites_.push_back({t, lattice_.snap(p), SiteKind::plain});
  }

  void add_chosen(const Stretch& stretch, bool closed) {
    const std::vector<SitePlace> places = places_between(metric_, stretch.from, stretch.to, lattice_, tolerance_);
    const std::vector<LocalIndex> path = shortest_site_path(places, closed);
    for (std::size_t k = 1; k + 1 < path.size(); ++k) {
      const SitePlace& place = places[static_cast<std::size_t>(path[k])];
      check_size(place.t, place.position);
      const bool round = place.t >= metric_.total();
      sites_.push_back({place.junction >= 0 ? metric_.piece_t(static_cast<std::size_t>(place.junction)) // exactly
                        : round             ? place.t - metric_.total()
                                            : place.t,
                        round ? place.position - metric_.loop().winding : place.position,
                        place.junction >= 0
                            ? kind_of_junction(metric_.loop(), static_cast<std::size_t>(place.junction), corner_angle_)
                            : SiteKind::plain});
    }
  }

  void check_size(double t, Vec2 p) const {
    const double least = BoundaryRules::shortest_in_steps * lattice_.step(), h = metric_.size(t);
    if (h < least)
      throw GeometryError(fmt::format("element size on the boundary at {}: expected at least {} (the resolution "
                                      "of the container), found {}; use a larger edge length or fewer points",
                                      Place(p, 0), least, h));
  }

  const LoopMetric& metric_;
  const geometry::Lattice& lattice_;
  const FeatureTolerance& tolerance_;
  double corner_angle_;
  std::vector<LoopSite>& sites_;
};

} // namespace

SiteKind kind_of_junction(const geometry::Loop& loop, std::size_t piece, double corner_angle) {
  if (loop.pieces[piece].wedge > 0)
    return SiteKind::sharp_corner;
  if (loop.turning > 0 && (piece == 0 || piece == loop.turning))
    return SiteKind::corner;
  if (loop.turn_degrees(piece) > BoundaryRules::sharp_turn)
    return SiteKind::sharp_corner;
  const double least_turn = std::fmin(corner_angle, BoundaryRules::always_a_corner);
  return loop.pieces[piece].corner || polygon::is_corner(loop, piece, least_turn) ? SiteKind::corner : SiteKind::plain;
}

struct LoopLayout::Plan {
  Plan(const LoopMetric& metric, const geometry::Lattice& lattice, double corner_angle,
       const FeatureTolerance& tolerance);

  const LoopMetric& metric;
  const geometry::Lattice& lattice;
  double corner_angle;
  FeatureTolerance tolerance;
  LoopStretches stretches;
  std::vector<std::int64_t> work_before; // each stretch, and of all
  bool closed;                           // one stretch, back to its start
};

LoopLayout::Plan::Plan(const LoopMetric& measured, const geometry::Lattice& on, double angle,
                       const FeatureTolerance& uncapped)
    : metric(measured), lattice(on), corner_angle(angle), tolerance(uncapped),
      stretches(cut_into_stretches(metric, corner_angle, tolerance.share)) {
  tolerance.most = most_of_extent * extent_of(metric.loop());
  closed = stretches.list.size() == 1 && !metric.loop().winds();
  work_before.push_back(0);
  for (const Stretch& stretch : stretches.list)
    work_before.push_back(work_before.back() +
                          std::min(most_work, stretch.ragged ? work_of_ragged(metric, stretch) : stretch.intervals));
}

LoopLayout::LoopLayout(const LoopMetric& metric, const geometry::Lattice& lattice, double corner_angle,
                       const FeatureTolerance& tolerance)
    : plan_(std::make_unique<const Plan>(metric, lattice, corner_angle, tolerance)) {}
LoopLayout::LoopLayout(LoopLayout&&) noexcept = default;
LoopLayout::~LoopLayout() = default;

std::int64_t LoopLayout::work() const {
  return plan_->work_before.back();
}

void LoopLayout::make(std::int64_t first, std::int64_t last, std::vector<LoopSite>& sites) const {
  const std::vector<std::int64_t>& before = plan_->work_before;
  std::vector<Job> jobs;
  for (auto k =
           static_cast<std::size_t>(std::upper_bound(before.begin(), before.end() - 1, first) - before.begin() - 1);
       k < plan_->stretches.list.size() && before[k] < last; ++k) {
    const std::int64_t from = std::max(first, before[k]), to = std::min(last, before[k + 1]);
    if (plan_->stretches.list[k].ragged) {
      if (from == before[k])
        jobs.push_back({&plan_->stretches.list[k], 0, 0});
      continue;
    }
    const std::int64_t row = std::max(sites_in_a_row, (to - from) / most_jobs + 1);
    for (std::int64_t begin = from; begin < to; begin += row)
      jobs.push_back({&plan_->stretches.list[k], begin - before[k], std::min(to, begin + row) - before[k]});
  }
  constexpr std::ptrdiff_t few = 4; // jobs that one thread does in a row
  const std::vector<LoopSite> made =
      gather_in_order<LoopSite>(std::ssize(jobs), few, [&](std::ptrdiff_t k, std::vector<LoopSite>& list) {
        Layouter layouter(plan_->metric, plan_->lattice, plan_->corner_angle, plan_->tolerance, list);
        if (const Job& job = jobs[static_cast<std::size_t>(k)]; job.stretch->ragged)
          layouter.add_ragged(*job.stretch, plan_->closed);
        else
          layouter.add_plain(*job.stretch, job.first, job.last);
      });
  sites.insert(sites.end(), made.begin(), made.end());
}

/// Mostly in order, but that the last ones lie behind the start of the loop.
void sort_along(std::span<LoopSite> sites) {
  const auto before = [](const LoopSite& a, const LoopSite& b) { return a.t < b.t; };
  std::rotate(sites.begin(), std::is_sorted_until(sites.begin(), sites.end(), before), sites.end());
  if (!std::is_sorted(sites.begin(), sites.end(), before))
    std::sort(sites.begin(), sites.end(), before);
}

} // namespace trime::boundary
