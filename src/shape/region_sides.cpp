// SPDX-License-Identifier: BSD-3-Clause
#include "shape/region_sides.hpp"

#include "geometry/narrow_wedges.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <set>

namespace trime::shape {
namespace {

// [area of the smaller region] Overlaps that are smaller come from the digits of maps, and nobody is warned of them.
constexpr double overlap_share = 1e-6;

// [smallest perimeter of a face] Regions with a shorter perimeter may go to a neighbour where the triangles become
// larger than expected. Then their neighbours touch.
constexpr double small_perimeter = 4;

using Pairs = std::set<std::array<int, 2>>;

/// Adds the pairs of the neighbours of each small region.
void add_neighbours(const std::vector<double>& perimeters, double least, Pairs& pairs) {
  std::vector<std::vector<int>> neighbours(perimeters.size());
  for (const auto& [a, b] : pairs) {
    neighbours[static_cast<std::size_t>(a)].push_back(b);
    neighbours[static_cast<std::size_t>(b)].push_back(a);
  }
  for (std::size_t k = 0; k < perimeters.size(); ++k)
    if (perimeters[k] < least)
      for (const int a : neighbours[k])
        for (const int b : neighbours[k])
          if (a < b)
            pairs.insert({a, b});
}

/// Returns the length of the border of each region.
std::vector<double> perimeters_of(const std::vector<geometry::InnerArc>& arcs, const geometry::Boundary& boundary,
                                  std::size_t regions) {
  std::vector<double> perimeters(regions, 0);
  for (const geometry::InnerArc& arc : arcs)
    if (arc.left != arc.right)
      for (const geometry::Piece& piece : arc.pieces)
        for (const int region : {arc.left, arc.right})
          perimeters[static_cast<std::size_t>(region)] += piece.length();
  for (const geometry::Loop& loop : boundary.loops)
    for (const geometry::Piece& piece : loop.pieces)
      perimeters[static_cast<std::size_t>(piece.region)] += piece.length();
  return perimeters;
}

} // namespace

RegionSides::RegionSides(const Division& division, std::span<const std::string> part_names)
    : division_(division), regions_of_(part_names.size() + 1 + division.parts.size()) {
  const std::size_t count = division.regions.size();
  expressions_.reserve(count); // the states refer to them
  for (const NamedRegion& region : division.regions)
    try {
      expressions_.push_back(region.part >= 0
                                 ? Region::of_part(static_cast<int>(part_names.size()) + 1 + region.part, region.name)
                                 : Region::parse(region.geometry, part_names));
    } catch (const Error& error) {
      throw ConfigError(fmt::format("region '{}': {}", region.name, error.what()));
    }
  for (std::size_t k = 0; k < count; ++k) {
    states_.emplace_back(expressions_[k], regions_of_.size());
    for (const int part : expressions_[k].parts())
      regions_of_[static_cast<std::size_t>(part)].push_back(k + 1);
  }
  for (std::vector<double>* areas : {&areas_, &given_, &outside_})
    areas->assign(count + 1, 0);
}

std::vector<int> RegionSides::parts() const {
  std::set<int> all;
  for (const Region& expression : expressions_)
    all.insert(expression.parts().begin(), expression.parts().end());
  return {all.begin(), all.end()};
}

int RegionSides::at(std::span<const int> parts, bool is_in_shape, double twice_area, geometry::Vec2 place) {
  candidates_.clear();
  for (const int part : parts)
    for (const std::size_t region : regions_of_[static_cast<std::size_t>(part)]) {
      states_[region - 1].enter(part);
      candidates_.push_back(region);
    }
  std::sort(candidates_.begin(), candidates_.end());
  candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
  holders_.clear();
  for (const std::size_t region : candidates_)
    if (states_[region - 1].contains())
      holders_.push_back(region);
  for (const int part : parts)
    for (const std::size_t region : regions_of_[static_cast<std::size_t>(part)])
      states_[region - 1].leave(part);
  for (const std::size_t region : holders_)
    (is_in_shape ? given_ : outside_)[region] += 0.5 * twice_area;
  if (!is_in_shape)
    return 0;
  const std::size_t first = holders_.empty() ? 0 : holders_.front();
  areas_[first] += 0.5 * twice_area;
  if (first == 0)
    place_of_rest_ = place;
  for (std::size_t k = 1; k < holders_.size(); ++k) {
    Area& overlap = overlaps_[{first, holders_[k]}];
    overlap.twice += twice_area;
    overlap.place = place;
  }
  return static_cast<int>(first);
}

void RegionSides::check(double least, const std::string& text) const {
  for (std::size_t region = 1; region < areas_.size(); ++region)
    if (!(areas_[region] > least))
      report_empty(region, least, text);
  if (division_.cover_all && areas_[0] > least)
    throw GeometryError(
        fmt::format("cover = all in [shape], but an area of {:.9g} of the geometry '{}' belongs to no region; its "
                    "boundary passes {}. Enlarge a region, or leave 'cover' out and name the rest by 'rest'",
                    areas_[0], text, Place(place_of_rest_, 10)));
}

void RegionSides::report_empty(std::size_t region, double least, const std::string& text) const {
  const std::string head = fmt::format("region '{}' (geometry '{}') ", name(region), expressions_[region - 1].text());
  if (given_[region] <= least && outside_[region] > least)
    throw GeometryError(fmt::format("{}lies outside of the shape '{}': expected a region that shares an area with it; "
                                    "move the region or its parts, or remove its section",
                                    head, text));
  if (given_[region] <= least)
    throw GeometryError(
        fmt::format("{}is empty: no point lies in it; check its parts and the order of the operands", head));
  std::string hiding;
  for (const auto& [pair, area] : overlaps_)
    if (pair[1] == region && 0.5 * area.twice > least)
      hiding += fmt::format("{}'{}'", hiding.empty() ? "" : ", ", name(pair[0]));
  throw GeometryError(
      fmt::format("{}has no area that is left to it: it lies in the regions before it ({}); put its section "
                  "before theirs, since the first region that contains a place has it",
                  head, hiding));
}

geometry::Regions RegionSides::regions(const std::vector<geometry::InnerArc>& arcs, const geometry::Boundary& boundary,
                                       double least, const std::string& text) const {
  geometry::Regions regions{{division_.rest.empty() ? text : division_.rest}, {}, areas_, outside_};
  for (std::size_t k = 1; k < outside_.size(); ++k)
    regions.outside[k] = outside_[k] > least ? outside_[k] : 0;
  for (const NamedRegion& region : division_.regions)
    regions.names.push_back(region.name);
  Pairs pairs;
  for (const geometry::InnerArc& arc : arcs)
    if (arc.left != arc.right)
      pairs.insert({std::min(arc.left, arc.right), std::max(arc.left, arc.right)});
  if (!boundary.periods.any()) { // parts of periodic containers are neither cut nor given away
    for (const geometry::NarrowWedge& wedge : geometry::narrow_wedges(arcs, boundary))
      if (wedge.left_region != wedge.right_region)
        pairs.insert(
            {std::min(wedge.left_region, wedge.right_region), std::max(wedge.left_region, wedge.right_region)});
    add_neighbours(perimeters_of(arcs, boundary, regions.names.size()), small_perimeter * division_.least_perimeter,
                   pairs);
  }
  regions.pairs.assign(pairs.begin(), pairs.end());
  for (const auto& [pair, area] : overlaps_)
    if (0.5 * area.twice > std::max(least, overlap_share * std::min(given_[pair[0]], given_[pair[1]])))
      regions.overlaps.push_back({static_cast<int>(pair[0]), static_cast<int>(pair[1]), 0.5 * area.twice, area.place});
  return regions;
}

} // namespace trime::shape
