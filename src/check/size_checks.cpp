// SPDX-License-Identifier: BSD-3-Clause
#include "checks.hpp"
#include "nearest.hpp"

#include <algorithm>

namespace trime_check {
namespace {

// A size is the length of the edges around it, within this factor: triangles may be four times worse than good ones.
constexpr double size_factor = 12;

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

void check_facets(const Mesh& mesh, Report& report) {
  Tally asked;
  for (std::size_t k = 0; k < mesh.facets.size(); ++k)
    if (!(mesh.asked_sizes[k] > 0) || !std::isfinite(mesh.asked_sizes[k]))
      asked.note([&] { return fmt::format("facet {}: {}", k, mesh.asked_sizes[k]); });
  report.none("asked_size", asked, "facets whose `asked_size` is no positive number");
}

} // namespace

void check_sizes(const Mesh& mesh, Report& report) {
  check_points(mesh, report);
  check_facets(mesh, report);
}

} // namespace trime_check
