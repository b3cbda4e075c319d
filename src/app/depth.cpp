// SPDX-License-Identifier: BSD-3-Clause
#include "app/depth.hpp"

#include "core/thread_loop.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>

namespace trime::app {

namespace {

// [1] If a larger share of the points has no positive depth, the sign of the depth is probably wrong.
constexpr double most_dry = 0.5;

void count(double depth, DepthSummary& summary) {
  ++summary.points;
  if (!std::isfinite(depth))
    return;
  ++summary.numbers;
  summary.positive += depth > 0;
  summary.negative += depth < 0;
  summary.least = std::fmin(summary.least, depth);
  summary.most = std::fmax(summary.most, depth);
}

bool is_variable(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0;
  });
}

/// The formula with the other sign.
std::string negated(const std::string& formula) {
  if (is_variable(formula))
    return "-" + formula;
  return formula.starts_with('-') && is_variable(std::string_view(formula).substr(1)) ? formula.substr(1)
                                                                                      : fmt::format("-({})", formula);
}

/// @param where_they_are "of the mesh", for example
void warn_of_depths(const DistanceFormula& formula, const DepthSummary& s, const char* where_they_are, Log& log) {
  if (s.numbers < s.points)
    log.warning("{}: '{}' is not a number at {} of {} points {}, the first one at {}", formula.where(), formula.text(),
                s.points - s.numbers, s.points, where_they_are, Place(s.first_without, 6));
  if (const std::int64_t dry = s.numbers - s.positive;
      static_cast<double>(dry) > most_dry * static_cast<double>(s.points))
    log.warning("{}: '{}' is not positive at {} of {} points {}, which are dry then: depths are positive downwards. If "
                "the sign is wrong, write 'depth = {}'",
                formula.where(), formula.text(), dry, s.points, where_they_are, negated(formula.text()));
}

/// The place of the first point without a number. Collective.
geometry::Vec2 first_without(const mesh::DistributedMesh& mesh, const comm::Communicator& comm) {
  const auto bad = std::ranges::find_if(*mesh.depth, [](double value) { return !std::isfinite(value); });
  const GlobalId none = mesh.point_slab.total;
  const GlobalId here = bad == mesh.depth->end() ? none : mesh.point_slab.first + (bad - mesh.depth->begin());
  std::array<double, 2> place{-INFINITY, -INFINITY};
  const GlobalId first = comm.min(here);
  if (here != none && here == first) {
    const geometry::Vec2 p = mesh.points[static_cast<std::size_t>(here - mesh.point_slab.first)];
    place = {p.x, p.y};
  }
  comm.max(place);
  return {place[0], place[1]};
}

/// Collective.
DepthSummary summary_of(const mesh::DistributedMesh& mesh, const comm::Communicator& comm) {
  DepthSummary here;
  for (const double depth : *mesh.depth)
    count(depth, here);
  std::array sums{here.points, here.numbers, here.positive, here.negative};
  comm.sum(sums);
  DepthSummary all{sums[0], sums[1], sums[2], sums[3], comm.min(here.least), comm.max(here.most), {}};
  if (all.numbers < all.points)
    all.first_without = first_without(mesh, comm);
  return all;
}

} // namespace

DepthSummary add_depth(const DistanceFormula& formula, meshing::MeshResult& result, const comm::Communicator& comm,
                       Log& log) {
  mesh::DistributedMesh& mesh = result.mesh;
  UnsetVector<double>& depth = mesh.depth.emplace();
  depth.resize(mesh.points.size());
  constexpr std::ptrdiff_t chunk = 256; // points per turn of a thread
  thread_loop(std::ssize(depth), chunk, [&](std::ptrdiff_t item, int) {
    const auto k = static_cast<std::size_t>(item);
    depth[k] = formula.evaluate(mesh.points[k].x, mesh.points[k].y);
  });
  const DepthSummary summary = summary_of(mesh, comm);
  result.checks.push_back({"depths", static_cast<double>(summary.points), static_cast<double>(summary.numbers),
                           summary.numbers == summary.points,
                           fmt::format("points whose depth is a number; 'depth = {}' in [output] must be one at every "
                                       "point of the mesh",
                                       formula.text())});
  warn_of_depths(formula, summary, "of the mesh", log);
  if (summary.numbers > 0)
    log.summary("depths from {:.6g} to {:.6g}; {} of {} points have a negative depth", summary.least, summary.most,
                summary.negative, summary.points);
  return summary;
}

io::MetadataGroup group_of(const DepthSummary& summary) {
  return {"depth",
          {{"numbers", summary.numbers},
           {"positive", summary.positive},
           {"negative", summary.negative},
           {"least", summary.least},
           {"most", summary.most}},
          {}};
}

void try_depth(const DistanceFormula& formula, std::span<const geometry::Vec2> places, Log& log) {
  DepthSummary summary;
  for (const geometry::Vec2 p : places) {
    const double depth = formula.evaluate(p.x, p.y);
    if (!std::isfinite(depth) && summary.numbers == summary.points)
      summary.first_without = p;
    count(depth, summary);
  }
  warn_of_depths(formula, summary, "where the shape was tried", log);
}

} // namespace trime::app
