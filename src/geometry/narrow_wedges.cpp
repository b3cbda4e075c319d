// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/narrow_wedges.hpp"

#include "core/angle.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace trime::geometry {
namespace {

// [radians] Wider wedges are left to the triangles: 20 degrees.
constexpr double narrow_angle = pi / 9;

/// A curve that leaves a node; one of the boundary has no arc.
struct Arm {
  Vec2 direction;
  double angle;
  ArcEnd end;
  bool is_straight_interface;
};

class Nodes {
public:
  Nodes(const std::vector<InnerArc>& arcs, const Boundary& boundary) : arcs_(arcs) {
    for (const InnerArc& arc : arcs)
      if (!arc.closed)
        for (const Vec2 node : {arc.pieces.front().start, arc.pieces.back().end})
          arms_[{node.x, node.y}];
    for (std::size_t k = 0; k < arcs.size(); ++k)
      if (!arcs[k].closed) {
        const Piece &first = arcs[k].pieces.front(), &last = arcs[k].pieces.back();
        add(first.start, first.tangent(0), {k, false}, is_interface(arcs[k], first));
        add(last.end, -1 * last.tangent(last.length()), {k, true}, is_interface(arcs[k], last));
      }
    for (const Loop& loop : boundary.loops)
      for (const Piece& piece : loop.pieces) {
        add(piece.start, piece.tangent(0), {arcs.size(), false}, false);
        add(piece.end, -1 * piece.tangent(piece.length()), {arcs.size(), true}, false);
      }
  }

  std::vector<NarrowWedge> wedges() {
    std::vector<NarrowWedge> found;
    for (auto& [place, arms] : arms_) {
      std::sort(arms.begin(), arms.end(), [](const Arm& a, const Arm& b) {
        return std::tie(a.angle, a.end.arc, a.end.at_end) < std::tie(b.angle, b.end.arc, b.end.at_end);
      });
      for (std::size_t k = 0; k < arms.size() && arms.size() > 1; ++k)
        look_at({place.first, place.second}, arms[k], arms[k + 1 < arms.size() ? k + 1 : 0], found);
    }
    return found;
  }

private:
  static bool is_interface(const InnerArc& arc, const Piece& piece) {
    return arc.left != arc.right && piece.part < 0 && !piece.circular;
  }
  void add(Vec2 node, Vec2 direction, ArcEnd end, bool is_straight_interface) {
    if (const auto found = arms_.find({node.x, node.y}); found != arms_.end())
      found->second.push_back({direction, angle_of(direction.y, direction.x), end, is_straight_interface});
  }
  int region_on(const Arm& arm, bool left) const {
    const InnerArc& arc = arcs_[arm.end.arc];
    return left != arm.end.at_end ? arc.left : arc.right;
  }
  void look_at(Vec2 node, const Arm& right, const Arm& left, std::vector<NarrowWedge>& found) const {
    if (!right.is_straight_interface || !left.is_straight_interface)
      return;
    const double angle = angle_of(cross(right.direction, left.direction), dot(right.direction, left.direction));
    if (!(angle > 0 && angle < narrow_angle) || region_on(right, true) != region_on(left, false))
      return;
    found.push_back(
        {node, right.end, left.end, region_on(right, true), region_on(right, false), region_on(left, true)});
  }

  const std::vector<InnerArc>& arcs_;
  std::map<std::pair<double, double>, std::vector<Arm>> arms_;
};

} // namespace

std::vector<NarrowWedge> narrow_wedges(const std::vector<InnerArc>& arcs, const Boundary& boundary) {
  return Nodes(arcs, boundary).wedges();
}

} // namespace trime::geometry
