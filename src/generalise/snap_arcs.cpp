// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/snap_arcs.hpp"

#include "generalise/edge_net.hpp"
#include "generalise/meeting_pieces.hpp"
#include "generalise/rules.hpp"
#include "generalise/vertex_tree.hpp"
#include "trime/geometry/piece_tree.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace trime::generalise {
namespace {

using geometry::Boundary;
using geometry::InnerArc;
using geometry::Piece;
using geometry::Segment;
using geometry::Vec2;

constexpr int most_rounds = 20; // edges may come near to further vertices
// The nearest edge of a line is usually the one that leads through a vertex; a few more may be tried if it may not.
constexpr std::size_t most_edges = 4;

// A search along curves ends after this number of vertices, or of nodes among them. Edges that it has not reached by
// then do not become one line with the curve.
constexpr std::size_t most_steps = 1000, most_nodes = 16;

/// The lengths of short ways along the edges of a net from a vertex to others. Takes O(n log n) time for n vertices on
/// the ways; n is bounded by most_steps and most_nodes.
class ShortWays {
public:
  /// @param longest of the ways
  ShortWays(const EdgeNet& net, LocalIndex from, double longest) {
    std::set<std::pair<double, LocalIndex>> open{{0.0, from}}; // the nearest vertex first (Dijkstra's algorithm)
    std::size_t nodes = 0;
    while (!open.empty() && ways_.size() < most_steps && nodes < most_nodes) {
      const auto [way, v] = *open.begin();
      open.erase(open.begin());
      if (!ways_.emplace(v, way).second)
        continue;
      nodes += net.around(v).size() > 2;
      for (const LocalIndex f : net.around(v)) {
        const LocalIndex to = net.edge(f).a == v ? net.edge(f).b : net.edge(f).a;
        const double longer = way + length(net.place(to) - net.place(v));
        if (longer < longest && !ways_.contains(to))
          open.emplace(longer, to);
      }
    }
    known_ = open.empty() ? longest : open.begin()->first;
  }

  /// Are the ways to both vertices known to be so long? @param bound at most the longest
  bool are_at_least(double bound, LocalIndex a, LocalIndex b) const {
    const auto is_long = [&](LocalIndex v) {
      const auto found = ways_.find(v);
      return found == ways_.end() || found->second >= bound;
    };
    return bound <= known_ && is_long(a) && is_long(b);
  }

private:
  std::map<LocalIndex, double> ways_;
  double known_ = 0; // longer ways are not known
};

class ArcSnapper {
public:
  ArcSnapper(const std::vector<InnerArc>& arcs, const Boundary& boundary, const ArcRules& rules,
             const VertexTree& vertices)
      : boundary_(boundary), size_(rules.size), kinds_(rules.kinds), interfaces_(rules.interfaces), vertices_(vertices),
        net_(arcs, boundary) {
    for (const geometry::Loop& loop : boundary.loops)
      rim_.insert(rim_.end(), loop.pieces.begin(), loop.pieces.end());
  }

  /// Returns what was joined.
  JoinedLines run() {
    std::int64_t before = -1;
    for (int round = 0; round < most_rounds && joined_.vertices != before; ++round) {
      before = joined_.vertices;
      index_edges();
      for (const Near& near : near_pairs())
        snap(near.vertex, near.edge);
    }
    return joined_;
  }

  const EdgeNet& net() const { return net_; }

private:
  /// A vertex near an edge of another line.
  struct Near {
    double squared_distance;
    double back; ///< 1 if the edge leads away from the vertex at its nearer end, below 0 if it leads towards it
    LocalIndex vertex, edge;
  };

  /// Makes the tree of the boundary and the living edges.
  void index_edges() {
    Boundary all = boundary_;
    std::vector<Piece>& pieces = all.loops.emplace_back().pieces;
    edges_.clear();
    for (LocalIndex e = 0; e < net_.edge_count(); ++e)
      if (net_.edge(e).alive) {
        edges_.push_back(e);
        pieces.push_back(net_.edge(e).piece);
      }
    tree_ = geometry::PieceTree(all);
  }

  double reach_at(LocalIndex v) const {
    return GeneraliseRules::snap_distance * sizing::checked_size(size_, net_.place(v));
  }

  Segment segment(LocalIndex e) const { return {net_.edge(e).piece.start, net_.edge(e).piece.end}; }

  /// May the edge lead through the vertex? One of both belongs to a curve and the other one to an interface or to
  /// another curve, and the line of the edge does not pass the vertex already. Two curves that meet, and a curve and
  /// the interface on which it goes on, must follow each other closely.
  bool may_meet(LocalIndex v, LocalIndex e, const ShortWays& ways) const {
    const EdgeNet::Edge& edge = net_.edge(e);
    if (edge.piece.circular || v == edge.a || v == edge.b || (!edge.is_curve() && !edge.is_interface()))
      return false;
    bool is_other = false, goes_on = false;
    for (const LocalIndex f : net_.around(v)) {
      const EdgeNet::Edge& its = net_.edge(f);
      if (edge.is_curve() ? its.arc == edge.arc
                          : std::minmax(its.left, its.right) == std::minmax(edge.left, edge.right))
        return false;
      const bool is_border = its.is_interface() != edge.is_interface(); // a curve and an interface
      if (is_border && (its.piece.part == edge.piece.part || its.piece.circular))
        goes_on = true;
      else if (is_border && (its.has_name() || edge.is_curve()))
        is_other = true;
      else
        goes_on |= may_be_one(its, edge);
    }
    return is_other || (goes_on && (is_sliver(v, e) || is_narrow(v, e, ways)));
  }

  bool is_split(int part) const {
    return static_cast<std::size_t>(part) < kinds_.size() && kinds_[static_cast<std::size_t>(part)].split;
  }

  /// May one edge have the names of both? A split curve keeps all of its edges.
  bool may_share_name(const EdgeNet::Edge& one, const EdgeNet::Edge& other) const {
    return !one.has_name() || !other.has_name() || one.piece.part == other.piece.part ||
           (!is_split(one.piece.part) && !is_split(other.piece.part));
  }

  /// May edges of two curves become one edge?
  bool may_be_one(const EdgeNet::Edge& one, const EdgeNet::Edge& other) const {
    return one.is_curve() && other.is_curve() && one.left == other.left && may_share_name(one, other);
  }

  bool may_join(LocalIndex e, LocalIndex f) const {
    return may_share_name(net_.edge(e), net_.edge(f)) && net_.may_join(e, f);
  }

  /// Do edges lead from the vertex to both ends of the edge? The nodes of smaller triangles become one instead.
  bool is_sliver(LocalIndex v, LocalIndex e) const {
    const Segment edge = segment(e);
    return length(edge.b - edge.a) > GeneraliseRules::node_distance * sizing::checked_size(size_, net_.place(v)) &&
           net_.between(v, net_.edge(e).a) >= 0 && net_.between(v, net_.edge(e).b) >= 0;
  }

  /// Is the way along curves from the vertex to the edge long, compared with their distance?
  bool is_narrow(LocalIndex v, LocalIndex e, const ShortWays& ways) const {
    return ways.are_at_least(std::sqrt(pair_of(v, e).squared_distance) / GeneraliseRules::narrow_share, net_.edge(e).a,
                             net_.edge(e).b);
  }

  /// The ways that decide for edges within a distance of the vertex.
  ShortWays ways_from(LocalIndex v, double distance) const {
    return {net_, v, distance / GeneraliseRules::narrow_share};
  }

  /// Such pairs within reach, the nearest first: for each vertex with its nearest edges, so that the memory does not
  /// grow with the number of edges within reach. Others come in a later round.
  std::vector<Near> near_pairs() const {
    std::vector<Near> pairs;
    for (LocalIndex v = 0; v < net_.vertex_count(); ++v) {
      if (net_.around(v).empty())
        continue;
      const double reach = reach_at(v);
      std::vector<Near> here;
      for (const std::size_t k : tree_.within(net_.place(v), reach))
        if (k >= rim_.size())
          here.push_back(pair_of(v, edges_[k - rim_.size()]));
      std::ranges::sort(here, {}, order_of);
      const ShortWays ways = ways_from(v, reach);
      std::size_t found = 0;
      for (std::size_t k = 0; k < here.size() && found < most_edges; ++k)
        if (may_meet(v, here[k].edge, ways)) {
          pairs.push_back(here[k]);
          ++found;
        }
    }
    std::ranges::sort(pairs, {}, order_of);
    return pairs;
  }

  static std::tuple<double, double, LocalIndex, LocalIndex> order_of(const Near& near) {
    return {near.squared_distance, near.back, near.vertex, near.edge};
  }

  Near pair_of(LocalIndex v, LocalIndex e) const {
    const Segment edge = segment(e);
    const Vec2 p = net_.place(v), along = edge.b - edge.a;
    const double share = dot(p - edge.a, along) / squared_length(along);
    return {geometry::squared_distance(p, edge), std::fmax(-share, share - 1), v, e};
  }

  /// The living edge that the edge has become near the vertex; -1 if it was joined with another one.
  LocalIndex living(LocalIndex e, LocalIndex v) const {
    while (!net_.edge(e).alive) {
      const auto [first, second] = net_.edge(e).parts;
      if (first == second)
        return -1;
      const Near one = pair_of(v, first), two = pair_of(v, second);
      e = std::tuple(one.squared_distance, one.back) <= std::tuple(two.squared_distance, two.back) ? first : second;
    }
    return e;
  }

  void snap(LocalIndex v, LocalIndex given) {
    const LocalIndex e = living(given, v);
    if (e < 0 || !may_meet(v, e, ways_from(v, std::sqrt(pair_of(v, e).squared_distance))))
      return;
    const double distance = std::sqrt(pair_of(v, e).squared_distance), reach = reach_at(v);
    if (!(distance + net_.edge(e).moved < reach) || !stays_near(e, v) || !is_free(v, e, reach))
      return;
    net_.divide(e, v, distance);
    ++joined_.vertices;
    if (distance > joined_.farthest) {
      joined_.farthest = distance;
      joined_.place = net_.place(v);
    }
  }

  /// Does the edge stay near the interfaces that were given if it leads through the vertex? Otherwise an interface
  /// could follow a curve away from them, vertex by vertex.
  bool stays_near(LocalIndex e, LocalIndex v) const {
    return interfaces_ == nullptr || !net_.edge(e).is_interface() ||
           interfaces_->distance(net_.place(v)) <
               GeneraliseRules::rim_distance * sizing::checked_size(size_, net_.place(v));
  }

  /// May the edge lead through the vertex without a touch of other curves?
  bool is_free(LocalIndex v, LocalIndex e, double reach) const {
    const EdgeNet::Edge& edge = net_.edge(e);
    const Vec2 a = net_.place(edge.a), b = net_.place(edge.b), p = net_.place(v);
    if (!vertices_.is_empty_at({a, p, b}))
      return false;
    const double around = 0.5 * length(b - a) + 2 * reach;
    const std::vector<std::size_t> near = tree_.within(0.5 * (a + b), around);
    for (const LocalIndex end : {edge.a, edge.b}) {
      Piece part;
      part.start = net_.place(end);
      part.end = p;
      const LocalIndex twin = net_.between(end, v);
      if (twin >= 0 && !may_join(e, twin))
        return false;
      for (const std::size_t k : near)
        if (k < rim_.size() ? meet(part, rim_[k]) : meets(part, edges_[k - rim_.size()], e, twin))
          return false;
    }
    return true;
  }

  /// Does a part of an edge meet another edge, or what has become of it? @param twin an edge with which the part is to
  /// be joined
  bool meets(const Piece& part, LocalIndex other, LocalIndex edge, LocalIndex twin) const {
    if (other == edge || other == twin)
      return false;
    const EdgeNet::Edge& its = net_.edge(other);
    if (its.alive)
      return meet(part, its.piece);
    return its.parts[0] != its.parts[1] &&
           (meets(part, its.parts[0], edge, twin) || meets(part, its.parts[1], edge, twin));
  }

  const Boundary& boundary_;
  const sizing::SizeField& size_;
  const std::span<const geometry::CurveKind> kinds_;
  const geometry::PieceTree* const interfaces_;
  const VertexTree& vertices_;
  EdgeNet net_;
  std::vector<Piece> rim_;
  geometry::PieceTree tree_;      // over the boundary and the edges
  std::vector<LocalIndex> edges_; // those in the tree
  JoinedLines joined_;
};

/// Are there a curve and something that it may follow?
bool may_follow(const std::vector<InnerArc>& arcs) {
  return arcs.size() > 1 && std::ranges::any_of(arcs, [](const InnerArc& a) { return a.pieces.front().part >= 0; });
}

double length_of(const InnerArc& arc) {
  double sum = 0;
  for (const Piece& piece : arc.pieces)
    sum += piece.length();
  return sum;
}

/// Is this a curve that two or more other arcs meet at one end and none at the other one?
/// @param arcs_at the number of ends of open arcs at a place
bool is_loose_end(const InnerArc& arc, const std::map<std::pair<double, double>, int>& arcs_at) {
  if (arc.closed || arc.left != arc.right || arc.pieces.front().part < 0)
    return false;
  const Vec2 a = arc.pieces.front().start, b = arc.pieces.back().end;
  const auto [few, many] = std::minmax(arcs_at.at({a.x, a.y}), arcs_at.at({b.x, b.y}));
  return few == 1 && many > 2;
}

/// Leaves out short ends of curves beyond other curves and interfaces; the last arc of a curve stays.
void drop_loose_ends(SnappedArcs& result, const Boundary& boundary, const ArcRules& rules) {
  std::map<std::pair<double, double>, int> arcs_at;
  std::map<int, int> arcs_of; // by curve
  for (const InnerArc& arc : result.arcs) {
    ++arcs_of[arc.pieces.front().part];
    if (arc.closed)
      continue;
    const Vec2 a = arc.pieces.front().start, b = arc.pieces.back().end;
    ++arcs_at[{a.x, a.y}];
    ++arcs_at[{b.x, b.y}];
  }
  for (const geometry::Loop& loop : boundary.loops) // an end on the boundary is not loose
    for (const Piece& piece : loop.pieces)
      if (const auto found = arcs_at.find({piece.start.x, piece.start.y}); found != arcs_at.end())
        found->second += 2;
  std::erase_if(result.arcs, [&](const InnerArc& arc) {
    if (!is_loose_end(arc, arcs_at))
      return false;
    const Vec2 a = arc.pieces.front().start, b = arc.pieces.back().end, end = arcs_at.at({a.x, a.y}) == 1 ? a : b;
    const double longest = GeneraliseRules::node_distance * sizing::checked_size(rules.size, end), its = length_of(arc);
    int& left = arcs_of.at(arc.pieces.front().part);
    if (its >= longest || left == 1 || std::ranges::binary_search(rules.corners, end, geometry::lexicographically_less))
      return false;
    --left;
    ++result.joined.loose_ends;
    result.joined.longest_end = std::fmax(result.joined.longest_end, its);
    return true;
  });
}

} // namespace

SnappedArcs snapped_arcs(const std::vector<InnerArc>& arcs, const Boundary& boundary, const ArcRules& rules) {
  SnappedArcs result{arcs, {}};
  if (!may_follow(arcs))
    return result;
  drop_loose_ends(result, boundary, rules);
  Boundary all = boundary;
  for (const InnerArc& arc : result.arcs) {
    std::vector<Piece>& pieces = all.loops.emplace_back().pieces;
    pieces = arc.pieces;
    Piece& end = pieces.emplace_back();
    end.start = end.end = arc.pieces.back().end;
  }
  const VertexTree vertices(all, rules.lattice, {});
  ArcSnapper snapper(result.arcs, boundary, rules, vertices);
  const JoinedLines joined = snapper.run();
  if (joined.vertices == 0)
    return result;
  result.arcs = snapper.net().arcs(result.arcs);
  result.joined.vertices = joined.vertices;
  result.joined.farthest = joined.farthest;
  result.joined.place = joined.place;
  return result;
}

} // namespace trime::generalise
