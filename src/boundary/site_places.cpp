// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/site_places.hpp"

#include "boundary/rules.hpp"
#include <algorithm>
#include <cmath>

namespace trime::boundary {

using geometry::Vec2;

namespace {

// [levels] Bounds that thinning; deeper, all places stay.
constexpr int deepest_division = 64;

/// Both ends and the junctions between them.
std::vector<SitePlace> junctions_between(const LoopMetric& metric, double t0, double t1,
                                         const geometry::Lattice& lattice) {
  const auto n = static_cast<LocalIndex>(metric.loop().pieces.size());
  std::vector<SitePlace> places;
  double shift = 0;
  Vec2 moved{};
  LocalIndex i = 0;
  const auto junction_t = [&] { return metric.piece_t(static_cast<std::size_t>(i)) + shift; };
  const auto advance = [&] {
    if (++i == n) {
      i = 0;
      shift += metric.total();
      moved = moved + metric.loop().winding;
    }
  };
  const auto add = [&](double t) {
    if (junction_t() == t)
      places.push_back({t, metric.loop().pieces[static_cast<std::size_t>(i)].start + moved, 0, 0, i});
    else
      places.push_back({t, lattice.snap(metric.point(t))});
  };
  i = metric.first_junction_from(t0 >= metric.total() ? t0 - metric.total() : t0);
  if (t0 >= metric.total()) {
    shift = metric.total();
    moved = metric.loop().winding;
  }
  if (i == n) {
    i = n - 1;
    advance();
  }
  add(t0);
  if (junction_t() == t0)
    advance();
  for (; junction_t() < t1; advance())
    add(junction_t());
  add(t1);
  return places;
}

/// Marks the places to keep between two kept ones.
void mark_kept(const std::vector<SitePlace>& places, std::vector<char>& kept) {
  struct Part {
    std::size_t from, to;
    int depth;
  };
  std::vector<Part> parts{{0, places.size() - 1, 0}};
  kept.front() = kept.back() = 1;
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    const Vec2 a = places[part.from].position, along = places[part.to].position - a;
    const double squared = geometry::squared_length(along);
    std::size_t farthest = part.from;
    double most = -1;
    bool far = false;
    for (std::size_t k = part.from + 1; k < part.to; ++k) {
      const Vec2 p = places[k].position - a;
      const double share = squared > 0 ? std::clamp(geometry::dot(p, along) / squared, 0.0, 1.0) : 0;
      const double distance = geometry::squared_length(p - share * along),
                   limit = BoundaryRules::place_thinning * places[k].tolerance;
      far |= distance > limit * limit;
      if (distance > most) {
        most = distance;
        farthest = k;
      }
    }
    if (!far)
      continue;
    if (part.depth == deepest_division) {
      std::fill(kept.begin() + static_cast<std::ptrdiff_t>(part.from),
                kept.begin() + static_cast<std::ptrdiff_t>(part.to), 1);
      continue;
    }
    kept[farthest] = 1;
    parts.push_back({part.from, farthest, part.depth + 1});
    parts.push_back({farthest, part.to, part.depth + 1});
  }
}

} // namespace

std::vector<SitePlace> places_between(const LoopMetric& metric, double t0, double t1, const geometry::Lattice& lattice,
                                      const FeatureTolerance& tolerance) {
  std::vector<SitePlace> junctions = junctions_between(metric, t0, t1, lattice);
  const auto measure = [&](SitePlace& place) {
    const SizePair sizes = metric.sizes(place.t);
    place.size = sizes.size;
    place.tolerance = tolerance.at(sizes.asked);
  };
  for (SitePlace& place : junctions)
    measure(place);
  std::vector<char> kept(junctions.size(), 0);
  mark_kept(junctions, kept);
  std::vector<SitePlace> places;
  for (std::size_t k = 0; k < junctions.size(); ++k) {
    if (!kept[k])
      continue;
    if (!places.empty()) {
      const SitePlace from = places.back(), &to = junctions[k];
      const double h = std::fmin(from.size, to.size);
      const double parts =
          std::ceil(geometry::length(to.position - from.position) / (BoundaryRules::place_spacing * h));
      for (double part = 1; part < parts; ++part) {
        SitePlace place{from.t + (to.t - from.t) * (part / parts), {}};
        place.position = lattice.snap(metric.point(place.t));
        measure(place);
        if (place.position != places.back().position && place.position != to.position)
          places.push_back(place);
      }
    }
    places.push_back(junctions[k]);
  }
  return places;
}

} // namespace trime::boundary
