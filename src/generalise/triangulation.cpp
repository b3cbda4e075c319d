// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/triangulation.hpp"

#include "geometry/predicates.hpp"

#include <algorithm>
#include <deque>

namespace trime::generalise {

using geometry::orient2d;
using geometry::Vec2;

Triangulation::Triangulation(const geometry::Box& box, const geometry::Lattice& lattice) : lattice_(lattice) {
  points_ = {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
  leaving_.assign(4, none);
  add_triangle();
  add_triangle();
  set_triangle(0, {0, 1, 2}, {none, none, 3}, {no_mark, no_mark, no_mark});
  set_triangle(1, {0, 2, 3}, {2, none, none}, {no_mark, no_mark, no_mark});
}

void Triangulation::reserve(std::size_t points) {
  points_.reserve(points + 4);
  leaving_.reserve(points + 4);
  origin_.reserve(6 * points + 12);
  twin_.reserve(6 * points + 12);
  mark_.reserve(6 * points + 12);
}

LocalIndex Triangulation::add_point(Vec2 p) {
  points_.push_back(p);
  leaving_.push_back(none);
  return vertex_count() - 1;
}

LocalIndex Triangulation::add_triangle() {
  const LocalIndex t = triangle_count();
  origin_.resize(origin_.size() + 3, none);
  twin_.resize(twin_.size() + 3, none);
  mark_.resize(mark_.size() + 3, no_mark);
  return t;
}

void Triangulation::set_triangle(LocalIndex t, std::array<LocalIndex, 3> vertices, std::array<HalfEdge, 3> twins,
                                 std::array<std::int32_t, 3> marks) {
  for (LocalIndex k = 0; k < 3; ++k) {
    const HalfEdge e = 3 * t + k;
    origin_[at(e)] = vertices[at(k)];
    mark_[at(e)] = marks[at(k)];
    leaving_[at(vertices[at(k)])] = e;
    link(e, twins[at(k)]);
  }
}

void Triangulation::link(HalfEdge e, HalfEdge f) {
  twin_[at(e)] = f;
  if (f != none)
    twin_[at(f)] = e;
}

int Triangulation::side(LocalIndex a, LocalIndex b, LocalIndex c) const {
  return orient2d(point(a), point(b), point(c));
}

/// A visibility walk; it ends in a Delaunay triangulation, and with constraints nearly always: else all are searched.
Triangulation::Location Triangulation::locate(Vec2 p) const {
  HalfEdge e = 3 * triangle(last_);
  const LocalIndex longest = triangle_count();
  const auto settle = [&](HalfEdge first) {
    last_ = first;
    for (HalfEdge f = first, k = 0; k < 3; f = next(f), ++k)
      if (point(origin(f)) == p)
        return Location{f, Location::at_origin};
    Location place{first, Location::inside};
    for (HalfEdge f = first, k = 0; k < 3; f = next(f), ++k)
      if (orient2d(point(origin(f)), point(target(f)), p) == 0)
        place = {f, Location::on_edge};
    return place;
  };
  HalfEdge entered = none;
  for (LocalIndex step = 0; step < longest; ++step) {
    HalfEdge leave = none;
    for (HalfEdge f = next(e), k = 0; k < 3 && leave == none; f = next(f), ++k)
      if (f != entered && twin(f) != none && orient2d(point(origin(f)), point(target(f)), p) < 0)
        leave = f;
    if (leave == none)
      return settle(e);
    e = entered = twin(leave);
  }
  for (LocalIndex t = 0; t < triangle_count(); ++t) {
    bool holds = true;
    for (HalfEdge f = 3 * t; f < 3 * t + 3; ++f)
      holds &= orient2d(point(origin(f)), point(target(f)), p) >= 0;
    if (holds)
      return settle(3 * t);
  }
  return settle(e);
}

LocalIndex Triangulation::insert(Vec2 p) {
  const Location place = locate(p);
  if (place.kind == Location::at_origin)
    return origin(place.edge);
  const LocalIndex v =
      place.kind == Location::on_edge ? split_edge(place.edge, p) : split_triangle(triangle(place.edge), p);
  legalize();
  return v;
}

LocalIndex Triangulation::split_triangle(LocalIndex t, Vec2 p) {
  const LocalIndex v = add_point(p), t1 = add_triangle(), t2 = add_triangle();
  const HalfEdge e = 3 * t;
  const std::array<LocalIndex, 3> o{origin(e), origin(e + 1), origin(e + 2)};
  const std::array<HalfEdge, 3> outside{twin(e), twin(e + 1), twin(e + 2)};
  const std::array<std::int32_t, 3> m{mark_[at(e)], mark_[at(e + 1)], mark_[at(e + 2)]};
  set_triangle(t, {o[0], o[1], v}, {outside[0], none, none}, {m[0], no_mark, no_mark});
  set_triangle(t1, {o[1], o[2], v}, {outside[1], none, none}, {m[1], no_mark, no_mark});
  set_triangle(t2, {o[2], o[0], v}, {outside[2], none, none}, {m[2], no_mark, no_mark});
  link(3 * t + 1, 3 * t1 + 2);
  link(3 * t1 + 1, 3 * t2 + 2);
  link(3 * t2 + 1, 3 * t + 2);
  doubtful_.insert(doubtful_.end(), {3 * t, 3 * t1, 3 * t2});
  return v;
}

/// Splits the edge e at p; @pre the four new triangles turn left, or p lies on the border of the box. Where p does not
/// lie exactly on e, on needles, the edges from p to the apexes may have to flip too.
LocalIndex Triangulation::split_edge(HalfEdge e, Vec2 p) {
  const HalfEdge f = twin(e);
  const LocalIndex v = add_point(p), a = origin(e), b = target(e), c = origin(previous(e));
  const LocalIndex t = triangle(e), t1 = add_triangle();
  const std::int32_t there = mark_[at(e)];
  const HalfEdge to_c = twin(next(e)), from_c = twin(previous(e));
  const std::int32_t to_c_mark = mark_[at(next(e))], from_c_mark = mark_[at(previous(e))];
  set_triangle(t, {a, v, c}, {none, none, from_c}, {there, no_mark, from_c_mark});
  set_triangle(t1, {v, b, c}, {none, to_c, none}, {there, to_c_mark, no_mark});
  link(3 * t + 1, 3 * t1 + 2);
  doubtful_.insert(doubtful_.end(), {3 * t + 1, 3 * t + 2, 3 * t1 + 1});
  if (f == none)
    return v;
  const LocalIndex d = origin(previous(f)), u = triangle(f), u1 = add_triangle();
  const std::int32_t back = mark_[at(f)];
  const HalfEdge to_d = twin(next(f)), from_d = twin(previous(f));
  const std::int32_t to_d_mark = mark_[at(next(f))], from_d_mark = mark_[at(previous(f))];
  set_triangle(u, {b, v, d}, {3 * t1, none, from_d}, {back, no_mark, from_d_mark});
  set_triangle(u1, {v, a, d}, {3 * t, to_d, none}, {back, to_d_mark, no_mark});
  link(3 * u + 1, 3 * u1 + 2);
  doubtful_.insert(doubtful_.end(), {3 * u + 1, 3 * u + 2, 3 * u1 + 1});
  return v;
}

LocalIndex Triangulation::split(HalfEdge e, Vec2 p) {
  const auto turns_left = [&](HalfEdge edge) {
    const Vec2 apex = point(origin(previous(edge)));
    return orient2d(point(origin(edge)), p, apex) > 0 && orient2d(p, point(target(edge)), apex) > 0;
  };
  if (!turns_left(e) || (twin(e) != none && !turns_left(twin(e))))
    return none;
  const LocalIndex v = split_edge(e, p);
  legalize();
  return v;
}

/// Does the vertex across an edge lie in the disc of the triangle on this side?
bool Triangulation::is_illegal(HalfEdge e) const {
  const HalfEdge f = twin(e);
  if (f == none || is_constrained(e))
    return false;
  return geometry::in_circle(point(origin(e)), point(target(e)), point(origin(previous(e))), point(origin(previous(f))),
                             lattice_) > 0;
}

void Triangulation::legalize() {
  while (!doubtful_.empty()) {
    const HalfEdge e = doubtful_.back();
    doubtful_.pop_back();
    if (!is_illegal(e))
      continue;
    const HalfEdge first = 3 * triangle(e), second = 3 * triangle(twin(e));
    flip(e);
    doubtful_.insert(doubtful_.end(), {first, first + 1, second, second + 1});
  }
}

/// The diagonal of the two triangles at e becomes the other one, the last half-edge of both.
void Triangulation::flip(HalfEdge e) {
  const HalfEdge f = twin(e);
  const LocalIndex a = origin(e), b = target(e), c = origin(previous(e)), d = origin(previous(f));
  const LocalIndex t = triangle(e), u = triangle(f);
  const HalfEdge bc = twin(next(e)), ca = twin(previous(e)), ad = twin(next(f)), db = twin(previous(f));
  const std::int32_t bc_mark = mark_[at(next(e))], ca_mark = mark_[at(previous(e))], ad_mark = mark_[at(next(f))],
                     db_mark = mark_[at(previous(f))];
  set_triangle(t, {c, a, d}, {ca, ad, none}, {ca_mark, ad_mark, no_mark});
  set_triangle(u, {d, b, c}, {db, bc, none}, {db_mark, bc_mark, no_mark});
  link(3 * t + 2, 3 * u + 2);
}

Triangulation::HalfEdge Triangulation::find_edge(LocalIndex a, LocalIndex b) const {
  const HalfEdge first = leaving(a);
  HalfEdge e = first;
  do { // counter-clockwise
    if (target(e) == b)
      return e;
    e = around(e);
  } while (e != none && e != first);
  if (e == none) // behind the border of the box: clockwise from the first
    for (e = twin(first); e != none; e = twin(e)) {
      e = next(e);
      if (e == first)
        break;
      if (target(e) == b)
        return e;
    }
  return none;
}

bool Triangulation::is_strictly_convex(HalfEdge e) const {
  const HalfEdge f = twin(e);
  const LocalIndex c = origin(previous(e)), d = origin(previous(f));
  return side(d, origin(e), c) < 0 && side(d, target(e), c) > 0;
}

/// The edges between a and b, seen from the right of the way; false if a vertex or a constraint is in it.
bool Triangulation::find_crossed(LocalIndex a, LocalIndex b, std::vector<HalfEdge>& crossed) const {
  HalfEdge e = leaving(a);
  const HalfEdge first = e;
  for (;;) { // the triangle at a that the way enters
    const int from = side(a, b, target(e)), to = side(a, b, origin(previous(e)));
    if (from <= 0 && to >= 0 && side(a, target(e), b) >= 0 && side(a, origin(previous(e)), b) <= 0) {
      if (from == 0 || to == 0)
        return false;
      break;
    }
    e = around(e);
    if (e == none || e == first)
      return false;
  }
  for (HalfEdge across = next(e);;) {
    if (is_constrained(across) || twin(across) == none)
      return false;
    crossed.push_back(across);
    const HalfEdge f = twin(across);
    const LocalIndex apex = origin(previous(f));
    if (apex == b)
      return true;
    const int where = side(a, b, apex);
    if (where == 0)
      return false;
    across = where > 0 ? next(f) : previous(f);
  }
}

Triangulation::HalfEdge Triangulation::flip_to_edge(LocalIndex a, LocalIndex b) {
  std::vector<HalfEdge> crossed;
  if (!find_crossed(a, b, crossed))
    return none;
  // Flips may rename half-edges, so edges are remembered by their ends.
  std::deque<std::array<LocalIndex, 2>> ways;
  for (const HalfEdge e : crossed)
    ways.push_back({origin(e), target(e)});
  std::vector<std::array<LocalIndex, 2>> made;
  for (std::size_t bound = 4 * ways.size() * ways.size() + 16; !ways.empty() && bound > 0; --bound) {
    const auto [u, v] = ways.front();
    ways.pop_front();
    const HalfEdge e = find_edge(u, v);
    if (!is_strictly_convex(e)) {
      ways.push_back({u, v});
      continue;
    }
    const LocalIndex c = origin(previous(e)), d = origin(previous(twin(e)));
    flip(e);
    const bool ends = c == a || c == b || d == a || d == b;
    if (!ends && side(a, b, c) * side(a, b, d) < 0)
      ways.push_back({c, d});
    else
      made.push_back({c, d});
  }
  const HalfEdge edge = find_edge(a, b);
  if (edge != none)
    for (const auto& [u, v] : made)
      if (const HalfEdge e = find_edge(u, v); e != none)
        doubtful_.push_back(e);
  return edge;
}

bool Triangulation::constrain(LocalIndex a, LocalIndex b, std::int32_t mark) {
  if (a == b)
    return false;
  HalfEdge edge = find_edge(a, b);
  if (edge == none)
    edge = flip_to_edge(a, b);
  if (edge == none || is_constrained(edge))
    return false;
  mark_[at(edge)] = mark;
  mark_[at(twin(edge))] = -1 - mark;
  legalize();
  return true;
}

} // namespace trime::generalise
