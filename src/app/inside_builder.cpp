// SPDX-License-Identifier: BSD-3-Clause
#include "app/inside_builder.hpp"

#include "contours/map_features.hpp"
#include "core/quoted.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>

namespace trime::app {
namespace {

// [warnings] Each one names a pair of regions that share an area.
constexpr std::size_t most_overlaps = 3;

/// The name of a curve or a region: NAME, or NAME.VALUE for a value of an attribute.
std::string name_of_value(const std::string& name, int marker, const contours::Contour& contour) {
  const std::vector<std::string>& values = contour.marker_names;
  return marker == 0      ? name
         : values.empty() ? fmt::format("{}.{}", name, marker)
                          : name + "." + values[static_cast<std::size_t>(marker - 1)];
}

/// The curves NAME, or NAME.VALUE for each value of an attribute, in the order of their first lines.
void add_lines(const CurveOptions& options, const contours::Contour& contour, const contours::Normalization& place,
               const geometry::Frame& frame, shape::InnerParts& parts) {
  std::map<int, std::size_t> number_of; // by marker
  std::vector<std::string> names;
  std::vector<std::vector<shape::CurveLine>> lines;
  for (const contours::ContourRing& ring : contour.rings) {
    const int marker = ring.markers.empty() ? 0 : ring.markers.front();
    const auto [found, is_new] = number_of.try_emplace(marker, names.size());
    if (is_new) {
      names.push_back(name_of_value(options.name, marker, contour));
      lines.emplace_back();
    }
    shape::CurveLine& line = lines[found->second].emplace_back();
    line.closed = !ring.open;
    for (std::size_t k = 0; k < ring.points.size(); ++k) {
      line.points.push_back(place.apply(ring.points[k]));
      line.labels.push_back(contours::where(contour, ring.lines[k]));
    }
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    parts.curves.push_back(shape::Part::curve(names[k], std::move(lines[k]), frame));
    parts.clip.push_back(options.clip ? 1 : 0);
    parts.kinds.push_back(options.kind);
  }
}

/// The polygons of a file by the value of their attribute, in the order of the first ring of each.
std::vector<std::pair<std::string, contours::Contour>> divided(const std::string& name,
                                                               const contours::Contour& contour) {
  std::map<int, std::size_t> number_of; // by marker
  std::vector<std::pair<std::string, contours::Contour>> all;
  for (const contours::ContourRing& ring : contour.rings) {
    const int marker = ring.markers.empty() ? 0 : ring.markers.front();
    const auto [found, is_new] = number_of.try_emplace(marker, all.size());
    if (is_new) {
      contours::Contour& one = all.emplace_back(name_of_value(name, marker, contour), contours::Contour()).second;
      one.source = contour.source;
      one.features = contour.features;
      one.crs = contour.crs;
      one.is_map = contour.is_map;
      one.is_raster = contour.is_raster;
      one.in_degrees = contour.in_degrees;
    }
    contours::ContourRing& copy = all[found->second].second.rings.emplace_back(ring);
    copy.markers.clear();
  }
  return all;
}

void tell_of_file(const contours::Contour& contour, Log& log) {
  for (const std::string& warning : contour.warnings)
    log.warning("{}", warning);
}

/// Warns of features without the attribute that names regions or curves: they share one name. An integer of 0 counts as
/// no value.
void tell_of_missing_values(const contours::Contour& contour, const std::string& attribute, const std::string& name,
                            Log& log) {
  if (attribute.empty())
    return;
  std::set<int> features; // by number, or by line
  for (const contours::ContourRing& ring : contour.rings)
    if ((ring.markers.empty() || ring.markers.front() == 0) && !ring.lines.empty())
      features.insert(ring.lines.front());
  if (!features.empty())
    log.warning("{}: {} feature{} no value of the attribute '{}', or the value 0, and {} '{}'; the first one is {}",
                contour.source, features.size(), features.size() == 1 ? " has" : "s have", attribute,
                features.size() == 1 ? "belongs to" : "belong to", name, contours::where(contour, *features.begin()));
}

} // namespace

void InsideBuilder::add_curve(const CurveOptions& curve, const contours::Contour& contour,
                              const contours::Normalization& place) {
  add_lines(curve, contour, place, frame_, parts);
  tell_of_file(contour, log_);
  tell_of_missing_values(contour, curve.attribute, curve.name, log_);
}

void InsideBuilder::add_region(const RegionOptions& region, const contours::Contour& contour,
                               const contours::Normalization& place) {
  shape::Division& division = parts.division;
  if (region.file.empty()) {
    division.regions.push_back({region.name, region.geometry});
    return;
  }
  tell_of_file(contour, log_);
  tell_of_missing_values(contour, region.attribute, region.name, log_);
  add_area_limits(region, contour, place.scale);
  const bool share_borders = contour.is_map || (!contour.marker_names.empty() && !contour.is_raster);
  for (const auto& [name, polygons] : divided(region.name, contour)) {
    division.regions.push_back({name, {}, static_cast<int>(division.parts.size())});
    division.parts.push_back(
        shape::Part::contour(name, polygons, place, frame_,
                             {.dissolve = share_borders, .faults = contours::Faults::refuse, .keep_touches = true}));
    for (const std::string& warning : division.parts.back().warnings())
      log_.warning("{}", warning);
  }
}

/// Notes the largest sizes in the regions of a file. @param scale lengths in the container over those in the file
void InsideBuilder::add_area_limits(const RegionOptions& region, const contours::Contour& contour, double scale) {
  if (contour.largest_areas.empty()) {
    if (region.area_limits)
      log_.warning("{}: 'area_limits = true' in [region.{}] has no effect: no region point has a largest area",
                   contour.source, region.name);
    return;
  }
  if (!region.area_limits) {
    log_.warning("{}: the largest areas of the region points are not used; 'area_limits = true' in [region.{}] "
                 "bounds the size by them",
                 contour.source, region.name);
    return;
  }
  const std::vector<std::pair<std::string, contours::Contour>> regions = divided(region.name, contour);
  for (std::size_t k = 0; k < regions.size(); ++k) // both are in the order of the markers
    if (const double area = contour.largest_areas[k]; std::isfinite(area))
      bounds.push_back({static_cast<int>(parts.division.regions.size() + k) + 1,
                        scale * std::sqrt(4 * area / std::numbers::sqrt3)}); // an equilateral triangle
}

namespace {

/// Says which curves do not lie inside, and where their names are lost.
void tell_of(const geometry::InnerCurves& curves, Log& log) {
  std::vector<char> is_inside(curves.names.size(), 0);
  for (const geometry::InnerArc& arc : curves.arcs)
    for (const geometry::Piece& piece : arc.pieces)
      if (piece.part >= 0)
        is_inside[static_cast<std::size_t>(piece.part)] = 1;
  for (std::size_t k = 0; k < curves.on_boundary.size(); ++k) {
    if (curves.outside[k] > 0)
      log.summary("curve '{}': a length of {:.6g} lies outside of the shape and is left out", curves.names[k],
                  curves.outside[k]);
    if (is_inside[k] == 0 && curves.on_boundary[k] > 0 && !(curves.outside[k] > 0)) {
      log.summary("curve '{}' lies on the boundary of the shape; the edges there have only the name of the boundary",
                  curves.names[k]);
      continue;
    }
    if (curves.on_boundary[k] > 0)
      log.warning(
          "curve '{}': a length of {:.6g} lies on the boundary of the shape; the edges there have only the name "
          "of the boundary",
          curves.names[k], curves.on_boundary[k]);
    if (is_inside[k] == 0)
      log.warning("curve '{}' has no edges: no part of it lies inside the shape and away from other curves",
                  curves.names[k]);
  }
}

/// Says which small faces belong to others, and warns of gaps.
void tell_of(const geometry::AbsorbedFaces& absorbed, Log& log) {
  if (absorbed.count > 0)
    log.summary(
        "{} part{} of regions with a total area of {:.6g} {} smaller or narrower than the triangles and {} to the "
        "region next to {}; the largest has an area of {:.6g} and lies at {}. keep_features = true keeps all",
        absorbed.count, absorbed.count == 1 ? "" : "s", absorbed.area, absorbed.count == 1 ? "is" : "are",
        absorbed.count == 1 ? "belongs" : "belong", absorbed.count == 1 ? "it" : "them", absorbed.largest,
        Place(absorbed.place, 6));
  std::int64_t gaps = 0;
  geometry::RegionLoss largest;
  for (const geometry::RegionLoss& face : absorbed.faces)
    if (face.loser == 0 && face.reason == geometry::LossReason::sliver) {
      ++gaps;
      largest = face.area > largest.area ? face : largest;
    }
  if (gaps > 0)
    log.warning("{} gap{} between regions {} narrower than the triangles and {} closed; the largest has an area of "
                "{:.6g} and passes {}. If {} meant, name the rest by 'rest' in [shape], or set keep_features = true",
                gaps, gaps == 1 ? "" : "s", gaps == 1 ? "is" : "are", gaps == 1 ? "is" : "are", largest.area,
                Place(largest.place, 6), gaps == 1 ? "it is" : "they are");
}

/// Says what regions share, what of them lies outside, and how large they are.
void tell_of(const geometry::Regions& regions, Log& log) {
  if (!regions.any())
    return;
  std::vector<geometry::RegionOverlap> overlaps = regions.overlaps;
  std::stable_sort(overlaps.begin(), overlaps.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
  for (std::size_t k = 0; k < std::min(overlaps.size(), most_overlaps); ++k) {
    const std::string& first = regions.names[static_cast<std::size_t>(overlaps[k].first)];
    log.warning("the regions '{}' and '{}' share an area of {:.6g}, for example at {}; it belongs to '{}', which comes "
                "first",
                first, regions.names[static_cast<std::size_t>(overlaps[k].second)], overlaps[k].area,
                Place(overlaps[k].place, 6), first);
  }
  if (overlaps.size() > most_overlaps)
    log.warning("{} more pairs of regions share smaller areas, which belong to the first region of each pair",
                overlaps.size() - most_overlaps);
  tell_of(regions.absorbed, log);
  for (std::size_t k = 1; k < regions.names.size(); ++k)
    if (regions.outside[k] > 0)
      log.summary("region '{}': an area of {:.6g} lies outside of the shape and is left out", regions.names[k],
                  regions.outside[k]);
}

} // namespace

void tell_of_inside(const geometry::Domain& domain, Log& log) {
  tell_of(domain.curves(), log);
  tell_of(domain.regions(), log);
}

} // namespace trime::app
