// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/regions.hpp"

#include "generalise/rules.hpp"

namespace trime::generalise {

using HalfEdge = Triangulation::HalfEdge;

Regions::Regions(const CurveMap& map, const std::vector<char>& labels) : region_(labels.size(), Triangulation::none) {
  const Triangulation& mesh = map.mesh();
  around_ = Triangulation::triangle(mesh.leaving(0));
  std::vector<LocalIndex> open;
  for (LocalIndex first = 0; first < mesh.triangle_count(); ++first) {
    if (region_[at(first)] != Triangulation::none)
      continue;
    const LocalIndex region = count();
    perimeter_.push_back(0);
    holds_kept_.push_back(0);
    region_[at(first)] = region;
    open.push_back(first);
    while (!open.empty()) {
      const LocalIndex t = open.back();
      open.pop_back();
      for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e) {
        if (mesh.twin(e) == Triangulation::none)
          continue;
        const LocalIndex there = Triangulation::triangle(mesh.twin(e));
        const LocalIndex a = mesh.origin(e), b = mesh.target(e);
        if (labels[at(there)] != labels[at(t)]) {
          perimeter_.back() += 2 * length(mesh.point(b) - mesh.point(a)) / (map.size(a) + map.size(b));
          holds_kept_.back() |= map.is_kept(a);
        } else if (region_[at(there)] == Triangulation::none) {
          region_[at(there)] = region;
          open.push_back(there);
        }
      }
    }
  }
}

std::int64_t fill_small_holes(const CurveMap& map, const Regions& regions, std::vector<char>& labels) {
  const auto is_small_hole = [&](LocalIndex t) {
    const LocalIndex region = regions.of(t);
    return !labels[at(t)] && region != regions.around() && !regions.holds_kept(region) &&
           regions.perimeter(region) < GeneraliseRules::smallest_hole;
  };
  std::vector<char> filled(at(regions.count()));
  for (LocalIndex t = 0; t < map.mesh().triangle_count(); ++t)
    if (is_small_hole(t))
      filled[at(regions.of(t))] = 1;
  std::int64_t count = 0;
  for (const char one : filled)
    count += one;
  for (LocalIndex t = 0; t < map.mesh().triangle_count(); ++t)
    if (filled[at(regions.of(t))])
      labels[at(t)] = 1;
  return count;
}

} // namespace trime::generalise
