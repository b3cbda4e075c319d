// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/absorb_parts.hpp"

#include "generalise/label_arcs.hpp"
#include "generalise/region_map.hpp"
#include "generalise/rules.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace trime::generalise {
namespace {

using geometry::LossReason;
using HalfEdge = Triangulation::HalfEdge;

// Each round changes parts that are not next to each other; usually a few rounds are enough.
constexpr int most_rounds = 30;

// A triangle that would go back and forth stays after this number of changes.
constexpr char most_changes = 4;

/// A connected set of triangles of one region.
struct Part {
  std::vector<LocalIndex> triangles;
  LossReason reason = LossReason::crumb;
  double area = 0;
};

class Absorber {
public:
  /// @param tips nodes at which narrow ends stay, in lexicographic order
  Absorber(RegionMap& map, std::span<const std::array<int, 2>> pairs, std::span<const geometry::Vec2> tips,
           std::vector<geometry::RegionLoss>& losses)
      : map_(map), mesh_(map.mesh()), pairs_(pairs), tips_(tips), losses_(losses),
        changes_(at(mesh_.triangle_count()), 0) {}

  /// Returns whether anything has changed.
  bool run(SmallParts which) {
    bool any = false;
    for (int round = 0; round < most_rounds; ++round) {
      bool changed = give_away(small_faces());
      if (!changed && which == SmallParts::and_necks)
        changed = give_away(necks());
      if (!changed)
        break;
      any = true;
    }
    return any;
  }

private:
  /// Collects the triangles that can be reached without crossing an edge at which `ends` is true.
  template <class Ends>
  std::vector<LocalIndex> collect(LocalIndex first, std::vector<char>& seen, const Ends& ends) const {
    std::vector<LocalIndex> found{first};
    seen[at(first)] = 1;
    for (std::size_t k = 0; k < found.size(); ++k)
      for (HalfEdge e = 3 * found[k]; e < 3 * found[k] + 3; ++e) {
        if (ends(e))
          continue;
        const LocalIndex there = Triangulation::triangle(mesh_.twin(e));
        if (seen[at(there)] == 0) {
          seen[at(there)] = 1;
          found.push_back(there);
        }
      }
    return found;
  }

  double size_at(HalfEdge e) const { return std::fmin(map_.size(mesh_.origin(e)), map_.size(mesh_.target(e))); }

  bool is_held(const Part& part) const {
    return std::ranges::any_of(part.triangles, [&](LocalIndex t) {
      return changes_[at(t)] >= most_changes || map_.is_held(mesh_.origin(3 * t)) ||
             map_.is_held(mesh_.origin(3 * t + 1)) || map_.is_held(mesh_.origin(3 * t + 2));
    });
  }

  void set_area(Part& part) const {
    for (const LocalIndex t : part.triangles)
      part.area += map_.area(t);
  }

  /// Returns the faces with a short perimeter and the slivers, the smallest first.
  std::vector<Part> small_faces() const {
    std::vector<Part> parts;
    std::vector<char> seen(changes_.size(), 0);
    for (LocalIndex t = 0; t < mesh_.triangle_count(); ++t) {
      if (seen[at(t)] != 0 || map_.label(t) == RegionMap::outside)
        continue;
      Part part{collect(t, seen, [&](HalfEdge e) { return map_.is_wall(e); })};
      double perimeter = 0, width = 0; // in h, and a length times h
      for (const LocalIndex of_part : part.triangles)
        for (HalfEdge e = 3 * of_part; e < 3 * of_part + 3; ++e)
          if (map_.is_wall(e)) {
            perimeter += map_.length(e) / size_at(e);
            width += map_.length(e) * size_at(e);
          }
      set_area(part);
      const bool is_crumb = perimeter < GeneraliseRules::smallest_face;
      if ((!is_crumb && 2 * part.area >= GeneraliseRules::narrowest_face * width) || is_held(part))
        continue;
      part.reason = is_crumb ? LossReason::crumb : LossReason::sliver;
      parts.push_back(std::move(part));
    }
    std::ranges::stable_sort(parts, {}, &Part::area);
    return parts;
  }

  void find_walls() {
    on_wall_.assign(at(mesh_.vertex_count()), 0);
    for (HalfEdge e = 0; e < 3 * mesh_.triangle_count(); ++e)
      if (map_.is_wall(e))
        on_wall_[at(mesh_.origin(e))] = 1;
  }

  /// Is an edge between two walls shorter than a share of h?
  bool is_short(HalfEdge e, double share) const {
    return on_wall_[at(mesh_.origin(e))] != 0 && on_wall_[at(mesh_.target(e))] != 0 &&
           map_.length(e) < share * size_at(e);
  }
  bool is_narrow(LocalIndex t) const {
    if (map_.label(t) == RegionMap::outside)
      return false;
    bool is_open = false;
    for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e)
      if (!map_.is_wall(e)) {
        is_open = true;
        if (!is_short(e, GeneraliseRules::narrow_region))
          return false;
      }
    return is_open;
  }

  /// Returns narrow passages, narrow ends at the boundary, and thin tips.
  std::vector<Part> necks() {
    find_walls();
    std::vector<char> narrow(changes_.size()), seen(changes_.size(), 0);
    for (LocalIndex t = 0; t < mesh_.triangle_count(); ++t)
      narrow[at(t)] = is_narrow(t);
    std::vector<Part> parts;
    for (LocalIndex t = 0; t < mesh_.triangle_count(); ++t) {
      if (narrow[at(t)] == 0 || seen[at(t)] != 0)
        continue;
      int lids = 0;
      HalfEdge lid = Triangulation::none;
      Part part{collect(t, seen, [&](HalfEdge e) {
        if (map_.is_wall(e))
          return true;
        const bool is_lid = narrow[at(Triangulation::triangle(mesh_.twin(e)))] == 0;
        lids += is_lid ? 1 : 0;
        lid = is_lid ? e : lid;
        return is_lid;
      })};
      part.reason = LossReason::sliver;
      if (lids > 0 && (lids > 1 || meets_boundary(part) || is_thin_tip(part, lid)) && is_clearly_narrow(part) &&
          !is_held(part)) {
        set_area(part);
        parts.push_back(std::move(part));
      }
    }
    return parts;
  }

  bool meets_boundary(const Part& part) const {
    return std::ranges::any_of(part.triangles, [&](LocalIndex t) {
      return map_.label_beside(3 * t) == RegionMap::outside || map_.label_beside(3 * t + 1) == RegionMap::outside ||
             map_.label_beside(3 * t + 2) == RegionMap::outside;
    });
  }
  /// Is a dead end behind a lid much deeper than wide?
  bool is_thin_tip(const Part& part, HalfEdge lid) const {
    const geometry::Segment across{mesh_.point(mesh_.origin(lid)), mesh_.point(mesh_.target(lid))};
    double deepest = 0;
    geometry::Vec2 tip;
    for (const LocalIndex t : part.triangles)
      for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e)
        if (const geometry::Vec2 p = mesh_.point(mesh_.origin(e)); squared_distance(p, across) > deepest) {
          deepest = squared_distance(p, across);
          tip = p;
        }
    return std::sqrt(deepest) * GeneraliseRules::thin_tip > map_.length(lid) &&
           !std::ranges::binary_search(tips_, tip, geometry::lexicographically_less);
  }
  bool is_clearly_narrow(const Part& part) const {
    for (const LocalIndex t : part.triangles)
      for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e)
        if (!map_.is_wall(e) && is_short(e, GeneraliseRules::clearly_narrow * GeneraliseRules::narrow_region))
          return true;
    return false;
  }

  /// Gives each part to a neighbour, as long as no triangle in it or next to it has changed in this round.
  bool give_away(const std::vector<Part>& parts) {
    std::vector<char> is_changed(changes_.size(), 0);
    bool any = false;
    for (const Part& part : parts) {
      const bool is_free = std::ranges::none_of(part.triangles, [&](LocalIndex t) {
        const auto has_changed = [&](HalfEdge e) {
          return mesh_.twin(e) != Triangulation::none && is_changed[at(Triangulation::triangle(mesh_.twin(e)))] != 0;
        };
        return is_changed[at(t)] != 0 || has_changed(3 * t) || has_changed(3 * t + 1) || has_changed(3 * t + 2);
      });
      const int winner = is_free ? winner_of(part) : RegionMap::outside;
      if (winner == RegionMap::outside)
        continue;
      losses_.push_back({map_.label(part.triangles[0]), winner, part.reason, part.area, 1, part.area,
                         mesh_.point(mesh_.origin(3 * part.triangles[0]))});
      for (const LocalIndex t : part.triangles) {
        map_.set_label(t, winner);
        ++changes_[at(t)];
        is_changed[at(t)] = 1;
      }
      any = true;
    }
    return any;
  }

  bool may_touch(int a, int b) const {
    const std::array<int, 2> pair{std::min(a, b), std::max(a, b)};
    return a == b || std::ranges::binary_search(pairs_, pair);
  }

  /// The region across the longest border that may touch all others around the part. The border between a part and
  /// the region that gets it goes. Edges on curves of the user stay, so they do not count.
  int winner_of(const Part& part) const {
    std::map<int, double> lengths;
    for (const LocalIndex t : part.triangles)
      for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e)
        if (map_.is_wall(e) && map_.label_beside(e) != RegionMap::outside)
          lengths[map_.label_beside(e)] += map_.curve_on(e) < 0 ? map_.length(e) : 0;
    int best = RegionMap::outside;
    double longest = 0;
    for (const auto& [label, length] : lengths)
      if (length > longest &&
          std::ranges::all_of(lengths, [&, own = label](const auto& other) { return may_touch(own, other.first); })) {
        longest = length;
        best = label;
      }
    return best;
  }

  RegionMap& map_;
  const Triangulation& mesh_;
  const std::span<const std::array<int, 2>> pairs_;
  const std::span<const geometry::Vec2> tips_;
  std::vector<geometry::RegionLoss>& losses_;
  std::vector<char> changes_; // by triangle
  std::vector<char> on_wall_; // by vertex
};

} // namespace

std::optional<Partition> absorb_parts(const geometry::InnerCurves& curves, const geometry::Boundary& boundary,
                                      const ArcRequest& request, std::span<const std::array<int, 2>> pairs,
                                      SmallParts which) {
  if (pairs.empty() || curves.empty())
    return std::nullopt;
  RegionMap map(curves, boundary, request);
  if (!map.is_valid())
    return std::nullopt;
  if (which == SmallParts::and_necks)
    map.add_nodes_to_narrow_parts();
  std::vector<geometry::RegionLoss> losses;
  if (!map.is_valid() || !Absorber(map, pairs, request.tips, losses).run(which))
    return std::nullopt;
  return curves_of_labels(map, curves, boundary, std::move(losses));
}

} // namespace trime::generalise
