// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/narrow_parts.hpp"

#include "generalise/rules.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace trime::generalise {
namespace {

using geometry::Vec2;
using HalfEdge = Triangulation::HalfEdge;

/// [1] Two numbers that differ by this factor differ by more than the rounding of a few operations.
constexpr double beyond_rounding = 1.0001;

/// Should the constrained edge e get a node, since the apex of its triangle is near?
bool wants_node(const CurveMap& map, HalfEdge e) {
  const Triangulation& mesh = map.mesh();
  const LocalIndex a = mesh.origin(e), b = mesh.target(e), apex = mesh.origin(Triangulation::previous(e));
  if (!map.is_on_curve(apex))
    return false;
  const double width =
      std::fmax(GeneraliseRules::narrow_inside, GeneraliseRules::narrow_outside) * std::fmin(map.size(a), map.size(b));
  const Vec2 along = mesh.point(b) - mesh.point(a), across = mesh.point(apex) - mesh.point(a);
  const double whole = length(along), place = dot(across, along) / whole, height = cross(along, across) / whole;
  return whole > GeneraliseRules::node_spacing * width && height < GeneraliseRules::node_reach * width &&
         place > -height && place < whole + height;
}

/// Calls `visit` with the half-edges of all triangles around a vertex.
template <class Visit>
void for_each_around(const Triangulation& mesh, LocalIndex v, const Visit& visit) {
  const HalfEdge first = mesh.leaving(v);
  HalfEdge e = first;
  do {
    const HalfEdge of_triangle = 3 * Triangulation::triangle(e);
    for (HalfEdge f = of_triangle; f < of_triangle + 3; ++f)
      visit(f);
    e = mesh.around(e);
  } while (e != first);
}

class NarrowFinder {
public:
  NarrowFinder(const CurveMap& map, const std::vector<char>& labels, bool inside, double share)
      : map_(map), mesh_(map.mesh()), labels_(labels), inside_(inside), share_(share), narrow_(labels.size()),
        seen_(labels.size()), on_rim_(at(mesh_.vertex_count())) {
    for (HalfEdge e = 0; e < 3 * mesh_.triangle_count(); ++e)
      if (is_wall(e))
        on_rim_[at(mesh_.origin(e))] = 1;
    for (LocalIndex t = 0; t < mesh_.triangle_count(); ++t)
      narrow_[at(t)] = is_narrow(t);
  }

  std::vector<NarrowPart> find() {
    std::vector<NarrowPart> parts;
    for (LocalIndex t = 0; t < mesh_.triangle_count(); ++t)
      if (narrow_[at(t)] && !seen_[at(t)])
        parts.push_back(collect(t));
    return parts;
  }

  std::vector<NarrowPart> twigs_of(const NarrowPart& part) {
    ways_.resize(labels_.size());
    peel(part);
    std::vector<NarrowPart> twigs;
    for (const LocalIndex t : part.triangles)
      if (ways_[at(t)] == peeled)
        twigs.push_back(collect_twig(t));
    return twigs;
  }

private:
  static constexpr int peeled = -1, collected = -2;

  /// Does the side end there? Not where a hole was filled.
  bool is_wall(HalfEdge e) const {
    const HalfEdge f = mesh_.twin(e);
    return f != Triangulation::none &&
           labels_[at(Triangulation::triangle(e))] != labels_[at(Triangulation::triangle(f))];
  }
  /// Nodes of a hole that was filled, or of a slit that was closed, give no widths.
  bool tells_width(LocalIndex v) const { return on_rim_[at(v)] || map_.is_held(v); }
  bool is_narrow_edge(HalfEdge e) const {
    const LocalIndex a = mesh_.origin(e), b = mesh_.target(e);
    if (!tells_width(a) || !tells_width(b))
      return false;
    const double width = share_ * std::fmin(map_.size(a), map_.size(b)); // 0 at the corners of the box
    return squared_length(mesh_.point(b) - mesh_.point(a)) < width * width;
  }
  bool is_narrow(LocalIndex t) const {
    if ((labels_[at(t)] != 0) != inside_)
      return false;
    int open = 0;
    for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e)
      if (!is_wall(e)) {
        ++open;
        if (!is_narrow_edge(e))
          return false;
      }
    return open > 0;
  }

  NarrowPart empty_part(LocalIndex first) const {
    NarrowPart part;
    part.inside = inside_;
    part.widened_to = inside_ ? GeneraliseRules::narrow_inside : GeneraliseRules::narrow_outside;
    part.triangles.push_back(first);
    part.size = part.width = INFINITY;
    return part;
  }

  /// Takes a half-edge of one of its triangles into account.
  void measure(HalfEdge e, NarrowPart& part) const {
    part.size = std::fmin(part.size, map_.size(mesh_.origin(e)));
    part.holds_kept |= map_.is_kept(mesh_.origin(e));
    if (is_wall(e))
      return;
    const Vec2 a = mesh_.point(mesh_.origin(e)), b = mesh_.point(mesh_.target(e));
    const double size = std::fmin(map_.size(mesh_.origin(e)), map_.size(mesh_.target(e)));
    if (const double width = length(b - a) / (share_ * size); width < part.width) {
      part.width = width;
      part.place = 0.5 * (a + b);
    }
  }

  NarrowPart collect(LocalIndex first) {
    NarrowPart part = empty_part(first);
    seen_[at(first)] = 1;
    for (std::size_t k = 0; k < part.triangles.size(); ++k) {
      const LocalIndex t = part.triangles[k];
      for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e) {
        measure(e, part);
        if (is_wall(e))
          continue;
        const LocalIndex there = Triangulation::triangle(mesh_.twin(e));
        if (!narrow_[at(there)])
          part.lids.push_back(e);
        else if (!seen_[at(there)]) {
          seen_[at(there)] = 1;
          part.triangles.push_back(there);
        }
      }
    }
    if (part.lids.size() == 1 && !part.holds_kept)
      measure_dead_end(part);
    return part;
  }

  /// Marks in ways_ the triangles of a passage from which only one way leads on, again and again.
  void peel(const NarrowPart& part) {
    std::vector<LocalIndex> ends;
    for (const LocalIndex t : part.triangles) {
      ways_[at(t)] = 0;
      for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e)
        if (!is_wall(e)) // a lid counts twice: there the passage ends
          ways_[at(t)] += narrow_[at(Triangulation::triangle(mesh_.twin(e)))] ? 1 : 2;
      if (ways_[at(t)] == 1)
        ends.push_back(t);
    }
    while (!ends.empty()) {
      const LocalIndex t = ends.back();
      ends.pop_back();
      ways_[at(t)] = peeled;
      for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e)
        if (!is_wall(e))
          if (const LocalIndex there = Triangulation::triangle(mesh_.twin(e));
              ways_[at(there)] > 0 && --ways_[at(there)] == 1)
            ends.push_back(there);
    }
  }

  /// A dead end of peeled triangles.
  NarrowPart collect_twig(LocalIndex first) {
    NarrowPart twig = empty_part(first);
    ways_[at(first)] = collected;
    for (std::size_t k = 0; k < twig.triangles.size(); ++k) {
      const LocalIndex t = twig.triangles[k];
      for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e) {
        measure(e, twig);
        if (is_wall(e))
          continue;
        const LocalIndex there = Triangulation::triangle(mesh_.twin(e));
        if (ways_[at(there)] == peeled) {
          ways_[at(there)] = collected;
          twig.triangles.push_back(there);
        } else if (ways_[at(there)] != collected) {
          twig.lids.push_back(e);
        }
      }
    }
    if (twig.lids.size() == 1 && !twig.holds_kept)
      measure_dead_end(twig);
    return twig;
  }

  void measure_dead_end(NarrowPart& part) const {
    const Vec2 a = mesh_.point(mesh_.origin(part.lids[0])), b = mesh_.point(mesh_.target(part.lids[0]));
    LocalIndex tip = mesh_.origin(part.lids[0]);
    for (const LocalIndex t : part.triangles)
      for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e)
        if (const double d = std::sqrt(squared_distance(mesh_.point(mesh_.origin(e)), {a, b})); d > part.depth) {
          part.depth = d;
          tip = mesh_.origin(e);
        }
    part.tip = mesh_.point(tip);
    const double opening = length(b - a) / part.depth; // the width of a corner grows by that share of the way
    const double reach = GeneraliseRules::corner_width * part.size / opening;
    part.is_corner = is_straight(tip, true, reach, opening) && is_straight(tip, false, reach, opening);
  }

  /// Is the curve from a tip on, ahead or behind, as straight as a corner of such an opening needs it?
  bool is_straight(LocalIndex tip, bool ahead, double reach, double opening) const {
    const Vec2 from = mesh_.point(tip);
    const auto leeway = [&](double distance) {
      return GeneraliseRules::straight_arms * opening * std::fmax(distance, 0.05 * reach);
    };
    std::vector<Vec2> arm;
    Vec2 farthest; // from the tip
    double most = 0;
    for (LocalIndex v = tip; arm.empty() || length(arm.back() - from) < reach;) {
      v = ahead ? map_.next_on_curve(v) : map_.previous_on_curve(v);
      if (v == tip)
        return false;
      arm.push_back(mesh_.point(v));
      const Vec2 way = arm.back() - from;
      const double distance = length(way);
      // No line from the tip passes both within their leeways: the way ends here, not with the curve.
      if (std::fabs(cross(farthest, way)) > beyond_rounding * (leeway(distance) * most + leeway(most) * distance))
        return false;
      if (distance > most) {
        farthest = way;
        most = distance;
      }
    }
    for (std::size_t k = 0; k + 1 < arm.size(); ++k) {
      const double far = leeway(length(arm[k] - from));
      if (squared_distance(arm[k], {from, arm.back()}) > far * far)
        return false;
    }
    return true;
  }

  const CurveMap& map_;
  const Triangulation& mesh_;
  const std::vector<char>& labels_;
  const bool inside_;
  const double share_;
  std::vector<char> narrow_, seen_; // by triangle
  std::vector<char> on_rim_;        // by vertex
  std::vector<int> ways_;           // by triangle of a passage: how many lead on; or what became of it
};

} // namespace

void add_nodes_to_narrow_parts(CurveMap& map) {
  const Triangulation& mesh = map.mesh();
  std::vector<std::array<LocalIndex, 2>> wanted;
  const auto look_at = [&](HalfEdge e) {
    if (mesh.is_constrained(e) && wants_node(map, e))
      wanted.push_back({std::min(mesh.origin(e), mesh.target(e)), std::max(mesh.origin(e), mesh.target(e))});
  };
  LocalIndex first_new = 0;
  for (int round = 0; round < GeneraliseRules::node_rounds; ++round) {
    wanted.clear();
    if (round == 0)
      for (HalfEdge e = 0; e < 3 * mesh.triangle_count(); ++e)
        look_at(e);
    else // all triangles that have changed lie around the new nodes
      for (LocalIndex v = first_new; v < mesh.vertex_count(); ++v)
        for_each_around(mesh, v, look_at);
    first_new = mesh.vertex_count();
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    bool added = false;
    for (const auto& [a, b] : wanted)
      added |= map.add_node(mesh.find_edge(a, b));
    if (!added)
      return;
  }
}

std::vector<NarrowPart> find_narrow_parts(const CurveMap& map, const std::vector<char>& labels, bool inside,
                                          double share) {
  return NarrowFinder(map, labels, inside, share).find();
}

std::vector<NarrowPart> dead_ends_of(const CurveMap& map, const std::vector<char>& labels,
                                     std::span<const NarrowPart> passages, double share) {
  std::vector<NarrowPart> all;
  if (passages.empty())
    return all;
  NarrowFinder finder(map, labels, passages.front().inside, share);
  for (const NarrowPart& passage : passages)
    for (NarrowPart& twig : finder.twigs_of(passage))
      if (twig.lids.size() == 1)
        all.push_back(std::move(twig));
  return all;
}

} // namespace trime::generalise
