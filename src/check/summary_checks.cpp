// SPDX-License-Identifier: BSD-3-Clause
#include "checks.hpp"
#include "exact.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace trime_check {
namespace {

// Single precision has 2^-24; the formulas here and there are not the same.
constexpr double float_tolerance = 1e-6, sum_tolerance = 1e-8;
// Medians come from classes of values: of 1e-4 up to 2, of some per cent beyond.
constexpr double median_tolerance = 2e-4, wide_median_tolerance = 0.02;
// A variance is the difference of sums, so what their rounding leaves of it has no sign and no relation to it. The
// terms of the file's sums are multiples of this.
constexpr double variance_tolerance = 0x1p-32;
// Means cap a ratio here.
constexpr double cap = 65536;
constexpr std::array<double, 9> classes{1, 1.01, 1.02, 1.05, 1.1, 1.2, 1.5, 2, 5};

bool near(double expected, double found, double tolerance) {
  return expected == found || std::fabs(expected - found) <= tolerance * std::fabs(expected);
}

struct Measures {
  double alpha, beta, angle, shortest;
};

/// By the sides: alpha = R/(2r), the ratio of the longest and the shortest, the smallest angle [degrees].
Measures measure(const std::array<Point, 3>& corners) {
  std::array<long double, 3> side;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point d = corners[(k + 1) % 3] - corners[k];
    side[k] = std::sqrt(static_cast<long double>(d.x) * d.x + static_cast<long double>(d.y) * d.y);
  }
  std::ranges::sort(side);
  const Point u = corners[1] - corners[0], v = corners[2] - corners[0];
  const long double area = std::fabs(static_cast<long double>(u.x) * v.y - static_cast<long double>(u.y) * v.x) / 2;
  const long double perimeter = side[0] + side[1] + side[2];
  const long double circumradius = side[0] * side[1] * side[2] / (4 * area), inradius = 2 * area / perimeter;
  const long double sine = std::min(1.0L, 2 * area / (side[1] * side[2]));
  return {static_cast<double>(std::max(1.0L, circumradius / (2 * inradius))), static_cast<double>(side[2] / side[0]),
          static_cast<double>(std::asin(sine) * 180 / 3.14159265358979323846L), static_cast<double>(side[0])};
}

/// Mean, half-mean, standard deviation, maximum and median of a ratio.
void check_ratio(const StoredFile& file, const std::string& name, std::vector<double> values, Tally& wrong) {
  long double sum = 0, roots = 0, squares = 0;
  for (const double value : values) {
    const double capped = std::min(value, cap);
    sum += capped;
    roots += std::sqrt(capped);
    squares += std::min((capped - 1) * (capped - 1), cap);
  }
  const auto n = static_cast<long double>(values.size());
  const auto mean = static_cast<double>(sum / n), root = static_cast<double>(roots / n);
  const double spread = std::sqrt(std::max(0.0, static_cast<double>(squares / n) - (mean - 1) * (mean - 1)));
  std::ranges::sort(values);
  const double median = values[values.size() / 2];
  const auto stored = [&](const char* what) { return file.number("/trime_mpi/quality", name + what); };
  const auto compare = [&](const char* what, double expected, double tolerance) {
    const std::optional<double> found = stored(what);
    if (!found || !near(expected, *found, tolerance))
      wrong.note([&] {
        return fmt::format("{}{}: expected {:.12g}, found {}", name, what, expected,
                           found ? fmt::format("{:.12g}", *found) : "nothing");
      });
  };
  compare("_mean", mean, sum_tolerance);
  compare("_half_mean", root * root, sum_tolerance);
  compare("_max", values.back(), sum_tolerance);
  compare("_median", median, median < 2 ? median_tolerance : wide_median_tolerance);
  if (const std::optional<double> found = stored("_std");
      !found || std::fabs(*found * *found - spread * spread) > variance_tolerance)
    compare("_std", spread, std::sqrt(sum_tolerance));
}

void check_histogram(const StoredFile& file, const std::vector<double>& alpha, Tally& wrong) {
  std::array<std::int64_t, classes.size()> counts{}, doubtful{};
  for (const double value : alpha) {
    const auto k = static_cast<std::size_t>(std::ranges::upper_bound(classes, std::max(1.0, value)) - classes.begin());
    ++counts[k - 1];
    for (std::size_t edge = 1; edge < classes.size(); ++edge) // at the edge of two classes rounding decides
      if (near(classes[edge], value, 1e-12)) {
        ++doubtful[edge];
        ++doubtful[edge - 1];
      }
  }
  const std::vector<double> found = file.column("/trime_mpi/quality/alpha_histogram");
  for (std::size_t k = 0; k < counts.size(); ++k)
    if (k >= found.size() || std::fabs(found[k] - static_cast<double>(counts[k])) > static_cast<double>(doubtful[k]))
      wrong.note([&] { return fmt::format("alpha_histogram from {}: expected {}", classes[k], counts[k]); });
}

void check_quality(const StoredFile& file, const Mesh& mesh, Report& report) {
  Tally alpha_wrong, beta_wrong, summary;
  std::vector<double> alpha, beta;
  double angle = 60, shortest = std::numeric_limits<double>::infinity();
  std::int64_t bad = 0, obtuse = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::array<Point, 3> corners = mesh.corners(mesh.triangles[t]);
    const Measures m = measure(corners);
    const auto note = [&](Tally& tally, double expected, double found) {
      if (!near(expected, found, float_tolerance))
        tally.note(
            [&] { return fmt::format("{}: expected {:.8g}, found {:.8g}", place_of(mesh, t), expected, found); });
    };
    note(alpha_wrong, m.alpha, mesh.alpha[t]);
    note(beta_wrong, m.beta, mesh.beta[t]);
    alpha.push_back(m.alpha);
    beta.push_back(m.beta);
    angle = std::min(angle, m.angle);
    shortest = std::min(shortest, m.shortest);
    bad += m.alpha > 2;
    obtuse += is_obtuse(corners[0], corners[1], corners[2]);
  }
  check_histogram(file, alpha, summary);
  check_ratio(file, "alpha", std::move(alpha), summary);
  check_ratio(file, "beta", std::move(beta), summary);
  if (!near(angle, file.number("/trime_mpi/quality", "min_angle_degrees").value_or(-1), sum_tolerance))
    summary.note([&] { return fmt::format("min_angle_degrees: expected {:.12g}", angle); });
  if (!near(shortest, file.number("/trime_mpi/quality", "shortest_edge").value_or(shortest), sum_tolerance))
    summary.note([&] { return fmt::format("shortest_edge: expected {:.12g}", shortest); }); // absent in older files
  if (file.number("/trime_mpi/quality", "bad_triangles").value_or(-1) != static_cast<double>(bad))
    summary.note([&] { return fmt::format("bad_triangles: expected {}", bad); });
  if (file.number("/trime_mpi/quality", "obtuse_triangles").value_or(static_cast<double>(obtuse)) !=
      static_cast<double>(obtuse)) // absent in older files
    summary.note([&] { return fmt::format("obtuse_triangles: expected {}", obtuse); });
  report.none("alpha", alpha_wrong, "triangles whose `alpha` is not R/(2r)");
  report.none("beta", beta_wrong, "triangles whose `beta` is not the longest over the shortest edge");
  report.none("quality", summary, "numbers in /trime_mpi/quality that are not those of the triangles");
}

/// The numbers of the file's checks that are counted here too, by their names.
std::map<std::string, double> numbers_here(const Mesh& mesh, const Counted& counted) {
  const auto triangles = static_cast<double>(mesh.triangles.size()), facets = static_cast<double>(mesh.facets.size());
  return {
      {"star_listings", 3 * triangles},
      {"written_points", static_cast<double>(mesh.points.size())},
      {"written_triangles", triangles},
      {"written_facets", facets},
      {"boundary_segments", facets},
      {"not_positive", static_cast<double>(counted.clockwise)},
      {"not_delaunay", static_cast<double>(counted.not_delaunay)},
      {"euler_characteristic", static_cast<double>(counted.euler_characteristic)},
      {"edge_count", static_cast<double>(counted.edges)},
      {"unused_points", static_cast<double>(counted.unused)},
      {"boundary_cycles", static_cast<double>(counted.loops)},
      {"corners", static_cast<double>(counted.corners)},
      {"area", counted.area},
  };
}

/// Does a check of the file hold by its own two numbers?
bool holds(const std::string& name, double expected, double found) {
  // The checks with a largest value. turns_kept and shortest_edge have a smallest one; for all others both numbers are
  // equal.
  const std::array<std::string, 8> limits{"vertex_distance", "generalisation", "chord_deviation", "arc_deviation",
                                          "area_residual",   "worst_alpha",    "lost_area",       "longest_edge"};
  if (std::ranges::find(limits, name) != limits.end())
    return found <= expected;
  return name == "turns_kept" || name == "shortest_edge" ? found >= expected : found == expected;
}

/// Notes the lines of the file's table of checks that are not what is found here. Returns the least value in the column
/// `passed`, at most 1.
double compare_checks(const StoredFile& file, const std::map<std::string, double>& here, Tally& wrong) {
  const std::vector<std::string> names = file.names("/trime_mpi/checks/name");
  const std::vector<double> expected = file.column("/trime_mpi/checks/expected");
  const std::vector<double> found = file.column("/trime_mpi/checks/found");
  const std::vector<double> passed = file.column("/trime_mpi/checks/passed");
  double all = 1;
  for (std::size_t k = 0; k < std::min({names.size(), expected.size(), found.size(), passed.size()}); ++k) {
    const auto own = here.find(names[k]);
    const bool same = own == here.end() || near(own->second, found[k], 1e-12);
    if (!same || holds(names[k], expected[k], found[k]) != (passed[k] == 1))
      wrong.note([&] {
        return fmt::format("{}: the file says expected {:.12g}, found {:.12g}, passed {}{}", names[k], expected[k],
                           found[k], passed[k], same ? "" : fmt::format("; trime_check finds {:.12g}", own->second));
      });
    all = std::min(all, passed[k]);
  }
  return all;
}

/// Compares the counts in the file with those made here.
void check_stored_checks(const StoredFile& file, const CountedMesh& split, const CountedMesh& whole, Report& report) {
  const double complete = file.number("/trime_mpi", "complete").value_or(-1);
  const std::string reason = file.text_attribute("/trime_mpi", "stop_reason").value_or("");
  const std::vector<std::string> names = file.names("/trime_mpi/checks/name");
  if (names.empty() && complete == 0 && reason.starts_with("none")) {
    report.skip("stored_checks", "the mesh is an intermediate step of a run and has no certificate");
    return;
  }
  std::map<std::string, double> here = numbers_here(whole.mesh, whole.counted);
  if (!split.mesh.split_pairs.empty())
    here["split_euler_characteristic"] = static_cast<double>(split.counted.euler_characteristic);
  Tally wrong;
  const double all = compare_checks(file, here, wrong);
  const double must_be = reason == "sweep cap" ? 0 : all;
  if (complete != must_be)
    wrong.note([&] { return fmt::format("`complete` is {}, expected {}", complete, must_be); });
  const auto missing = static_cast<std::size_t>(std::ranges::count_if(
      here, [&](const auto& known) { return std::ranges::find(names, known.first) == names.end(); }));
  if (missing > 1) // files of older versions have no written_points
    wrong.note([&] { return fmt::format("{} of {} known checks are missing", missing, here.size()); });
  const auto compare_count = [&](const char* name, std::size_t count) {
    if (file.number("/trime_mpi", name) != static_cast<double>(count))
      wrong.note([&] { return fmt::format("`{}` is not {}", name, count); });
  };
  compare_count("points", split.mesh.points.size());
  compare_count("triangles", split.mesh.triangles.size());
  report.none("stored_checks", wrong, "rows of /trime_mpi/checks and counts that differ from what trime_check finds");
}

} // namespace

void check_summary(const StoredFile& file, const CountedMesh& mesh, const CountedMesh& whole, Report& report) {
  check_quality(file, mesh.mesh, report);
  check_sizes(file, mesh.mesh, report);
  check_stored_checks(file, mesh, whole, report);
}

} // namespace trime_check
