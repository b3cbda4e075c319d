// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/thin_inner_curves.hpp"

#include "generalise/absorb_parts.hpp"
#include "generalise/arc_chords.hpp"
#include "generalise/close_nodes.hpp"
#include "generalise/cut_wedges.hpp"
#include "generalise/join_lines.hpp"
#include "generalise/rules.hpp"
#include "generalise/smooth_arcs.hpp"
#include "generalise/snap_arcs.hpp"
#include "generalise/vertex_tree.hpp"
#include "generalise/zip_lines.hpp"
#include "geometry/inner_wedges.hpp"
#include "trime/core/types.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace trime::generalise {
namespace {

using geometry::InnerArc;
using geometry::Piece;
using geometry::Vec2;

/// The loops of the boundary, then the pieces of each arc. An open arc has one piece more, without length, at its end.
geometry::Boundary all_curves(const geometry::InnerCurves& curves, const geometry::Boundary& boundary) {
  geometry::Boundary all = boundary;
  for (const InnerArc& arc : curves.arcs) {
    geometry::Loop& loop = all.loops.emplace_back();
    loop.pieces = arc.pieces;
    if (arc.closed)
      continue;
    Piece& end = loop.pieces.emplace_back();
    end.start = end.end = arc.pieces.back().end;
  }
  return all;
}

/// The objects that all arcs share.
struct Thinning {
  const sizing::SizeField& size;
  VertexTree& tree;
  std::span<const Vec2> corners;
};

/// Counts the open arcs by their ends. Two arcs with the same ends must not both become straight. An arc between two
/// places of the boundary must keep a vertex, too, since a straight one could lie on the boundary.
class ArcEnds {
public:
  /// @param rim_vertices vertices below this number lie on the boundary
  ArcEnds(const std::vector<InnerArc>& arcs, std::span<const std::vector<LocalIndex>> vertices, LocalIndex rim_vertices)
      : rim_vertices_(rim_vertices) {
    for (std::size_t k = 0; k < arcs.size(); ++k)
      if (!arcs[k].closed)
        ++arcs_of_[ends(vertices[k])];
  }
  bool must_bend(const std::vector<LocalIndex>& vertices) const {
    const auto found = arcs_of_.find(ends(vertices));
    return found != arcs_of_.end() && (found->second > 1 || found->first.second < rim_vertices_);
  }

private:
  using Ends = std::pair<LocalIndex, LocalIndex>; // the lower one first
  static Ends ends(const std::vector<LocalIndex>& vertices) { return std::minmax({vertices.front(), vertices.back()}); }
  LocalIndex rim_vertices_;
  std::map<Ends, int> arcs_of_;
};

/// Removes vertices of arcs one after the other.
class ArcThinner {
public:
  /// @param must_bend the arc may not become one straight edge
  ArcThinner(const InnerArc& arc, std::vector<LocalIndex> vertices, bool must_bend, const Thinning& thinning)
      : arc_(arc), vertices_(std::move(vertices)), least_left_(least_vertices(arc, must_bend)), size_(thinning.size),
        tree_(thinning.tree), corners_(thinning.corners) {
    const std::size_t n = vertices_.size();
    for (std::size_t k = 0; k < n; ++k) {
      next_.push_back(k + 1 < n ? k + 1 : 0);
      previous_.push_back(k > 0 ? k - 1 : n - 1);
    }
    is_gone_.assign(n, 0);
    left_ = n;
  }

  InnerArc run() {
    std::set<std::tuple<double, std::size_t>> queue; // by the area of the triangle
    std::vector<double> areas(vertices_.size(), 0);
    const auto enter = [&](std::size_t k, double least) {
      if (!may_go(k))
        return;
      areas[k] = std::fmax(least, area_at(k));
      queue.insert({areas[k], k});
    };
    for (std::size_t k = 0; k < vertices_.size(); ++k)
      enter(k, 0);
    while (!queue.empty() && left_ > least_left_) {
      const auto [area, k] = *queue.begin();
      queue.erase(queue.begin());
      if (!has_way(k, area) || becomes_straight(k))
        continue; // until a neighbour goes
      is_gone_[k] = 1;
      --left_;
      tree_.remove(vertices_[k]);
      next_[previous_[k]] = next_[k];
      previous_[next_[k]] = previous_[k];
      for (const std::size_t neighbour : {previous_[k], next_[k]}) {
        queue.erase({areas[neighbour], neighbour});
        enter(neighbour, area);
      }
    }
    return result();
  }

private:
  /// An arc from a node to itself must enclose something.
  static std::size_t least_vertices(const InnerArc& arc, bool must_bend) {
    if (arc.closed)
      return GeneraliseRules::least_vertices;
    return arc.pieces.front().start == arc.pieces.back().end ? 4 : must_bend ? 3 : 2;
  }

  Vec2 place(std::size_t k) const { return k < arc_.pieces.size() ? arc_.pieces[k].start : arc_.pieces.back().end; }

  /// Ends of an open arc stay, and what the user asked for.
  bool may_go(std::size_t k) const {
    if (is_gone_[k] != 0 || (!arc_.closed && (k == 0 || k + 1 == vertices_.size())))
      return false;
    const Piece &before = arc_.pieces[k > 0 ? k - 1 : arc_.pieces.size() - 1], &behind = arc_.pieces[k];
    return !behind.corner && !behind.circular && !before.circular && before.part == behind.part &&
           !std::binary_search(corners_.begin(), corners_.end(), place(k), geometry::lexicographically_less);
  }

  double area_at(std::size_t k) const {
    const Vec2 a = place(previous_[k]), b = place(next_[k]);
    return 0.5 * std::fabs(geometry::cross(b - a, place(k) - a));
  }

  bool has_way(std::size_t k, double area) const {
    const double h = sizing::checked_size(size_, place(k)), most = GeneraliseRules::vertex_move * h;
    const geometry::Segment chord{place(previous_[k]), place(next_[k])};
    return area < GeneraliseRules::vertex_area * h * h && chord.a != chord.b &&
           geometry::squared_distance(place(k), chord) <= most * most &&
           tree_.is_empty({vertices_[previous_[k]], vertices_[k], vertices_[next_[k]]}) &&
           (arc_.pieces.front().part < 0 || tree_.has_room(chord, vertices_[k], GeneraliseRules::clearance * h));
  }

  /// Would an arc that must bend, and bends, keep only a vertex on the line between its ends?
  bool becomes_straight(std::size_t k) const {
    if (arc_.closed || least_left_ != 3 || left_ != 4)
      return false;
    const std::size_t other = next_[0] == k ? next_[k] : next_[0];
    return is_on_line(other) && !is_on_line(k);
  }
  /// Does a vertex lie on the line between the ends of the arc?
  bool is_on_line(std::size_t k) const {
    const Vec2 a = place(0), along = place(vertices_.size() - 1) - a;
    return std::fabs(cross(along, place(k) - a)) < 1e-6 * squared_length(along);
  }

  InnerArc result() const {
    InnerArc thinned = arc_;
    thinned.pieces.clear();
    for (std::size_t k = 0; k < arc_.pieces.size(); ++k) {
      if (is_gone_[k] != 0)
        continue;
      thinned.pieces.push_back(arc_.pieces[k]);
      if (next_[k] != k + 1)
        thinned.pieces.back().end = place(next_[k]);
    }
    return thinned;
  }

  const InnerArc& arc_;
  const std::vector<LocalIndex> vertices_; // numbers in the tree
  const std::size_t least_left_;
  const sizing::SizeField& size_;
  VertexTree& tree_;
  std::span<const Vec2> corners_;
  std::vector<std::size_t> next_, previous_;
  std::vector<char> is_gone_;
  std::size_t left_ = 0;
};

/// The area between the vertices of an arc and the lines from a place to its ends, positive if the place lies on its
/// left.
double area_beside(const InnerArc& arc, Vec2 place) {
  double twice = 0;
  for (const Piece& piece : arc.pieces)
    twice += cross(piece.start - place, piece.end - place);
  return 0.5 * twice;
}

bool is_same(const InnerArc& a, const InnerArc& b) {
  return std::equal(a.pieces.begin(), a.pieces.end(), b.pieces.begin(), b.pieces.end(),
                    [](const Piece& p, const Piece& q) { return p.start == q.start && p.end == q.end; });
}

/// Notes what the simplification of an interface has taken from the region on its left.
void note_loss(const InnerArc& given, InnerArc& arc) {
  if (arc.left == arc.right || is_same(given, arc))
    return;
  const Vec2 place = given.pieces.front().start;
  arc.is_simplified = true;
  arc.lost_area = given.lost_area + area_beside(given, place) - area_beside(arc, place);
}

/// Removes vertices of all arcs, and joins close nodes. @param given the arcs before any simplification
geometry::InnerCurves thin_arcs(const geometry::InnerCurves& curves, const geometry::Boundary& boundary,
                                const ArcRequest& request, const std::vector<InnerArc>& given) {
  const auto& [size, lattice, corners, tips] = request;
  const geometry::Boundary all = all_curves(curves, boundary);
  VertexTree tree(all, lattice, {});
  Nodes ends{.kept = corners};
  VerticesByPlace& nodes = ends.vertices; // one vertex for all curves that meet in a node
  std::vector<std::vector<LocalIndex>> vertices;
  for (std::size_t loop = 0; loop < all.loops.size(); ++loop) {
    vertices.push_back(tree.starts_of_loop(loop));
    if (loop >= boundary.loops.size() && !curves.arcs[loop - boundary.loops.size()].closed)
      for (const Piece* piece : {&all.loops[loop].pieces.front(), &all.loops[loop].pieces.back()})
        nodes[{piece->start.x, piece->start.y}] = -1;
  }
  for (std::size_t loop = 0; loop < all.loops.size(); ++loop)
    for (std::size_t k = 0; k < vertices[loop].size(); ++k) {
      const Vec2 p = all.loops[loop].pieces[k].start;
      const auto node = nodes.find({p.x, p.y});
      if (node == nodes.end())
        continue;
      if (node->second < 0)
        node->second = vertices[loop][k];
      else
        tree.remove(vertices[loop][k]);
      vertices[loop][k] = node->second;
    }
  for (std::size_t loop = 0; loop < boundary.loops.size(); ++loop)
    for (const LocalIndex vertex : vertices[loop])
      ends.rim_vertices = std::max(ends.rim_vertices, vertex + 1);
  const std::span<const std::vector<LocalIndex>> of_arcs = std::span(vertices).subspan(boundary.loops.size());
  const ArcEnds arc_ends(curves.arcs, of_arcs, ends.rim_vertices);
  geometry::InnerCurves thinned{{}, curves.names, {}, {}, curves.joined_nodes, curves.kinds, curves.losses};
  for (std::size_t k = 0; k < curves.arcs.size(); ++k)
    thinned.arcs.push_back(
        ArcThinner(curves.arcs[k], of_arcs[k], arc_ends.must_bend(of_arcs[k]), {size, tree, corners}).run());
  for (std::size_t k = 0; k < given.size(); ++k)
    note_loss(given[k], thinned.arcs[k]);
  join_close_nodes(thinned, ends, size, tree);
  return thinned;
}

// Arcs that have merged become simpler, and then further parts may be narrow.
constexpr int most_rounds = 6;

/// All interfaces between regions.
geometry::PieceTree interface_tree(const std::vector<InnerArc>& arcs) {
  geometry::Boundary all;
  for (const InnerArc& arc : arcs)
    if (arc.left != arc.right)
      all.loops.emplace_back().pieces = arc.pieces;
  return geometry::PieceTree(all);
}

/// Joins curves with the interfaces and curves that they follow. Returns whether any were joined.
/// @param interfaces from which interfaces do not stray
bool snap(Partition& partition, const ArcRequest& request, const geometry::PieceTree& interfaces) {
  const geometry::InnerCurves& curves = partition.curves;
  SnappedArcs snapped = snapped_arcs(curves.arcs, partition.boundary,
                                     {request.size, request.lattice, request.kept, curves.kinds, &interfaces});
  partition.curves.arcs = std::move(snapped.arcs);
  partition.joined.add(snapped.joined);
  return snapped.joined.vertices + snapped.joined.loose_ends > 0;
}

/// Gives small faces away and joins curves with interfaces, one after the other: a face between two interfaces may go
/// only as a whole, so the faces come first, whatever curves lead through them. Curves that were joined may leave
/// further ones.
Partition without_slivers(Partition given, const ArcRequest& request, std::span<const std::array<int, 2>> pairs,
                          bool& has_absorbed) {
  Partition made = std::move(given);
  const geometry::PieceTree interfaces = interface_tree(made.curves.arcs);
  for (int round = 0; round < most_rounds; ++round) {
    std::optional<Partition> large = absorb_parts(made.curves, made.boundary, request, pairs, SmallParts::faces);
    if (large) {
      large->joined = made.joined;
      made = std::move(*large);
      has_absorbed = true;
    }
    const bool has_snapped = snap(made, request, interfaces);
    std::optional<Partition> zipped = pairs.empty() ? std::nullopt : zip_lines(made, request, pairs);
    if (zipped)
      made = std::move(*zipped);
    if (!large && !has_snapped && !zipped)
      break;
  }
  return made;
}

/// Joins curves with the boundary, with interfaces and with each other. Circular interfaces become chords where curves
/// follow them that had to stay: snap() joins straight lines only.
Partition with_joined_lines(Partition given, const ArcRequest& request) {
  given.curves.on_boundary.clear(); // which belongs to the curves as they were given
  given.curves.outside.clear();
  if (std::optional<Partition> joined = join_lines(given, request))
    given = std::move(*joined);
  std::optional<Partition> straight = with_chords_along_curves(given, request);
  return straight ? std::move(*straight) : std::move(given);
}

} // namespace

Partition simplify_partition(const geometry::InnerCurves& curves, const geometry::Boundary& boundary,
                             const ArcRequest& request, std::span<const std::array<int, 2>> pairs) {
  bool has_absorbed = false;
  const Partition joined = with_joined_lines({curves, boundary}, request);
  Partition made = without_slivers(joined, request, pairs, has_absorbed);
  const bool is_relabelled = made.is_relabelled || joined.is_relabelled;
  std::vector<geometry::NarrowWedge> wedges = geometry::narrow_wedges(made.curves.arcs, made.boundary);
  if (has_absorbed)
    std::erase_if(wedges, [&](const geometry::NarrowWedge& wedge) {
      const std::array<int, 2> pair{std::min(wedge.left_region, wedge.right_region),
                                    std::max(wedge.left_region, wedge.right_region)};
      return pair[0] != pair[1] && !std::ranges::binary_search(pairs, pair);
    });
  std::vector<Vec2> tips; // which cut_wedges treats
  for (const geometry::NarrowWedge& wedge : wedges)
    tips.push_back(wedge.node);
  std::sort(tips.begin(), tips.end(), geometry::lexicographically_less);
  ArcRequest beyond_tips = request;
  beyond_tips.tips = tips;
  std::vector<InnerArc> given = made.curves.arcs;
  const FlowRequest flow{request.size, boundary.bounding_box(), GeneraliseRules::flow_reach, request.kept};
  made.curves.arcs = smooth_arcs(given, made.boundary, flow, request.lattice);
  for (int round = 0;; ++round) {
    made.curves = thin_arcs(made.curves, made.boundary, request, given);
    if (round == most_rounds)
      break; // arcs are thin in the end
    std::optional<Partition> wide = absorb_parts(made.curves, made.boundary, beyond_tips, pairs, SmallParts::and_necks);
    if (!wide)
      break;
    wide->joined = made.joined;
    made = std::move(*wide);
    snap(made, request, interface_tree(made.curves.arcs));
    given = made.curves.arcs;
  }
  cut_wedges(made.curves, wedges, made.boundary, request);
  geometry::set_wedges(made.curves.arcs, made.boundary);
  made.is_relabelled = made.is_relabelled || is_relabelled;
  return made;
}

geometry::InnerCurves thin_inner_curves(const geometry::InnerCurves& curves, const geometry::Boundary& boundary,
                                        const sizing::SizeField& size, const geometry::Lattice& lattice,
                                        std::span<const Vec2> corners) {
  return simplify_partition(curves, boundary, {size, lattice, corners}, {}).curves;
}

} // namespace trime::generalise
