// SPDX-License-Identifier: BSD-3-Clause
#include "boundary_layout.hpp"

#include "trime/core/angle.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace trime::meshing {

using geometry::Vec2;

namespace {

constexpr double always_a_corner = 120;           // degrees; no chord can stand for such a turn
constexpr double sharp_turn = 120;                // degrees; the arms then meet at less than 60
constexpr double largest_turn = pi / 3 + 1e-9;    // of the curve within one interval
constexpr double smallest_size_in_steps = 0x1p11; // of the lattice, for h

struct Corner {
  double t;
  Vec2 position;
  bool sharp;
  std::vector<double> ahead, behind; // t of the shells on its two arms, from the corner outward; unwrapped
};

std::vector<Corner> find_corners(const LoopMetric& metric, double corner_angle) {
  std::vector<Corner> corners;
  const auto& pieces = metric.loop().pieces;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double turn = metric.loop().turn_degrees(i);
    if (turn > std::fmin(corner_angle, always_a_corner) || pieces[i].corner)
      corners.push_back({metric.piece_t(i), pieces[i].start, turn > sharp_turn, {}, {}});
  }
  return corners;
}

/// The two neighbours of a corner along the loop, as places on its arms.
struct Arms {
  double ahead_end, behind_end;     // t of the next and the previous corner, unwrapped
  double ahead_limit, behind_limit; // shells go no farther: half-way if the other corner is sharp too
};

Arms arms_of(const std::vector<Corner>& corners, std::size_t k, double total) {
  const std::size_t n = corners.size();
  const Corner &next = corners[(k + 1) % n], &previous = corners[(k + n - 1) % n];
  const double t = corners[k].t;
  Arms arms{};
  arms.ahead_end = k + 1 < n ? next.t : next.t + total;
  arms.behind_end = k > 0 ? previous.t : previous.t - total;
  arms.ahead_limit = next.sharp ? 0.5 * (t + arms.ahead_end) - 0.25 : arms.ahead_end - 0.5;
  arms.behind_limit = previous.sharp ? 0.5 * (t + arms.behind_end) + 0.25 : arms.behind_end + 0.5;
  return arms;
}

/// Sites at equal distances from the corner on both arms, one local size apart, until the arms are that far apart.
void make_shells(const LoopMetric& metric, const Arms& arms, Corner& corner) {
  double radius = 0, ahead = corner.t, behind = corner.t;
  Vec2 ahead_point = corner.position, behind_point = corner.position;
  const double longest = metric.total() + 2; // in local sizes: each turn of the loop covers about one
  for (int shell = 0; shell < longest; ++shell) {
    radius += 0.5 * (metric.size(ahead_point) + metric.size(behind_point));
    const auto next_ahead = metric.first_at_radius(ahead, arms.ahead_end, corner.position, radius);
    const auto next_behind = metric.first_at_radius(behind, arms.behind_end, corner.position, radius);
    if (!next_ahead || !next_behind || *next_ahead > arms.ahead_limit || *next_behind < arms.behind_limit)
      return;
    corner.ahead.push_back(ahead = *next_ahead);
    corner.behind.push_back(behind = *next_behind);
    ahead_point = metric.point(ahead);
    behind_point = metric.point(behind);
    const double h = std::fmin(metric.size(ahead_point), metric.size(behind_point));
    if (geometry::length(ahead_point - behind_point) >= h)
      return;
  }
}

/// A stretch between two fixed places that is divided at equal quantiles.
struct Stretch {
  double from, to;
  long intervals;
};

long intervals_of(const LoopMetric& metric, double from, double to) {
  const double by_turn = std::ceil(std::fabs(metric.summarize(from, to, {}, {}).turn) / largest_turn);
  return std::max({1L, std::lround(to - from), std::lround(by_turn)});
}

std::vector<Stretch> stretches_of(const LoopMetric& metric, const std::vector<Corner>& corners) {
  std::vector<Stretch> stretches;
  if (corners.empty())
    return {{0, metric.total(), std::max(3L, intervals_of(metric, 0, metric.total()))}};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const bool last = k + 1 == corners.size();
    const Corner &corner = corners[k], &next = corners[last ? 0 : k + 1];
    double from = corner.t;
    const auto add = [&](double to, bool shell) {
      stretches.push_back({from, to, shell ? 1 : intervals_of(metric, from, to)});
      from = to;
    };
    const double shift = last ? metric.total() : 0;
    for (const double t : corner.ahead)
      add(t, true);
    const double end = next.t + shift;
    // The shells of `next` behind it are unwrapped relative to its own t.
    add(next.behind.empty() ? end : next.behind.back() + shift, false);
    for (std::size_t j = next.behind.size(); j > 0; --j)
      add(j > 1 ? next.behind[j - 2] + shift : end, true);
  }
  return stretches;
}

/// At least 3 sites: the stretches with the longest intervals get more.
void ensure_polygon(std::vector<Stretch>& stretches) {
  long sites = 0;
  for (const Stretch& stretch : stretches)
    sites += stretch.intervals;
  for (; sites < 3; ++sites) {
    const auto length = [](const Stretch& s) { return (s.to - s.from) / static_cast<double>(s.intervals); };
    ++std::max_element(stretches.begin(), stretches.end(), [&](const Stretch& a, const Stretch& b) {
        return length(a) < length(b);
      })->intervals;
  }
}

} // namespace

std::vector<LoopSite> lay_out_loop(const LoopMetric& metric, const geometry::Lattice& lattice, double corner_angle) {
  std::vector<Corner> corners = find_corners(metric, corner_angle);
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (corners[k].sharp)
      make_shells(metric, arms_of(corners, k, metric.total()), corners[k]);
  std::vector<Stretch> stretches = stretches_of(metric, corners);
  ensure_polygon(stretches);
  std::vector<LoopSite> sites;
  std::size_t corner = 0;
  for (const Stretch& stretch : stretches)
    for (long j = 0; j < stretch.intervals; ++j) {
      double t = stretch.from +
                 (stretch.to - stretch.from) * (static_cast<double>(j) / static_cast<double>(stretch.intervals));
      if (j == 0 && corner < corners.size() && t == corners[corner].t) {
        sites.push_back(
            {t, corners[corner].position, corners[corner].sharp ? SiteKind::sharp_corner : SiteKind::corner});
        ++corner;
        continue;
      }
      t = t >= metric.total() ? t - metric.total() : t;
      const Vec2 p = metric.point(t);
      if (metric.size(p) < smallest_size_in_steps * lattice.step())
        throw GeometryError(
            fmt::format("element size on the boundary at ({}, {}): expected at least {} (the resolution "
                        "of the container), found {}; use a larger edge length or fewer points",
                        p.x, p.y, smallest_size_in_steps * lattice.step(), metric.size(p)));
      sites.push_back({t, lattice.snap(p), SiteKind::plain});
    }
  std::sort(sites.begin(), sites.end(), [](const LoopSite& a, const LoopSite& b) { return a.t < b.t; });
  return sites;
}

} // namespace trime::meshing
