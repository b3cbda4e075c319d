// SPDX-License-Identifier: BSD-3-Clause
#include "checks.hpp"
#include "nearest.hpp"

#include <algorithm>

namespace trime_check {
namespace {

// A size is the length of the edges around it, within this factor: triangles may be four times worse than good ones.
constexpr double size_factor = 12;
// Of the mean over all edges: the file takes h in the middle of an edge, where a steep size is another than at its
// ends.
constexpr double mean_factor = 1.5;
// Narrow places lower the size to no less of it (configs/README.md).
constexpr double least_share = 0.05;
constexpr double single_precision = 1e-6;

/// Means of the edges at each point; 0 where there are none.
std::vector<double> mean_edges(const Mesh& mesh) {
  std::vector<double> length(mesh.points.size(), 0);
  std::vector<std::int64_t> edges(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    const auto corners = mesh.corners(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Point d = corners[(k + 1) % 3] - corners[k];
      for (const std::int64_t id : {t[k], t[(k + 1) % 3]}) {
        length[static_cast<std::size_t>(id)] += std::hypot(d.x, d.y);
        ++edges[static_cast<std::size_t>(id)];
      }
    }
  }
  for (std::size_t i = 0; i < length.size(); ++i)
    length[i] /= static_cast<double>(std::max<std::int64_t>(1, edges[i]));
  return length;
}

/// Fixed points that lie closer to another one, or to the boundary, than the size: no triangle there can have it.
std::vector<Point> crowded_points(const Mesh& mesh) {
  std::vector<Point> fixed;
  std::vector<std::size_t> ids;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    if (mesh.fixed[i] == 1) {
      fixed.push_back(mesh.points[i]);
      ids.push_back(i);
    }
  const PointFinder others(fixed, mesh.periods);
  const FacetFinder facets(mesh);
  std::vector<Point> crowded;
  for (std::size_t k = 0; k < fixed.size(); ++k) {
    const double size = mesh.size[ids[k]];
    const bool is_inside = mesh.boundary[ids[k]] == 0;
    if (others.nearest_other(k).distance < size || (is_inside && facets.nearest(fixed[k]).distance < size))
      crowded.push_back(fixed[k]);
  }
  return crowded;
}

/// Sizes are positive, and about as long as the edges there.
void check_points(const Mesh& mesh, Report& report) {
  const std::vector<double> means = mean_edges(mesh);
  const PointFinder crowded(crowded_points(mesh), mesh.periods);
  Tally wrong;
  std::int64_t left_out = 0;
  for (std::size_t i = 0; i < mesh.size.size(); ++i) {
    const double size = mesh.size[i], mean = means[i];
    const bool is_positive = size > 0 && std::isfinite(size);
    if (is_positive && (mean == 0 || (size * size_factor > mean && size < size_factor * mean)))
      continue;
    if (is_positive && crowded.nearest(mesh.points[i]).distance < size)
      ++left_out;
    else
      wrong.note([&] {
        return fmt::format("point {} at {}: size {:.6g}, edges {:.6g}", i, place_of(mesh.points[i]), size, mean);
      });
  }
  const std::string beside =
      left_out == 0 ? ""
                    : fmt::format("; {} beside fixed points that lie closer to each other or to the boundary than "
                                  "the size are left out",
                                  left_out);
  report.none(
      "size", wrong,
      fmt::format("points whose `size` is not the length of their edges within a factor of {}{}", size_factor, beside));
}

/// The mean over all edges of their length over the mean size of their ends.
double mean_ratio(const Mesh& mesh) {
  double sum = 0, count = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto corners = mesh.corners(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      const Point d = corners[next] - corners[k];
      const bool on_facet =
          mesh.boundary[static_cast<std::size_t>(t[k])] != 0 && mesh.boundary[static_cast<std::size_t>(t[next])] != 0;
      const double share = on_facet ? 1 : 0.5; // edges inside are met twice
      const double sizes = mesh.size[static_cast<std::size_t>(t[k])] + mesh.size[static_cast<std::size_t>(t[next])];
      sum += share * std::hypot(d.x, d.y) * 2 / sizes;
      count += share;
    }
  }
  return sum / count;
}

void check_mean(const StoredFile& file, const Mesh& mesh, Report& report) {
  const double expected = file.number("/trime_mpi/quality", "size_mean").value_or(0), found = mean_ratio(mesh);
  report.add(
      "size_mean", found < mean_factor * expected && expected < mean_factor * found, fmt::format("{:.6g}", expected),
      fmt::format("{:.6g}", found),
      fmt::format("mean of edges over `size`; expected is `size_mean` of /trime_mpi/quality, within a factor of {}",
                  mean_factor));
}

/// Positive, and related to the sizes of the points; where the size is uniform all are the same.
void check_facets(const StoredFile& file, const Mesh& mesh, Report& report) {
  const double lowest = std::min(1.0, file.number("/trime_mpi", "lowest_size_share").value_or(least_share));
  const bool is_uniform = file.text_attribute("/trime_mpi", "sizing") == "uniform";
  const std::optional<double> length = file.number("/trime_mpi", "edge_length");
  Tally asked;
  for (std::size_t k = 0; k < mesh.facets.size(); ++k) {
    const double size = mesh.asked_sizes[k], a = mesh.size[static_cast<std::size_t>(mesh.facets[k][0])],
                 b = mesh.size[static_cast<std::size_t>(mesh.facets[k][1])];
    const bool is_positive = size > 0 && std::isfinite(size);
    const bool is_related = size * size_factor > std::min(a, b) && size * lowest < size_factor * std::max(a, b);
    const bool is_same = !is_uniform || !length || std::fabs(size - *length) <= single_precision * *length;
    if (!is_positive || !is_related || !is_same)
      asked.note([&] { return fmt::format("facet {}: {}, points {:.6g} and {:.6g}", k, size, a, b); });
  }
  report.none(
      "asked_size", asked,
      fmt::format("facets whose `asked_size` is not positive, that of a uniform size, or the `size` of their points "
                  "within a factor of {}, lowered to {:.3g} at narrow places",
                  size_factor, lowest));
}

} // namespace

void check_sizes(const StoredFile& file, const Mesh& mesh, Report& report) {
  check_points(mesh, report);
  check_mean(file, mesh, report);
  check_facets(file, mesh, report);
}

} // namespace trime_check
