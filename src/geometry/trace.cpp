// SPDX-License-Identifier: BSD-3-Clause
#include "trace.hpp"

#include "curve_refiner.hpp"
#include "trime/geometry/segment.hpp"
#include "zero_chains.hpp"

#include <algorithm>
#include <cmath>

namespace trime::geometry {

namespace {

constexpr double default_resolution = 1.0 / 512; // of the longer side
constexpr double nearly_equal = 1e-3;            // in cells: vertices that rounding or a node on the curve made

/// Without the vertices that follow another one too closely.
std::vector<Vec2> without_repeats(const std::vector<Vec2>& chain, double distance) {
  std::vector<Vec2> result;
  for (const Vec2 p : chain)
    if (result.empty() || length(p - result.back()) > distance)
      result.push_back(p);
  while (result.size() > 1 && length(result.front() - result.back()) <= distance)
    result.pop_back();
  return result;
}

/// Is every vertex of the chain on the ring? In a tip narrower than a cell the grid sees islands, of which the refined
/// ring of the whole has the curve already.
bool lies_on(const std::vector<Vec2>& chain, const std::vector<Vec2>& ring, double distance) {
  Box box;
  for (const Vec2 p : ring)
    box.include(p);
  const Vec2 margin{distance, distance};
  box = {box.min - margin, box.max + margin};
  return std::all_of(chain.begin(), chain.end(), [&](Vec2 p) {
    if (!box.contains(p))
      return false;
    for (std::size_t k = 0; k < ring.size(); ++k)
      if (squared_distance(p, {ring[k], ring[(k + 1) % ring.size()]}) <= distance * distance)
        return true;
    return false;
  });
}

double resolution_of(const std::string& name, double given, double side) {
  if (!std::isfinite(given) || given < 0)
    throw GeometryError(
        fmt::format("part '{}': expected a resolution > 0, or 0 for the default, found {}", name, given));
  return given > 0 ? given : default_resolution * side;
}

} // namespace

std::vector<std::vector<Vec2>> trace_zero_set(const std::string& name, const Shape& shape, const Frame& frame,
                                              double resolution) {
  const Box& box = frame.inner();
  const double side = std::fmax(box.width(), box.height());
  LevelFunction function(name, shape, box);
  const ZeroChains coarse = march(function, box, resolution_of(name, resolution, side));
  const TraceTolerances tolerances(side);
  const CurveRefiner refiner(function, tolerances);
  std::vector<std::vector<Vec2>> chains;
  for (const std::vector<Vec2>& chain : coarse.chains)
    chains.push_back(without_repeats(chain, nearly_equal * coarse.cell));
  std::stable_sort(chains.begin(), chains.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
  std::vector<std::vector<Vec2>> rings;
  for (const std::vector<Vec2>& chain : chains) {
    // With fewer vertices it is what rounding makes around a node, smaller than the resolution by far.
    if (chain.size() < 3 || std::any_of(rings.begin(), rings.end(), [&](const std::vector<Vec2>& ring) {
          return lies_on(chain, ring, 4 * tolerances.chord);
        }))
      continue;
    std::vector<Vec2> ring = refiner.refine(chain);
    if (ring.size() >= 3)
      rings.push_back(std::move(ring));
  }
  return rings;
}

} // namespace trime::geometry
