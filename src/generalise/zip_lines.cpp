// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/zip_lines.hpp"

#include "generalise/chord_losses.hpp"
#include "generalise/line_mesh.hpp"
#include "generalise/region_map.hpp"
#include "generalise/rules.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace trime::generalise {
namespace {

using geometry::InnerArc;
using geometry::Piece;
using HalfEdge = Triangulation::HalfEdge;
using Line = LineMesh::Line;

class LineZipper {
public:
  LineZipper(const RegionMap& map, const Partition& given, std::span<const std::array<int, 2>> pairs)
      : map_(map), given_(given), lines_(map, pairs), spread_(vertex_count(), 0), on_rim_(vertex_count(), 0),
        is_end_(vertex_count(), 0) {
    for (const RegionMap::Strand& strand : map.strands())
      for (const LocalIndex v : {strand.from, strand.to})
        if (strand.arc < 0)
          on_rim_[at(v)] = 1;
    for (LocalIndex v = 4; v < std::ssize(spread_); ++v) {
      degree_.push_back(lines_.degree(v));
      is_end_[at(v)] = degree_.back() == 1;
    }
  }

  /// Returns whether any lines were joined. The shortest edges go first.
  bool run() {
    const Triangulation& mesh = map_.mesh();
    for (HalfEdge e = 0; e < 3 * mesh.triangle_count(); ++e)
      if (mesh.origin(e) < mesh.target(e) && !mesh.is_constrained(e) &&
          map_.label(Triangulation::triangle(e)) != RegionMap::outside)
        look_at(mesh.origin(e), mesh.target(e));
    while (!queue_.empty()) {
      const auto [distance, a, b] = *queue_.begin();
      queue_.erase(queue_.begin());
      if (lines_.is_edge(a, b) || lines_.is_edge(b, a))
        join(a, b, distance);
    }
    for (LocalIndex t = 0; t < mesh.triangle_count(); ++t)
      flatten(t);
    return joined_.vertices > 0;
  }

  Partition result() {
    Partition made = given_;
    made.curves.arcs.clear();
    made.joined.add(joined_);
    made.curves.losses.insert(made.curves.losses.end(), lines_.losses().begin(), lines_.losses().end());
    std::map<std::pair<LocalIndex, LocalIndex>, char> is_kept;
    keep_arcs(made.curves, is_kept);
    add_arcs(made.curves, is_kept);
    return made;
  }

private:
  std::size_t vertex_count() const { return at(map_.mesh().vertex_count()); }
  int degree(LocalIndex v) const { return degree_[at(v) - 4]; }
  geometry::Vec2 place(LocalIndex v) const { return map_.mesh().point(v); }

  /// Puts an edge into the queue if it is shorter than the triangles can show and leads from one line to another one
  /// that follows it, or along a line to where it has been joined with another one.
  void look_at(LocalIndex a, LocalIndex b) {
    if (std::min(a, b) < 4 || degree(a) == 0 || degree(b) == 0)
      return;
    const double distance = geometry::length(place(b) - place(a));
    if (!(distance < reach(a, b)) || (!lines_.has_curve(a) && !lines_.has_curve(b)))
      return;
    const bool is_line = lines_.is_line(a, b), is_spur = degree(a) == 1 || degree(b) == 1;
    if (is_line ? is_spur || (lines_.is_changed(a) && degree(a) > 2) || (lines_.is_changed(b) && degree(b) > 2)
                : lines_.follow(a, b))
      queue_.insert({distance, std::min(a, b), std::max(a, b)});
  }
  double reach(LocalIndex a, LocalIndex b) const {
    return GeneraliseRules::snap_distance * std::fmin(map_.size(a), map_.size(b));
  }

  /// How much speaks against a move of the vertex: 3: it must stay.
  int rank(LocalIndex v) const {
    if (on_rim_[at(v)] != 0 || map_.is_held(v) || is_end_[at(v)] != 0)
      return 3;
    return degree(v) > 2 ? 2 : 1;
  }

  void join(LocalIndex a, LocalIndex b, double distance) {
    const bool first_moves = std::tuple(rank(a), a) < std::tuple(rank(b), b);
    const LocalIndex from = first_moves ? a : b, to = first_moves ? b : a;
    const LocalIndex left = moves(from, to) ? to : moves(to, from) ? from : Triangulation::none;
    if (left == Triangulation::none)
      return;
    ++joined_.vertices;
    if (distance > joined_.farthest) {
      joined_.farthest = distance;
      joined_.place = place(left);
    }
    const std::vector<LocalIndex> around = lines_.neighbours(left);
    for (const LocalIndex v : around)
      if (v >= 4)
        degree_[at(v) - 4] = lines_.degree(v);
    for (const LocalIndex v : around)
      look_at(left, v);
  }
  /// Makes one line of the three around a triangle that is less high than the triangles of the mesh can show.
  void flatten(LocalIndex t) {
    const HalfEdge e = 3 * t;
    const LocalIndex a = map_.mesh().origin(e), b = map_.mesh().origin(e + 1), c = map_.mesh().origin(e + 2);
    if (std::min({a, b, c}) >= 4 && (lines_.has_curve(a) || lines_.has_curve(b) || lines_.has_curve(c)) &&
        lines_.flatten(t, std::fmin(reach(a, b), reach(b, c))))
      ++joined_.vertices;
  }
  /// Would the two edges of a line at a vertex farther away become one, with an end there?
  bool leaves_spur(LocalIndex from, LocalIndex to) const {
    return std::ranges::any_of(lines_.neighbours(from), [&](LocalIndex v) {
      return v != to && v >= 4 && degree(v) == 2 && lines_.is_edge(v, to) && lines_.is_line(v, from) &&
             lines_.is_line(v, to) && !(geometry::length(place(v) - place(to)) < reach(v, to));
    });
  }
  bool moves(LocalIndex from, LocalIndex to) {
    const double way = geometry::length(place(to) - place(from));
    if (rank(from) == 3 || (map_.is_held(to) && !map_.is_kept(to)) || !(spread_[at(from)] + way < reach(from, to)) ||
        leaves_spur(from, to) || !lines_.contract(from, to))
      return false;
    spread_[at(to)] = std::fmax(spread_[at(to)], spread_[at(from)] + way);
    degree_[at(to) - 4] = lines_.degree(to);
    return true;
  }

  /// Takes over the arcs that no contraction has reached.
  void keep_arcs(geometry::InnerCurves& made, std::map<std::pair<LocalIndex, LocalIndex>, char>& is_kept) const {
    const Triangulation& mesh = map_.mesh();
    std::vector<char> stays(given_.curves.arcs.size(), 1);
    std::vector<std::vector<std::pair<LocalIndex, LocalIndex>>> edges(stays.size());
    for (HalfEdge e = 0; e < 3 * mesh.triangle_count(); ++e) {
      if (mesh.mark(e) < 0 || map_.strands()[at(mesh.mark(e))].arc < 0)
        continue;
      const auto arc = static_cast<std::size_t>(map_.strands()[at(mesh.mark(e))].arc);
      const LocalIndex a = mesh.origin(e), b = mesh.target(e);
      edges[arc].emplace_back(std::min(a, b), std::max(a, b));
      stays[arc] = stays[arc] != 0 && !lines_.is_changed(a) && !lines_.is_changed(b);
    }
    for (std::size_t k = 0; k < stays.size(); ++k) {
      const InnerArc& arc = given_.curves.arcs[k];
      if (stays[k] != 0) {
        made.arcs.push_back(arc);
        for (const auto& edge : edges[k])
          is_kept[edge] = 1;
      } else if (arc.left != arc.right && arc.lost_area != 0) {
        const bool left_loses = arc.lost_area > 0;
        const double area = std::fabs(arc.lost_area);
        made.losses.push_back({left_loses ? arc.left : arc.right, left_loses ? arc.right : arc.left,
                               geometry::LossReason::thinning, area, 1, area, arc.pieces.front().start});
      }
    }
    add_chord_losses(map_, stays, made.losses);
  }

  /// Makes arcs of all other lines, from node to node, then rings.
  void add_arcs(geometry::InnerCurves& made, const std::map<std::pair<LocalIndex, LocalIndex>, char>& is_kept) {
    all_ = lines_.lines();
    std::vector<char> is_used, is_node(vertex_count(), 0);
    std::vector<std::vector<std::size_t>> at_vertex(vertex_count());
    for (std::size_t k = 0; k < all_.size(); ++k) {
      is_used.push_back(is_kept.contains(std::minmax({all_[k].from, all_[k].to})) ? 1 : 0);
      at_vertex[at(all_[k].from)].push_back(k);
      at_vertex[at(all_[k].to)].push_back(k);
    }
    for (std::size_t v = 0; v < at_vertex.size(); ++v)
      is_node[v] = is_node_at(static_cast<LocalIndex>(v), at_vertex[v], is_used);
    for (const bool rings : {false, true})
      for (std::size_t k = 0; k < all_.size(); ++k)
        if (is_used[k] == 0 && (rings || is_node[at(all_[k].from)] != 0))
          made.arcs.push_back(follow(k, at_vertex, is_node, is_used));
  }

  /// Do arcs end at the vertex? An end of a curve that was given stays unless something has changed there.
  bool is_node_at(LocalIndex v, const std::vector<std::size_t>& here, const std::vector<char>& is_used) const {
    if (here.empty())
      return false;
    if (here.size() != 2 || on_rim_[at(v)] != 0)
      return true;
    const Line &a = all_[here[0]], &b = all_[here[1]];
    return a.left != b.left || a.right != b.right || a.curve != b.curve || (a.to == v) == (b.to == v) ||
           is_used[here[0]] != is_used[here[1]];
  }

  InnerArc follow(std::size_t first, const std::vector<std::vector<std::size_t>>& at_vertex,
                  const std::vector<char>& is_node, std::vector<char>& is_used) const {
    InnerArc arc;
    arc.left = all_[first].left;
    arc.right = all_[first].right;
    arc.is_simplified = arc.left != arc.right;
    for (std::size_t k = first;;) {
      const Line& line = all_[k];
      is_used[k] = 1;
      Piece& piece = arc.pieces.emplace_back();
      piece.start = place(line.from);
      piece.end = place(line.to);
      piece.part = line.curve;
      piece.corner = map_.is_kept(line.from);
      if (is_node[at(line.to)] != 0 || line.to == all_[first].from)
        break;
      const std::vector<std::size_t>& here = at_vertex[at(line.to)];
      k = here[0] == k ? here[1] : here[0];
    }
    arc.closed = is_node[at(all_[first].from)] == 0;
    if (arc.closed)
      std::rotate(arc.pieces.begin(),
                  std::ranges::min_element(arc.pieces, geometry::lexicographically_less, &Piece::start),
                  arc.pieces.end());
    return arc;
  }

  const RegionMap& map_;
  const Partition& given_;
  LineMesh lines_;
  std::vector<double> spread_; // by vertex: how far it is from the vertices that moved there
  std::vector<char> on_rim_;   // by vertex
  std::vector<char> is_end_;   // by vertex: a free end of a curve
  std::set<std::tuple<double, LocalIndex, LocalIndex>> queue_; // edges that may be contracted, by their lengths
  std::vector<int> degree_;                                    // by vertex, beyond the corners of the box
  std::vector<Line> all_;
  JoinedLines joined_;
};

bool has_curves(const Partition& given) {
  return std::ranges::any_of(given.curves.arcs, [](const InnerArc& arc) { return arc.pieces.front().part >= 0; });
}

} // namespace

std::optional<Partition> zip_lines(const Partition& given, const ArcRequest& request,
                                   std::span<const std::array<int, 2>> pairs) {
  if (!has_curves(given) || given.boundary.periods.any())
    return std::nullopt;
  RegionMap map(given.curves, given.boundary, request);
  if (map.is_valid())
    map.add_nodes_to_narrow_parts();
  if (!map.is_valid())
    return std::nullopt;
  LineZipper zipper(map, given, pairs);
  if (!zipper.run())
    return std::nullopt;
  return zipper.result();
}

} // namespace trime::generalise
