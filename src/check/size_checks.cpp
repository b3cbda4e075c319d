// SPDX-License-Identifier: BSD-3-Clause
#include "checks.hpp"
#include "config_text.hpp"
#include "inside.hpp"

#include <algorithm>

namespace trime_check {
namespace {

// A size is the length of the edges around it, within this factor: triangles may be four times worse than good ones.
constexpr double size_factor = 12;
// Tolerance of the mean over all edges: the file uses h in the middle of an edge, where a steep size differs from that
// at its ends.
constexpr double mean_factor = 1.5;
// Narrow places lower the size to no less of it (configs/boundaries.md).
constexpr double least_share = 0.05;
// Share of all points or facets that may be odd where the size is an expression.
constexpr double local_share = 0.25;
constexpr double floor_slack = 1.1; // the size changes along a facet
constexpr double single_precision = 1e-6;
// Gradation of the automatic size, if the config says `auto`.
constexpr double default_gradation = 0.1;
// Gradation of a uniform size that grows from parts of the boundary, if the config says `auto`.
constexpr double boundary_gradation = 0.15;
// Gradation where regions have sizes of their own, if the config says `auto`.
constexpr double region_gradation = 0.3;

struct Range {
  double low = 0, high = 0;
};

/// The sizes in the config.
struct Sizing {
  bool is_expression = false; ///< it may jump, so the size between points is anything
  double gradation = 0;       ///< it changes by no more per length
  bool may_be_raised = false; ///< a uniform size may be larger at places, so that no edge is too short

  explicit Sizing(const StoredFile& file) {
    const ConfigText config(file.text("/trime_mpi/config_resolved"), "");
    const std::string type = config.value("sizing", "type");
    is_expression = type == "expression" || config.has_section("size.");
    may_be_raised = config.number("sizing", "shortest_edge").has_value();
    const std::string size_at = config.value("sizing", "size_at");
    const bool in_regions = has_region_sizes(config);
    if (type == "uniform" && !is_expression && (size_at.empty() || size_at == "none") && !in_regions)
      return;
    const double automatic = in_regions ? region_gradation : type == "uniform" ? boundary_gradation : default_gradation;
    gradation = config.number("sizing", "gradation").value_or(automatic);
  }
};

/// Reports wrong sizes, except at a few places of an expression, which are not judged.
void judge(const std::string& name, const Tally& wrong, std::size_t all, const Sizing& sizing,
           const std::string& meaning, Report& report) {
  if (sizing.is_expression && wrong.count > 0 &&
      static_cast<double>(wrong.count) < local_share * static_cast<double>(all))
    report.skip(name, fmt::format("{} {}; this may be right, because the size is an expression, whose value may jump "
                                  "between points; first: {}",
                                  wrong.count, meaning, wrong.place));
  else
    report.none(name, wrong, meaning);
}

/// Returns the means of the edges at each point; 0 where there are no edges.
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

/// Below this a point of the boundary has a size that was lowered as far as it may be; 0 inside.
std::vector<double> lowest_sizes(const Mesh& mesh) {
  std::vector<double> lowest(mesh.points.size(), 0);
  for (std::size_t k = 0; k < mesh.facets.size(); ++k)
    for (const std::int64_t id : mesh.facets[k]) {
      double& least = lowest[static_cast<std::size_t>(id)];
      least = std::max(least, floor_slack * least_share * mesh.asked_sizes[k]);
    }
  return lowest;
}

/// Sizes are positive, and about as long as the edges there.
void check_points(const Mesh& mesh, const Sizing& sizing, Report& report) {
  const std::vector<double> means = mean_edges(mesh), lowest = lowest_sizes(mesh);
  const PointFinder crowded(crowded_points(mesh), mesh.periods);
  Tally wrong, not_positive;
  std::int64_t beside_fixed = 0, at_floor = 0;
  for (std::size_t i = 0; i < mesh.size.size(); ++i) {
    const double size = mesh.size[i], mean = means[i];
    const auto place = [&] {
      return fmt::format("point {} at {}: size {:.6g}, edges {:.6g}", i, place_of(mesh.points[i]), size, mean);
    };
    if (!(size > 0) || !std::isfinite(size))
      not_positive.note(place);
    else if (mean == 0 || (size * size_factor > mean && size < size_factor * mean))
      continue;
    else if (crowded.nearest(mesh.points[i]).distance < size)
      ++beside_fixed;
    else if (mean < size && size <= lowest[i])
      ++at_floor;
    else
      wrong.note(place);
  }
  std::string left_out;
  if (beside_fixed > 0)
    left_out += fmt::format("; {} more are not counted, because they lie next to fixed points that are closer to each "
                            "other or to the boundary than the size",
                            beside_fixed);
  if (at_floor > 0)
    left_out += fmt::format("; {} more are not counted, because they lie on the boundary where the size is lowered to "
                            "{} of the size asked for",
                            at_floor, least_share);
  report.none("positive_size", not_positive, "points whose `size` is not a positive number");
  judge("size", wrong, mesh.size.size(), sizing,
        fmt::format("points whose `size` differs from the mean length of their edges by more than a factor of {}{}",
                    size_factor, left_out),
        report);
}

/// @brief Bounds of the mean over all edges of their length over the size in their middle, by the sizes of their ends.
Range mean_ratios(const Mesh& mesh, const Sizing& sizing) {
  double low = 0, high = 0, count = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto corners = mesh.corners(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(t[k]), b = static_cast<std::size_t>(t[(k + 1) % 3]);
      const Point d = corners[(k + 1) % 3] - corners[k];
      const double length = std::hypot(d.x, d.y), change = sizing.gradation * length / 2;
      const double share = mesh.boundary[a] != 0 && mesh.boundary[b] != 0 ? 1 : 0.5; // edges inside are met twice
      low += share * length / (std::max(mesh.size[a], mesh.size[b]) + change);
      high += share * length / std::min(mesh.size[a], mesh.size[b]);
      count += share;
    }
  }
  return {low / count, high / count};
}

void check_mean(const StoredFile& file, const Mesh& mesh, const Sizing& sizing, Report& report) {
  if (sizing.is_expression) {
    report.skip("size_mean", "the size is an expression, whose value may jump between points");
    return;
  }
  const double stored = file.number("/trime_mpi/quality", "size_mean").value_or(0);
  const Range found = mean_ratios(mesh, sizing);
  report.add(
      "size_mean", stored * mean_factor >= found.low && stored <= found.high * mean_factor,
      fmt::format("{:.6g}", stored), fmt::format("{:.6g} to {:.6g}", found.low, found.high),
      fmt::format(
          "mean of edge length divided by `size`; expected is `size_mean` of /trime_mpi/quality, within a factor of {}",
          mean_factor));
}

/// Positive, and related to the sizes of the points; where the size is uniform all are the same.
void check_facets(const StoredFile& file, const Mesh& mesh, const Sizing& sizing, Report& report) {
  const double lowest = std::min(1.0, file.number("/trime_mpi", "lowest_size_share").value_or(least_share));
  const bool is_uniform = file.text_attribute("/trime_mpi", "sizing") == "uniform";
  const std::optional<double> length = file.number("/trime_mpi", "edge_length");
  Tally asked, unrelated;
  for (std::size_t k = 0; k < mesh.facets.size(); ++k) {
    const double size = mesh.asked_sizes[k], a = mesh.size[static_cast<std::size_t>(mesh.facets[k][0])],
                 b = mesh.size[static_cast<std::size_t>(mesh.facets[k][1])];
    const auto place = [&] { return fmt::format("facet {}: {:.6g}, points {:.6g} and {:.6g}", k, size, a, b); };
    const double most = single_precision * length.value_or(0);
    if (!(size > 0) || !std::isfinite(size) ||
        (is_uniform && length && (size < *length - most || (size > *length + most && !sizing.may_be_raised))))
      asked.note(place);
    else if (size * size_factor <= std::min(a, b) || size * lowest >= size_factor * std::max(a, b))
      unrelated.note(place);
  }
  report.none("asked_size", asked,
              "facets whose `asked_size` is not positive, or differs from edge_length although the size is uniform");
  judge("asked_to_size", unrelated, mesh.facets.size(), sizing,
        fmt::format("facets whose `asked_size` differs by more than a factor of {} from the `size` of their points, "
                    "which may be lowered to {:.3g} of it",
                    size_factor, lowest),
        report);
}

} // namespace

void check_sizes(const StoredFile& file, const Mesh& mesh, Report& report) {
  const Sizing sizing(file);
  check_points(mesh, sizing, report);
  check_mean(file, mesh, sizing, report);
  check_facets(file, mesh, sizing, report);
}

} // namespace trime_check
