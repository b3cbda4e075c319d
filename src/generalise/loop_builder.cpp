// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/loop_builder.hpp"

#include "generalise/rim.hpp"
#include "generalise/rules.hpp"
#include "polygon/chord_curve.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace trime::generalise {
namespace {

using geometry::Boundary;
using geometry::Loop;
using geometry::Piece;
using geometry::Vec2;
using HalfEdge = Triangulation::HalfEdge;

/// A loop that is being built.
struct BuiltLoop {
  Loop loop;
  std::map<LocalIndex, double> sources; // length by loop of the given boundary
  double area = 0;
};

class LoopBuilder {
public:
  LoopBuilder(const CurveMap& map, const std::vector<char>& labels, const MovedVertices& moved)
      : map_(map), mesh_(map.mesh()), rim_(map.mesh(), labels), moved_(moved) {
    for (LocalIndex v = 0; v < mesh_.vertex_count(); ++v)
      kept_.push_back(map.is_kept(v));
  }

  Boundary build() {
    std::vector<char> seen(3 * at(mesh_.triangle_count()));
    for (HalfEdge e = 0; e < 3 * mesh_.triangle_count(); ++e) {
      if (seen[at(e)] || !rim_.holds(e))
        continue;
      std::vector<HalfEdge> edges;
      for (HalfEdge f = e; !seen[at(f)]; f = rim_.next(f)) {
        seen[at(f)] = 1;
        edges.push_back(f);
      }
      leave_out_collapsed(edges);
      if (edges.size() > 2)
        built_.push_back(build_loop(std::move(edges)));
    }
    name_loops();
    Boundary result;
    result.part_names = map_.boundary().part_names;
    result.periods = map_.boundary().periods;
    for (BuiltLoop& one : built_)
      result.loops.push_back(std::move(one.loop));
    result.area = polygon::area_of_loops(result);
    return result;
  }

private:
  /// Edges whose ends were joined. If the first end is one that the user has asked for, the next piece starts there.
  void leave_out_collapsed(std::vector<HalfEdge>& edges) {
    const auto collapsed = [&](HalfEdge e) { return place(mesh_.origin(e)) == place(mesh_.target(e)); };
    for (int round = 0; round < 2; ++round) // the way may begin between two of them
      for (const HalfEdge e : edges)
        if (collapsed(e))
          kept_[at(mesh_.target(e))] |= kept_[at(mesh_.origin(e))];
    edges.erase(std::remove_if(edges.begin(), edges.end(), collapsed), edges.end());
  }

  Vec2 place(LocalIndex v) const { return moved_.empty() ? mesh_.point(v) : moved_[at(v)]; }
  bool is_moved(LocalIndex v) const { return !moved_.empty() && moved_[at(v)] != mesh_.point(v); }
  const Piece& piece_of(const CurveMap::Span& span) const {
    return map_.boundary().loops[at(span.loop)].pieces[at(span.piece)];
  }
  /// Does the edge follow its piece?
  bool is_true(HalfEdge e) const {
    return mesh_.mark(e) >= 0 && !is_moved(mesh_.origin(e)) && !is_moved(mesh_.target(e));
  }

  /// Do two edges that follow each other belong to one piece of the result?
  bool continues(HalfEdge e, HalfEdge f) const {
    if (!is_true(e) || !is_true(f))
      return false;
    const CurveMap::Span a = map_.span_of(e), b = map_.span_of(f);
    return a.loop == b.loop && a.piece == b.piece && a.to == b.from;
  }

  Piece piece_between(HalfEdge first, HalfEdge last) const {
    Piece piece;
    piece.start = place(mesh_.origin(first));
    piece.end = place(mesh_.target(last));
    piece.corner = kept_[at(mesh_.origin(first))] != 0;
    if (mesh_.mark(first) < 0)
      return piece;
    const CurveMap::Span from = map_.span_of(first), to = map_.span_of(last);
    const Piece& given = piece_of(from);
    const double whole = given.length();
    const bool is_whole = from.from == 0 && to.to == whole;
    piece.part = given.part;
    piece.region = given.region;
    if (!is_true(first))
      return piece;
    if (is_whole) {
      const bool corner = piece.corner;
      piece = given;
      piece.corner = corner;
      return piece;
    }
    if (given.circular) {
      piece.circular = true;
      piece.center = given.center;
      piece.radius = given.radius;
      piece.start_angle = given.start_angle + given.sweep * (from.from / whole);
      piece.sweep = given.sweep * ((to.to - from.from) / whole);
    }
    return piece;
  }

  BuiltLoop build_loop(std::vector<HalfEdge> edges) const {
    // Begin where a piece begins, and where a loop begins that is as it was.
    std::size_t first = 0;
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const HalfEdge before = edges[(k + edges.size() - 1) % edges.size()];
      if (continues(before, edges[k]))
        continue;
      first = k;
      if (mesh_.mark(edges[k]) >= 0)
        if (const CurveMap::Span span = map_.span_of(edges[k]); span.piece == 0 && span.from == 0)
          break;
    }
    std::rotate(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(first), edges.end());
    BuiltLoop built;
    for (std::size_t k = 0; k < edges.size();) {
      std::size_t last = k;
      while (last + 1 < edges.size() && continues(edges[last], edges[last + 1]))
        ++last;
      built.loop.pieces.push_back(piece_between(edges[k], edges[last]));
      if (mesh_.mark(edges[k]) >= 0)
        built.sources[map_.span_of(edges[k]).loop] += built.loop.pieces.back().length();
      else if (const std::size_t n = built.loop.pieces.size(); n > 1) {
        built.loop.pieces[n - 1].part = built.loop.pieces[n - 2].part;
        built.loop.pieces[n - 1].region = built.loop.pieces[n - 2].region;
      }
      k = last + 1;
    }
    const Vec2 origin = built.loop.pieces.front().start;
    for (const HalfEdge e : edges)
      built.area += 0.5 * cross(place(mesh_.origin(e)) - origin, place(mesh_.target(e)) - origin);
    built.loop.outer = built.area > 0;
    return built;
  }

  /// Tags and order of the loops.
  void name_loops() {
    std::map<LocalIndex, std::size_t> heirs; // of each given loop, the built one with most of it
    for (std::size_t k = 0; k < built_.size(); ++k)
      for (const auto& [source, part] : built_[k].sources) {
        const auto [there, is_new] = heirs.try_emplace(source, k);
        if (!is_new && part > built_[there->second].sources.at(source))
          there->second = k;
      }
    std::vector<LocalIndex> given(built_.size(), Triangulation::none);
    for (auto entry = heirs.rbegin(); entry != heirs.rend(); ++entry)
      given[entry->second] = entry->first; // the lowest in the end
    int next_tag = 1;
    for (const Loop& loop : map_.boundary().loops)
      next_tag = std::max(next_tag, loop.tag + 1);
    for (std::size_t k = 0; k < built_.size(); ++k)
      built_[k].loop.tag = given[k] >= 0 ? map_.boundary().loops[at(given[k])].tag : next_tag++;
    std::stable_sort(built_.begin(), built_.end(),
                     [](const BuiltLoop& a, const BuiltLoop& b) { return a.loop.tag < b.loop.tag; });
  }

  const CurveMap& map_;
  const Triangulation& mesh_;
  const Rim rim_;
  const MovedVertices& moved_;
  std::vector<char> kept_; // by vertex: do pieces that start there start at a corner?
  std::vector<BuiltLoop> built_;
};

/// The triangles of one side around a vertex, between two constrained or changed edges.
struct Sector {
  std::vector<LocalIndex> triangles;
  double longest = 0; // edge at the vertex; infinite if it leads to a point that must stay inside
};

/// The inside sectors at v. @pre v is not a corner of the box
std::vector<Sector> sectors_at(const CurveMap& map, const Rim& rim, LocalIndex v) {
  const Triangulation& mesh = map.mesh();
  std::vector<Sector> sectors;
  const HalfEdge first = mesh.leaving(v);
  HalfEdge start = first;
  do { // begin where the inside begins
    if (rim.holds(start))
      break;
    start = mesh.around(start);
  } while (start != first);
  if (!rim.holds(start))
    return sectors;
  HalfEdge e = start;
  do {
    if (rim.is_inside(e)) {
      if (rim.holds(e))
        sectors.emplace_back();
      Sector& sector = sectors.back();
      sector.triangles.push_back(Triangulation::triangle(e));
      for (const LocalIndex end : {mesh.target(e), mesh.origin(Triangulation::previous(e))})
        sector.longest =
            map.is_held(end) ? INFINITY : std::fmax(sector.longest, length(mesh.point(end) - mesh.point(v)));
    }
    e = mesh.around(e);
  } while (e != start);
  return sectors;
}

/// Gives the triangles around a vertex their old labels. Returns those that change.
std::vector<LocalIndex> restore_around(const Triangulation& mesh, LocalIndex v, const std::vector<char>& given,
                                       std::vector<char>& labels) {
  std::vector<LocalIndex> changed;
  HalfEdge e = mesh.leaving(v);
  do {
    const LocalIndex t = Triangulation::triangle(e);
    if (labels[at(t)] != given[at(t)])
      changed.push_back(t);
    labels[at(t)] = given[at(t)];
    e = mesh.around(e);
  } while (e != mesh.leaving(v));
  return changed;
}

} // namespace

Boundary build_loops(const CurveMap& map, const std::vector<char>& labels, const MovedVertices& moved) {
  return LoopBuilder(map, labels, moved).build();
}

bool separate_touching_loops(const CurveMap& map, const std::vector<char>& given, std::vector<char>& labels) {
  const Triangulation& mesh = map.mesh();
  const Rim rim(mesh, labels);
  std::set<LocalIndex> here, next; // vertices of triangles that have changed, in this round and for the next one
  LocalIndex v = 0;
  const auto look_at = [&](LocalIndex t) {
    for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e)
      if (const LocalIndex u = mesh.origin(e); u >= 4)
        (u > v ? here : next).insert(u);
  };
  for (LocalIndex t = 0; t < mesh.triangle_count(); ++t)
    if (labels[at(t)] != given[at(t)])
      look_at(t);
  for (int round = 0; round < GeneraliseRules::touch_rounds && !here.empty(); ++round) {
    for (; !here.empty(); here.erase(here.begin())) {
      v = *here.begin();
      std::vector<Sector> sectors = sectors_at(map, rim, v);
      while (sectors.size() > 1) {
        const auto least = std::min_element(sectors.begin(), sectors.end(),
                                            [](const Sector& a, const Sector& b) { return a.longest < b.longest; });
        if (least->longest > GeneraliseRules::narrow_inside * map.size(v)) {
          for (const LocalIndex t : restore_around(mesh, v, given, labels))
            look_at(t);
          break;
        }
        for (const LocalIndex t : least->triangles) {
          labels[at(t)] = 0;
          look_at(t);
        }
        sectors.erase(least);
      }
    }
    here.swap(next);
    v = 0;
  }
  return here.empty();
}

} // namespace trime::generalise
