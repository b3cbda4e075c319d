// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/region_map.hpp"

#include "core/hilbert.hpp"
#include "generalise/arc_chords.hpp"
#include "generalise/rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

namespace trime::generalise {
namespace {

using geometry::Box;
using geometry::InnerArc;
using geometry::Piece;
using geometry::Vec2;

constexpr int unknown = -2;

/// The box of the curves, and a quarter of its longer side around it.
Box box_around(const geometry::Boundary& boundary, const geometry::Lattice& lattice) {
  Box box = boundary.bounding_box();
  const double margin = 0.25 * std::fmax(box.width(), box.height());
  box.min = lattice.snap(box.min - Vec2{margin, margin});
  box.max = lattice.snap(box.max + Vec2{margin, margin});
  return box;
}

/// The order of points along a space-filling curve.
std::vector<std::size_t> order_of(const std::vector<Vec2>& places) {
  constexpr int level = 20;
  Box box;
  for (const Vec2 p : places)
    box.include(p);
  const double scale = std::ldexp(0.999, level) / std::fmax(box.width(), box.height());
  std::vector<std::pair<std::uint64_t, std::size_t>> keys(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Vec2 p = scale * (places[k] - box.min);
    keys[k] = {hilbert_key(static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y), level), k};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> order;
  for (const auto& [key, k] : keys)
    order.push_back(k);
  return order;
}

} // namespace

RegionMap::RegionMap(const geometry::InnerCurves& curves, const geometry::Boundary& boundary, const ArcRequest& request)
    : curves_(curves), boundary_(boundary), request_(request),
      mesh_(box_around(boundary, request.lattice), request.lattice) {
  find_tips();
  std::vector<Vec2> places; // the two ends of each strand
  for (std::size_t loop = 0; loop < boundary.loops.size(); ++loop)
    add_strands(-1 - static_cast<int>(loop), boundary.loops[loop].pieces, places);
  for (std::size_t arc = 0; arc < curves.arcs.size(); ++arc)
    add_strands(static_cast<int>(arc), curves.arcs[arc].pieces, places);
  const Box box = boundary.bounding_box();
  valid_ = std::ranges::all_of(places, [&](Vec2 p) { return box.contains(p); });
  if (!valid_)
    return;
  insert_vertices(places);
  for (std::size_t k = 0; k < strands_.size() && valid_; ++k)
    valid_ = strands_[k].from != strands_[k].to &&
             mesh_.constrain(strands_[k].from, strands_[k].to, static_cast<std::int32_t>(k));
  if (!valid_)
    return;
  hold_vertices();
  set_labels();
}

const Piece& RegionMap::piece(const Strand& strand) const {
  return strand.arc < 0 ? boundary_.loops[static_cast<std::size_t>(-1 - strand.arc)].pieces[strand.piece]
                        : curves_.arcs[static_cast<std::size_t>(strand.arc)].pieces[strand.piece];
}

/// Finds where the sides of thin tips get a vertex, so that the tips can be cut there.
void RegionMap::find_tips() {
  for (const geometry::NarrowWedge& wedge : geometry::narrow_wedges(curves_.arcs, boundary_)) {
    if (std::ranges::binary_search(request_.tips, wedge.node, geometry::lexicographically_less))
      continue;
    std::array<Vec2, 2> ways;
    const std::array<geometry::ArcEnd, 2> ends{wedge.right, wedge.left};
    std::array<std::size_t, 2> numbers{};
    for (std::size_t side = 0; side < 2; ++side) {
      const std::vector<Piece>& pieces = curves_.arcs[ends[side].arc].pieces;
      numbers[side] = ends[side].at_end ? pieces.size() - 1 : 0;
      const Piece& piece = pieces[numbers[side]];
      ways[side] = ends[side].at_end ? piece.start - piece.end : piece.end - piece.start;
    }
    const double lengths[] = {geometry::length(ways[0]), geometry::length(ways[1])};
    const double opening = geometry::length((1 / lengths[0]) * ways[0] - (1 / lengths[1]) * ways[1]);
    const double reach =
        GeneraliseRules::cut_tip * sizing::checked_size(request_.size, wedge.node) / std::fmax(opening, 1e-9);
    for (std::size_t side = 0; side < 2; ++side)
      if (1.2 * reach < lengths[side])
        splits_.push_back({ends[side].arc, numbers[side], ends[side].at_end,
                           request_.lattice.snap(wedge.node + (reach / lengths[side]) * ways[side])});
  }
  std::ranges::stable_sort(splits_, [](const Split& a, const Split& b) {
    return std::tie(a.arc, a.piece, a.at_end) < std::tie(b.arc, b.piece, b.at_end);
  });
  const auto overlap = [&](const Split& a, const Split& b) {
    if (a.arc != b.arc || a.piece != b.piece)
      return false;
    const Vec2 start = curves_.arcs[a.arc].pieces[a.piece].start;
    return squared_length(a.place - start) >= squared_length(b.place - start);
  };
  splits_.erase(std::unique(splits_.begin(), splits_.end(), overlap), splits_.end());
}

double RegionMap::bulge(const Strand& strand) const {
  return area_on_chord(geometry::length(mesh_.point(strand.to) - mesh_.point(strand.from)), strand.sweep);
}

void RegionMap::add_strands(int arc, const std::vector<Piece>& pieces, std::vector<Vec2>& places) {
  auto split = std::ranges::lower_bound(splits_, static_cast<std::size_t>(std::max(0, arc)), {}, &Split::arc);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Piece& piece = pieces[k];
    places.push_back(piece.start);
    const int parts = chords_along(piece, request_.size);
    const auto add = [&](Vec2 end) {
      if (end == places.back())
        return;
      places.push_back(end);
      strands_.push_back({arc, k, 0, 0, piece.circular ? piece.sweep / parts : 0});
      places.push_back(end); // where the next strand begins
    };
    const double whole = piece.length();
    for (int j = 1; j < parts; ++j)
      add(request_.lattice.snap(piece.point(whole * j / parts)));
    for (; split != splits_.end() && arc >= 0 && split->arc == static_cast<std::size_t>(arc) && split->piece == k;
         ++split)
      add(split->place);
    add(piece.end);
    places.pop_back();
  }
}

void RegionMap::insert_vertices(const std::vector<Vec2>& places) {
  mesh_.reserve(places.size() / 2);
  size_.assign(4, 0);
  for (const std::size_t k : order_of(places)) {
    const LocalIndex v = mesh_.insert(places[k]);
    if (v == std::ssize(size_))
      size_.push_back(sizing::checked_size(request_.size, places[k]));
    (k % 2 == 0 ? strands_[k / 2].from : strands_[k / 2].to) = v;
  }
}

bool RegionMap::is_kept(LocalIndex v) const {
  return std::binary_search(request_.kept.begin(), request_.kept.end(), mesh_.point(v),
                            geometry::lexicographically_less);
}

/// Holds what the user asked for, and arcs of circles.
void RegionMap::hold_vertices() {
  held_.assign(size_.size(), 0);
  for (std::size_t v = 4; v < size_.size(); ++v)
    held_[v] = is_kept(static_cast<LocalIndex>(v));
  for (const Strand& strand : strands_) {
    const Piece& own = piece(strand);
    for (const LocalIndex v : {strand.from, strand.to})
      if (own.circular && (strand.arc >= 0 || (mesh_.point(v) != own.start && mesh_.point(v) != own.end)))
        held_[at(v)] = 1;
  }
}

int RegionMap::curve_on(HalfEdge e) const {
  if (!mesh_.is_constrained(e))
    return -1;
  const Strand& strand = strands_[at(mesh_.mark_of_edge(e))];
  return strand.arc < 0 ? -1 : piece(strand).part;
}

int RegionMap::given_label(HalfEdge e) const {
  const Strand& strand = strands_[at(mesh_.mark_of_edge(e))];
  const bool along = mesh_.mark(e) >= 0;
  if (strand.arc < 0)
    return along ? piece(strand).region : outside;
  const InnerArc& arc = curves_.arcs[static_cast<std::size_t>(strand.arc)];
  return along ? arc.left : arc.right;
}

void RegionMap::set_labels() {
  labels_.assign(at(mesh_.triangle_count()), unknown);
  std::vector<LocalIndex> open;
  const auto set = [&](LocalIndex t, int label) {
    if (labels_[at(t)] == unknown) {
      labels_[at(t)] = label;
      open.push_back(t);
    }
    valid_ = valid_ && labels_[at(t)] == label;
  };
  const auto is_border = [this](HalfEdge e) {
    return mesh_.is_constrained(e) && mesh_.twin(e) != Triangulation::none &&
           given_label(e) != given_label(mesh_.twin(e));
  };
  for (HalfEdge e = 0; e < 3 * mesh_.triangle_count(); ++e)
    if (is_border(e))
      set(Triangulation::triangle(e), given_label(e));
  while (!open.empty()) { // curves with one region on both sides end nothing
    const LocalIndex t = open.back();
    open.pop_back();
    for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e)
      if (!is_border(e) && mesh_.twin(e) != Triangulation::none)
        set(Triangulation::triangle(mesh_.twin(e)), labels_[at(t)]);
  }
}

/// Is the third vertex of the triangle of a long edge so near that widths must be measured between more nodes?
bool RegionMap::wants_node(HalfEdge e) const {
  const LocalIndex a = mesh_.origin(e), b = mesh_.target(e), apex = mesh_.origin(Triangulation::previous(e));
  if (!mesh_.is_constrained(e) || strands_[at(mesh_.mark_of_edge(e))].arc < 0 || apex < 4 || is_held(a) || is_held(b) ||
      given_label(e) == outside)
    return false;
  const double width = GeneraliseRules::narrow_region * std::fmin(size(a), size(b));
  const Vec2 along = mesh_.point(b) - mesh_.point(a), across = mesh_.point(apex) - mesh_.point(a);
  const double whole = geometry::length(along), place = dot(across, along) / whole,
               height = cross(along, across) / whole;
  return whole > GeneraliseRules::node_spacing * width && height < width && place > -height && place < whole + height;
}

/// Divides an edge in the middle. Returns false if the lattice is too coarse.
bool RegionMap::add_node(HalfEdge e) {
  const Vec2 p = request_.lattice.snap(0.5 * (mesh_.point(mesh_.origin(e)) + mesh_.point(mesh_.target(e))));
  const HalfEdge own = mesh_.mark(e) >= 0 ? e : mesh_.twin(e);
  if (mesh_.split(own, p) == Triangulation::none)
    return false;
  size_.push_back(sizing::checked_size(request_.size, p));
  held_.push_back(0);
  return true;
}

void RegionMap::add_nodes_to_narrow_parts() {
  bool is_finished = false, has_new = false;
  for (int round = 0; round < GeneraliseRules::node_rounds && !is_finished; ++round) {
    std::vector<std::array<LocalIndex, 2>> wanted;
    for (HalfEdge e = 0; e < 3 * mesh_.triangle_count(); ++e)
      if (wants_node(e))
        wanted.push_back({std::min(mesh_.origin(e), mesh_.target(e)), std::max(mesh_.origin(e), mesh_.target(e))});
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    is_finished = true;
    for (const auto& [a, b] : wanted)
      if (add_node(mesh_.find_edge(a, b)))
        is_finished = false, has_new = true;
  }
  if (has_new)
    set_labels();
}

double RegionMap::area(LocalIndex t) const {
  const Vec2 a = mesh_.point(mesh_.origin(3 * t));
  return 0.5 * cross(mesh_.point(mesh_.origin(3 * t + 1)) - a, mesh_.point(mesh_.origin(3 * t + 2)) - a);
}

} // namespace trime::generalise
