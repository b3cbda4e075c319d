// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/chord_losses.hpp"

#include "trime/core/types.hpp"

#include <algorithm>
#include <cmath>

namespace trime::generalise {
namespace {

using geometry::RegionLoss;
using HalfEdge = Triangulation::HalfEdge;

/// Takes an area off the largest row for these regions.
void take_off(std::vector<RegionLoss>& losses, int loser, int winner, double area) {
  RegionLoss* row = nullptr;
  for (RegionLoss& loss : losses)
    if (loss.loser == loser && loss.winner == winner && (row == nullptr || loss.area > row->area))
      row = &loss;
  if (row == nullptr)
    return;
  row->area = std::fmax(0, row->area - area);
  row->largest = std::fmin(row->largest, row->area);
}

} // namespace

void add_chord_losses(const RegionMap& map, std::span<const char> stays, std::vector<RegionLoss>& losses) {
  const Triangulation& mesh = map.mesh();
  for (const RegionMap::Strand& strand : map.strands()) {
    const double bulge = map.bulge(strand), area = std::fabs(bulge);
    if (area == 0 || (strand.arc >= 0 && stays[at(strand.arc)] != 0))
      continue;
    const HalfEdge along = mesh.find_edge(strand.from, strand.to);
    if (along == Triangulation::none)
      continue;
    const HalfEdge back = mesh.twin(along);
    const HalfEdge inside = bulge > 0 ? along : back, beyond = bulge > 0 ? back : along; // of the arc
    const int owner = map.given_label(inside), counted = map.given_label(beyond);
    const int now =
        strand.arc < 0 ? map.label(Triangulation::triangle(along)) : map.label(Triangulation::triangle(beyond));
    const auto lose = [&](int loser) {
      losses.push_back({loser, now, geometry::LossReason::thinning, area, 1, area, mesh.point(strand.from)});
    };
    if (owner != RegionMap::outside && owner != now)
      lose(owner);
    if (counted != RegionMap::outside && counted != now)
      take_off(losses, counted, now, area);
  }
}

} // namespace trime::generalise
