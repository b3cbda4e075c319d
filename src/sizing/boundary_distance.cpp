// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/boundary_distance.hpp"

#include "core/quoted.hpp"
#include "sizing/coarse_curves.hpp"
#include "trime/core/error.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace trime::sizing {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The part before the first dot of a name, and the words after it, which may be empty.
struct SplitName {
  std::string_view part, words;

  explicit SplitName(std::string_view name)
      : part(name.substr(0, name.find('.'))), words(part.size() < name.size() ? name.substr(part.size() + 1) : "") {}
};

bool has_name(std::string_view part, std::string_view name) {
  const SplitName split(part);
  return name.empty() || part == name || split.part == name || (!split.words.empty() && split.words == name);
}

std::vector<std::string> names_of(const std::vector<std::string>& parts) {
  std::set<std::string> names;
  for (const std::string& part : parts) {
    const SplitName split(part);
    names.emplace(split.part);
    if (!split.words.empty()) {
      names.insert(part);
      names.emplace(split.words);
    }
  }
  return {names.begin(), names.end()};
}

/// The pieces of the parts with this name, in the order of the boundary, as one open loop.
geometry::Boundary pieces_named(const geometry::Boundary& boundary, std::string_view name) {
  const std::vector<int> parts = parts_named(name, boundary.part_names);
  geometry::Boundary found;
  found.periods = boundary.periods;
  std::vector<geometry::Piece>& pieces = found.loops.emplace_back().pieces;
  for (const geometry::Loop& loop : boundary.loops)
    for (const geometry::Piece& piece : loop.pieces)
      if (name.empty() || std::binary_search(parts.begin(), parts.end(), piece.part))
        pieces.push_back(piece);
  if (pieces.empty())
    throw ConfigError(name.empty() ? "the shape has no boundary"
                                   : fmt::format("no edge of the boundary belongs to {}", trime::quoted(name)));
  return found;
}

} // namespace

std::vector<int> parts_named(std::string_view name, const std::vector<std::string>& part_names) {
  std::vector<int> found;
  for (std::size_t k = 0; k < part_names.size(); ++k)
    if (has_name(part_names[k], name))
      found.push_back(static_cast<int>(k));
  if (found.empty()) {
    const std::vector<std::string> known = names_of(part_names);
    throw ConfigError(fmt::format("no part of the boundary has the name {}{}; known names: {}", trime::quoted(name),
                                  suggestion(name, known), fmt::join(known, ", ")));
  }
  return found;
}

std::vector<std::string> curve_names(const geometry::Domain& domain) {
  std::vector<std::string> names = domain.boundary().part_names;
  names.insert(names.end(), domain.curves().names.begin(), domain.curves().names.end());
  for (std::size_t pair = 0; pair < domain.regions().pairs.size(); ++pair)
    names.push_back(domain.regions().pair_name(pair));
  if (!domain.fixed_points().empty())
    names.emplace_back(fixed_points_name);
  return names;
}

geometry::Boundary named_curves(const geometry::Domain& domain) {
  geometry::Boundary named = domain.boundary();
  const auto parts = static_cast<int>(named.part_names.size());
  const geometry::InnerCurves& inner = domain.curves();
  const geometry::Regions& regions = domain.regions();
  const int first_pair = parts + static_cast<int>(inner.names.size());
  named.part_names = curve_names(domain);
  for (const geometry::InnerArc& arc : inner.arcs)
    for (geometry::Piece& piece : named.loops.emplace_back(geometry::Loop{arc.pieces}).pieces) {
      piece.part = piece.part >= 0 ? parts + piece.part : first_pair + regions.pair_of(arc.left, arc.right);
      const geometry::Vec2 middle = 0.5 * (piece.start + piece.end), home = named.periods.wrap(middle) - middle;
      piece.start = piece.start + home; // an arc may lead far out of a periodic container
      piece.end = piece.end + home;
      piece.center = piece.center + home;
    }
  for (const geometry::FixedPoint& fixed : domain.fixed_points()) {
    geometry::Piece& point = named.loops.emplace_back().pieces.emplace_back();
    point.start = point.end = named.periods.wrap(fixed.position);
    point.part = static_cast<int>(named.part_names.size()) - 1;
  }
  return named;
}

Images images_of(const geometry::Domain& domain) {
  const geometry::Periods& periods = domain.boundary().periods;
  return {domain.frame().container(), periods.x, periods.y};
}

DistanceLookup distances_in(const geometry::Domain& domain) {
  return [&domain](const std::string& name) -> PlaceFunction {
    const auto curves = std::make_shared<const BoundaryDistance>(
        name.empty() ? domain.boundary() : named_curves(domain), name, images_of(domain));
    return [curves](double x, double y) { return curves->distance({x, y}); };
  };
}

BoundaryDistance::BoundaryDistance(const geometry::Boundary& boundary, std::string_view name, const Images& images)
    : images_(images) {
  constexpr int most_copies = 8;
  constexpr double between_copies = 4; // factor between the deviations of two copies
  constexpr double worth_a_copy = 0.5; // a copy with a larger share of the pieces saves little
  geometry::Boundary curves = pieces_named(boundary, name);
  std::vector<geometry::Piece> given = std::move(curves.loops.front().pieces);
  const geometry::Box box = boundary.bounding_box();
  double deviation = far_deviation * geometry::length(box.max - box.min); // the diagonal: no distance inside is larger
  for (int copy = 0; copy < most_copies; ++copy) {
    deviation /= between_copies;
    std::vector<geometry::Piece> coarse = coarse_curves(given, deviation);
    if (static_cast<double>(coarse.size()) > worth_a_copy * static_cast<double>(given.size()))
      break;
    curves.loops.front().pieces = std::move(coarse);
    copies_.push_back({deviation, PieceLocator(curves, images_)});
  }
  curves.loops.front().pieces = std::move(given);
  copies_.push_back({0, PieceLocator(curves, images_)});
}

double BoundaryDistance::distance(geometry::Vec2 p) const {
  return distance_within(p, infinity);
}

double BoundaryDistance::distance_within(geometry::Vec2 p, double reach) const {
  const geometry::Vec2 place = images_.wrap(p);
  double bound = reach;
  for (auto copy = copies_.begin(); copy != copies_.end();) {
    const auto nearest = copy->locator.nearest(place, bound + copy->deviation);
    if (!nearest)
      return bound;
    const double distance = geometry::length(nearest->point - place);
    const auto is_precise = [&](const Copy& c) { return c.deviation <= far_deviation * distance; };
    if (is_precise(*copy))
      return std::fmin(distance, bound);
    bound = std::fmin(bound, distance + copy->deviation);
    copy = std::find_if(std::next(copy), copies_.end(), is_precise);
  }
  return bound;
}

BoundarySize::BoundarySize(const SizeField& field, const geometry::Boundary& boundary,
                           const std::vector<NamedSize>& sizes, double gradation, const Images& images)
    : field_(field), gradation_(gradation) {
  std::map<int, const NamedSize*> size_of_part;
  for (const NamedSize& named : sizes) {
    for (const int part : parts_named(named.name, boundary.part_names)) {
      const NamedSize& first = *size_of_part.emplace(part, &named).first->second;
      if (first.size != named.size)
        throw ConfigError(fmt::format("the boundary {} has two sizes: {:.6g} as {} and {:.6g} as {}; name each "
                                      "part of the boundary once, by the text behind the dot of its name",
                                      trime::quoted(boundary.part_names[static_cast<std::size_t>(part)]), first.size,
                                      trime::quoted(first.name), named.size, trime::quoted(named.name)));
    }
    sources_.push_back({named.size, BoundaryDistance(boundary, named.name, images)});
  }
}

double BoundarySize::size(geometry::Vec2 p) const {
  double size = field_.size(p);
  if (!is_valid_size(size))
    return size;
  for (const Source& source : sources_)
    if (source.size < size) {
      const double reach = (size - source.size) / gradation_;
      const double distance = source.distance.distance_within(p, reach);
      if (distance < reach)
        size = std::fmin(size, source.size + gradation_ * distance);
    }
  return size;
}

} // namespace trime::sizing
