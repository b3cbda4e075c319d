// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/close_nodes.hpp"

#include "generalise/rules.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace trime::generalise {
namespace {

using geometry::InnerArc;
using geometry::Piece;
using geometry::Vec2;

constexpr int most_rounds = 20; // over all arcs; nodes may come near to others

class NodeJoiner {
public:
  NodeJoiner(geometry::InnerCurves& curves, const Nodes& nodes, const sizing::SizeField& size, VertexTree& tree)
      : curves_(curves), arcs_(curves.arcs), nodes_(nodes), size_(size), tree_(tree), is_gone_(curves.arcs.size(), 0) {
    for (std::size_t k = 0; k < arcs_.size(); ++k)
      ++arcs_of_[curve(k)];
    for (std::size_t k = 0; k < arcs_.size(); ++k)
      if (!arcs_[k].closed) {
        arms_[key(start(k))].push_back({k, false});
        arms_[key(end(k))].push_back({k, true});
      }
  }

  std::int64_t run() {
    std::int64_t joined = 0;
    for (int round = 0, before = -1; round < most_rounds && joined != before; ++round) {
      before = static_cast<int>(joined);
      for (std::size_t k = 0; k < arcs_.size(); ++k)
        joined += is_short(k) && (joins(k, end(k), start(k)) || joins(k, start(k), end(k)));
    }
    std::size_t left = 0;
    for (std::size_t k = 0; k < arcs_.size(); ++k)
      if (is_gone_[k] == 0) {
        if (left != k)
          arcs_[left] = std::move(arcs_[k]);
        ++left;
      }
    arcs_.resize(left);
    return joined;
  }

private:
  struct Arm {
    std::size_t arc;
    bool at_end; ///< the arc ends here; otherwise it begins here
  };
  using Key = std::pair<double, double>;
  static Key key(Vec2 p) { return {p.x, p.y}; }
  Vec2 start(std::size_t arc) const { return arcs_[arc].pieces.front().start; }
  Vec2 end(std::size_t arc) const { return arcs_[arc].pieces.back().end; }
  int curve(std::size_t arc) const { return arcs_[arc].pieces.front().part; }

  bool is_short(std::size_t k) const {
    const InnerArc& arc = arcs_[k];
    if (is_gone_[k] != 0 || arc.closed || arc.pieces.size() != 1 || arc.pieces[0].circular || start(k) == end(k) ||
        (curve(k) >= 0 && arcs_of_.at(curve(k)) == 1)) // no curve loses all of its edges
      return false;
    return geometry::length(end(k) - start(k)) < GeneraliseRules::node_distance * sizing::checked_size(size_, start(k));
  }

  Piece& last_piece(const Arm& arm) {
    return arm.at_end ? arcs_[arm.arc].pieces.back() : arcs_[arm.arc].pieces.front();
  }

  /// Is the place a node on the boundary? An edge between two of them may lie on the boundary.
  bool is_on_rim(Vec2 p) const {
    const auto node = nodes_.vertices.find(key(p));
    return node != nodes_.vertices.end() && node->second < nodes_.rim_vertices;
  }

  /// Does an arc at the node lead to this vertex first?
  bool has_edge(Vec2 node, Vec2 vertex) {
    return std::ranges::any_of(arms_.at(key(node)), [&](const Arm& arm) {
      const Piece& piece = last_piece(arm);
      return (arm.at_end ? piece.start : piece.end) == vertex;
    });
  }

  /// Moves all arcs at `from` to `to` if they may move. @param edge the arc between the two
  bool joins(std::size_t edge, Vec2 from, Vec2 to) {
    std::vector<Arm>& arms = arms_.at(key(from));
    const LocalIndex vertex = nodes_.vertices.at(key(from));
    const bool is_free_end = arms_.at(key(to)).size() < 2 && !is_on_rim(to);
    if (is_free_end || arms.size() < 3 || is_on_rim(from) ||
        std::binary_search(nodes_.kept.begin(), nodes_.kept.end(), from, geometry::lexicographically_less))
      return false;
    for (const Arm& arm : arms) {
      if (arm.arc == edge)
        continue;
      const Piece& piece = last_piece(arm);
      const Vec2 next = arm.at_end ? piece.start : piece.end;
      if (piece.circular || start(arm.arc) == end(arm.arc) || (arm.at_end ? start(arm.arc) : end(arm.arc)) == to ||
          next == to || has_edge(to, next) || (is_on_rim(to) && is_on_rim(next)) ||
          !tree_.is_empty_at({from, to, next}))
        return false;
    }
    for (const Arm& arm : arms)
      if (arm.arc != edge) {
        note_loss(arm, from, to);
        (arm.at_end ? last_piece(arm).end : last_piece(arm).start) = to;
        arms_.at(key(to)).push_back(arm);
      }
    arms.clear();
    std::erase_if(arms_.at(key(to)), [edge](const Arm& arm) { return arm.arc == edge; });
    note_loss_of(arcs_[edge]);
    tree_.remove(vertex);
    --arcs_of_[curve(edge)];
    is_gone_[edge] = 1;
    return true;
  }

  /// Notes which region the last piece of an arm takes from when it turns to another node.
  void note_loss(const Arm& arm, Vec2 from, Vec2 to) {
    const InnerArc& arc = arcs_[arm.arc];
    const Piece& piece = last_piece(arm);
    const double to_left = -0.5 * cross(piece.end - piece.start, to - piece.start);
    if (arc.left != arc.right && to_left != 0)
      curves_.losses.push_back({to_left > 0 ? arc.right : arc.left, to_left > 0 ? arc.left : arc.right,
                                geometry::LossReason::close_nodes, std::fabs(to_left), 1, std::fabs(to_left), from});
  }

  /// Notes what an arc that goes has taken from its left side before.
  void note_loss_of(const InnerArc& arc) {
    if (arc.lost_area == 0)
      return;
    const bool left_loses = arc.lost_area > 0;
    const double area = std::fabs(arc.lost_area);
    curves_.losses.push_back({left_loses ? arc.left : arc.right, left_loses ? arc.right : arc.left,
                              geometry::LossReason::thinning, area, 1, area, arc.pieces.front().start});
  }

  geometry::InnerCurves& curves_;
  std::vector<InnerArc>& arcs_;
  const Nodes& nodes_;
  const sizing::SizeField& size_;
  VertexTree& tree_;
  std::vector<char> is_gone_; // by arc
  std::map<Key, std::vector<Arm>> arms_;
  std::map<int, std::size_t> arcs_of_; // by curve: how many are left
};

} // namespace

void join_close_nodes(geometry::InnerCurves& curves, const Nodes& nodes, const sizing::SizeField& size,
                      VertexTree& tree) {
  curves.joined_nodes += NodeJoiner(curves, nodes, size, tree).run();
}

} // namespace trime::generalise
