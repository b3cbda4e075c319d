// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/generalise.hpp"

#include "generalise/curve_flow.hpp"
#include "generalise/joining_parts.hpp"
#include "generalise/loop_builder.hpp"
#include "generalise/narrow_parts.hpp"
#include "generalise/ragged_curves.hpp"
#include "generalise/regions.hpp"
#include "generalise/rules.hpp"
#include "generalise/vertex_moves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace trime::generalise {
namespace {

using geometry::Boundary;
using geometry::Vec2;

double area_of(const Triangulation& mesh, std::span<const LocalIndex> triangles) {
  double twice = 0;
  for (const LocalIndex t : triangles) {
    const Vec2 a = mesh.point(mesh.origin(3 * t));
    twice += cross(mesh.point(mesh.origin(3 * t + 1)) - a, mesh.point(mesh.origin(3 * t + 2)) - a);
  }
  return 0.5 * twice;
}

/// Is it clearly narrow, and more than roughness?
bool matters(const Triangulation& mesh, const NarrowPart& part) {
  if (part.width > GeneraliseRules::clearly_narrow)
    return false;
  if (part.lids.size() != 1)
    return true;
  const double lid = length(mesh.point(mesh.target(part.lids[0])) - mesh.point(mesh.origin(part.lids[0])));
  return part.depth > GeneraliseRules::least_depth * part.size && part.depth > lid;
}

/// Remembers from pass to pass the tips of the corners of the given shape, which stay, however sharp they are.
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
  std::int64_t held = 0; ///< narrow parts that stay since they join or separate, in the pass with most

private:
  std::vector<Vec2> tips_;
};

/// The treatment of narrow parts in one pass.
struct Plan {
  std::vector<NarrowPart> changed; ///< cut, or closed: they go to the other side
  std::vector<NarrowPart> apart;   ///< their sides are moved apart
  std::vector<LocalIndex> rest;    ///< triangles that go with what is changed
  Witnesses witnesses;             ///< of what must stay connected or separate; nothing if all may go
  polygon::Simplification counts;  ///< of the parts that join or separate
};

void put(std::span<const LocalIndex> triangles, bool inside, std::vector<char>& labels) {
  for (const LocalIndex t : triangles)
    labels[at(t)] = inside;
}

/// Takes parts out of what is changed, into what is moved apart.
void take_back(const std::vector<char>& which, Plan& plan) {
  std::vector<NarrowPart> stay;
  for (std::size_t k = 0; k < plan.changed.size(); ++k)
    (which[k] ? plan.apart : stay).push_back(std::move(plan.changed[k]));
  plan.changed = std::move(stay);
}

/// Takes back what joins or separates, or counts it if that may go.
void hold_joining_parts(const CurveMap& map, const std::vector<char>& given, const Choice& choice, double share,
                        Plan& plan) {
  Verdict verdict = judge_parts(map, given, plan.changed, !choice.cuts_thin_components);
  std::vector<char> held;
  for (std::size_t k = 0; k < plan.changed.size(); ++k) {
    NarrowPart& part = plan.changed[k];
    held.push_back(!verdict.goes[k]);
    if (verdict.goes[k])
      continue;
    if (choice.keeps_joining) {
      part.widened_to = std::fmin(part.widened_to, GeneraliseRules::joining_width);
      ++plan.counts.held;
    } else {
      ++plan.counts.severed;
      if (const double width = share * part.width; width > plan.counts.widest_severed) {
        plan.counts.widest_severed = width;
        plan.counts.severed_place = part.place;
      }
    }
  }
  if (!choice.keeps_joining) {
    if (!plan.changed.empty() && plan.changed.front().inside)
      plan.rest = std::move(verdict.loose); // else a few triangles would stay between two cuts
    return;
  }
  plan.rest = std::move(verdict.rest);
  take_back(held, plan);
  plan.witnesses = std::move(verdict.witnesses);
}

/// Cuts the dead ends that branch off from passages that stay.
void cut_branches(const CurveMap& map, const std::vector<char>& given, double share, Corners& corners, Plan& plan) {
  std::vector<NarrowPart> passages;
  for (const NarrowPart& part : plan.apart)
    if (part.lids.size() > 1)
      passages.push_back(part);
  std::vector<char> goes(given.size());
  for (NarrowPart& branch : dead_ends_of(map, given, passages, share))
    if (!branch.holds_kept && matters(map.mesh(), branch) && !corners.holds(branch)) {
      put(branch.triangles, true, goes);
      plan.changed.push_back(std::move(branch));
    }
  for (NarrowPart& part : plan.apart)
    std::erase_if(part.triangles, [&](LocalIndex t) { return goes[at(t)] != 0; });
}

/// Plans to take narrow parts out of the shape: the parts less wide than a share of h, or than a part of that if all of
/// the shape is. Components that are narrow all over stay, unless they are small or all is to be cut.
Plan plan_cuts(const CurveMap& map, const std::vector<char>& given, const Regions& regions, const Choice& choice,
               Corners& corners) {
  const auto stays = [&](const NarrowPart& part) {
    return !choice.cuts_thin_components && part.lids.empty() &&
           regions.perimeter(regions.of(part.triangles[0])) >= GeneraliseRules::small_component;
  };
  Plan plan;
  double share = GeneraliseRules::narrow_inside;
  for (int round = 0; round < GeneraliseRules::narrower_rounds; ++round, share *= 0.5) {
    std::vector<char> labels = given;
    plan = {};
    for (NarrowPart& part : find_narrow_parts(map, given, true, share)) {
      if (part.holds_kept || !matters(map.mesh(), part) || corners.holds(part))
        continue;
      const bool is_thin = stays(part);
      (is_thin ? plan.apart : plan.changed).push_back(std::move(part));
    }
    hold_joining_parts(map, given, choice, share, plan);
    for (const NarrowPart& part : plan.changed)
      put(part.triangles, false, labels);
    put(plan.rest, false, labels);
    if (std::find(labels.begin(), labels.end(), 1) != labels.end())
      break;
  }
  if (choice.keeps_joining)
    cut_branches(map, given, share, corners, plan);
  return plan;
}

/// Is a small component next to the part?
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

/// Would the next pass cut a closed part out again? By part.
std::vector<char> cut_again(const CurveMap& map, const std::vector<char>& given, const std::vector<char>& labels,
                            std::span<const NarrowPart> closed) {
  std::vector<char> goes(labels.size()), result;
  for (const NarrowPart& part : find_narrow_parts(map, labels, true, GeneraliseRules::narrow_inside))
    if (!part.holds_kept && matters(map.mesh(), part) && !part.is_corner)
      for (const LocalIndex t : part.triangles)
        goes[at(t)] = !given[at(t)];
  for (const NarrowPart& part : closed)
    result.push_back(
        std::any_of(part.triangles.begin(), part.triangles.end(), [&](LocalIndex t) { return goes[at(t)] != 0; }));
  return result;
}

/// Plans to fill narrow parts of the outside. Those that would be narrow parts of the shape then are moved apart.
Plan plan_closings(const CurveMap& map, const std::vector<char>& given, const Regions& regions, const Choice& choice,
                   Corners& corners) {
  Plan plan;
  for (NarrowPart& part : find_narrow_parts(map, given, false, GeneraliseRules::narrow_outside)) {
    if (part.holds_kept || !matters(map.mesh(), part) || corners.holds(part))
      continue;
    const bool stays = !choice.closes_narrow && !is_beside_small(map, regions, given, part);
    (stays ? plan.apart : plan.changed).push_back(std::move(part));
  }
  hold_joining_parts(map, given, choice, GeneraliseRules::narrow_outside, plan);
  for (int round = 0; round <= GeneraliseRules::opening_rounds && !plan.changed.empty(); ++round) {
    std::vector<char> labels = given;
    for (const NarrowPart& part : plan.changed)
      put(part.triangles, true, labels);
    put(plan.rest, true, labels);
    std::vector<char> open = cut_again(map, given, labels, plan.changed);
    if (std::find(open.begin(), open.end(), 1) == open.end())
      break;
    if (round == GeneraliseRules::opening_rounds)
      open.assign(plan.changed.size(), 1);
    plan.rest.clear();
    take_back(open, plan);
  }
  return plan;
}

/// The labels after the plan. What cannot be changed without a touch of two loops is moved apart instead. Empty if that
/// does not end.
std::vector<char> follow(const CurveMap& map, const std::vector<char>& given, Plan& plan) {
  if (plan.changed.empty())
    return given;
  for (;;) {
    std::vector<char> labels = given;
    for (const NarrowPart& part : plan.changed)
      put(part.triangles, !part.inside, labels);
    for (const LocalIndex t : plan.rest)
      labels[at(t)] = !given[at(t)];
    if (!separate_touching_loops(map, given, labels))
      return {};
    std::vector<char> back;
    for (const NarrowPart& part : plan.changed)
      back.push_back(part.inside && std::any_of(part.triangles.begin(), part.triangles.end(),
                                                [&](LocalIndex t) { return labels[at(t)] != 0; }));
    if (std::find(back.begin(), back.end(), 1) == back.end())
      return labels;
    take_back(back, plan);
  }
}

/// The labels after the plan. Takes back what would separate or join the witnesses after all, since loops touch: first
/// passages, then all parts.
std::vector<char> follow_connected(const CurveMap& map, const std::vector<char>& given, Plan& plan) {
  const auto back_if = [&](const auto& is_one) {
    std::vector<char> back;
    for (NarrowPart& part : plan.changed) {
      back.push_back(is_one(part));
      if (back.back())
        part.widened_to = std::fmin(part.widened_to, GeneraliseRules::joining_width);
    }
    take_back(back, plan);
    plan.rest.clear();
    return follow(map, given, plan);
  };
  const auto is_good = [&](const std::vector<char>& labels) {
    return labels.empty() || confirms(map, labels, plan.witnesses);
  };
  if (plan.changed.empty())
    return given;
  std::vector<char> labels = follow(map, given, plan);
  if (!is_good(labels))
    labels = back_if([](const NarrowPart& part) { return part.lids.size() != 1; });
  if (!is_good(labels))
    labels = back_if([](const NarrowPart&) { return true; });
  return labels;
}

void count(const CurveMap& map, const std::vector<char>& given, const Plan& plan, polygon::Simplification& counts) {
  counts.add(plan.counts);
  for (const NarrowPart& part : plan.changed) {
    ++(part.inside ? counts.cut : counts.closed);
    (part.inside ? counts.cut_area : counts.closed_area) += area_of(map.mesh(), part.triangles);
  }
  for (const LocalIndex t : plan.rest)
    (given[at(t)] ? counts.cut_area : counts.closed_area) += area_of(map.mesh(), std::span(&t, 1));
}

/// Do the boundaries have the same pieces, in whatever order?
bool have_same_pieces(const Boundary& a, const Boundary& b) {
  const auto ends = [](const Boundary& boundary) {
    std::vector<std::array<double, 4>> all;
    for (const geometry::Loop& loop : boundary.loops)
      for (const geometry::Piece& piece : loop.pieces)
        all.push_back({piece.start.x, piece.start.y, piece.end.x, piece.end.y});
    std::sort(all.begin(), all.end());
    return all;
  };
  return polygon::piece_count(a) == polygon::piece_count(b) && ends(a) == ends(b);
}

/// Lists how a pass treats the narrow parts that it found.
struct Treated {
  std::vector<char> labels;      ///< empty if nothing good does
  std::vector<NarrowPart> apart; ///< their sides are to be moved apart
  polygon::Simplification counts;
};

/// Takes narrow parts out of the shape, and closes those of the outside that is left.
Treated treat_narrow_parts(const CurveMap& map, const std::vector<char>& given, const Regions& regions,
                           const Choice& choice, Corners& corners) {
  Plan cuts = plan_cuts(map, given, regions, choice, corners);
  const std::vector<char> cut = follow_connected(map, given, cuts);
  if (cut.empty())
    return {};
  Plan closings = plan_closings(map, cut, regions, choice, corners);
  Treated treated{follow_connected(map, cut, closings), std::move(cuts.apart), {}};
  std::move(closings.apart.begin(), closings.apart.end(), std::back_inserter(treated.apart));
  corners.held = std::max(corners.held, cuts.counts.held + closings.counts.held);
  count(map, given, cuts, treated.counts);
  count(map, cut, closings, treated.counts);
  return treated;
}

/// Makes one pass over the boundary. Returns null if nothing is to be done.
std::unique_ptr<Generalised> pass_over(const Boundary& boundary, const sizing::SizeField& size,
                                       const geometry::Lattice& lattice, const Choice& choice,
                                       std::span<const Vec2> inside, Corners& corners) {
  CurveMap map(boundary, size, lattice, inside);
  if (!map.is_valid())
    return nullptr;
  add_nodes_to_narrow_parts(map);
  const std::vector<char> given = map.inside();
  auto result = std::make_unique<Generalised>();
  polygon::Simplification& counts = result->counts;
  std::vector<char> filled = given;
  std::optional<Regions> regions(std::in_place, map, given);
  counts.filled = fill_small_holes(map, *regions, filled);
  if (counts.filled > 0)
    regions.emplace(map, filled);
  Treated treated = treat_narrow_parts(map, filled, *regions, choice, corners);
  const std::vector<char>& labels = treated.labels;
  if (labels.empty())
    return nullptr;
  counts.add(treated.counts);
  VertexMoves moves(map, labels, lattice, choice.bounds);
  counts.widened = moves.widen(std::move(treated.apart));
  moves.merge_close_corners();
  counts.largest_move = moves.largest_share();
  if (labels == given && !moves.any())
    return nullptr;
  result->boundary = build_loops(map, labels, moves.any() ? moves.places() : MovedVertices{});
  if (result->boundary.loops.empty() || have_same_pieces(result->boundary, boundary))
    return nullptr; // nothing is left, or vertices that were added went again
  return result;
}

/// Returns the boundary with fewer vertices in ragged runs; null if none goes.
std::unique_ptr<Generalised> with_thin_runs(const Boundary& boundary, const sizing::SizeField& size,
                                            const geometry::Lattice& lattice, std::span<const Vec2> inside) {
  std::unique_ptr<Boundary> thin =
      without_ragged_runs(boundary, size, lattice, inside, {GeneraliseRules::thinned_share, Thinning::to_the_end});
  if (!thin)
    return nullptr;
  auto result = std::make_unique<Generalised>(Generalised{std::move(*thin), {}});
  result->counts.thinned = polygon::piece_count(boundary) - polygon::piece_count(result->boundary);
  return result;
}

/// Returns the boundary without ragged runs, or null if nothing is ragged. Smooths less, and finally not at all, while
/// curves cross.
std::unique_ptr<Generalised> smoothed(const Boundary& boundary, const sizing::SizeField& size,
                                      const geometry::Lattice& lattice, std::span<const Vec2> inside) {
  double reach = GeneraliseRules::flow_reach;
  for (int round = 0; round < GeneraliseRules::flow_rounds; ++round, reach *= 0.5) {
    std::unique_ptr<SmoothedCurves> flowed = smooth_ragged_runs(boundary, size, lattice, reach);
    if (!flowed)
      return nullptr;
    if (!CurveMap(flowed->boundary, size, lattice, inside).is_valid())
      continue;
    auto result = std::make_unique<Generalised>(Generalised{std::move(flowed->boundary), {}});
    result->counts.smoothed = flowed->vertices;
    return result;
  }
  return nullptr;
}

/// The points that lie inside the boundary; none if its chords cross.
std::vector<Vec2> those_inside(const Boundary& boundary, const sizing::SizeField& size,
                               const geometry::Lattice& lattice, std::span<const Vec2> points) {
  if (points.empty())
    return {};
  const CurveMap map(boundary, size, lattice);
  return map.is_valid() ? map.those_inside(points) : std::vector<Vec2>{};
}

} // namespace

void remember_at_vertices(const Boundary& boundary, sizing::RememberedSize& size) {
  std::vector<Vec2> vertices;
  vertices.reserve(static_cast<std::size_t>(polygon::piece_count(boundary)));
  for (const geometry::Loop& loop : boundary.loops)
    for (const geometry::Piece& piece : loop.pieces)
      vertices.push_back(piece.start);
  size.remember(vertices);
}

std::unique_ptr<const Boundary> thinned(const Boundary& boundary, const sizing::SizeField& size,
                                        const geometry::Lattice& lattice, std::span<const Vec2> inside) {
  if (boundary.periods.any())
    return nullptr;
  return without_ragged_runs(boundary, size, lattice, those_inside(boundary, size, lattice, inside),
                             {GeneraliseRules::thinned_share, Thinning::dense});
}

std::unique_ptr<Generalised> generalise(const Boundary& boundary, const sizing::SizeField& size,
                                        const geometry::Lattice& lattice, const Choice& choice,
                                        std::span<const Vec2> inside) {
  if (boundary.periods.any() || boundary.loops.empty())
    return nullptr;
  sizing::RememberedSize known(size);
  const std::vector<Vec2> held = those_inside(boundary, known, lattice, inside);
  std::unique_ptr<Generalised> result;
  const auto follow_with = [&result](std::unique_ptr<Generalised> next) {
    if (next && result)
      next->counts.add(result->counts);
    const bool any = next != nullptr;
    if (any)
      result = std::move(next);
    return any;
  };
  Corners corners;
  const auto latest = [&]() -> const Boundary& { return result ? result->boundary : boundary; };
  const auto pass = [&](int most) { // what was moved apart may leave others narrow
    bool thins = true;              // until narrow parts have changed
    for (int k = 0; k < most; ++k) {
      remember_at_vertices(latest(), known);
      const bool is_thinner = thins && follow_with(with_thin_runs(latest(), known, lattice, held));
      if (k > 0 && thins && !is_thinner)
        break; // the pass would see the same curves
      const bool any = follow_with(pass_over(latest(), known, lattice, choice, held, corners));
      corners.is_first_pass = false;
      if (!any && !is_thinner)
        break;
      thins = !any;
    }
  };
  pass(GeneraliseRules::most_passes);
  if (follow_with(smoothed(latest(), known, lattice, held)))
    pass(GeneraliseRules::late_passes);
  if (result)
    result->counts.held = corners.held;
  return result;
}

bool would_generalise(const Boundary& boundary, const sizing::SizeField& size, const geometry::Lattice& lattice,
                      const Choice& choice, std::span<const Vec2> inside) {
  if (boundary.periods.any() || boundary.loops.empty())
    return false;
  const std::vector<Vec2> held = those_inside(boundary, size, lattice, inside);
  Corners corners;
  return smooth_ragged_runs(boundary, size, lattice, GeneraliseRules::flow_reach) ||
         with_thin_runs(boundary, size, lattice, held) || pass_over(boundary, size, lattice, choice, held, corners);
}

} // namespace trime::generalise
