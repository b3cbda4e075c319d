// SPDX-License-Identifier: BSD-3-Clause
// Measures the quality of triangles and of whole meshes. Statistics consist of integers (fixed-point sums, histograms),
// so merging them in any order gives the same bits. Also defines the checks of a mesh: named pairs of an expected and a
// found value.
#pragma once

#include "trime/core/sum.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace trime::mesh {

/// @brief Returns alpha = abc / (8 (s-a)(s-b)(s-c)) = R/(2r) of a triangle with side lengths a, b, c and half perimeter
/// s: 1 for an equilateral triangle, infinity for a flat one.
double aspect_ratio(geometry::Vec2 p, geometry::Vec2 q, geometry::Vec2 r);
/// @brief Returns a threshold for a fast test: if the squared edges of a triangle add up to less than the threshold
/// times twice its area, its alpha is below `limit`. Few other triangles have an alpha below `limit`. For limits above
/// 1.13, however, the test accepts only triangles with alpha below 1.13.
/// @pre limit > 1
///
/// Reason: let eta = (a^2 + b^2 + c^2) / (4 sqrt(3) area). Among all triangles with the same eta, an isosceles one has
/// the largest alpha. If eta is at most 1.1, this alpha is less than 1 + 1.3 (eta - 1).
constexpr double squares_surely_below(double limit) {
  constexpr double root_3 = 1.7320508075688772, steepness = 1.3, largest_excess = 0.1;
  return (1 + std::min((limit - 1) / steepness, largest_excess)) * 2 * root_3;
}
/// @brief Returns true only if the alpha of a triangle is certainly below a limit. Uses squares_surely_below, without
/// root and division; this settles most triangles of a good mesh. May return false although alpha is below the limit.
inline bool is_surely_below(double limit, geometry::Vec2 p, geometry::Vec2 q, geometry::Vec2 r) {
  const geometry::Vec2 u = q - p, v = r - p;
  const double squares = geometry::squared_length(u) + geometry::squared_length(v) + geometry::squared_length(r - q);
  return squares < squares_surely_below(limit) * geometry::cross(u, v);
}
/// Returns beta = longest edge / shortest edge of a triangle.
double edge_ratio(geometry::Vec2 p, geometry::Vec2 q, geometry::Vec2 r);
/// Returns the smallest angle of a triangle in degrees.
double min_angle_degrees(geometry::Vec2 p, geometry::Vec2 q, geometry::Vec2 r);

/// Returns true if an angle of a triangle is larger than 90 degrees. Exact for points of one lattice.
bool is_obtuse(geometry::Vec2 p, geometry::Vec2 q, geometry::Vec2 r);
/// Returns the largest angle of a triangle in degrees.
double max_angle_degrees(geometry::Vec2 p, geometry::Vec2 q, geometry::Vec2 r);
/// No obtuse triangle has a smaller aspect ratio: among right-angled triangles the isosceles one has the least ratio,
/// (1 + sqrt(2)) / 2 = 1.20711.
inline constexpr double least_obtuse_alpha = 1.2071;

/// Quality measures of one triangle.
struct TriangleMeasures {
  double alpha, beta;
  double least_sine; ///< sine of the smallest angle; NaN if all three points are equal
};
inline TriangleMeasures measure_triangle(geometry::Vec2 p, geometry::Vec2 q, geometry::Vec2 r) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double a = geometry::length(q - r), b = geometry::length(r - p), c = geometry::length(p - q);
  const double twice_area = geometry::cross(q - p, r - p);
  const double shortest = std::min(std::min(a, b), c), longest = std::max(std::max(a, b), c);
  // With the area A = |cross|/2, abc/(8(s-a)(s-b)(s-c)) = abc s/(8 A^2). The right side has no cancellation for flat
  // triangles.
  const double alpha = std::max(1.0, a * b * c * (a + b + c) / (4 * twice_area * twice_area));
  const double others = a == shortest   ? b * c
                        : b == shortest ? c * a
                                        : a * b; // product of the two longer sides, which enclose the smallest angle
  return {twice_area == 0 ? infinity : alpha, shortest > 0 ? longest / shortest : infinity,
          std::fabs(twice_area) / others};
}

/// Mean, half-mean ((mean of square roots)^2), standard deviation, median and maximum of a ratio that is at least 1.
struct RatioSummary {
  double median = 1, mean = 1, max = 1, half_mean = 1, std = 0;
};

/// @brief Statistics of a ratio that is at least 1, which can be merged. Values are capped at 2^16 in the sums; the
/// maximum is exact. The median comes from bins with a width of 1e-6 up to 1.01, 1e-4 up to 2, 1e-2 up to 10, and 1.6 %
/// of the value beyond. Because there are many bins, ranks do not sum all of them: first they sum the result of `pack`,
/// then only the run of bins that contains the median. See RatioTotals.
class RatioStatistics {
public:
  RatioStatistics();
  void add(double ratio);
  /// Adds several ratios, at most 4096. The result is the same as if they were added one by one.
  void add(std::span<const double> ratios);
  void merge(const RatioStatistics& other);
  double max() const { return max_; }

  static constexpr std::size_t classes = 9;
  /// Lower ends of the classes of the histogram: [1,1.01), [1.01,1.02), [1.02,1.05), [1.05,1.1), [1.1,1.2), [1.2,1.5),
  /// [1.5,2), [2,5), [5,inf).
  static constexpr std::array<double, classes> histogram_edges{1, 1.01, 1.02, 1.05, 1.1, 1.2, 1.5, 2, 5};
  static constexpr std::size_t run_length = 128; ///< number of bins in a run
  /// `pack` returns three sums of two words each, then the counts in the classes, then the counts in the runs of bins.
  static constexpr std::size_t runs = 169, packed_size = 6 + classes + runs;
  std::array<std::int64_t, packed_size> pack() const;
  /// Returns the counts in the bins of a run; there are run_length of them.
  std::span<const std::int64_t> bins(std::size_t run) const;

private:
  FixedSum sum_, sum_of_roots_, sum_of_squares_;
  double max_ = 1;
  std::vector<std::int64_t> bins_;
};

/// The statistics of a ratio over all ranks, computed from packed sums.
class RatioTotals {
public:
  /// @param packed the results of RatioStatistics::pack, added over all ranks
  RatioTotals(std::span<const std::int64_t, RatioStatistics::packed_size> packed, double max);
  /// Returns the number of the run of bins that contains the median.
  std::size_t median_run() const { return median_run_; }
  /// @param bins counts in the bins of the median's run, added over all ranks
  RatioSummary summary(std::span<const std::int64_t> bins) const;
  /// Returns the counts in the classes of the histogram.
  const std::array<std::int64_t, RatioStatistics::classes>& histogram() const { return histogram_; }

private:
  std::int64_t count_ = 0, below_ = 0; // below_: count of all values in the runs before the median's run
  std::size_t median_run_ = 0;
  double mean_ = 1, half_mean_ = 1, std_ = 0, max_ = 1;
  std::array<std::int64_t, RatioStatistics::classes> histogram_{};
};

/// One of the worst triangles, and the sharp corner of the shape that explains its bad quality.
struct BadTriangle {
  double alpha = 0;
  geometry::Vec2 place;      ///< centre of the triangle
  double corner_degrees = 0; ///< angle of the nearest sharp corner, at most 3 longest edges of the triangle away; 0:
                             ///< there is no such corner
  geometry::Vec2 corner;
  double largest_degrees = 0; ///< its largest angle
  std::int64_t obtuse = 0;    ///< 1 if this angle is larger than 90 degrees, by exact arithmetic
};

/// @brief How fast h grows: |h(m) - h(p)| / |m - p| for one end p of each edge and its middle m. The quantiles are
/// rounded up to a multiple of 1/1024.
struct GrowthSummary {
  double of_90_percent = 0; ///< 90 % of the edges have at most this growth
  double of_99_percent = 0; ///< 99 % of the edges have at most this growth
  double largest = 0;
  geometry::Vec2 place; ///< middle of the edge with the largest growth
};

/// Quality of a whole mesh, as printed and stored.
struct QualitySummary {
  RatioSummary alpha, beta;
  double min_angle_degrees = 60;
  geometry::Vec2 worst_place; ///< centre of the triangle with the largest alpha
  double shortest_edge = 0;   ///< length of the shortest edge of the mesh
  geometry::Vec2
      shortest_place;   ///< middle of the shortest edge; of equally short edges, the lexicographically first middle
  GrowthSummary growth; ///< how fast the target edge length grows along the edges
  double longest_over_size = 0;       ///< largest L / h of an edge of length L, with h at its middle
  geometry::Vec2 longest_place;       ///< middle of this edge
  double size_mean = 1, size_std = 0; ///< mean and standard deviation of L / (s h) over all edges of length L, with h
                                      ///< at the middle; s is chosen so that the mean is 1
  std::array<std::int64_t, RatioStatistics::classes> alpha_histogram{};
  std::int64_t bad_triangles = 0;           ///< number of triangles with an alpha above 2
  std::int64_t obtuse_triangles = 0;        ///< number of triangles with an angle above 90 degrees
  std::int64_t obtuse_at_corners = 0;       ///< number of obtuse triangles near a sharp corner, see BadTriangle
  std::vector<BadTriangle> worst_triangles; ///< at most 10 with an alpha above 2 or an obtuse angle, the worst first
  BadTriangle worst_away; ///< the worst triangle with an alpha above 2 and no sharp corner near it; alpha 0: none
};

/// One check of the mesh: it passes if the found value agrees with the expected one.
struct Check {
  std::string name; ///< lower case with underscores; also the name in the mesh file
  double expected = 0;
  double found = 0;
  bool passed = false;
  std::string meaning; ///< explanation in one line, for the report
};

using Checks = std::vector<Check>;

inline bool all_passed(const Checks& checks) {
  for (const Check& check : checks)
    if (!check.passed)
      return false;
  return true;
}

} // namespace trime::mesh
