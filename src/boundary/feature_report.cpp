// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/feature_report.hpp"

#include "boundary/rules.hpp"
#include "core/angle.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace trime::boundary {
namespace {

using geometry::Vec2;
using polygon::BoundarySites;

/// Interior angle of the polygon of chords at site k, degrees.
double interior_angle(const BoundarySites& boundary, LocalIndex k) {
  const geometry::Segment out = boundary.chord(k),
                          in = boundary.chord(boundary.sites[static_cast<std::size_t>(k)].previous);
  const Vec2 ahead = out.b - out.a, back = in.a - in.b;
  const double angle = angle_of(cross(ahead, back), dot(ahead, back)) * (180 / pi);
  return angle < 0 ? angle + 360 : angle;
}

std::string counted(GlobalId count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

} // namespace

FeatureReport report_features(const BoundarySites& boundary, std::span<const sizing::SizeLimit> limits,
                              const sizing::SizeField& asked) {
  FeatureReport report;
  report.dropped_islands = boundary.dropped.components;
  report.dropped_lakes = boundary.dropped.holes;
  report.dropped_area = boundary.dropped.area;
  report.dropped_share = boundary.dropped.share;
  report.corners_left_out = boundary.left_out;
  report.largest_deviation = boundary.deviation;
  report.segments_halved = boundary.halvings;
  report.size_limits = std::ssize(limits);
  for (const sizing::SizeLimit& limit : limits)
    report.lowest_size_share = std::fmin(report.lowest_size_share, limit.size / asked.size(limit.place));
  for (std::size_t k = 0; k < boundary.sites.size(); ++k)
    if (boundary.sites[k].corner)
      if (const double angle = interior_angle(boundary, static_cast<LocalIndex>(k)); angle < FeatureReport::sharp_angle)
        report.sharp_corners.push_back({boundary.sites[k].position, angle});
  std::stable_sort(report.sharp_corners.begin(), report.sharp_corners.end(),
                   [](const SharpCorner& a, const SharpCorner& b) { return a.degrees < b.degrees; });
  return report;
}

std::vector<std::string> describe(const FeatureReport& report) {
  constexpr std::size_t most_listed = 5;
  std::vector<std::string> lines;
  if (report.dropped_islands + report.dropped_lakes > 0)
    lines.push_back(fmt::format("{} and {} with a perimeter below {:g} local sizes dropped, {:.3g} of the area",
                                counted(report.dropped_islands, "island", "islands"),
                                counted(report.dropped_lakes, "lake", "lakes"), BoundaryRules::least_perimeter,
                                report.dropped_share));
  if (report.corners_left_out > 0)
    lines.push_back(fmt::format("{} below the resolution left out, at most {:.2f} local sizes from the facets",
                                counted(report.corners_left_out, "corner", "corners"), report.largest_deviation));
  if (report.segments_halved > 0)
    lines.push_back(fmt::format("{} halved: another part of the boundary is near, or the curve bends",
                                counted(report.segments_halved, "chord was", "chords were")));
  if (report.size_limits > 0)
    lines.push_back(
        fmt::format("size lowered at {}, down to {:.2g} of what was asked for: channels and corners are narrower",
                    counted(report.size_limits, "place", "places"), report.lowest_size_share));
  if (!report.sharp_corners.empty()) {
    std::string list;
    for (std::size_t k = 0; k < std::min(most_listed, report.sharp_corners.size()); ++k)
      list += fmt::format("{}{:.1f} at ({:.6g}, {:.6g})", k == 0 ? "" : ", ", report.sharp_corners[k].degrees,
                          report.sharp_corners[k].place.x, report.sharp_corners[k].place.y);
    lines.push_back(fmt::format("{} of less than {:g} degrees, where smaller angles cannot be avoided: {}{}",
                                counted(std::ssize(report.sharp_corners), "corner", "corners"),
                                FeatureReport::sharp_angle, list,
                                report.sharp_corners.size() > most_listed ? ", ..." : ""));
  }
  return lines;
}

} // namespace trime::boundary
