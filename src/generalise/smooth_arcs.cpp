// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/smooth_arcs.hpp"

#include "core/angle.hpp"
#include "generalise/meeting_pieces.hpp"
#include "generalise/rules.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/piece_tree.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace trime::generalise {
namespace {

using geometry::Boundary;
using geometry::InnerArc;
using geometry::Piece;
using geometry::Vec2;

/// Holds arcs, some of them smooth, and the given form of each.
class SmoothArcs {
public:
  SmoothArcs(const std::vector<InnerArc>& given, const Boundary& boundary, const FlowRequest& request,
             const geometry::Lattice& lattice)
      : given_(given), boundary_(boundary), request_(request), lattice_(lattice), arcs_(given),
        is_smooth_(given.size(), 0), is_new_(given.size(), 1), rounds_(given.size(), 0) {
    for (const InnerArc& arc : given)
      if (!arc.closed)
        for (const Vec2 node : {arc.pieces.front().start, arc.pieces.back().end})
          nodes_[{node.x, node.y}];
  }

  /// Smooths arcs less where curves would cross, and in the end not at all. Each round changes at least one of them.
  std::vector<InnerArc> result() {
    for (std::size_t k = 0; k < arcs_.size(); ++k)
      if (given_[k].left != given_[k].right)
        smooth(k);
    while (std::ranges::any_of(is_smooth_, [](char is) { return is != 0; })) {
      std::vector<char> is_bad(arcs_.size(), 0);
      find_crossings(is_bad);
      find_turned_nodes(is_bad);
      std::ranges::fill(is_new_, 0);
      bool any = false;
      for (std::size_t k = 0; k < arcs_.size(); ++k)
        if (is_bad[k] != 0 && is_smooth_[k] != 0) {
          ++rounds_[k];
          smooth(k);
          is_new_[k] = 1;
          any = true;
        }
      if (!any)
        break;
    }
    return std::move(arcs_);
  }

private:
  void smooth(std::size_t arc) {
    arcs_[arc] = given_[arc];
    is_smooth_[arc] = 0;
    if (rounds_[arc] == GeneraliseRules::flow_rounds)
      return;
    FlowRequest request = request_;
    request.reach = std::ldexp(request_.reach, -rounds_[arc]);
    if (auto pieces = smoothed_arc(given_[arc], request, lattice_)) {
      arcs_[arc].pieces = *std::move(pieces);
      is_smooth_[arc] = 1;
    }
  }

  /// Marks arcs that meet a smooth one outside of their nodes, if one of the two has changed in the last round.
  void find_crossings(std::vector<char>& is_bad) const {
    Boundary all = boundary_;
    std::vector<std::size_t> arc_of; // by piece; the number of arcs for the boundary
    for (const geometry::Loop& loop : all.loops)
      arc_of.insert(arc_of.end(), loop.pieces.size(), arcs_.size());
    for (std::size_t k = 0; k < arcs_.size(); ++k) {
      all.loops.emplace_back().pieces = arcs_[k].pieces;
      arc_of.insert(arc_of.end(), arcs_[k].pieces.size(), k);
    }
    std::vector<const Piece*> pieces;
    for (const geometry::Loop& loop : all.loops)
      for (const Piece& piece : loop.pieces)
        pieces.push_back(&piece);
    const geometry::PieceTree tree(all);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const Piece& piece = *pieces[k];
      if (arc_of[k] == arcs_.size() || is_new_[arc_of[k]] == 0 || piece.circular)
        continue;
      const double reach = 0.51 * length(piece.end - piece.start);
      for (const std::size_t other : tree.within(0.5 * (piece.start + piece.end), reach))
        if (other != k && (is_smooth_[arc_of[k]] != 0 || is_smooth(arc_of[other])) && meet(piece, *pieces[other])) {
          is_bad[arc_of[k]] = 1;
          if (arc_of[other] < arcs_.size())
            is_bad[arc_of[other]] = 1;
        }
    }
  }

  bool is_smooth(std::size_t arc) const { return arc < arcs_.size() && is_smooth_[arc] != 0; }

  /// A curve that begins or ends at a node, and its direction there.
  struct Arm {
    double angle;
    std::size_t end; ///< 2 k: the start of arc k, 2 k + 1: its end; above these, pieces of the boundary
    bool operator<(const Arm& other) const { return std::pair(angle, end) < std::pair(other.angle, other.end); }
  };
  using Arms = std::map<std::pair<double, double>, std::vector<Arm>>;

  /// The arms around each node, counter-clockwise, the lowest one first.
  Arms arms_of(const std::vector<InnerArc>& arcs) const {
    Arms arms = nodes_;
    const auto add = [&](Vec2 node, Vec2 direction, std::size_t end) {
      if (const auto found = arms.find({node.x, node.y}); found != arms.end())
        found->second.push_back({angle_of(direction.y, direction.x), end});
    };
    for (std::size_t k = 0; k < arcs.size(); ++k) {
      if (arcs[k].closed)
        continue;
      const Piece &first = arcs[k].pieces.front(), &last = arcs[k].pieces.back();
      add(first.start, first.tangent(0), 2 * k);
      add(last.end, -1 * last.tangent(last.length()), 2 * k + 1);
    }
    std::size_t end = 2 * arcs.size();
    for (const geometry::Loop& loop : boundary_.loops)
      for (const Piece& piece : loop.pieces) {
        add(piece.start, piece.tangent(0), end++);
        add(piece.end, -1 * piece.tangent(piece.length()), end++);
      }
    for (auto& [node, around] : arms) {
      std::sort(around.begin(), around.end());
      const auto lowest =
          std::min_element(around.begin(), around.end(), [](const Arm& a, const Arm& b) { return a.end < b.end; });
      std::rotate(around.begin(), lowest, around.end());
    }
    return arms;
  }

  /// Marks arcs at nodes around which the order of the curves is another one than before.
  void find_turned_nodes(std::vector<char>& is_bad) const {
    const Arms before = arms_of(given_), after = arms_of(arcs_);
    for (const auto& [node, around] : before) {
      const std::vector<Arm>& now = after.at(node);
      const bool is_same = std::equal(around.begin(), around.end(), now.begin(), now.end(),
                                      [](const Arm& a, const Arm& b) { return a.end == b.end; });
      for (const Arm& arm : around)
        if (!is_same && arm.end < 2 * arcs_.size())
          is_bad[arm.end / 2] = 1;
    }
  }

  const std::vector<InnerArc>& given_;
  const Boundary& boundary_;
  const FlowRequest& request_;
  const geometry::Lattice& lattice_;
  std::vector<InnerArc> arcs_;
  std::vector<char> is_smooth_; // by arc
  std::vector<char> is_new_;    // by arc: made in the last round
  std::vector<int> rounds_;     // by arc: how often its reach was halved
  Arms nodes_;                  // without arms
};

} // namespace

std::vector<InnerArc> smooth_arcs(const std::vector<InnerArc>& arcs, const Boundary& boundary,
                                  const FlowRequest& request, const geometry::Lattice& lattice) {
  return SmoothArcs(arcs, boundary, request, lattice).result();
}

} // namespace trime::generalise
