// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/free_ends.hpp"

#include "generalise/rules.hpp"
#include "geometry/box_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace trime::generalise {
namespace {

using geometry::Box;
using geometry::InnerArc;
using geometry::Piece;
using geometry::Vec2;

constexpr double step = 0.05;            // [h] by which an end is tried farther back
constexpr double most_of_its_edge = 0.5; // [length of the last edge] by which an end may move

/// A free end of an arc.
struct FreeEnd {
  std::size_t arc;
  bool at_end; ///< the arc ends there; otherwise it begins there
};

class EndMover {
public:
  EndMover(geometry::InnerCurves& curves, const geometry::Boundary& boundary, const ArcRequest& request)
      : curves_(curves), request_(request), ends_(free_ends(boundary)) {
    if (ends_.empty())
      return;
    for (const geometry::Loop& loop : boundary.loops)
      for (const Piece& piece : loop.pieces)
        add(piece, no_arc);
    for (std::size_t arc = 0; arc < curves.arcs.size(); ++arc)
      for (const Piece& piece : curves.arcs[arc].pieces)
        add(piece, arc);
    std::vector<Box> boxes;
    for (const Other& other : others_)
      boxes.push_back(other.piece.covering_box());
    tree_ = geometry::BoxTree(boxes);
  }

  void run() {
    for (const FreeEnd& end : ends_)
      curves_.joined_nodes += draws_back(end) ? 1 : 0;
  }

private:
  static constexpr std::size_t no_arc = std::numeric_limits<std::size_t>::max();
  struct Other {
    Piece piece;
    std::size_t arc;
  };

  void add(const Piece& piece, std::size_t arc) { others_.push_back({piece, arc}); }

  /// The ends at which no other arc and no loop of the boundary has a vertex, and that may move.
  std::vector<FreeEnd> free_ends(const geometry::Boundary& boundary) const {
    const auto key = [](Vec2 p) { return std::pair(p.x, p.y); };
    std::map<std::pair<double, double>, int> arms;
    for (const InnerArc& arc : curves_.arcs)
      if (!arc.closed) {
        ++arms[key(arc.pieces.front().start)];
        ++arms[key(arc.pieces.back().end)];
      }
    for (const geometry::Loop& loop : boundary.loops)
      for (const Piece& piece : loop.pieces)
        if (const auto node = arms.find(key(piece.start)); node != arms.end())
          ++node->second;
    std::vector<FreeEnd> ends;
    for (std::size_t k = 0; k < curves_.arcs.size(); ++k)
      for (const bool at_end : {false, true}) {
        const InnerArc& arc = curves_.arcs[k];
        const Piece& last = at_end ? arc.pieces.back() : arc.pieces.front();
        const Vec2 p = at_end ? last.end : last.start;
        if (!arc.closed && !last.circular && arms.at(key(p)) == 1 &&
            !std::ranges::binary_search(request_.kept, p, geometry::lexicographically_less))
          ends.push_back({k, at_end});
      }
    return ends;
  }

  /// The pieces of other curves near a place, but those that meet the curve at `behind`.
  std::vector<const Piece*> pieces_near(const FreeEnd& end, Vec2 p, Vec2 behind, double reach) const {
    std::vector<const Piece*> near;
    const Box around{p - Vec2{reach, reach}, p + Vec2{reach, reach}};
    for (const std::size_t k : tree_.meeting(around))
      if (const Other& other = others_[k];
          other.arc != end.arc && other.piece.start != behind && other.piece.end != behind)
        near.push_back(&other.piece);
    return near;
  }

  static double distance(Vec2 p, const std::vector<const Piece*>& pieces) {
    double least = std::numeric_limits<double>::infinity();
    for (const Piece* piece : pieces)
      least = std::fmin(least, piece->distance(p));
    return least;
  }

  bool draws_back(const FreeEnd& end) {
    InnerArc& arc = curves_.arcs[end.arc];
    Piece& last = end.at_end ? arc.pieces.back() : arc.pieces.front();
    Vec2& tip = end.at_end ? last.end : last.start;
    const Vec2 behind = end.at_end ? last.start : last.end;
    const double h = sizing::checked_size(request_.size, tip), length = geometry::length(behind - tip);
    const double most = std::fmin(GeneraliseRules::most_drawn_back * h, most_of_its_edge * length);
    const std::vector<const Piece*> near = pieces_near(end, tip, behind, most + GeneraliseRules::end_clearance * h);
    if (!(distance(tip, near) < GeneraliseRules::end_gap * h))
      return false;
    for (int k = 1; k * step * h <= most; ++k) {
      const Vec2 p = request_.lattice.snap(tip + (k * step * h / length) * (behind - tip));
      if (distance(p, near) < GeneraliseRules::end_clearance * h)
        continue;
      tip = p;
      return true;
    }
    return false;
  }

  geometry::InnerCurves& curves_;
  const ArcRequest& request_;
  const std::vector<FreeEnd> ends_;
  std::vector<Other> others_; // as they were given: no other curve comes nearer to an end
  geometry::BoxTree tree_;
};

} // namespace

void draw_back_ends(geometry::InnerCurves& curves, const geometry::Boundary& boundary, const ArcRequest& request) {
  EndMover(curves, boundary, request).run();
}

} // namespace trime::generalise
