// SPDX-License-Identifier: BSD-3-Clause
#include "trime/mesh/quality.hpp"

#include "core/angle.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

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
constexpr double sum_cap = 65536;

} // namespace

double aspect_ratio(Vec2 p, Vec2 q, Vec2 r) {
  return measure_triangle(p, q, r).alpha;
}

double edge_ratio(Vec2 p, Vec2 q, Vec2 r) {
  return measure_triangle(p, q, r).beta;
}

double min_angle_degrees(Vec2 p, Vec2 q, Vec2 r) {
  return std::asin(std::min(1.0, measure_triangle(p, q, r).least_sine)) * degrees_per_radian;
}

RatioStatistics::RatioStatistics() : bins_(all_bins, 0) {}

std::size_t RatioStatistics::bin(double ratio) {
  if (!(ratio > 1))
    return 0;
  for (const Section& section : sections)
    if (ratio < section.from + section.width * static_cast<double>(section.count))
      return section.first +
             std::min(section.count - 1, static_cast<std::size_t>(std::max(0.0, ratio - section.from) / section.width));
  const std::uint64_t above = std::bit_cast<std::uint64_t>(ratio) - std::bit_cast<std::uint64_t>(octaves_from);
  return first_octave_bin + std::min(octave_bins - 1, static_cast<std::size_t>(above >> octave_shift));
}

double RatioStatistics::bin_middle(std::size_t bin) {
  for (const Section& section : sections)
    if (bin < section.first + section.count)
      return section.from + (static_cast<double>(bin - section.first) + 0.5) * section.width;
  const std::uint64_t above =
      (std::uint64_t{bin - first_octave_bin} << octave_shift) + (std::uint64_t{1} << (octave_shift - 1));
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(octaves_from) + above);
}

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
    ++bins_[bin(ratio < sum_cap ? ratio : sum_cap)];
  count_ += std::ssize(ratios);
  sum_.add_units(sum);
  sum_of_roots_.add_units(roots);
  sum_of_squares_.add_units(squares);
  max_ = largest;
}

void RatioStatistics::merge(const RatioStatistics& other) {
  count_ += other.count_;
  sum_.add(other.sum_);
  sum_of_roots_.add(other.sum_of_roots_);
  sum_of_squares_.add(other.sum_of_squares_);
  max_ = std::max(max_, other.max_);
  for (std::size_t k = 0; k < bins_.size(); ++k)
    bins_[k] += other.bins_[k];
}

RatioSummary RatioStatistics::summary() const {
  RatioSummary s;
  if (count_ == 0)
    return s;
  const double n = static_cast<double>(count_);
  s.mean = sum_.value() / n;
  s.half_mean = (sum_of_roots_.value() / n) * (sum_of_roots_.value() / n);
  s.std = std::sqrt(std::max(0.0, sum_of_squares_.value() / n - (s.mean - 1) * (s.mean - 1)));
  s.max = max_;
  std::int64_t below = 0;
  for (std::size_t k = 0; k < bins_.size(); ++k) {
    below += bins_[k];
    if (2 * below > count_) {
      s.median = bin_middle(k);
      break;
    }
  }
  return s;
}

std::vector<std::int64_t> RatioStatistics::pack() const {
  std::vector<std::int64_t> packed(bins_);
  packed.push_back(count_);
  for (const FixedSum& sum : {sum_, sum_of_roots_, sum_of_squares_}) {
    packed.push_back(sum.split().low);
    packed.push_back(sum.split().high);
  }
  return packed;
}

void RatioStatistics::unpack(const std::vector<std::int64_t>& packed, double max) {
  std::copy_n(packed.begin(), bins_.size(), bins_.begin());
  const std::int64_t* rest = packed.data() + bins_.size();
  count_ = rest[0];
  sum_ = FixedSum::join({rest[1], rest[2]});
  sum_of_roots_ = FixedSum::join({rest[3], rest[4]});
  sum_of_squares_ = FixedSum::join({rest[5], rest[6]});
  max_ = max;
}

std::array<std::int64_t, 9> RatioStatistics::histogram() const {
  std::array<std::int64_t, 9> counts{};
  for (std::size_t k = 0; k < bins_.size(); ++k) {
    const double middle = bin_middle(k);
    const auto next = std::upper_bound(histogram_edges.begin(), histogram_edges.end(), middle);
    counts[static_cast<std::size_t>(next - histogram_edges.begin()) - 1] += bins_[k];
  }
  return counts;
}

} // namespace trime::mesh
