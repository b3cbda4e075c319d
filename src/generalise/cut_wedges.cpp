// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/cut_wedges.hpp"

#include "generalise/meeting_pieces.hpp"
#include "generalise/rules.hpp"
#include "geometry/predicates.hpp"
#include "trime/geometry/piece_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace trime::generalise {
namespace {

using geometry::ArcEnd;
using geometry::InnerArc;
using geometry::NarrowWedge;
using geometry::orient2d;
using geometry::Piece;
using geometry::Vec2;

/// All pieces of the boundary and of the arcs before anything is cut, to find what lies in a tip.
class Obstacles {
public:
  Obstacles(const geometry::Boundary& boundary, const std::vector<InnerArc>& arcs) : all_(boundary) {
    for (const InnerArc& arc : arcs)
      all_.loops.emplace_back().pieces = arc.pieces;
    for (const geometry::Loop& loop : all_.loops)
      pieces_.insert(pieces_.end(), loop.pieces.begin(), loop.pieces.end());
    tree_ = geometry::PieceTree(all_);
  }

  /// Is the triangle free of curves, apart from the sides at its first corner, the node?
  bool is_free(const std::array<Vec2, 3>& corners) const {
    const Vec2 middle = (1.0 / 3) * (corners[0] + corners[1] + corners[2]);
    double reach = 0;
    for (const Vec2 corner : corners)
      reach = std::fmax(reach, length(corner - middle));
    Piece lid;
    lid.start = corners[1];
    lid.end = corners[2];
    const auto pieces = tree_.within(middle, reach);
    return std::ranges::none_of(pieces, [&](std::size_t k) {
      const Piece& piece = pieces_[k];
      const bool is_side = is_along(piece, corners[0], corners[1]) || is_along(piece, corners[0], corners[2]);
      return !is_side && (holds(corners, piece.start) || holds(corners, piece.end) || meet(lid, piece));
    });
  }

private:
  /// Does the piece begin or end at the node and pass `p`, to within rounding to the lattice?
  static bool is_along(const Piece& piece, Vec2 node, Vec2 p) {
    if (piece.circular || (piece.start != node && piece.end != node))
      return false;
    const Vec2 way = (piece.start == node ? piece.end : piece.start) - node;
    return dot(way, p - node) > 0 && std::fabs(cross(way, p - node)) < 1e-6 * length(way) * length(p - node);
  }
  static bool holds(const std::array<Vec2, 3>& corners, Vec2 p) {
    const int a = orient2d(corners[0], corners[1], p), b = orient2d(corners[1], corners[2], p),
              c = orient2d(corners[2], corners[0], p);
    return p != corners[0] && ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0));
  }

  geometry::Boundary all_;
  std::vector<Piece> pieces_;
  geometry::PieceTree tree_;
};

class WedgeCutter {
public:
  WedgeCutter(geometry::InnerCurves& curves, const geometry::Boundary& boundary, const ArcRequest& request)
      : curves_(curves), obstacles_(boundary, curves.arcs), request_(request) {}

  void cut(const NarrowWedge& wedge) {
    if (std::binary_search(request_.kept.begin(), request_.kept.end(), wedge.node, geometry::lexicographically_less) ||
        is_cut_.contains(key(wedge.left)) || is_cut_.contains(key(wedge.right)))
      return;
    const double h = sizing::checked_size(request_.size, wedge.node), narrow = GeneraliseRules::narrow_inside * h;
    const bool left_wins = wedge.left_region <= wedge.right_region;
    const ArcEnd kept = left_wins ? wedge.right : wedge.left, other = left_wins ? wedge.left : wedge.right;
    const Vec2 along = first_way(kept, wedge.node), beside = first_way(other, wedge.node);
    const double shortest = std::fmin(length(along), length(beside));
    const Vec2 u = (1 / length(along)) * along, v = (1 / length(beside)) * beside;
    const double reach = narrow / length(u - v); // there the tip is as wide as it must be
    if (!(reach + narrow + h < shortest))
      return;
    const Vec2 node = request_.lattice.snap(wedge.node + reach * u),
               end = request_.lattice.snap(wedge.node + (reach + narrow) * v);
    if (orient2d(wedge.node, node, end) == 0 || !obstacles_.is_free({wedge.node, node, end}))
      return;
    is_cut_.insert({key(kept), key(other)});
    begin_at(kept, node);
    begin_at(other, end);
    put_before(other, node, end);
    add_border(wedge, kept, node);
    const double area = 0.5 * std::fabs(cross(node - wedge.node, end - wedge.node));
    curves_.losses.push_back({wedge.region, left_wins ? wedge.left_region : wedge.right_region,
                              geometry::LossReason::pinch_out, area, 1, area, node});
  }

private:
  static std::pair<std::size_t, bool> key(ArcEnd end) { return {end.arc, end.at_end}; }

  /// The first piece from the node on.
  Vec2 first_way(ArcEnd end, Vec2 node) const {
    const std::vector<Piece>& pieces = curves_.arcs[end.arc].pieces;
    return (end.at_end ? pieces.back().start : pieces.front().end) - node;
  }

  void begin_at(ArcEnd end, Vec2 p) {
    std::vector<Piece>& pieces = curves_.arcs[end.arc].pieces;
    (end.at_end ? pieces.back().end : pieces.front().start) = p;
  }

  /// Lets the arc begin at `from`, with a piece to `to`, where it began.
  void put_before(ArcEnd end, Vec2 from, Vec2 to) {
    std::vector<Piece>& pieces = curves_.arcs[end.arc].pieces;
    Piece lid = end.at_end ? pieces.back() : pieces.front();
    lid.start = end.at_end ? to : from;
    lid.end = end.at_end ? from : to;
    lid.corner = false;
    pieces.insert(end.at_end ? pieces.end() : pieces.begin(), lid);
  }

  /// Lets the two regions next to the tip touch up to the new node.
  void add_border(const NarrowWedge& wedge, ArcEnd kept, Vec2 node) {
    if (wedge.left_region == wedge.right_region)
      return;
    Piece piece = curves_.arcs[kept.arc].pieces.front();
    const bool is_along = wedge.left_region < wedge.right_region; // the lower one lies on the left
    piece.start = is_along ? wedge.node : node;
    piece.end = is_along ? node : wedge.node;
    piece.corner = false;
    InnerArc& border = curves_.arcs.emplace_back();
    border.pieces = {piece};
    border.left = std::min(wedge.left_region, wedge.right_region);
    border.right = std::max(wedge.left_region, wedge.right_region);
  }

  geometry::InnerCurves& curves_;
  const Obstacles obstacles_;
  const ArcRequest& request_;
  std::set<std::pair<std::size_t, bool>> is_cut_; // ends of arcs
};

} // namespace

void cut_wedges(geometry::InnerCurves& curves, std::span<const NarrowWedge> given, const geometry::Boundary& boundary,
                const ArcRequest& request) {
  if (given.empty())
    return;
  std::set<std::array<double, 5>> known;
  for (const NarrowWedge& wedge : given)
    known.insert(wedge.key());
  const std::vector<NarrowWedge> wedges = geometry::narrow_wedges(curves.arcs, boundary);
  WedgeCutter cutter(curves, boundary, request);
  for (const NarrowWedge& wedge : wedges)
    if (known.contains(wedge.key()))
      cutter.cut(wedge);
}

} // namespace trime::generalise
