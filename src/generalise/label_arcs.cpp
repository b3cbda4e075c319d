// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/label_arcs.hpp"

#include "generalise/chord_losses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace trime::generalise {
namespace {

using geometry::InnerArc;
using geometry::Piece;
using HalfEdge = Triangulation::HalfEdge;

class ArcFinder {
public:
  ArcFinder(const RegionMap& map, const geometry::InnerCurves& curves, const geometry::Boundary& boundary)
      : map_(map), mesh_(map.mesh()), curves_(curves), boundary_(boundary), degree_(at(mesh_.vertex_count()), 0),
        on_rim_(degree_.size(), 0), is_node_(degree_.size(), 0), is_corner_(degree_.size(), 0),
        is_used_(at(3 * mesh_.triangle_count()), 0) {}

  Partition result(std::vector<geometry::RegionLoss> losses) {
    find_nodes();
    Partition made{curves_, boundary_, true};
    made.curves.arcs.clear();
    add_chord_losses(map_, keep_arcs(made.curves), losses);
    made.curves.losses.insert(made.curves.losses.end(), losses.begin(), losses.end());
    for (HalfEdge e = 0; e < 3 * mesh_.triangle_count(); ++e)
      if (is_free(e) && is_node_[at(mesh_.origin(e))] != 0)
        made.curves.arcs.push_back(follow(e));
    for (HalfEdge e = 0; e < 3 * mesh_.triangle_count(); ++e)
      if (is_free(e))
        made.curves.arcs.push_back(ring(e));
    label_boundary(made.boundary);
    return made;
  }

private:
  /// Does an edge belong to an arc inside? The edges of curves of the user do, whatever lies on both sides.
  bool is_inner(HalfEdge e) const {
    const int left = map_.label(Triangulation::triangle(e)), right = map_.label_beside(e);
    return left != RegionMap::outside && right != RegionMap::outside && (left != right || map_.curve_on(e) >= 0);
  }
  /// From a node along an edge that belongs to no arc yet.
  bool is_free(HalfEdge e) const { return is_used_[at(e)] == 0 && is_inner(e); }
  void use(HalfEdge e) { is_used_[at(e)] = is_used_[at(mesh_.twin(e))] = 1; }

  /// Returns the regions on both sides, the lower one first, and the curve. An arc ends where they change.
  std::array<int, 3> sides_of(HalfEdge e) const {
    const auto [low, high] = std::minmax({map_.label(Triangulation::triangle(e)), map_.label_beside(e)});
    return {low, high, map_.curve_on(e)};
  }

  /// A node: on the boundary, where arcs branch or end, and where other regions or another curve begin. Ends of arcs of
  /// the user and of circles are nodes already; where an interface that ended there has gone, the curve goes on.
  void find_nodes() {
    std::vector<std::array<int, 3>> sides(degree_.size());
    std::vector<char> has_lost(degree_.size(), 0); // an interface
    for (const RegionMap::Strand& strand : map_.strands())
      if (strand.arc < 0)
        on_rim_[at(strand.from)] = on_rim_[at(strand.to)] = 1;
    for (HalfEdge e = 0; e < 3 * mesh_.triangle_count(); ++e) {
      const LocalIndex v = mesh_.origin(e);
      if (!is_inner(e)) {
        if (mesh_.is_constrained(e) && map_.strands()[at(mesh_.mark_of_edge(e))].arc >= 0)
          has_lost[at(v)] = 1;
        continue;
      }
      if (degree_[at(v)]++ == 0)
        sides[at(v)] = sides_of(e);
      else if (sides[at(v)] != sides_of(e))
        is_node_[at(v)] = 1;
    }
    for (std::size_t v = 0; v < degree_.size(); ++v)
      is_node_[v] = degree_[v] > 0 && (is_node_[v] != 0 || on_rim_[v] != 0 || degree_[v] != 2);
    for (const RegionMap::Strand& strand : map_.strands())
      if (strand.arc >= 0) {
        const InnerArc& arc = curves_.arcs[static_cast<std::size_t>(strand.arc)];
        const Piece& piece = arc.pieces[strand.piece];
        for (const LocalIndex v : {strand.from, strand.to})
          if (!arc.closed && (piece.circular || (piece.part >= 0 && has_lost[at(v)] == 0)))
            hold_end(v, arc);
        if (piece.corner && mesh_.point(strand.from) == piece.start)
          is_corner_[at(strand.from)] = 1;
      }
  }
  void hold_end(LocalIndex v, const InnerArc& arc) {
    if (mesh_.point(v) == arc.pieces.front().start || mesh_.point(v) == arc.pieces.back().end)
      is_node_[at(v)] = 1;
  }

  /// Takes over the arcs whose labels and nodes have not changed; returns for each arc whether it is one of these.
  std::vector<char> keep_arcs(geometry::InnerCurves& made) {
    const std::size_t n = curves_.arcs.size();
    std::vector<char> stays(n, 1);
    std::vector<std::vector<HalfEdge>> edges(n);
    for (HalfEdge e = 0; e < 3 * mesh_.triangle_count(); ++e) {
      if (mesh_.mark(e) < 0)
        continue;
      const std::size_t number = at(mesh_.mark(e));
      if (map_.strands()[number].arc < 0)
        continue;
      const auto arc = static_cast<std::size_t>(map_.strands()[number].arc);
      stays[arc] = stays[arc] != 0 && is_as_given(e, number);
      edges[arc].push_back(e);
    }
    for (std::size_t k = 0; k < n; ++k) {
      const InnerArc& given = curves_.arcs[k];
      if (stays[k] == 0) {
        note_loss(given, made);
        continue;
      }
      made.arcs.push_back(given);
      for (const HalfEdge e : edges[k])
        use(e);
    }
    return stays;
  }

  /// Has an edge of a strand the regions and the nodes that its arc was given? Nodes are only the two ends of an arc.
  bool is_as_given(HalfEdge e, std::size_t number) const {
    const std::vector<RegionMap::Strand>& strands = map_.strands();
    const RegionMap::Strand& strand = strands[number];
    const InnerArc& given = curves_.arcs[static_cast<std::size_t>(strand.arc)];
    const bool is_first = number == 0 || strands[number - 1].arc != strand.arc,
               is_last = number + 1 == strands.size() || strands[number + 1].arc != strand.arc;
    const bool is_start = !given.closed && is_first && mesh_.origin(e) == strand.from,
               is_end = !given.closed && is_last && mesh_.target(e) == strand.to;
    return is_inner(e) && map_.label(Triangulation::triangle(e)) == given.left && map_.label_beside(e) == given.right &&
           (is_node_[at(mesh_.origin(e))] != 0) == is_start && (is_node_[at(mesh_.target(e))] != 0) == is_end;
  }

  /// The new arc has the area that it has; what the old one has lost before is written down.
  static void note_loss(const InnerArc& arc, geometry::InnerCurves& made) {
    if (arc.left == arc.right || arc.lost_area == 0)
      return;
    const bool left_loses = arc.lost_area > 0;
    const double area = std::fabs(arc.lost_area);
    made.losses.push_back({left_loses ? arc.left : arc.right, left_loses ? arc.right : arc.left,
                           geometry::LossReason::thinning, area, 1, area, arc.pieces.front().start});
  }

  Piece piece_along(HalfEdge e) const {
    Piece piece;
    piece.start = mesh_.point(mesh_.origin(e));
    piece.end = mesh_.point(mesh_.target(e));
    piece.part = map_.curve_on(e);
    const LocalIndex from = mesh_.origin(e);
    piece.corner = map_.is_kept(from) || (piece.part >= 0 && is_corner_[at(from)] != 0);
    return piece;
  }

  /// The other edge at the end of e that belongs to an arc.
  HalfEdge after(HalfEdge e) const {
    const HalfEdge back = mesh_.twin(e);
    for (HalfEdge next = mesh_.around(back);; next = mesh_.around(next))
      if (is_inner(next))
        return next;
  }

  InnerArc follow(HalfEdge first) {
    InnerArc arc;
    arc.left = map_.label(Triangulation::triangle(first));
    arc.right = map_.label_beside(first);
    arc.is_simplified = true;
    for (HalfEdge e = first;; e = after(e)) {
      use(e);
      arc.pieces.push_back(piece_along(e));
      if (is_node_[at(mesh_.target(e))] != 0 || mesh_.target(e) == mesh_.origin(first))
        break;
    }
    if (arc.pieces.front().part >= 0 ? mesh_.mark(first) < 0 : arc.left > arc.right)
      turn(arc); // curves have the direction that they were given
    return arc;
  }

  static void turn(InnerArc& arc) {
    std::swap(arc.left, arc.right);
    std::ranges::reverse(arc.pieces);
    bool corner = false; // of the last piece there is no start inside of the arc
    for (Piece& piece : arc.pieces) {
      std::swap(piece.start, piece.end);
      corner = std::exchange(piece.corner, corner);
    }
  }

  InnerArc ring(HalfEdge first) {
    InnerArc arc = follow(first);
    arc.closed = true;
    const auto lowest = std::ranges::min_element(arc.pieces, geometry::lexicographically_less, &Piece::start);
    std::rotate(arc.pieces.begin(), lowest, arc.pieces.end());
    return arc;
  }

  void label_boundary(geometry::Boundary& made) const {
    for (const RegionMap::Strand& strand : map_.strands()) {
      if (strand.arc >= 0)
        continue;
      Piece& piece = made.loops[static_cast<std::size_t>(-1 - strand.arc)].pieces[strand.piece];
      if (mesh_.point(strand.from) != piece.start)
        continue;
      piece.region = map_.label(Triangulation::triangle(mesh_.find_edge(strand.from, strand.to)));
      if (is_node_[at(strand.from)] != 0)
        piece.corner = true;
      else if (met_curve(strand.from))
        piece.corner = map_.is_kept(strand.from);
    }
  }
  /// Did an arc end there?
  bool met_curve(LocalIndex v) const {
    HalfEdge e = mesh_.leaving(v);
    const HalfEdge first = e;
    do {
      if (mesh_.is_constrained(e) && map_.strands()[at(mesh_.mark_of_edge(e))].arc >= 0)
        return true;
      e = mesh_.around(e);
    } while (e != first && e != Triangulation::none);
    return false;
  }

  const RegionMap& map_;
  const Triangulation& mesh_;
  const geometry::InnerCurves& curves_;
  const geometry::Boundary& boundary_;
  std::vector<int> degree_;            // by vertex: edges of arcs
  std::vector<char> on_rim_, is_node_; // by vertex
  std::vector<char> is_corner_;        // by vertex: a curve was given a corner there
  std::vector<char> is_used_;          // by half-edge
};

} // namespace

Partition curves_of_labels(const RegionMap& map, const geometry::InnerCurves& curves,
                           const geometry::Boundary& boundary, std::vector<geometry::RegionLoss> losses) {
  return ArcFinder(map, curves, boundary).result(std::move(losses));
}

} // namespace trime::generalise
