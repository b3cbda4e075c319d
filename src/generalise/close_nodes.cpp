// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/close_nodes.hpp"

#include "generalise/rules.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
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
    for (std::size_t k = 0; k < arcs_.size(); ++k) {
      ++arcs_of_[curve(k)];
      pairs_.insert(std::minmax(arcs_[k].left, arcs_[k].right));
    }
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

  /// May the arm at `from` move to `to`? Two arcs with the same ends could become one straight line.
  bool may_move(const Arm& arm, Vec2 from, Vec2 to) const {
    const Vec2 next = vertex_after(arm);
    const Vec2 far = far_end(arm);
    if (last_piece(arm).circular || far == from || far == to || next == to || (is_on_rim(to) && is_on_rim(next)) ||
        !tree_.is_empty_at({from, to, next}))
      return false;
    if (const Arm* beside = arm_to(to, next); beside != nullptr)
      return merges(arm, *beside);
    const double clearance = GeneraliseRules::clearance * sizing::checked_size(size_, from);
    return (curve(arm.arc) < 0 || tree_.has_room({to, next}, nodes_.vertices.at(key(from)), clearance)) &&
           std::ranges::none_of(arms_.at(key(to)), [&](const Arm& other) { return far_end(other) == far; });
  }

  /// May both arms become one edge? They must be edges, and the regions beyond them must be neighbours already.
  bool merges(const Arm& arm, const Arm& beside) const {
    const InnerArc &goes = arcs_[arm.arc], &stays = arcs_[beside.arc];
    const auto [left, right] = sides_of_both(arm, beside);
    return goes.pieces.size() == 1 && stays.pieces.size() == 1 && !stays.pieces[0].circular &&
           (left == right || pairs_.contains(std::minmax(left, right)));
  }

  /// Returns the regions on both sides of an arc when it takes the place of another one too. The face between the two
  /// lies on that side of the arc that stays on which both have the same region.
  std::pair<int, int> sides_of_both(const Arm& arm, const Arm& beside) const {
    const InnerArc &goes = arcs_[arm.arc], &stays = arcs_[beside.arc];
    const bool same_way = arm.at_end == beside.at_end;
    const Vec2 a = stays.pieces[0].start, b = stays.pieces[0].end;
    const Vec2 other = arm.at_end ? goes.pieces[0].end : goes.pieces[0].start; // where the arm begins
    return cross(b - a, other - a) > 0 ? std::pair(same_way ? goes.left : goes.right, stays.right)
                                       : std::pair(stays.left, same_way ? goes.right : goes.left);
  }

  /// Does each curve keep an edge if the arms become arms at `to`?
  bool keeps_all_curves(std::size_t edge, const std::vector<Arm>& arms, Vec2 to) const {
    std::map<int, std::size_t> gone{{curve(edge), 1}};
    for (const Arm& arm : arms)
      if (arm.arc != edge)
        if (const Arm* beside = arm_to(to, vertex_after(arm)); beside != nullptr && curve(beside->arc) >= 0)
          ++gone[curve(arm.arc)];
    return std::ranges::all_of(gone,
                               [&](const auto& one) { return one.first < 0 || arcs_of_.at(one.first) > one.second; });
  }

  /// Moves all arcs at `from` to `to` if they may move. @param edge the arc between the two
  bool joins(std::size_t edge, Vec2 from, Vec2 to) {
    const std::vector<Arm> arms = arms_.at(key(from));
    const bool is_free_end = arms_.at(key(to)).size() < 2 && !is_on_rim(to);
    if (is_free_end || arms.size() < 3 || must_stay(from) ||
        !std::ranges::all_of(arms, [&](const Arm& arm) { return arm.arc == edge || may_move(arm, from, to); }) ||
        !keeps_all_curves(edge, arms, to))
      return false;
    tree_.remove(nodes_.vertices.at(key(from)));
    note_loss_of(arcs_[edge]);
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

  /// Makes one edge of two that have the same ends now: the face between them is gone.
  void merge(const Arm& arm, const Arm& beside) {
    InnerArc& stays = arcs_[beside.arc];
    if (const auto [left, right] = sides_of_both(arm, beside); left != stays.left || right != stays.right) {
      note_loss_of(stays);
      stays.lost_area = 0; // of another pair
      stays.left = left;
      stays.right = right;
    }
    if (curve(beside.arc) < 0 && curve(arm.arc) >= 0) {
      --arcs_of_[curve(beside.arc)];
      stays.pieces[0].part = curve(arm.arc);
      ++arcs_of_[curve(beside.arc)];
      if (arm.at_end != beside.at_end)
        turn_round(beside.arc); // edges have the direction of their curve
    }
    note_loss_of(arcs_[arm.arc]);
    remove(arm.arc);
    if (stays.left == stays.right && curve(beside.arc) < 0)
      remove(beside.arc);
  }

  void turn_round(std::size_t arc) {
    InnerArc& turned = arcs_[arc];
    std::swap(turned.left, turned.right);
    turned.lost_area = -turned.lost_area;
    std::swap(turned.pieces[0].start, turned.pieces[0].end);
    for (const Vec2 p : {start(arc), end(arc)})
      for (Arm& arm : arms_.at(key(p)))
        if (arm.arc == arc)
          arm.at_end = !arm.at_end;
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
  std::map<int, std::size_t> arcs_of_;  // by curve: how many are left
  std::set<std::pair<int, int>> pairs_; // regions that are neighbours, the lower one first
};

} // namespace

void join_close_nodes(geometry::InnerCurves& curves, const Nodes& nodes, const sizing::SizeField& size,
                      VertexTree& tree) {
  curves.joined_nodes += NodeJoiner(curves, nodes, size, tree).run();
}

} // namespace trime::generalise
