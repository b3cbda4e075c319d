// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/inner_wedges.hpp"

#include "core/angle.hpp"

#include <cmath>
#include <map>
#include <utility>

namespace trime::geometry {
namespace {

constexpr double sharp_angle = pi / 3;

/// The directions in which curves leave their nodes.
class Directions {
public:
  explicit Directions(const Periods& periods) : periods_(periods) {}
  void watch(Vec2 node) { arms_[key(node)]; }
  void add(Vec2 node, Vec2 direction) {
    if (const auto found = arms_.find(key(node)); found != arms_.end())
      found->second.push_back(direction);
  }
  void add_both(const Piece& piece) {
    add(piece.start, piece.tangent(0));
    add(piece.end, -1 * piece.tangent(piece.length()));
  }
  /// Returns the smallest angle between two curves at the node, or 0 if it is not below 60 degrees.
  double wedge(Vec2 node) const {
    const std::vector<Vec2>& arms = arms_.at(key(node));
    double least = sharp_angle;
    for (std::size_t k = 0; k < arms.size(); ++k)
      for (std::size_t j = 0; j < k; ++j)
        least = std::fmin(least, std::fabs(angle_of(cross(arms[k], arms[j]), dot(arms[k], arms[j]))));
    return least < sharp_angle ? least : 0;
  }

private:
  std::pair<double, double> key(Vec2 node) const {
    const Vec2 canonical = periods_.wrap(node);
    return {canonical.x, canonical.y};
  }

  const Periods& periods_;
  std::map<std::pair<double, double>, std::vector<Vec2>> arms_;
};

} // namespace

void set_wedges(std::vector<InnerArc>& arcs, const Boundary& boundary) {
  Directions directions(boundary.periods);
  for (const InnerArc& arc : arcs)
    if (!arc.closed)
      for (const Vec2 node : {arc.pieces.front().start, arc.pieces.back().end})
        directions.watch(node);
  for (const InnerArc& arc : arcs)
    if (!arc.closed) {
      directions.add(arc.pieces.front().start, arc.pieces.front().tangent(0));
      directions.add(arc.pieces.back().end, -1 * arc.pieces.back().tangent(arc.pieces.back().length()));
    }
  for (const Loop& loop : boundary.loops)
    for (const Piece& piece : loop.pieces)
      directions.add_both(piece);
  for (InnerArc& arc : arcs)
    if (!arc.closed) {
      arc.start_wedge = directions.wedge(arc.pieces.front().start);
      arc.end_wedge = directions.wedge(arc.pieces.back().end);
    }
}

} // namespace trime::geometry
