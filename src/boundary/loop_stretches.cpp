// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/loop_stretches.hpp"

#include "boundary/rules.hpp"
#include "core/angle.hpp"
#include "core/thread_loop.hpp"
#include "polygon/polygon.hpp"

#include <algorithm>
#include <cmath>

namespace trime::boundary {

using geometry::Vec2;

namespace {

/// A vertex of the convex hull: it lies at the end of something.
std::size_t outermost_junction(const geometry::Loop& loop) {
  geometry::Box box;
  for (const geometry::Piece& piece : loop.pieces)
    box.include(piece.start);
  const Vec2 middle = 0.5 * (box.min + box.max);
  std::size_t outermost = 0;
  for (std::size_t i = 1; i < loop.pieces.size(); ++i)
    if (geometry::squared_length(loop.pieces[i].start - middle) >
        geometry::squared_length(loop.pieces[outermost].start - middle))
      outermost = i;
  return outermost;
}

/// Junctions of a loop by what becomes of them.
struct Junctions {
  std::vector<LoopCorner> kept; // for certain
  std::vector<double> others;   // t of those that may be left out: features below the resolution
};

/// An open curve is a loop there and back. Its two sides do not form a wedge at its ends.
LoopCorner corner_at(const LoopMetric& metric, std::size_t piece) {
  const geometry::Loop& loop = metric.loop();
  const bool is_end = loop.turning > 0 && (piece == 0 || piece == loop.turning);
  const double wedge = loop.pieces[piece].wedge;
  const bool sharp = wedge > 0 || (!is_end && loop.turn_degrees(piece) > BoundaryRules::sharp_turn);
  return {metric.piece_t(piece), loop.pieces[piece].start, sharp, wedge, {}, {}};
}

/// A junction that turns by more than the corner angle, or where parts of the shape meet.
struct Turning {
  std::size_t piece;
  double t;
  double turn; // signed, radians
};

std::vector<Turning> find_turnings(const LoopMetric& metric, double corner_angle) {
  const double least = std::fmin(corner_angle, BoundaryRules::always_a_corner);
  std::vector<Turning> turnings;
  for (std::size_t i = 0; i < metric.loop().pieces.size(); ++i)
    if (const double turn = metric.turn(i);
        std::fabs(turn) * (180 / pi) > least || polygon::changes_part(metric.loop(), i))
      turnings.push_back({i, metric.piece_t(i), turn});
  return turnings;
}

/// @brief Which of the junctions stand at a long arm on both sides, or at the two ends of a short way on which the
/// curve turns back between two long arms: the end of a slit. Its sides get sites in pairs only if both corners stay;
/// else they meet in a wedge that takes any number of sites.
std::vector<char> find_clear_corners(const std::vector<Turning>& turnings, double total) {
  const std::size_t n = turnings.size();
  const auto way_ahead = [&](std::size_t k) {
    return k + 1 < n ? turnings[k + 1].t - turnings[k].t : turnings.front().t + total - turnings.back().t;
  };
  std::vector<char> clear(n, 0);
  for (std::size_t k = 0; k < n; ++k) {
    if (way_ahead((k + n - 1) % n) < BoundaryRules::long_arm)
      continue;
    double turn = 0, way = 0;
    for (std::size_t hop = 0; hop < n && way < BoundaryRules::long_arm; ++hop) {
      const std::size_t last = (k + hop) % n;
      turn += turnings[last].turn;
      if (way_ahead(last) >= BoundaryRules::long_arm) {
        if (hop == 0 || std::fabs(turn) >= BoundaryRules::turned_back)
          clear[k] = clear[last] = 1;
        break;
      }
      way += way_ahead(last);
    }
  }
  return clear;
}

Junctions find_junctions(const LoopMetric& metric, double corner_angle, double tolerance) {
  const auto& pieces = metric.loop().pieces;
  const std::vector<Turning> turnings = find_turnings(metric, corner_angle);
  const std::vector<char> clear = find_clear_corners(turnings, metric.total());
  Junctions found;
  std::size_t next = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const bool turns = next < turnings.size() && turnings[next].piece == i;
    if (pieces[i].corner || (turns && (clear[next] || tolerance == 0)))
      found.kept.push_back(corner_at(metric, i));
    else if (turns)
      found.others.push_back(metric.piece_t(i));
    next += turns;
  }
  if (found.kept.empty() && !found.others.empty())
    found.kept.push_back(corner_at(metric, outermost_junction(metric.loop())));
  if (!found.kept.empty())
    std::erase(found.others, found.kept.front().t);
  return found;
}

/// The two neighbours of a corner along the loop, as places on its arms.
struct Arms {
  double ahead_end, behind_end;     // t of the next and the previous corner, unwrapped
  double ahead_limit, behind_limit; // shells go no farther: half-way if the other corner is sharp too
};

Arms arms_of(const std::vector<LoopCorner>& corners, std::size_t k, double total) {
  const std::size_t n = corners.size();
  const LoopCorner &next = corners[(k + 1) % n], &previous = corners[(k + n - 1) % n];
  const double t = corners[k].t;
  Arms arms{};
  arms.ahead_end = k + 1 < n ? next.t : next.t + total;
  arms.behind_end = k > 0 ? previous.t : previous.t - total;
  arms.ahead_limit = next.sharp ? 0.5 * (t + arms.ahead_end) - 0.25 : arms.ahead_end - 0.5;
  arms.behind_limit = previous.sharp ? 0.5 * (t + arms.behind_end) + 0.25 : arms.behind_end + 0.5;
  return arms;
}

/// Sites at equal distances from the corner on both arms, one local size apart, until the arms are that far apart.
void make_shells(const LoopMetric& metric, const Arms& arms, LoopCorner& corner) {
  double radius = 0, ahead = corner.t, behind = corner.t;
  Vec2 ahead_point = corner.position, behind_point = corner.position;
  const double longest = metric.total() + 2; // in local sizes: each turn of the loop covers about one
  for (int shell = 0; shell < longest; ++shell) {
    radius += 0.5 * (metric.size(ahead) + metric.size(behind));
    const auto next_ahead = metric.first_at_radius(ahead, arms.ahead_end, corner.position, radius);
    const auto next_behind = metric.first_at_radius(behind, arms.behind_end, corner.position, radius);
    if (!next_ahead || !next_behind || *next_ahead > arms.ahead_limit || *next_behind < arms.behind_limit)
      return;
    corner.ahead.push_back(ahead = *next_ahead);
    corner.behind.push_back(behind = *next_behind);
    ahead_point = metric.point(ahead);
    behind_point = metric.point(behind);
    const double h = std::fmin(metric.size(ahead), metric.size(behind));
    if (geometry::length(ahead_point - behind_point) >= h)
      return;
  }
}

/// Sites at equal distances from a node of curves, one local size apart, until the two curves with the smallest angle
/// are that far apart. All curves at the node get the same distances.
void make_wedge_shells(const LoopMetric& metric, const Arms& arms, LoopCorner& corner) {
  const double h = metric.size(corner.t), gap = 2 * sin_cos(0.5 * corner.wedge).sin;
  const int shells = static_cast<int>(std::ceil(std::fmin(1 / gap, BoundaryRules::most_shells)));
  double ahead = corner.t, behind = corner.t;
  for (int shell = 1; shell <= shells; ++shell) {
    const auto next = metric.first_at_radius(ahead, arms.ahead_end, corner.position, shell * h);
    if (!next || *next > arms.ahead_limit)
      break;
    corner.ahead.push_back(ahead = *next);
  }
  for (int shell = 1; shell <= shells; ++shell) {
    const auto next = metric.first_at_radius(behind, arms.behind_end, corner.position, shell * h);
    if (!next || *next < arms.behind_limit)
      break;
    corner.behind.push_back(behind = *next);
  }
}

long intervals_of(const LoopMetric& metric, double from, double to) {
  const double by_turn = std::ceil(std::fabs(metric.summarize(from, to, {}, {}).turn) / BoundaryRules::largest_turn);
  return std::max({1L, std::lround(to - from), std::lround(by_turn)});
}

std::vector<Stretch> stretches_of(const LoopMetric& metric, const Junctions& junctions) {
  const std::vector<LoopCorner>& corners = junctions.kept;
  std::vector<Stretch> stretches;
  const auto ragged = [&](double from, double to) {
    const auto has = [&](double low, double high) {
      const auto first = std::upper_bound(junctions.others.begin(), junctions.others.end(), low);
      return first != junctions.others.end() && *first < high;
    };
    return has(from, to) || has(from - metric.total(), to - metric.total());
  };
  if (corners.empty())
    return {{0, metric.total(), std::max(3L, intervals_of(metric, 0, metric.total())), false, nullptr}};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const bool last = k + 1 == corners.size();
    const LoopCorner &corner = corners[k], &next = corners[last ? 0 : k + 1];
    double from = corner.t;
    const auto add = [&](double to, bool shell) {
      const bool chosen = !shell && ragged(from, to);
      stretches.push_back({from, to, shell || chosen ? 1 : 0, chosen, from == corner.t ? &corner : nullptr});
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
  thread_loop(std::ssize(stretches), 16, [&](std::ptrdiff_t k, int) {
    Stretch& stretch = stretches[static_cast<std::size_t>(k)];
    if (stretch.intervals == 0)
      stretch.intervals = intervals_of(metric, stretch.from, stretch.to);
  });
  return stretches;
}

/// At least 3 sites: the stretches with the longest intervals get more.
void ensure_polygon(std::vector<Stretch>& stretches) {
  long sites = 0;
  for (const Stretch& stretch : stretches)
    sites += stretch.ragged ? 3 : stretch.intervals;
  for (; sites < 3; ++sites) {
    const auto length = [](const Stretch& s) { return (s.to - s.from) / static_cast<double>(s.intervals); };
    ++std::max_element(stretches.begin(), stretches.end(), [&](const Stretch& a, const Stretch& b) {
        return length(a) < length(b);
      })->intervals;
  }
}

} // namespace

LoopStretches cut_into_stretches(const LoopMetric& metric, double corner_angle, double tolerance) {
  Junctions junctions = find_junctions(metric, corner_angle, tolerance);
  std::vector<LoopCorner>& corners = junctions.kept;
  thread_loop(std::ssize(corners), 16, [&](std::ptrdiff_t item, int) {
    const auto k = static_cast<std::size_t>(item);
    if (corners[k].wedge > 0)
      make_wedge_shells(metric, arms_of(corners, k, metric.total()), corners[k]);
    else if (corners[k].sharp)
      make_shells(metric, arms_of(corners, k, metric.total()), corners[k]);
  });
  LoopStretches cut;
  cut.list = stretches_of(metric, junctions);
  ensure_polygon(cut.list);
  cut.corners = std::move(junctions.kept);
  return cut;
}

} // namespace trime::boundary
