// SPDX-License-Identifier: BSD-3-Clause
#include "trime/mesh/quality.hpp"

#include "core/angle.hpp"
#include "core/elementary.hpp"
#include "geometry/predicates.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace trime::mesh {
namespace {

using geometry::Vec2;

/// Bins of the histogram: [1, 1.01) by 1e-6, [1.01, 2) by 1e-4, [2, 10) by 1e-2, and from there 64 an octave, which are
/// leading bits of the number itself.
struct Section {
  double from, width;
  std::size_t first, count;
};
constexpr std::array<Section, 3> sections{{{1, 1e-6, 0, 10000}, {1.01, 1e-4, 10000, 9900}, {2, 1e-2, 19900, 800}}};
constexpr double octaves_from = 8;
constexpr std::size_t first_octave_bin = 20700, octave_bins = 64 * 13 + 1;
constexpr int octave_shift = 52 - 6; // six bits of the fraction
constexpr std::size_t all_bins = first_octave_bin + octave_bins;
constexpr std::size_t padded_bins = RatioStatistics::runs * RatioStatistics::run_length;
static_assert(all_bins <= padded_bins && all_bins + RatioStatistics::run_length > padded_bins);
constexpr double sum_cap = 65536;

std::size_t bin_of(double ratio) {
  if (!(ratio > 1))
    return 0;
  for (const Section& section : sections)
    if (ratio < section.from + section.width * static_cast<double>(section.count))
      return section.first +
             std::min(section.count - 1, static_cast<std::size_t>(std::max(0.0, ratio - section.from) / section.width));
  const std::uint64_t above = std::bit_cast<std::uint64_t>(ratio) - std::bit_cast<std::uint64_t>(octaves_from);
  return first_octave_bin + std::min(octave_bins - 1, static_cast<std::size_t>(above >> octave_shift));
}

double bin_middle(std::size_t bin) {
  for (const Section& section : sections)
    if (bin < section.first + section.count)
      return section.from + (static_cast<double>(bin - section.first) + 0.5) * section.width;
  const std::uint64_t above =
      (std::uint64_t{bin - first_octave_bin} << octave_shift) + (std::uint64_t{1} << (octave_shift - 1));
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(octaves_from) + above);
}

/// The first bin whose middle is not below.
std::size_t first_bin_from(double ratio) {
  std::size_t first = 0, last = all_bins;
  while (first < last)
    if (const std::size_t middle = first + (last - first) / 2; bin_middle(middle) < ratio)
      first = middle + 1;
    else
      last = middle;
  return first;
}

} // namespace

double aspect_ratio(Vec2 p, Vec2 q, Vec2 r) {
  return measure_triangle(p, q, r).alpha;
}

double edge_ratio(Vec2 p, Vec2 q, Vec2 r) {
  return measure_triangle(p, q, r).beta;
}

double min_angle_degrees(Vec2 p, Vec2 q, Vec2 r) {
  return elementary::asin(std::min(1.0, measure_triangle(p, q, r).least_sine)) * degrees_per_radian;
}

bool is_obtuse(Vec2 p, Vec2 q, Vec2 r) {
  using geometry::diametral_side;
  return diametral_side(q, r, p) < 0 || diametral_side(r, p, q) < 0 || diametral_side(p, q, r) < 0;
}

double max_angle_degrees(Vec2 p, Vec2 q, Vec2 r) {
  double largest = 0;
  for (const auto& [at, from, to] : {std::array{p, q, r}, std::array{q, r, p}, std::array{r, p, q}}) {
    const Vec2 u = from - at, v = to - at;
    largest = std::max(largest, std::fabs(angle_of(geometry::cross(u, v), geometry::dot(u, v))));
  }
  return largest * degrees_per_radian;
}

RatioStatistics::RatioStatistics() : bins_(padded_bins, 0) {}

void RatioStatistics::add(double ratio) {
  add(std::span(&ratio, 1));
}

void RatioStatistics::add(std::span<const double> ratios) {
  std::int64_t sum = 0, roots = 0, squares = 0;
  double largest = max_;
  for (const double ratio : ratios) {
    const double capped = ratio < sum_cap ? ratio : sum_cap; // also catches infinity and NaN
    const double square = (capped - 1) * (capped - 1);
    sum += FixedSum::units(capped);
    roots += FixedSum::units(std::sqrt(capped));
    squares += FixedSum::units(square < sum_cap ? square : sum_cap);
    largest = largest < ratio ? ratio : largest;
  }
  for (const double ratio : ratios)
    ++bins_[bin_of(ratio < sum_cap ? ratio : sum_cap)];
  sum_.add_units(sum);
  sum_of_roots_.add_units(roots);
  sum_of_squares_.add_units(squares);
  max_ = largest;
}

void RatioStatistics::merge(const RatioStatistics& other) {
  sum_.add(other.sum_);
  sum_of_roots_.add(other.sum_of_roots_);
  sum_of_squares_.add(other.sum_of_squares_);
  max_ = std::max(max_, other.max_);
  for (std::size_t k = 0; k < bins_.size(); ++k)
    bins_[k] += other.bins_[k];
}

std::array<std::int64_t, RatioStatistics::packed_size> RatioStatistics::pack() const {
  std::array<std::int64_t, packed_size> packed{};
  auto next = packed.begin();
  for (const FixedSum& sum : {sum_, sum_of_roots_, sum_of_squares_}) {
    *next++ = sum.split().low;
    *next++ = sum.split().high;
  }
  for (std::size_t k = 0; k < classes; ++k) {
    const auto from = bins_.begin() + static_cast<std::ptrdiff_t>(first_bin_from(histogram_edges[k]));
    const auto to = k + 1 == classes
                        ? bins_.end()
                        : bins_.begin() + static_cast<std::ptrdiff_t>(first_bin_from(histogram_edges[k + 1]));
    *next++ = std::accumulate(from, to, std::int64_t{0});
  }
  for (std::size_t run = 0; run < runs; ++run) {
    const std::span<const std::int64_t> counts = bins(run);
    *next++ = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  }
  return packed;
}

std::span<const std::int64_t> RatioStatistics::bins(std::size_t run) const {
  return std::span(bins_).subspan(run * run_length, run_length);
}

RatioTotals::RatioTotals(std::span<const std::int64_t, RatioStatistics::packed_size> packed, double max) {
  const auto classes = packed.subspan<6, RatioStatistics::classes>();
  const auto runs = packed.last<RatioStatistics::runs>();
  std::copy(classes.begin(), classes.end(), histogram_.begin());
  count_ = std::accumulate(runs.begin(), runs.end(), std::int64_t{0});
  if (count_ == 0)
    return;
  while (2 * (below_ + runs[median_run_]) <= count_)
    below_ += runs[median_run_++];
  const double n = static_cast<double>(count_);
  const auto mean = [&](std::size_t k) { return FixedSum::join({packed[k], packed[k + 1]}).value() / n; };
  mean_ = mean(0);
  half_mean_ = mean(2) * mean(2);
  std_ = std::sqrt(std::max(0.0, mean(4) - (mean_ - 1) * (mean_ - 1)));
  max_ = max;
}

RatioSummary RatioTotals::summary(std::span<const std::int64_t> bins) const {
  RatioSummary summary{1, mean_, max_, half_mean_, std_};
  std::int64_t below = below_;
  for (std::size_t k = 0; k < bins.size(); ++k) {
    below += bins[k];
    if (2 * below > count_) {
      summary.median = bin_middle(median_run_ * RatioStatistics::run_length + k);
      break;
    }
  }
  return summary;
}

} // namespace trime::mesh
