// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/snap_arcs.hpp"

#include "generalise/edge_net.hpp"
#include "generalise/meeting_pieces.hpp"
#include "generalise/rules.hpp"
#include "generalise/vertex_tree.hpp"
#include "trime/geometry/piece_tree.hpp"

#include <algorithm>
#include <cmath>
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

class ArcSnapper {
public:
  ArcSnapper(const std::vector<InnerArc>& arcs, const Boundary& boundary, const sizing::SizeField& size,
             const VertexTree& vertices)
      : boundary_(boundary), size_(size), vertices_(vertices), net_(arcs) {
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

  /// May the edge lead through the vertex? One of both belongs to a curve and the other one to an interface, and the
  /// line of the edge does not pass the vertex already.
  bool may_meet(LocalIndex v, LocalIndex e) const {
    const EdgeNet::Edge& edge = net_.edge(e);
    const bool is_curve = edge.is_curve(), is_interface = edge.is_interface();
    if (edge.piece.circular || v == edge.a || v == edge.b || (!is_curve && !is_interface))
      return false;
    bool is_other = false;
    for (const LocalIndex f : net_.around(v)) {
      const EdgeNet::Edge& its = net_.edge(f);
      if (is_curve ? its.piece.part == edge.piece.part
                   : std::minmax(its.left, its.right) == std::minmax(edge.left, edge.right))
        return false;
      is_other |= is_curve ? its.left != its.right : its.piece.part >= 0;
    }
    return is_other;
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
        if (k >= rim_.size() && may_meet(v, edges_[k - rim_.size()]))
          here.push_back(pair_of(v, edges_[k - rim_.size()]));
      std::ranges::sort(here, {}, order_of);
      here.resize(std::min(here.size(), most_edges));
      pairs.insert(pairs.end(), here.begin(), here.end());
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
    if (e < 0 || !may_meet(v, e))
      return;
    const double distance = std::sqrt(pair_of(v, e).squared_distance), reach = reach_at(v);
    if (!(distance + net_.edge(e).moved < reach) || !is_free(v, e, reach))
      return;
    net_.divide(e, v, distance);
    ++joined_.vertices;
    if (distance > joined_.farthest) {
      joined_.farthest = distance;
      joined_.place = net_.place(v);
    }
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
      if (twin >= 0 && !net_.may_join(e, twin))
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
  const VertexTree& vertices_;
  EdgeNet net_;
  std::vector<Piece> rim_;
  geometry::PieceTree tree_;      // over the boundary and the edges
  std::vector<LocalIndex> edges_; // those in the tree
  JoinedLines joined_;
};

bool has_both(const std::vector<InnerArc>& arcs) {
  return std::ranges::any_of(arcs, [](const InnerArc& arc) { return arc.left != arc.right; }) &&
         std::ranges::any_of(arcs, [](const InnerArc& arc) { return arc.pieces.front().part >= 0; });
}

} // namespace

SnappedArcs snapped_arcs(const std::vector<InnerArc>& arcs, const Boundary& boundary, const sizing::SizeField& size,
                         const geometry::Lattice& lattice) {
  if (!has_both(arcs))
    return {arcs, {}};
  Boundary all = boundary;
  for (const InnerArc& arc : arcs) {
    std::vector<Piece>& pieces = all.loops.emplace_back().pieces;
    pieces = arc.pieces;
    Piece& end = pieces.emplace_back();
    end.start = end.end = arc.pieces.back().end;
  }
  const VertexTree vertices(all, lattice, {});
  ArcSnapper snapper(arcs, boundary, size, vertices);
  const JoinedLines joined = snapper.run();
  if (joined.vertices == 0)
    return {arcs, {}};
  return {snapper.net().arcs(arcs), joined};
}

} // namespace trime::generalise
