// SPDX-License-Identifier: BSD-3-Clause
// Quality of the finished mesh, from the certified stars: every triangle and every edge once, over all ranks.
#include "meshing/extraction.hpp"

#include "trime/comm/agree.hpp"
#include "trime/core/thread_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trime::meshing {
namespace {

using geometry::Vec2;

std::size_t at(LocalIndex i) {
  return static_cast<std::size_t>(i);
}

/// Mergeable: sums are integers inside, the worst triangle is the lexicographically first of equals.
struct QualitySums {
  mesh::RatioStatistics alpha, beta;
  double min_angle = 60;
  double worst_alpha = 0;
  Vec2 worst_place;
  FixedSum ratio, squared_ratio; ///< L / h over edges
  std::int64_t edges = 0;

  void add_triangle(Vec2 p, Vec2 q, Vec2 r, const geometry::Periods& periods) {
    const double a = mesh::aspect_ratio(p, q, r);
    alpha.add(a);
    beta.add(mesh::edge_ratio(p, q, r));
    min_angle = std::min(min_angle, mesh::min_angle_degrees(p, q, r));
    note_worst(a, periods.wrap((1.0 / 3) * (p + q + r)));
  }
  void note_worst(double a, Vec2 place) {
    if (a > worst_alpha || (a == worst_alpha && geometry::lexicographically_less(place, worst_place))) {
      worst_alpha = a;
      worst_place = place;
    }
  }
  void add_edge(double length_over_size) {
    const double capped = std::min(500.0, length_over_size); // keeps the square within the reach of FixedSum
    ratio.add(capped);
    squared_ratio.add(capped * capped);
    ++edges;
  }
  void add(const QualitySums& other) {
    alpha.merge(other.alpha);
    beta.merge(other.beta);
    min_angle = std::min(min_angle, other.min_angle);
    note_worst(other.worst_alpha, other.worst_place);
    ratio.add(other.ratio);
    squared_ratio.add(other.squared_ratio);
    edges += other.edges;
  }
};

void measure_site(const ExtractionContext& context, const std::vector<GlobalId>& ids, LocalIndex i, QualitySums& sums) {
  const mesh::BinnedPoints& points = context.state.points();
  const geometry::Periods& periods = points.grid().periods();
  const Fan fan = inside_fan(context, i);
  const Vec2 p = points.position(i);
  for (std::size_t k = 0; k < fan.triangles; ++k) {
    const LocalIndex a = fan.neighbour(k), b = fan.neighbour(k + 1);
    if (ids[at(i)] < ids[at(a)] && ids[at(i)] < ids[at(b)])
      sums.add_triangle(p, points.position(a), points.position(b), periods);
  }
  for (std::size_t k = 0; fan.complete && k < fan.edges(); ++k) {
    const LocalIndex j = fan.neighbour(k);
    const Vec2 q = points.position(j);
    if (ids[at(i)] < ids[at(j)])
      sums.add_edge(geometry::length(q - p) / sizing::checked_size(context.size, periods.wrap(0.5 * (p + q))));
  }
}

/// The sums of all ranks, on every rank. Collective.
void reduce(const comm::Communicator& comm, QualitySums& sums) {
  for (mesh::RatioStatistics* statistics : {&sums.alpha, &sums.beta}) {
    std::vector<std::int64_t> packed = statistics->pack();
    comm.sum(packed);
    statistics->unpack(packed, comm.max(statistics->max()));
  }
  const auto ratio = sums.ratio.split(), squared = sums.squared_ratio.split();
  std::array<std::int64_t, 5> packed{ratio.low, ratio.high, squared.low, squared.high, sums.edges};
  comm.sum(packed);
  sums.ratio = FixedSum::join({packed[0], packed[1]});
  sums.squared_ratio = FixedSum::join({packed[2], packed[3]});
  sums.edges = packed[4];
  sums.min_angle = comm.min(sums.min_angle);
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  const double worst = comm.max(sums.worst_alpha);
  const bool here = sums.worst_alpha == worst;
  const double x = comm.min(here ? sums.worst_place.x : nowhere);
  const double y = comm.min(here && sums.worst_place.x == x ? sums.worst_place.y : nowhere);
  sums.worst_alpha = worst;
  sums.worst_place = {x, y};
}

} // namespace

mesh::QualitySummary measure_quality(const ExtractionContext& context, const decomposition::Numbering& numbering) {
  std::vector<QualitySums> of_thread(static_cast<std::size_t>(std::max(1, thread_count())));
  comm::run_agreed(context.state.comm(), [&] { // the size field is the user's
    thread_loop(context.state.points().owned(), 4096, [&](std::ptrdiff_t i, int thread) {
      measure_site(context, numbering.global_ids, static_cast<LocalIndex>(i),
                   of_thread[static_cast<std::size_t>(thread)]);
    });
  });
  QualitySums all;
  for (const QualitySums& sums : of_thread)
    all.add(sums);
  reduce(context.state.comm(), all);

  mesh::QualitySummary quality;
  quality.alpha = all.alpha.summary();
  quality.beta = all.beta.summary();
  quality.alpha_histogram = all.alpha.histogram();
  quality.min_angle_degrees = all.min_angle;
  quality.worst_place = all.worst_place;
  const double edges = static_cast<double>(std::max<std::int64_t>(1, all.edges));
  const double mean = all.ratio.value() / edges, square = all.squared_ratio.value() / edges;
  quality.size_mean = mean;
  quality.size_std = mean > 0 ? std::sqrt(std::max(0.0, square / (mean * mean) - 1)) : 0;
  return quality;
}

} // namespace trime::meshing
