// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/generalise.hpp"

#include "generalise/loop_builder.hpp"
#include "generalise/narrow_parts.hpp"
#include "generalise/ragged_curves.hpp"
#include "generalise/regions.hpp"
#include "generalise/rules.hpp"
#include "generalise/vertex_moves.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace trime::generalise {
namespace {

using geometry::Boundary;
using geometry::Vec2;

double area_of(const Triangulation& mesh, const NarrowPart& part) {
  double twice = 0;
  for (const LocalIndex t : part.triangles) {
    const Vec2 a = mesh.point(mesh.origin(3 * t));
    twice += cross(mesh.point(mesh.origin(3 * t + 1)) - a, mesh.point(mesh.origin(3 * t + 2)) - a);
  }
  return 0.5 * twice;
}

/// Is it more than roughness or a corner of the shape?
bool matters(const Triangulation& mesh, const NarrowPart& part) {
  if (part.lids.size() != 1)
    return true;
  const double lid = length(mesh.point(mesh.target(part.lids[0])) - mesh.point(mesh.origin(part.lids[0])));
  return part.depth > GeneraliseRules::least_depth * part.size && part.depth > lid;
}

/// The tips of the corners of the shape as it was given: they stay, however sharp.
class Corners {
public:
  /// Is it a dead end at one? In the first pass those that have straight arms are.
  bool holds(const NarrowPart& part) {
    if (!part.is_corner)
      return false;
    if (is_first_pass)
      tips_.push_back(part.tip);
    return is_first_pass || std::find(tips_.begin(), tips_.end(), part.tip) != tips_.end();
  }
  bool is_first_pass = true;

private:
  std::vector<Vec2> tips_;
};

/// Takes narrow parts out of the shape: the parts less wide than a share of h, or than a part of that if all of the
/// shape is.
void cut_narrow_parts(const CurveMap& map, const std::vector<char>& given, Corners& corners, std::vector<char>& labels,
                      GeneralisedCounts& counts) {
  const Triangulation& mesh = map.mesh();
  double share = GeneraliseRules::narrow_inside;
  for (int round = 0; round < GeneraliseRules::narrower_rounds; ++round, share *= 0.5) {
    labels = given;
    counts.cut = 0;
    counts.cut_area = 0;
    for (const NarrowPart& part : find_narrow_parts(map, given, true, share)) {
      if (part.holds_kept || !matters(mesh, part) || corners.holds(part))
        continue;
      ++counts.cut;
      counts.cut_area += area_of(mesh, part);
      for (const LocalIndex t : part.triangles)
        labels[at(t)] = 0;
    }
    if (std::find(labels.begin(), labels.end(), 1) != labels.end())
      return;
  }
}

/// Is a small component beside the part?
bool is_beside_small(const CurveMap& map, const Regions& regions, const std::vector<char>& given,
                     const NarrowPart& part) {
  const Triangulation& mesh = map.mesh();
  for (const LocalIndex t : part.triangles)
    for (Triangulation::HalfEdge e = 3 * t; e < 3 * t + 3; ++e) {
      const LocalIndex there = Triangulation::triangle(mesh.twin(e));
      if (given[at(there)] && regions.perimeter(regions.of(there)) < GeneraliseRules::small_component)
        return true;
    }
  return false;
}

/// Fills narrow parts of the outside that are to be closed; returns the others.
std::vector<NarrowPart> close_narrow_parts(const CurveMap& map, const std::vector<char>& given, Narrow narrow,
                                           Corners& corners, std::vector<char>& labels, GeneralisedCounts& counts) {
  const Regions regions(map, given);
  std::vector<NarrowPart> slits;
  for (NarrowPart& part : find_narrow_parts(map, given, false, GeneraliseRules::narrow_outside)) {
    if (part.holds_kept || !matters(map.mesh(), part) || corners.holds(part))
      continue;
    if (narrow == Narrow::keep && !is_beside_small(map, regions, given, part)) {
      slits.push_back(std::move(part));
      continue;
    }
    ++counts.closed;
    counts.closed_area += area_of(map.mesh(), part);
    for (const LocalIndex t : part.triangles)
      labels[at(t)] = 1;
  }
  return slits;
}

std::int64_t piece_count(const Boundary& boundary) {
  std::int64_t count = 0;
  for (const geometry::Loop& loop : boundary.loops)
    count += std::ssize(loop.pieces);
  return count;
}

/// Once over the boundary; null if nothing is to be done.
std::unique_ptr<Generalised> pass_over(const Boundary& boundary, const sizing::SizeField& size,
                                       const geometry::Lattice& lattice, Narrow narrow, Corners& corners) {
  std::unique_ptr<const Boundary> thinned;
  std::optional<CurveMap> made;
  double share = GeneraliseRules::thinned_share;
  for (int round = 0; round <= GeneraliseRules::thinning_rounds; ++round, share *= GeneraliseRules::finer_thinning) {
    thinned = round < GeneraliseRules::thinning_rounds ? without_ragged_runs(boundary, size, share) : nullptr;
    made.emplace(thinned ? *thinned : boundary, size, lattice);
    if (made->is_valid() || !thinned)
      break;
  }
  CurveMap& map = *made;
  if (!map.is_valid())
    return nullptr;
  add_nodes_to_narrow_parts(map);
  const std::vector<char> given = map.inside();
  auto result = std::make_unique<Generalised>();
  GeneralisedCounts& counts = result->counts;
  if (thinned)
    counts.thinned = piece_count(boundary) - piece_count(*thinned);
  std::vector<char> filled = given;
  counts.filled = fill_small_holes(map, filled);
  std::vector<char> labels = filled;
  cut_narrow_parts(map, filled, corners, labels, counts);
  std::vector<NarrowPart> slits; // they are looked for once nothing narrow is left inside
  if (counts.cut == 0)
    slits = close_narrow_parts(map, filled, narrow, corners, labels, counts);
  if (!separate_touching_loops(map, labels))
    return nullptr;
  VertexMoves moves(map, labels, lattice);
  moves.widen(slits);
  counts.widened = std::ssize(slits);
  moves.merge_close_corners();
  counts.largest_move = moves.largest_share();
  if (labels == given && !moves.any() && !thinned)
    return nullptr;
  result->boundary = build_loops(map, labels, moves.any() ? moves.places() : MovedVertices{});
  return result;
}

} // namespace

std::unique_ptr<const Generalised> generalise(const Boundary& boundary, const sizing::SizeField& size,
                                              const geometry::Lattice& lattice, Narrow narrow,
                                              std::span<const Vec2> inside) {
  (void)inside;
  if (boundary.periods.any() || boundary.loops.empty())
    return nullptr;
  std::unique_ptr<Generalised> result;
  Corners corners;
  for (int pass = 0; pass < GeneraliseRules::most_passes;
       ++pass) { // parts that were moved apart may leave others narrow
    std::unique_ptr<Generalised> next = pass_over(result ? result->boundary : boundary, size, lattice, narrow, corners);
    corners.is_first_pass = false;
    if (!next)
      break;
    if (result)
      next->counts.add(result->counts);
    result = std::move(next);
  }
  return result;
}

bool has_narrow_parts(const Boundary& boundary, const sizing::SizeField& size, const geometry::Lattice& lattice,
                      Narrow narrow) {
  if (boundary.periods.any() || boundary.loops.empty())
    return false;
  Corners corners;
  return pass_over(boundary, size, lattice, narrow, corners) != nullptr;
}

} // namespace trime::generalise
