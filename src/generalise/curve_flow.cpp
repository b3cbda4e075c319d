// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/curve_flow.hpp"

#include "core/angle.hpp"
#include "generalise/cyclic_curve.hpp"
#include "generalise/rules.hpp"
#include "polygon/chord_curve.hpp"
#include "trime/core/types.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace trime::generalise {
namespace {

using geometry::Box;
using geometry::Loop;
using geometry::Piece;
using geometry::Vec2;

/// A vertex of a loop that flows, and the way to the next one.
struct Node {
  Vec2 place, home; // now and at first
  double size;
  std::size_t vertex;  // the start of this piece, or a place on it
  std::size_t piece;   // on which the way to the next node lies
  bool given;          // the start of `vertex`
  bool pinned;         // it stays
  bool moved = false;  // it has left its place
  double mobility = 0; // 0 where the curve is as smooth as the resolution, 1 where it is ragged
};

/// One loop while it flows.
class FlowingLoop {
public:
  /// @param two_sided the shape lies on both sides, so that the curve has no slits
  FlowingLoop(const Loop& loop, const sizing::SizeField& size, const Box& bounds, bool two_sided = false)
      : loop_(loop), size_(size), bounds_(bounds), two_sided_(two_sided) {
    const std::vector<Piece>& pieces = loop.pieces;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const Piece &before = pieces[(k + pieces.size() - 1) % pieces.size()], &behind = pieces[k];
      nodes_.push_back({behind.start, behind.start, checked_size(size, behind.start), k, k, true,
                        behind.corner || behind.circular || before.circular || before.part != behind.part});
    }
  }

  /// Flows as long as it is ragged. False if it is not from the start.
  bool flow(double reach) {
    if (nodes_.size() <= GeneraliseRules::least_vertices || !measure_mobility())
      return false;
    divide();
    const double time = 0.5 * reach * reach / GeneraliseRules::flow_steps;
    for (int step = 0; step < GeneraliseRules::flow_steps && measure_mobility(); ++step) {
      const double area = twice_area();
      move(time);
      join();
      restore_area(area);
    }
    std::erase_if(nodes_, [](const Node& node) { return !node.given && !node.moved; });
    leave_out_flat();
    return nodes_.size() > GeneraliseRules::least_vertices &&
           std::any_of(nodes_.begin(), nodes_.end(), [](const Node& node) { return node.moved; });
  }

  Loop result(const geometry::Lattice& lattice) const {
    Loop result = loop_;
    result.pieces.clear();
    for (const Node& node : nodes_) {
      Piece piece = loop_.pieces[node.piece];
      piece.corner = node.given && loop_.pieces[node.vertex].corner;
      piece.start = node.moved ? lattice.snap(node.place) : node.place;
      result.pieces.push_back(piece);
    }
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      result.pieces[k].end = result.pieces[(k + 1) % nodes_.size()].start;
    std::erase_if(result.pieces, [](const Piece& piece) { return piece.start == piece.end; });
    return result;
  }

  /// Vertices of the given loop that have moved or gone.
  std::int64_t changed() const {
    return std::ssize(loop_.pieces) -
           std::count_if(nodes_.begin(), nodes_.end(), [](const Node& node) { return node.given && !node.moved; });
  }

private:
  static double checked_size(const sizing::SizeField& size, Vec2 p) { return sizing::checked_size(size, p); }
  std::size_t ahead(std::size_t k) const { return k + 1 < nodes_.size() ? k + 1 : 0; }
  std::size_t behind(std::size_t k) const { return k > 0 ? k - 1 : nodes_.size() - 1; }
  bool is_arc(const Node& node) const { return loop_.pieces[node.piece].circular; }

  double twice_area() const {
    double twice = 0;
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      twice += cross(nodes_[k].place - nodes_[0].place, nodes_[ahead(k)].place - nodes_[0].place);
    return twice;
  }

  /// Signed angles of the turns; 0 next to arcs.
  void measure_turns() {
    const std::size_t n = nodes_.size();
    ways_.resize(n);
    turns_.resize(n);
    for (std::size_t k = 0; k < n; ++k)
      ways_[k] = length(nodes_[ahead(k)].place - nodes_[k].place);
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 in = nodes_[k].place - nodes_[behind(k)].place, out = nodes_[ahead(k)].place - nodes_[k].place;
      turns_[k] = is_arc(nodes_[k]) || is_arc(nodes_[behind(k)]) ? 0 : angle_of(cross(in, out), dot(in, out));
    }
  }

  /// @brief Marks ragged nodes: near them the curve turns back and forth, much more than it turns in total. Returns
  /// false if there are no such nodes.
  bool measure_mobility() {
    measure_turns();
    TurnWindow window(ways_, turns_);
    bool any = false;
    for (Node& node : nodes_) {
      const double ragged = window.to_and_fro(GeneraliseRules::ragged_way * node.size) - GeneraliseRules::least_ragged;
      node.mobility = node.pinned ? 0 : std::clamp(ragged / GeneraliseRules::ragged_range, 0.0, 1.0);
      any |= node.mobility > 0;
    }
    return free_close_corners() || any;
  }

  /// @brief Two sharp turns with so short a way between them carry no feature: they and what is near move, too. But not
  /// where both turn away from the shape: the end of a slit forces no small angles. True if there are any.
  bool free_close_corners() {
    const std::size_t n = nodes_.size();
    const auto sharpness = [&](std::size_t k) {
      return (std::fabs(turns_[k]) - GeneraliseRules::close_turn) / GeneraliseRules::close_range;
    };
    bool any = false;
    for (std::size_t first = 0; first < n; ++first) {
      if (!(sharpness(first) > 0))
        continue;
      std::size_t last = first;
      double way = 0;
      do {
        way += ways_[last];
        last = ahead(last);
      } while (last != first && way < GeneraliseRules::corner_arm * nodes_[first].size && !(sharpness(last) > 0));
      const bool is_slit = !two_sided_ && turns_[first] < 0 && turns_[last] < 0;
      if (last == first || is_slit || !(way < GeneraliseRules::corner_arm * nodes_[first].size))
        continue;
      const double mobility = std::fmin(1, std::fmin(sharpness(first), sharpness(last)));
      any |= free(first, last, mobility);
    }
    return any;
  }

  /// Lets the nodes from one to the other, and a little beyond, move. True if one can.
  bool free(std::size_t first, std::size_t last, double mobility) {
    const double beyond = GeneraliseRules::beside_corner * nodes_[first].size;
    double way = 0;
    for (std::size_t rest = nodes_.size() / 4; rest > 0 && way < beyond; --rest) {
      first = behind(first);
      way += ways_[first];
    }
    way = 0;
    for (std::size_t rest = nodes_.size() / 4; rest > 0 && way < beyond; --rest) {
      way += ways_[last];
      last = ahead(last);
    }
    bool any = false;
    for (std::size_t k = ahead(first); k != last; k = ahead(k))
      if (!nodes_[k].pinned) {
        nodes_[k].mobility = std::fmax(nodes_[k].mobility, mobility);
        any = true;
      }
    return any;
  }

  /// Adds nodes to straight stretches that have a moving end.
  void divide() {
    std::vector<Node> divided;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      const Node &from = nodes_[k], &to = nodes_[ahead(k)];
      divided.push_back(from);
      if (is_arc(from) || std::fmax(from.mobility, to.mobility) == 0)
        continue;
      const double spacing = GeneraliseRules::flow_spacing * std::fmin(from.size, to.size);
      const double parts = std::ceil(length(to.place - from.place) / spacing);
      for (double part = 1; part < parts; ++part) {
        const Vec2 place = from.place + (part / parts) * (to.place - from.place);
        divided.push_back({place, place, checked_size(size_, place), from.piece, from.piece, false, false});
      }
    }
    nodes_ = std::move(divided);
  }

  /// One step, implicit: dx/dt = mobility h^2 d2x/ds2. @param time over h^2
  void move(double time) {
    const std::size_t n = nodes_.size();
    CyclicSystem system(n);
    std::vector<double> x(n), y(n);
    for (std::size_t k = 0; k < n; ++k) {
      const Node& node = nodes_[k];
      x[k] = node.place.x;
      y[k] = node.place.y;
      if (node.mobility == 0)
        continue;
      const double least = GeneraliseRules::flow_least_way * node.size;
      const double in = std::fmax(ways_[behind(k)], least), out = std::fmax(ways_[k], least);
      const double rate = 2 * time * node.mobility * node.size * node.size / (in + out);
      system.below[k] = -rate / in;
      system.above[k] = -rate / out;
      system.diagonal[k] = 1 + rate / in + rate / out;
    }
    system.factorise();
    system.solve(x);
    system.solve(y);
    for (std::size_t k = 0; k < n; ++k)
      if (nodes_[k].mobility > 0)
        place(nodes_[k], {x[k], y[k]});
  }

  /// No farther from where it was than the curve may move.
  void place(Node& node, Vec2 p) {
    const Vec2 way = p - node.home;
    const double most = GeneraliseRules::flow_most * node.size, far = length(way);
    if (far > most)
      p = node.home + (most / far) * way;
    node.place = {std::clamp(p.x, bounds_.min.x, bounds_.max.x), std::clamp(p.y, bounds_.min.y, bounds_.max.y)};
    node.moved = true;
  }

  /// Shifts what has moved along its normals, until the loop has the area again that it had.
  void restore_area(double twice) {
    const std::size_t n = nodes_.size();
    std::vector<Vec2> outward(n);
    double width = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 along = nodes_[ahead(k)].place - nodes_[behind(k)].place;
      const double way = length(along);
      if (nodes_[k].mobility == 0 || !(way > 0))
        continue;
      outward[k] = (-nodes_[k].mobility / way) * geometry::left_normal(along);
      width += 0.5 * nodes_[k].mobility * way;
    }
    if (!(width > 0))
      return;
    const double shift = 0.5 * (twice - twice_area()) / width;
    for (std::size_t k = 0; k < n; ++k)
      if (nodes_[k].mobility > 0) {
        const double most = GeneraliseRules::most_outward * nodes_[k].size;
        place(nodes_[k], nodes_[k].place + std::clamp(shift, -most, most) * outward[k]);
      }
  }

  /// Takes out nodes that have come near to the one before.
  void join() {
    std::vector<Node> joined;
    std::size_t left = nodes_.size();
    for (const Node& node : nodes_) {
      const double close = GeneraliseRules::flow_join * GeneraliseRules::flow_spacing * node.size;
      if (!joined.empty() && node.moved && left > GeneraliseRules::least_vertices + 1 &&
          squared_length(node.place - joined.back().place) < close * close) {
        joined.back().piece = node.piece;
        --left;
      } else {
        joined.push_back(node);
      }
    }
    nodes_ = std::move(joined);
  }

  /// Takes out moved nodes where the curve is nearly straight. The loop keeps its area.
  void leave_out_flat() {
    const double area = twice_area();
    std::vector<Node> left;
    std::size_t count = nodes_.size();
    for (std::size_t first = 0, last; first < nodes_.size(); first = last) {
      left.push_back(nodes_[first]);
      for (last = first + 1;
           last < nodes_.size() && count > GeneraliseRules::least_vertices + 1 && is_flat(first, last); ++last)
        --count;
    }
    nodes_ = std::move(left);
    for (Node& node : nodes_)
      node.mobility = node.moved;
    restore_area(area);
  }

  /// May the curve lead from a node straight to the one behind `last`? Moved nodes lie between straight pieces of one
  /// part.
  bool is_flat(std::size_t first, std::size_t last) const {
    if (!nodes_[last].moved)
      return false;
    const geometry::Segment chord{nodes_[first].place, nodes_[ahead(last)].place};
    const double longest = GeneraliseRules::flow_longest * nodes_[first].size;
    return squared_length(chord.b - chord.a) <= longest * longest &&
           std::all_of(nodes_.begin() + static_cast<std::ptrdiff_t>(first) + 1,
                       nodes_.begin() + static_cast<std::ptrdiff_t>(last) + 1, [&](const Node& node) {
                         const double close = GeneraliseRules::flow_flat * node.size;
                         return squared_distance(node.place, chord) < close * close;
                       });
  }

  const Loop& loop_;
  const sizing::SizeField& size_;
  const Box bounds_;
  const bool two_sided_;
  std::vector<Node> nodes_;
  std::vector<double> ways_, turns_; // by node: length of the way to the next, angle of the turn
};

/// The arc as a loop. Its ends stay, and the way back between them is one piece that does not move.
Loop closed_loop(const geometry::InnerArc& arc, std::span<const Vec2> kept) {
  Loop loop;
  loop.pieces = arc.pieces;
  for (Piece& piece : loop.pieces)
    piece.corner |= std::binary_search(kept.begin(), kept.end(), piece.start, geometry::lexicographically_less);
  if (arc.closed)
    return loop;
  Piece& back = loop.pieces.emplace_back();
  back.start = arc.pieces.back().end;
  back.end = arc.pieces.front().start;
  back.part = arc.pieces.front().part;
  back.circular = true;
  return loop;
}

} // namespace

std::optional<std::vector<Piece>> smoothed_arc(const geometry::InnerArc& arc, const FlowRequest& request,
                                               const geometry::Lattice& lattice) {
  const Loop loop = closed_loop(arc, request.kept);
  FlowingLoop flowing(loop, request.size, request.bounds, true);
  if (!flowing.flow(request.reach))
    return {};
  std::vector<Piece> pieces = flowing.result(lattice).pieces;
  if (!arc.closed && loop.pieces.back().start != loop.pieces.back().end)
    pieces.pop_back();
  return pieces;
}

std::unique_ptr<SmoothedCurves> smooth_ragged_runs(const geometry::Boundary& boundary, const sizing::SizeField& size,
                                                   const geometry::Lattice& lattice, double reach) {
  std::unique_ptr<SmoothedCurves> result;
  const Box bounds = boundary.bounding_box();
  for (std::size_t k = 0; k < boundary.loops.size(); ++k) {
    FlowingLoop flowing(boundary.loops[k], size, bounds);
    if (!flowing.flow(reach))
      continue;
    if (!result)
      result = std::make_unique<SmoothedCurves>(SmoothedCurves{boundary, 0});
    result->boundary.loops[k] = flowing.result(lattice);
    result->vertices += flowing.changed();
  }
  if (result)
    result->boundary.area = polygon::area_of_loops(result->boundary);
  return result;
}

} // namespace trime::generalise
