// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/edge_net.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace trime::generalise {

using geometry::InnerArc;
using geometry::Piece;
using geometry::Vec2;

EdgeNet::EdgeNet(const std::vector<InnerArc>& arcs, const geometry::Boundary& boundary) {
  std::map<std::pair<double, double>, LocalIndex> vertices;
  const auto vertex_at = [&](Vec2 p) {
    const auto [entry, is_new] = vertices.try_emplace({p.x, p.y}, static_cast<LocalIndex>(places_.size()));
    if (is_new) {
      places_.push_back(p);
      around_.emplace_back();
      is_node_.push_back(0);
      is_changed_.push_back(0);
    }
    return entry->second;
  };
  for (std::size_t k = 0; k < arcs.size(); ++k) {
    for (const Piece& piece : arcs[k].pieces) {
      Edge edge{vertex_at(piece.start), vertex_at(piece.end), piece, arcs[k].left, arcs[k].right};
      edge.arc = k;
      if (&piece == &arcs[k].pieces.front())
        edge.lost = arcs[k].lost_area;
      add(edge);
    }
    if (!arcs[k].closed) {
      is_node_[at(vertex_at(arcs[k].pieces.front().start))] = 1;
      is_node_[at(vertex_at(arcs[k].pieces.back().end))] = 1;
    }
  }
  given_edges_ = edge_count();
  is_on_rim_.assign(places_.size(), 0);
  for (const geometry::Loop& loop : boundary.loops)
    for (const Piece& piece : loop.pieces)
      if (const auto found = vertices.find({piece.start.x, piece.start.y}); found != vertices.end())
        is_on_rim_[at(found->second)] = 1;
}

void EdgeNet::add(Edge edge) {
  const auto e = static_cast<LocalIndex>(edges_.size());
  around_[at(edge.a)].push_back(e);
  around_[at(edge.b)].push_back(e);
  edges_.push_back(std::move(edge));
}

void EdgeNet::kill(LocalIndex e) {
  Edge& edge = edges_[at(e)];
  edge.alive = false;
  for (const LocalIndex v : {edge.a, edge.b})
    std::erase(around_[at(v)], e);
}

LocalIndex EdgeNet::between(LocalIndex a, LocalIndex b) const {
  for (const LocalIndex e : around(a))
    if ((edge(e).a == a && edge(e).b == b) || (edge(e).a == b && edge(e).b == a))
      return e;
  return -1;
}

bool EdgeNet::may_join(LocalIndex e, LocalIndex f) const {
  const Edge &curve = edge(e).is_curve() ? edge(e) : edge(f), &border = edge(e).is_curve() ? edge(f) : edge(e);
  return curve.is_curve() && (border.is_interface() || border.is_curve()) && !curve.piece.circular &&
         !border.piece.circular && (border.left == curve.left || border.right == curve.left);
}

/// Makes one edge of two, with the regions of the interface if one of them is an interface. The first curve gives it
/// its name and direction.
void EdgeNet::join(Edge& part, const Edge& other) const {
  const bool turns = part.a != other.a;
  const bool is_first = part.has_name() && (!other.has_name() || part.piece.part <= other.piece.part);
  const Edge &namer = is_first ? part : other, &border = part.is_interface() ? part : other;
  const bool is_turned = turns && &namer != &border;
  Edge joined = namer;
  joined.left = is_turned ? border.right : border.left;
  joined.right = is_turned ? border.left : border.right;
  joined.lost = is_turned ? -border.lost : border.lost;
  joined.moved = std::fmax(part.moved, other.moved);
  part = std::move(joined);
}

void EdgeNet::divide(LocalIndex e, LocalIndex vertex, double distance) {
  const Edge given = edge(e);
  kill(e);
  const Vec2 from = place(given.a), to = place(given.b), p = place(vertex);
  const double lost = given.left != given.right ? given.lost + 0.5 * cross(to - from, p - from) : 0;
  for (const LocalIndex v : {given.a, given.b, vertex})
    is_changed_[at(v)] = 1;
  for (int k = 0; k < 2; ++k) {
    Edge part = given;
    (k == 0 ? part.b : part.a) = vertex;
    (k == 0 ? part.piece.end : part.piece.start) = p;
    part.piece.corner = k == 0 && given.piece.corner;
    part.lost = 0.5 * lost;
    part.moved = given.moved + distance;
    part.alive = true;
    if (const LocalIndex other = between(part.a, part.b); other >= 0) {
      join(part, edge(other));
      kill(other);
    }
    edges_[at(e)].parts[static_cast<std::size_t>(k)] = edge_count();
    add(part);
  }
}

/// The edge that continues this one beyond one of its ends in the same arc; -1 if no edge does.
LocalIndex EdgeNet::beside(LocalIndex e, bool at_end) const {
  const Edge& one = edge(e);
  const LocalIndex v = at_end ? one.b : one.a;
  if (around(v).size() != 2 || is_on_rim_[at(v)] || (is_node_[at(v)] && !is_changed_[at(v)]))
    return -1;
  const LocalIndex f = around(v)[0] == e ? around(v)[1] : around(v)[0];
  const Edge& other = edge(f);
  const bool continues = (at_end ? other.a : other.b) == v && other.left == one.left && other.right == one.right &&
                         (other.arc == one.arc || (is_changed_[at(v)] && other.piece.part == one.piece.part));
  return continues && f != e ? f : -1;
}

InnerArc EdgeNet::arc_of(const std::vector<LocalIndex>& run, bool closed) const {
  InnerArc arc;
  const bool is_changed = std::ranges::any_of(run, [&](LocalIndex e) { return e >= given_edges_; });
  arc.left = edge(run.front()).left;
  arc.right = edge(run.front()).right;
  arc.closed = closed;
  arc.is_simplified = is_changed && arc.left != arc.right;
  for (const LocalIndex e : run) {
    arc.pieces.push_back(edge(e).piece);
    arc.lost_area += edge(e).lost;
  }
  return arc;
}

std::vector<InnerArc> EdgeNet::arcs(const std::vector<InnerArc>& given) const {
  std::vector<char> is_changed(given.size(), 0), is_done(edges_.size(), 0);
  for (const Edge& one : edges_)
    if (!one.alive || is_changed_[at(one.a)] || is_changed_[at(one.b)])
      is_changed[one.arc] = 1;
  std::vector<LocalIndex> order; // all living edges, those of an arc next to each other
  for (LocalIndex e = 0; e < edge_count(); ++e)
    if (edge(e).alive)
      order.push_back(e);
  std::ranges::stable_sort(order, {}, [&](LocalIndex e) { return edge(e).arc; });
  std::vector<InnerArc> result;
  for (const LocalIndex first : order) {
    if (is_done[at(first)])
      continue;
    const std::size_t its = edge(first).arc;
    if (is_changed[its] == 0) { // all its edges follow
      for (LocalIndex e = first; e < edge_count() && edge(e).arc == its; ++e)
        is_done[at(e)] = 1;
      result.push_back(given[its]);
      continue;
    }
    LocalIndex begin = first;
    for (LocalIndex e = beside(first, false); e >= 0 && e != first; e = beside(e, false))
      begin = e;
    const bool closed = beside(begin, false) >= 0;
    std::vector<LocalIndex> run;
    for (LocalIndex e = closed ? first : begin; e >= 0 && !is_done[at(e)]; e = beside(e, true)) {
      is_done[at(e)] = 1;
      run.push_back(e);
    }
    result.push_back(arc_of(run, closed));
  }
  return result;
}

} // namespace trime::generalise
