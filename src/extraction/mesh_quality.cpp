// SPDX-License-Identifier: BSD-3-Clause
#include "extraction/mesh_quality.hpp"

#include "core/angle.hpp"
#include "core/elementary.hpp"
#include "extraction/rules.hpp"
#include "polygon/both_sides.hpp"
#include "sizing/size_blocks.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

namespace trime::extraction {
namespace {

using geometry::Vec2;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double most_over_size = 500; // keeps the square within the reach of FixedSum

using mesh::RatioStatistics;
using mesh::RatioTotals;

/// The values that ranks sum first: all except the bins that hold the medians.
struct FirstSums {
  std::array<std::int64_t, RatioStatistics::packed_size> alpha, beta;
  FixedSum::Parts ratio, squared_ratio;
  std::int64_t edges;
  BadTriangles::Counts bad;
  GrowthCounts growth;
};
constexpr std::size_t first_words = sizeof(FirstSums) / sizeof(std::int64_t);

constexpr std::size_t extreme_values = 4; // of QualitySums

/// The medians, and the places of the extreme values: what can only be asked for once the sums are known.
struct Detail {
  mesh::RatioSummary alpha, beta;
  std::array<Vec2, extreme_values> places;
};

/// The totals of all ranks that look_closer() needs.
struct Totals {
  RatioTotals alpha, beta;
  std::array<double, extreme_values> extremes;
};

/// Collective.
Detail look_closer(const comm::Communicator& comm, const QualitySums& sums, const Totals& of_all) {
  const RatioTotals &alpha = of_all.alpha, &beta = of_all.beta;
  constexpr std::size_t n = RatioStatistics::run_length;
  std::array<std::int64_t, 2 * n> bins;
  std::ranges::copy(sums.alpha.bins(alpha.median_run()), bins.begin());
  std::ranges::copy(sums.beta.bins(beta.median_run()), bins.begin() + n);
  // The first places in lexicographic order of those with the same value.
  const std::array<const Extreme*, extreme_values> mine = sums.extremes();
  std::array<double, extreme_values> x, y;
  for (std::size_t k = 0; k < extreme_values; ++k)
    x[k] = mine[k]->value == of_all.extremes[k] ? -mine[k]->place.x : -infinity;
  comm.sum_and_max(bins, x);
  for (std::size_t k = 0; k < extreme_values; ++k)
    y[k] = mine[k]->value == of_all.extremes[k] && mine[k]->place.x == -x[k] ? mine[k]->place.y : infinity;
  comm.min(y);
  Detail detail{alpha.summary(std::span(bins).first(n)), beta.summary(std::span(bins).last(n)), {}};
  for (std::size_t k = 0; k < extreme_values; ++k)
    detail.places[k] = {-x[k], y[k]};
  return detail;
}

using geometry::lexicographically_less;
using mesh::BadTriangle;

bool is_worse(const BadTriangle& a, const BadTriangle& b) {
  return a.alpha != b.alpha ? a.alpha > b.alpha : lexicographically_less(a.place, b.place);
}

/// Inside angle of the polygon of chords at a site, in degrees.
double inside_angle(const polygon::BoundarySites& boundary, LocalIndex k) {
  const geometry::Segment out = boundary.chord(k), in = boundary.chord(boundary.sites[at(k)].previous);
  const Vec2 ahead = out.b - out.a, back = in.a - in.b;
  const double angle = angle_of(cross(ahead, back), dot(ahead, back)) * degrees_per_radian;
  return angle < 0 ? angle + 360 : angle;
}

} // namespace

void SharpCorners::add_if_sharp(const Corner& corner) {
  if (!(corner.degrees < ExtractionRules::sharp_degrees))
    return;
  corners_.push_back(corner);
  sharpest_ = std::fmin(sharpest_, corner.degrees);
}

void SharpCorners::sort() {
  std::sort(corners_.begin(), corners_.end(),
            [](const Corner& a, const Corner& b) { return lexicographically_less(a.place, b.place); });
}

SharpCorners::SharpCorners(const polygon::BoundarySites& given, const geometry::Periods& periods) : periods_(periods) {
  const polygon::BoundarySites sides = given.inner.empty() ? polygon::BoundarySites() : polygon::with_both_sides(given);
  const polygon::BoundarySites& boundary = given.inner.empty() ? given : sides;
  for (LocalIndex k = 0; k < std::ssize(boundary.sites); ++k)
    if (boundary.sites[at(k)].corner) {
      const geometry::Segment out = boundary.chord(k), in = boundary.chord(boundary.sites[at(k)].previous);
      add_if_sharp(
          {periods.wrap(boundary.sites[at(k)].position), inside_angle(boundary, k), out.b - out.a, in.a - in.b});
    }
  sort();
}

SharpCorners::SharpCorners(std::span<const Corner> corners, const geometry::Periods& periods) : periods_(periods) {
  for (const Corner& corner : corners)
    add_if_sharp(corner);
  sort();
}

namespace {

/// Returns the distance from its tip up to which a wedge of this angle is narrower than a length.
double depth_of_wedge(double degrees, double width) {
  return width / (degrees / degrees_per_radian);
}

/// Does the vertex lie between the arms of the corner, where they are less than `longest` apart? No good triangle has
/// an edge of that length there.
bool is_in_wedge(const SharpCorners::Corner& corner, Vec2 from_tip, double longest) {
  const double depth = length(from_tip);
  const double slack = ExtractionRules::wedge_slack * depth * (corner.degrees / degrees_per_radian);
  return depth <= depth_of_wedge(corner.degrees, longest) && dot(corner.ahead + corner.back, from_tip) > 0 &&
         cross(corner.ahead, from_tip) >= -slack * length(corner.ahead) &&
         cross(from_tip, corner.back) >= -slack * length(corner.back);
}

} // namespace

SharpCorners::Corner SharpCorners::near(Vec2 p, Vec2 q, Vec2 r) const {
  const double longest =
      std::sqrt(std::fmax(squared_length(q - p), std::fmax(squared_length(r - q), squared_length(p - r))));
  const double edges = ExtractionRules::corner_reach * longest;
  const double reach = std::fmax(edges, depth_of_wedge(sharpest_, longest));
  Corner best;
  double least = reach * reach;
  for (const Vec2 vertex : {p, q, r})
    for (const double shift : {-periods_.x, 0.0, periods_.x}) { // a corner across the border
      const double x = vertex.x + shift;
      auto corner = std::lower_bound(corners_.begin(), corners_.end(), x - reach,
                                     [](const Corner& c, double low) { return c.place.x < low; });
      for (; corner != corners_.end() && corner->place.x <= x + reach; ++corner) {
        const Vec2 from_tip = vertex - periods_.nearest_image(corner->place, vertex);
        const double d = squared_length(from_tip);
        if (d > edges * edges && !is_in_wedge(*corner, from_tip, longest))
          continue;
        if (d < least || (d == least && (best.degrees == 0 || lexicographically_less(corner->place, best.place)))) {
          least = d;
          best = *corner;
        }
      }
      if (periods_.x == 0)
        break;
    }
  return best;
}

void BadTriangles::add(const BadTriangle& triangle) {
  const bool is_bad = triangle.alpha > ExtractionRules::listed_alpha, is_excused = triangle.corner_degrees > 0;
  counts_.bad += is_bad;
  counts_.obtuse += triangle.obtuse;
  counts_.obtuse_at_corners += is_excused ? triangle.obtuse : 0;
  if (is_bad && !is_excused && (away_.alpha == 0 || is_worse(triangle, away_)))
    away_ = triangle;
  if (worst_.size() == ExtractionRules::most_listed) {
    if (!is_worse(triangle, worst_.back()))
      return;
    worst_.pop_back();
  }
  worst_.insert(std::upper_bound(worst_.begin(), worst_.end(), triangle, is_worse), triangle);
}

void BadTriangles::merge(const BadTriangles& other) {
  const Counts sums{counts_.bad + other.counts_.bad, counts_.obtuse + other.counts_.obtuse,
                    counts_.obtuse_at_corners + other.counts_.obtuse_at_corners};
  for (const BadTriangle& triangle : other.worst_)
    add(triangle);
  if (other.away_.alpha > 0 && (away_.alpha == 0 || is_worse(other.away_, away_)))
    away_ = other.away_;
  counts_ = sums;
}

void BadTriangles::gather(const comm::Communicator& comm, const Counts& counts) {
  if (counts.bad == 0 && counts.obtuse == 0)
    return;
  std::vector<BadTriangle> sent = worst_;
  const bool is_listed = std::ranges::any_of(
      worst_, [&](const BadTriangle& one) { return one.alpha == away_.alpha && one.place == away_.place; });
  if (away_.alpha > 0 && !is_listed)
    sent.push_back(away_);
  *this = {};
  for (const BadTriangle& triangle : comm::from_bytes<BadTriangle>(comm.all_gather(comm::to_bytes<BadTriangle>(sent))))
    add(triangle);
  counts_ = counts;
}

void BadTriangles::tell(mesh::QualitySummary& quality) const {
  quality.bad_triangles = counts_.bad;
  quality.obtuse_triangles = counts_.obtuse;
  quality.obtuse_at_corners = counts_.obtuse_at_corners;
  quality.worst_triangles = worst_;
  quality.worst_away = away_;
}

double GrowthCounts::quantile(double share) const {
  std::int64_t all = 0, below = 0;
  for (const std::int64_t count : counts)
    all += count;
  std::size_t k = 0;
  for (; k < bins && static_cast<double>(below += counts[k]) < share * static_cast<double>(all); ++k)
    ;
  return all == counts[0] ? 0 : width * static_cast<double>(k + 1);
}

void QualitySums::add(const QualitySums& other) {
  alpha.merge(other.alpha);
  beta.merge(other.beta);
  least_sine = std::min(least_sine, other.least_sine);
  worst.note(other.worst.value, other.worst.place);
  shortest.note(other.shortest.value, other.shortest.place);
  growth.note(other.growth.value, other.growth.place);
  longest.note(other.longest.value, other.longest.place);
  for (std::size_t k = 0; k < GrowthCounts::bins; ++k)
    growth_counts.counts[k] += other.growth_counts.counts[k];
  ratio.add(other.ratio);
  squared_ratio.add(other.squared_ratio);
  edges += other.edges;
  bad.merge(other.bad);
}

void QualityMeter::add_triangle(Vec2 p, Vec2 q, Vec2 r) {
  p_.set(triangles_, p);
  q_.set(triangles_, q);
  r_.set(triangles_, r);
  if (++triangles_ == block)
    measure_triangles();
}

void QualityMeter::add_edge(Vec2 p, Vec2 q, double size_at_p) {
  if (size_ && size_->prefers_blocks()) {
    waiting_.push_back({p, q, size_at_p});
    if (std::ssize(waiting_) == sizing::places_in_block)
      add_waiting_edges();
    return;
  }
  collect_edge(p, q, size_at_p);
}

/// Asks for the sizes in the middles of all waiting edges at once.
void QualityMeter::add_waiting_edges() {
  std::vector<Vec2> middles;
  middles.reserve(waiting_.size());
  for (const WaitingEdge& edge : waiting_)
    middles.push_back(periods_.wrap(0.5 * (edge.from + edge.to)));
  const std::vector<double> sizes = sizing::checked_sizes_at(*size_, middles);
  for (std::size_t k = 0; k < sizes.size(); ++k)
    add_edge(waiting_[k].from, waiting_[k].to, waiting_[k].size_at_from, sizes[k]);
  waiting_.clear();
}

void QualityMeter::collect_edge(Vec2 p, Vec2 q, double size_at_p) {
  from_size_[edges_] = size_at_p;
  from_.set(edges_, p);
  to_.set(edges_, q);
  if (++edges_ == block)
    measure_edges();
}

void QualityMeter::add_edge(Vec2 p, Vec2 q, double size_at_p, double size_at_middle) {
  middle_size_[edges_] = size_at_middle;
  collect_edge(p, q, size_at_p);
}

void QualityMeter::finish() {
  measure_triangles();
  if (!waiting_.empty()) // without them there may be no size, as for a refined mesh
    add_waiting_edges();
  measure_edges();
}

void QualityMeter::measure_triangles() {
  const std::size_t n = triangles_;
  Values alpha, beta, sine;
  for (std::size_t k = 0; k < n; ++k) {
    const mesh::TriangleMeasures m = mesh::measure_triangle(p_[k], q_[k], r_[k]);
    alpha[k] = m.alpha;
    beta[k] = m.beta;
    sine[k] = m.least_sine;
  }
  double least = sums_.least_sine, worst = 0;
  for (std::size_t k = 0; k < n; ++k) {
    alpha_[k] = static_cast<float>(alpha[k]);
    beta_[k] = static_cast<float>(beta[k]);
    least = std::min(least, sine[k]);
    worst = std::max(worst, alpha[k]);
  }
  sums_.least_sine = least;
  if (worst >= sums_.worst.value)
    for (std::size_t k = 0; k < n; ++k)
      if (alpha[k] == worst)
        sums_.worst.note(worst, periods_.wrap((1.0 / 3) * (p_[k] + q_[k] + r_[k])));
  for (std::size_t k = 0; worst > mesh::least_obtuse_alpha && k < n; ++k)
    if (alpha[k] > mesh::least_obtuse_alpha)
      list_if_bad(alpha[k], k);
  sums_.alpha.add(std::span(alpha).first(n));
  sums_.beta.add(std::span(beta).first(n));
  write_to(alpha_.subspan(n), beta_.subspan(n));
  triangles_ = 0;
}

void QualityMeter::list_if_bad(double alpha, std::size_t k) {
  const bool obtuse = mesh::is_obtuse(p_[k], q_[k], r_[k]);
  if (!obtuse && !(alpha > ExtractionRules::listed_alpha))
    return;
  const SharpCorners::Corner corner = corners_.near(p_[k], q_[k], r_[k]);
  sums_.bad.add({alpha, periods_.wrap((1.0 / 3) * (p_[k] + q_[k] + r_[k])), corner.degrees, corner.place,
                 mesh::max_angle_degrees(p_[k], q_[k], r_[k]), obtuse});
}

/// Sets h at the middles of the edges of this block.
void QualityMeter::find_sizes(std::span<double> sizes) const {
  if (!size_ || size_->prefers_blocks())
    std::copy_n(middle_size_.begin(), sizes.size(), sizes.begin());
  else if (size_->is_uniform())
    std::ranges::fill(sizes, sizing::checked_size(*size_, {}));
  else
    for (std::size_t k = 0; k < sizes.size(); ++k)
      sizes[k] = sizing::checked_size(*size_, periods_.wrap(0.5 * (from_[k] + to_[k])));
}

void QualityMeter::measure_edges() {
  const std::size_t n = edges_;
  Values size;
  find_sizes(std::span(size).first(n));
  Values length;
  for (std::size_t k = 0; k < n; ++k)
    length[k] = geometry::length(to_[k] - from_[k]);
  note_extremes(std::span(length).first(n), std::span(size).first(n));
  std::int64_t ratios = 0, squares = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double capped = std::min(most_over_size, length[k] / size[k]);
    ratios += FixedSum::units(capped);
    squares += FixedSum::units(capped * capped);
  }
  sums_.ratio.add_units(ratios);
  sums_.squared_ratio.add_units(squares);
  sums_.edges += static_cast<std::int64_t>(n);
  edges_ = 0;
}

/// @param length, size of the edges of this block
void QualityMeter::note_extremes(std::span<const double> length, std::span<const double> size) {
  const std::size_t n = length.size();
  Values growth, ratio;
  double shortest = infinity, steepest = 0, longest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    growth[k] = length[k] > 0 ? std::fabs(size[k] - from_size_[k]) / (0.5 * length[k]) : 0;
    ratio[k] = length[k] / size[k];
    shortest = std::min(shortest, length[k]);
    steepest = std::max(steepest, growth[k]);
    longest = std::max(longest, ratio[k]);
  }
  for (std::size_t k = 0; k < n; ++k)
    sums_.growth_counts.add(growth[k]);
  if (-shortest < sums_.shortest.value && steepest < sums_.growth.value && longest < sums_.longest.value)
    return;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 middle = periods_.wrap(0.5 * (from_[k] + to_[k]));
    sums_.shortest.note(-length[k], middle);
    sums_.growth.note(growth[k], middle);
    sums_.longest.note(ratio[k], middle);
  }
}

mesh::QualitySummary summarize(const comm::Communicator& comm, QualitySums& sums) {
  const FirstSums mine{sums.alpha.pack(), sums.beta.pack(),  sums.ratio.split(), sums.squared_ratio.split(),
                       sums.edges,        sums.bad.counts(), sums.growth_counts};
  auto words = std::bit_cast<std::array<std::int64_t, first_words>>(mine);
  constexpr std::size_t maxima = 3;
  std::array<double, maxima + extreme_values> largest{sums.alpha.max(), sums.beta.max(), -sums.least_sine};
  std::ranges::transform(sums.extremes(), largest.begin() + maxima, [](const Extreme* one) { return one->value; });
  comm.sum_and_max(words, largest);
  const auto first = std::bit_cast<FirstSums>(words);
  Totals totals{{first.alpha, largest[0]}, {first.beta, largest[1]}, {}};
  std::copy(largest.begin() + maxima, largest.end(), totals.extremes.begin());
  const Detail detail = look_closer(comm, sums, totals);

  mesh::QualitySummary quality;
  quality.alpha = detail.alpha;
  quality.beta = detail.beta;
  quality.alpha_histogram = totals.alpha.histogram();
  quality.min_angle_degrees = std::min(60.0, elementary::asin(std::min(1.0, -largest[2])) * (180 / pi));
  quality.worst_place = detail.places[0];
  if (first.edges > 0) {
    quality.shortest_edge = -totals.extremes[1];
    quality.shortest_place = detail.places[1];
    quality.growth = {first.growth.quantile(0.9), first.growth.quantile(0.99), totals.extremes[2], detail.places[2]};
    quality.longest_over_size = totals.extremes[3];
    quality.longest_place = detail.places[3];
  }
  sums.bad.gather(comm, first.bad);
  sums.bad.tell(quality);
  const double edges = static_cast<double>(std::max<std::int64_t>(1, first.edges));
  const double mean = FixedSum::join(first.ratio).value() / edges;
  const double square = FixedSum::join(first.squared_ratio).value() / edges;
  quality.size_mean = mean;
  quality.size_std = mean > 0 ? std::sqrt(std::max(0.0, square / (mean * mean) - 1)) : 0;
  return quality;
}

} // namespace trime::extraction
