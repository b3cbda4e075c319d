// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/curve_map.hpp"

#include "core/hilbert.hpp"
#include "generalise/rules.hpp"
#include "geometry/predicates.hpp"

#include <algorithm>
#include <cmath>

namespace trime::generalise {
namespace {

using geometry::Box;
using geometry::Vec2;

/// The box of the curves, and a quarter of its longer side around it.
Box box_around(const geometry::Boundary& boundary, const geometry::Lattice& lattice) {
  Box box = boundary.bounding_box();
  const double margin = 0.25 * std::fmax(box.width(), box.height());
  box.min = lattice.snap(box.min - Vec2{margin, margin});
  box.max = lattice.snap(box.max + Vec2{margin, margin});
  return box;
}

} // namespace

CurveMap::CurveMap(const geometry::Boundary& boundary, const sizing::SizeField& size, const geometry::Lattice& lattice,
                   std::span<const Vec2> inside)
    : boundary_(boundary), field_(size), lattice_(lattice), mesh_(box_around(boundary, lattice), lattice) {
  for (LocalIndex loop = 0; loop < std::ssize(boundary.loops); ++loop)
    add_strands(loop);
  insert_vertices(inside);
  for (LocalIndex k = 0; k < std::ssize(strands_) && valid_; ++k)
    valid_ = mesh_.constrain(strands_[at(k)].first, strands_[at(k)].last, k);
  valid_ = valid_ && (inside.empty() || holds_points());
}

void CurveMap::add_strands(LocalIndex loop) {
  const auto& pieces = boundary_.loops[at(loop)].pieces;
  for (LocalIndex k = 0; k < std::ssize(pieces); ++k) {
    const geometry::Piece& piece = pieces[at(k)];
    const double whole = piece.length();
    const int parts = piece.circular
                          ? std::max(1, static_cast<int>(std::ceil(std::fabs(piece.sweep) / GeneraliseRules::arc_step)))
                          : 1;
    for (int j = 0; j < parts; ++j)
      strands_.push_back({loop, k, whole * j / parts, j + 1 == parts ? whole : whole * (j + 1) / parts, 0, 0});
  }
}

/// In the order of a space-filling curve: any order serves, this one keeps the walks short.
void CurveMap::insert_vertices(std::span<const Vec2> held) {
  const std::size_t n = strands_.size();
  std::vector<Vec2> places(n);
  Box box;
  for (std::size_t k = 0; k < n; ++k) {
    const Strand& strand = strands_[k];
    places[k] = lattice_.snap(boundary_.loops[at(strand.loop)].pieces[at(strand.piece)].point(strand.from));
    box.include(places[k]);
  }
  for (const Vec2 p : held) {
    valid_ = valid_ && box.contains(p);
    places.push_back(p);
  }
  if (!valid_)
    return;
  constexpr int level = 20;
  const double scale = std::ldexp(0.999, level) / std::fmax(box.width(), box.height());
  std::vector<std::pair<std::uint64_t, std::size_t>> order(places.size());
  for (std::size_t k = 0; k < places.size(); ++k)
    order[k] = {hilbert_key(static_cast<std::uint32_t>((places[k].x - box.min.x) * scale),
                            static_cast<std::uint32_t>((places[k].y - box.min.y) * scale), level),
                k};
  std::sort(order.begin(), order.end());
  mesh_.reserve(places.size() + n / 2);
  size_.assign(4, 0);
  kept_.assign(4, 0);
  held_.assign(4, 0);
  along_.assign(4, 0);
  for (const auto& [key, k] : order)
    if (!insert_one(places[k], k < n ? &strands_[k] : nullptr)) {
      valid_ = false;
      return;
    }
  for (std::size_t k = 0, first = 0; k < n; ++k) {
    const bool closes = k + 1 == n || strands_[k + 1].loop != strands_[k].loop;
    strands_[k].last = strands_[closes ? first : k + 1].first;
    first = closes ? k + 1 : first;
  }
}

/// The start of a strand, or a point that is held; false if it is where a node is.
bool CurveMap::insert_one(Vec2 p, Strand* strand) {
  const LocalIndex v = mesh_.insert(p);
  if (v < std::ssize(size_))
    return !strand && is_held(v); // a point that was given twice
  size_.push_back(sizing::checked_size(field_, p));
  held_.push_back(!strand);
  kept_.push_back(!strand || (strand->from == 0 && boundary_.loops[at(strand->loop)].pieces[at(strand->piece)].corner));
  along_.push_back(strand ? strand->from : 0);
  if (strand)
    strand->first = v;
  return true;
}

bool CurveMap::holds_points() const {
  const std::vector<char> side = inside();
  for (LocalIndex v = 4; v < mesh_.vertex_count(); ++v)
    if (is_held(v) && side[at(Triangulation::triangle(mesh_.leaving(v)))] != 1)
      return false;
  return true;
}

std::vector<Vec2> CurveMap::those_inside(std::span<const Vec2> points) const {
  std::vector<Vec2> found;
  const std::vector<char> side = inside();
  const Box box = boundary_.bounding_box();
  for (const Vec2 p : points) {
    if (!box.contains(p))
      continue;
    const LocalIndex t = mesh_.triangle_at(p);
    bool is_on_curve = false;
    for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e)
      is_on_curve |= mesh_.is_constrained(e) &&
                     geometry::orient2d(mesh_.point(mesh_.origin(e)), mesh_.point(mesh_.target(e)), p) == 0;
    if (side[at(t)] == 1 && !is_on_curve)
      found.push_back(p);
  }
  return found;
}

CurveMap::Span CurveMap::span_of(HalfEdge e) const {
  const Strand& strand = strands_[at(mesh_.mark(e))];
  const LocalIndex a = mesh_.origin(e), b = mesh_.target(e);
  return {strand.loop, strand.piece, a == strand.first ? strand.from : along_[at(a)],
          b == strand.last ? strand.to : along_[at(b)]};
}

LocalIndex CurveMap::next_on_curve(LocalIndex v) const {
  HalfEdge e = mesh_.leaving(v);
  while (mesh_.mark(e) < 0)
    e = mesh_.around(e);
  return mesh_.target(e);
}

LocalIndex CurveMap::previous_on_curve(LocalIndex v) const {
  HalfEdge e = mesh_.leaving(v);
  while (!mesh_.is_constrained(e) || mesh_.mark(e) >= 0)
    e = mesh_.around(e);
  return mesh_.target(e);
}

bool CurveMap::add_node(HalfEdge e) {
  const HalfEdge own = mesh_.mark(e) >= 0 ? e : mesh_.twin(e);
  const Span span = span_of(own);
  const double middle = 0.5 * (span.from + span.to);
  const Vec2 p = lattice_.snap(boundary_.loops[at(span.loop)].pieces[at(span.piece)].point(middle));
  const double h = sizing::checked_size(field_, p);
  if (mesh_.split(own, p) == Triangulation::none)
    return false;
  size_.push_back(h);
  kept_.push_back(0);
  held_.push_back(0);
  along_.push_back(middle);
  return true;
}

std::vector<char> CurveMap::inside() const {
  std::vector<char> side(at(mesh_.triangle_count()), 2); // not known
  std::vector<LocalIndex> open{Triangulation::triangle(mesh_.leaving(0))};
  side[at(open.front())] = 0;
  while (!open.empty()) {
    const LocalIndex t = open.back();
    open.pop_back();
    for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e) {
      const HalfEdge f = mesh_.twin(e);
      if (f == Triangulation::none || side[at(Triangulation::triangle(f))] != 2)
        continue;
      side[at(Triangulation::triangle(f))] = mesh_.is_constrained(e) ? !side[at(t)] : side[at(t)];
      open.push_back(Triangulation::triangle(f));
    }
  }
  return side;
}

} // namespace trime::generalise
