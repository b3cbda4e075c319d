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

// [arcs] That go where two nodes become one: the edge between them, and one for each triangle at this edge that closes.
constexpr std::size_t most_removed = 3;

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
        joined += is_short(k) && (drops_end(k) || joins(k, end(k), start(k)) || joins(k, start(k), end(k)));
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

  const Piece& last_piece(const Arm& arm) const {
    return arm.at_end ? arcs_[arm.arc].pieces.back() : arcs_[arm.arc].pieces.front();
  }

  /// Is the place a node on the boundary? An edge between two of them may lie on the boundary.
  bool is_on_rim(Vec2 p) const {
    const auto node = nodes_.vertices.find(key(p));
    return node != nodes_.vertices.end() && node->second < nodes_.rim_vertices;
  }

  Vec2 vertex_after(const Arm& arm) const {
    const InnerArc& arc = arcs_[arm.arc];
    return arm.at_end ? arc.pieces.back().start : arc.pieces.front().end;
  }

  Vec2 far_end(const Arm& arm) const { return arm.at_end ? start(arm.arc) : end(arm.arc); }

  /// The arm at the node that leads to this vertex first; nullptr if no arm does.
  const Arm* arm_to(Vec2 node, Vec2 vertex) const {
    const std::vector<Arm>& arms = arms_.at(key(node));
    const auto found = std::ranges::find_if(arms, [&](const Arm& arm) { return vertex_after(arm) == vertex; });
    return found == arms.end() ? nullptr : &*found;
  }

  bool must_stay(Vec2 p) const {
    return is_on_rim(p) ||
           std::binary_search(nodes_.kept.begin(), nodes_.kept.end(), p, geometry::lexicographically_less);
  }

  /// Takes an arc out of the lists of its ends.
  void remove(std::size_t arc) {
    for (const Vec2 p : {start(arc), end(arc)})
      std::erase_if(arms_.at(key(p)), [arc](const Arm& arm) { return arm.arc == arc; });
    --arcs_of_[curve(arc)];
    is_gone_[arc] = 1;
  }

  /// Removes an edge of a curve that ends shortly behind a node where it meets others.
  bool drops_end(std::size_t edge) {
    if (arcs_[edge].left != arcs_[edge].right)
      return false;
    for (const auto& [free, node] : {std::pair(start(edge), end(edge)), std::pair(end(edge), start(edge))})
      if (arms_.at(key(free)).size() == 1 && !must_stay(free) && (arms_.at(key(node)).size() > 2 || is_on_rim(node))) {
        tree_.remove(nodes_.vertices.at(key(free)));
        remove(edge);
        return true;
      }
    return false;
  }

  /// May the arm at `from` move to `to`? Two arcs with the same ends could become one straight line.
  bool may_move(const Arm& arm, Vec2 from, Vec2 to) const {
    const Vec2 next = vertex_after(arm);
    const Vec2 far = far_end(arm);
    if (last_piece(arm).circular || far == from || far == to || next == to || (is_on_rim(to) && is_on_rim(next)) ||
        !tree_.is_empty_at({from, to, next}))
      return false;
    if (const Arm* beside = arm_to(to, next); beside != nullptr)
      return merges(arm, *beside);
    return std::ranges::none_of(arms_.at(key(to)), [&](const Arm& other) { return far_end(other) == far; });
  }

  /// Are both arms single edges, so that they become one? A curve keeps at least one edge.
  bool merges(const Arm& arm, const Arm& beside) const {
    const InnerArc &goes = arcs_[arm.arc], &stays = arcs_[beside.arc];
    return goes.pieces.size() == 1 && stays.pieces.size() == 1 && !stays.pieces[0].circular &&
           (curve(arm.arc) < 0 || curve(arm.arc) == curve(beside.arc) || curve(beside.arc) < 0 ||
            arcs_of_.at(curve(arm.arc)) > most_removed);
  }

  /// Moves all arcs at `from` to `to` if they may move. @param edge the arc between the two
  bool joins(std::size_t edge, Vec2 from, Vec2 to) {
    const std::vector<Arm> arms = arms_.at(key(from));
    const bool is_free_end = arms_.at(key(to)).size() < 2 && !is_on_rim(to);
    if (is_free_end || arms.size() < 3 || must_stay(from) ||
        !std::ranges::all_of(arms, [&](const Arm& arm) { return arm.arc == edge || may_move(arm, from, to); }))
      return false;
    tree_.remove(nodes_.vertices.at(key(from)));
    remove(edge);
    for (const Arm& arm : arms)
      if (arm.arc != edge)
        move(arm, from, to);
    return true;
  }

  void move(const Arm& arm, Vec2 from, Vec2 to) {
    note_loss(arm, from, to);
    const Arm* found = arm_to(to, vertex_after(arm));
    if (found != nullptr) {
      const Arm beside = *found;
      merge(arm, beside);
      return;
    }
    std::erase_if(arms_.at(key(from)), [&](const Arm& other) { return other.arc == arm.arc; });
    (arm.at_end ? arcs_[arm.arc].pieces.back().end : arcs_[arm.arc].pieces.front().start) = to;
    arms_.at(key(to)).push_back(arm);
  }

  /// Makes one edge of two that have the same ends now: the face between them is gone. It lies on that side of the arc
  /// that stays on which both have the same region.
  void merge(const Arm& arm, const Arm& beside) {
    const InnerArc& goes = arcs_[arm.arc];
    InnerArc& stays = arcs_[beside.arc];
    const bool same_way = arm.at_end == beside.at_end;
    const Vec2 a = stays.pieces[0].start, b = stays.pieces[0].end;
    const Vec2 other = arm.at_end ? goes.pieces[0].end : goes.pieces[0].start; // where the arm begins
    if (cross(b - a, other - a) > 0)
      stays.left = same_way ? goes.left : goes.right;
    else
      stays.right = same_way ? goes.right : goes.left;
    if (curve(beside.arc) < 0 && curve(arm.arc) >= 0) {
      --arcs_of_[curve(beside.arc)];
      stays.pieces[0].part = curve(arm.arc);
      ++arcs_of_[curve(beside.arc)];
    }
    remove(arm.arc);
    if (stays.left == stays.right && curve(beside.arc) < 0)
      remove(beside.arc);
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
