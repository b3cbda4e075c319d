// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/patch_mesh.hpp"

#include "cleanup/rules.hpp"
#include "core/hilbert.hpp"
#include "geometry/predicates.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace trime::cleanup {
namespace {

using geometry::Vec2;

constexpr int next(int k) {
  return k == 2 ? 0 : k + 1;
}
constexpr int previous(int k) {
  return k == 0 ? 2 : k - 1;
}

/// Returns the position of v among the vertices of the triangle.
int place_of(const PatchMesh::Triangle& triangle, LocalIndex v) {
  return triangle.vertex[0] == v ? 0 : triangle.vertex[1] == v ? 1 : 2;
}

/// @brief geometry::in_circle, decided here where the determinant is far from 0: with the largest squared distance L
/// the products add up to 3 L^2 at most, so the rounding error stays below 2^-48 L^2 (Shewchuk 1997, bound A).
inline bool holds(Vec2 a, Vec2 b, Vec2 c, Vec2 d, const geometry::Lattice& lattice, const geometry::Periods& periods) {
  const double ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y, cx = c.x - d.x, cy = c.y - d.y;
  const double a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  const double determinant = a2 * (bx * cy - cx * by) + b2 * (cx * ay - ax * cy) + c2 * (ax * by - bx * ay);
  const double largest = std::max(a2, std::max(b2, c2)), sure = 0x1p-46 * largest * largest;
  if (determinant > sure || determinant < -sure)
    return determinant > 0;
  return geometry::in_circle(a, b, c, d, lattice, periods) > 0;
}

} // namespace

void PatchMesh::start(Vec2 center, double half_width) {
  const double w = half_width;
  positions_ = {center + Vec2{-w, -w}, center + Vec2{w, -w}, center + Vec2{w, w}, center + Vec2{-w, w}};
  triangles_ = {{{0, 1, 2}, {-1, 1, -1}}, {{0, 2, 3}, {-1, -1, 0}}};
  corner_of_ = {0, 0, 0, 1};
  unused_.clear();
  changed_.clear();
  last_ = 0;
}

/// A visibility walk: ends in a Delaunay triangulation.
LocalIndex PatchMesh::locate(Vec2 p) const {
  LocalIndex t = last_;
  for (std::size_t steps = 0; steps <= 2 * triangles_.size(); ++steps) {
    const Triangle& at = triangle(t);
    int k = 0;
    while (k < 3 && geometry::orient2d(position(at.vertex[static_cast<std::size_t>(next(k))]),
                                       position(at.vertex[static_cast<std::size_t>(previous(k))]), p) >= 0)
      ++k;
    if (k == 3)
      return t;
    t = at.neighbour[static_cast<std::size_t>(k)];
    if (t < 0)
      break;
  }
  throw InternalError(fmt::format("the point ({}, {}) lies outside of the frame of its patch", p.x, p.y));
}

bool PatchMesh::disc_holds(LocalIndex t, Vec2 p) const {
  const auto& v = triangle(t).vertex;
  return holds(position(v[0]), position(v[1]), position(v[2]), p, lattice_, periods_);
}

/// Lists the triangles whose discs hold p, and the rim around them.
void PatchMesh::open_cavity(LocalIndex t, Vec2 p) {
  work_.cavity.assign(1, t);
  work_.rim.clear();
  for (std::size_t i = 0; i < work_.cavity.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const Triangle& at = triangle(work_.cavity[i]);
      const LocalIndex beyond = at.neighbour[static_cast<std::size_t>(k)];
      if (beyond >= 0 && std::find(work_.cavity.begin(), work_.cavity.end(), beyond) != work_.cavity.end())
        continue;
      if (beyond >= 0 && disc_holds(beyond, p))
        work_.cavity.push_back(beyond);
      else
        work_.rim.push_back({at.vertex[static_cast<std::size_t>(next(k))],
                             at.vertex[static_cast<std::size_t>(previous(k))], beyond, -1});
    }
}

LocalIndex PatchMesh::new_triangle() {
  if (!unused_.empty()) {
    const LocalIndex t = unused_.back();
    unused_.pop_back();
    return t;
  }
  triangles_.push_back({});
  return static_cast<LocalIndex>(triangles_.size()) - 1;
}

/// Triangle t gets `other` as its neighbour k; `other` had `old` there.
void PatchMesh::link(LocalIndex t, int k, LocalIndex other, LocalIndex old) {
  triangle(t).neighbour[static_cast<std::size_t>(k)] = other;
  if (other >= 0)
    for (LocalIndex& back : triangle(other).neighbour)
      if (back == old) {
        back = t;
        return;
      }
}

/// A fan around v instead of the cavity.
void PatchMesh::close_cavity(LocalIndex v) {
  const std::size_t reused = work_.cavity.size();
  for (std::size_t i = 0; i < work_.rim.size(); ++i) {
    Rim& edge = work_.rim[i];
    edge.created = i < reused ? work_.cavity[i] : new_triangle();
    triangle(edge.created) = {{v, edge.from, edge.to}, {edge.outside, -1, -1}};
    corner_of(edge.from) = edge.created;
    changed_.push_back(edge.created);
    if (edge.outside < 0)
      continue;
    Triangle& beyond = triangle(edge.outside);
    for (std::size_t k = 0; k < 3; ++k)
      if (beyond.vertex[(k + 1) % 3] == edge.to && beyond.vertex[(k + 2) % 3] == edge.from)
        beyond.neighbour[k] = edge.created;
  }
  for (const Rim& edge : work_.rim) {
    const LocalIndex following = corner_of(edge.to); // the one that begins where this edge ends
    triangle(edge.created).neighbour[1] = following;
    triangle(following).neighbour[2] = edge.created;
  }
  corner_of(v) = last_ = work_.rim.front().created;
}

LocalIndex PatchMesh::append(Vec2 p) {
  positions_.push_back(p);
  corner_of_.push_back(-1);
  return vertices() - 1;
}

/// Each near the one before, so that searches are short and cavities small.
void PatchMesh::connect_all() {
  constexpr int level = CleanupRules::curve_level;
  constexpr double side = 1 << level;
  const Vec2 low = position(0);
  const double scale = side / (position(2).x - low.x);
  const auto cell = [&](double offset) {
    return static_cast<std::uint32_t>(std::clamp(scale * offset, 0.0, side - 1));
  };
  work_.on_curve.clear();
  for (LocalIndex v = frame; v < vertices(); ++v) {
    const Vec2 offset = position(v) - low;
    work_.on_curve.push_back({static_cast<std::uint32_t>(hilbert_key(cell(offset.x), cell(offset.y), level)), v});
  }
  std::sort(work_.on_curve.begin(), work_.on_curve.end(),
            [](const OnCurve& a, const OnCurve& b) { return a.key != b.key ? a.key < b.key : a.vertex < b.vertex; });
  for (const OnCurve& next : work_.on_curve)
    TRIME_ASSERT(place(next.vertex), "two sites at ({}, {})", position(next.vertex).x, position(next.vertex).y);
  forget_changes();
}

LocalIndex PatchMesh::insert(Vec2 p) {
  positions_.push_back(p);
  corner_of_.push_back(-1);
  if (place(vertices() - 1))
    return vertices() - 1;
  positions_.pop_back();
  corner_of_.pop_back();
  return -1;
}

/// Connects a vertex that has no triangles. @return false if another one lies there
bool PatchMesh::place(LocalIndex v) {
  const LocalIndex t = locate(position(v));
  for (const LocalIndex other : triangle(t).vertex)
    if (position(other) == position(v))
      return false;
  open_cavity(t, position(v));
  close_cavity(v);
  return true;
}

bool PatchMesh::replace(LocalIndex v, Vec2 to) {
  if (!remove(v))
    return false;
  positions_[static_cast<std::size_t>(v)] = to;
  return place(v);
}

void PatchMesh::collect_ring(LocalIndex v, std::vector<LocalIndex>& ring) const {
  ring.clear();
  const LocalIndex first = corner_of_[static_cast<std::size_t>(v)];
  LocalIndex t = first;
  do {
    const int k = place_of(triangle(t), v);
    ring.push_back(triangle(t).vertex[static_cast<std::size_t>(next(k))]);
    t = triangle(t).neighbour[static_cast<std::size_t>(next(k))];
  } while (t != first && t >= 0);
}

LocalIndex PatchMesh::degree(LocalIndex v) const {
  LocalIndex count = 0;
  const LocalIndex first = corner_of_[static_cast<std::size_t>(v)];
  LocalIndex t = first;
  do {
    ++count;
    t = triangle(t).neighbour[static_cast<std::size_t>(next(place_of(triangle(t), v)))];
  } while (t != first && t >= 0);
  return count;
}

std::optional<PatchMesh::Apexes> PatchMesh::apexes(LocalIndex from, LocalIndex to) const {
  const LocalIndex first = corner_of_[static_cast<std::size_t>(from)];
  LocalIndex t = first;
  do {
    const int k = place_of(triangle(t), from);
    const Triangle& left = triangle(t);
    if (left.vertex[static_cast<std::size_t>(next(k))] == to) {
      const LocalIndex u = left.neighbour[static_cast<std::size_t>(previous(k))];
      return Apexes{left.vertex[static_cast<std::size_t>(previous(k))],
                    u < 0 ? -1 : triangle(u).vertex[static_cast<std::size_t>(next(place_of(triangle(u), from)))]};
    }
    t = left.neighbour[static_cast<std::size_t>(next(k))];
  } while (t != first && t >= 0);
  return std::nullopt;
}

/// The edge of triangle t opposite of its vertex k, between the triangles (a, b, c) and (d, c, b), becomes a-d.
void PatchMesh::flip(LocalIndex t, int k) {
  const LocalIndex u = triangle(t).neighbour[static_cast<std::size_t>(k)];
  const Triangle one = triangle(t), two = triangle(u);
  const auto at = [](const Triangle& triangle, int place) {
    return std::pair{triangle.vertex[static_cast<std::size_t>(place)],
                     triangle.neighbour[static_cast<std::size_t>(place)]};
  };
  const auto [a, across] = at(one, k);
  const auto [b, beyond_b] = at(one, next(k));     // beyond_b: across the edge c-a
  const auto [c, beyond_c] = at(one, previous(k)); // across a-b
  int m = 0;
  while (two.neighbour[static_cast<std::size_t>(m)] != t || two.vertex[static_cast<std::size_t>(next(m))] != c)
    ++m;
  const auto [d, back] = at(two, m);
  const LocalIndex beyond_cd = two.neighbour[static_cast<std::size_t>(previous(m))]; // two is (d, c, b): across d-c
  const LocalIndex beyond_bd = two.neighbour[static_cast<std::size_t>(next(m))];     // across b-d
  changed_.push_back(t);
  changed_.push_back(u);
  triangle(t) = {{a, b, d}, {-1, u, -1}};
  triangle(u) = {{a, d, c}, {-1, -1, t}};
  link(t, 0, beyond_bd, u);
  link(t, 2, beyond_c, t);
  link(u, 0, beyond_cd, u);
  link(u, 1, beyond_b, t);
  corner_of(a) = corner_of(b) = corner_of(d) = t;
  corner_of(c) = u;
}

/// Flips until no suspect, and no edge around a flip, has a vertex in its discs. Exact tests: it ends.
void PatchMesh::legalize() {
  while (!work_.suspects.empty()) {
    const auto [t, k] = work_.suspects.back();
    work_.suspects.pop_back();
    const Triangle& at = triangle(t);
    const LocalIndex u = at.neighbour[static_cast<std::size_t>(k)];
    if (at.vertex[0] < 0 || u < 0)
      continue;
    const LocalIndex from = at.vertex[static_cast<std::size_t>(next(k))];
    const Triangle& other = triangle(u);
    int m = 0;
    while (other.neighbour[static_cast<std::size_t>(m)] != t ||
           other.vertex[static_cast<std::size_t>(previous(m))] != from)
      ++m;
    if (!disc_holds(t, position(other.vertex[static_cast<std::size_t>(m)])))
      continue;
    flip(t, k); // the edge between t and u is right now
    work_.suspects.push_back({t, 0});
    work_.suspects.push_back({t, 2});
    work_.suspects.push_back({u, 0});
    work_.suspects.push_back({u, 1});
  }
}

void PatchMesh::restore(std::span<const LocalIndex> shifted) {
  work_.is_shifted.resize(positions_.size(), 0);
  for (const LocalIndex v : shifted)
    work_.is_shifted[static_cast<std::size_t>(v)] = 1;
  const auto is_shifted = [&](LocalIndex u) { return work_.is_shifted[static_cast<std::size_t>(u)] != 0; };
  for (const LocalIndex v : shifted) { // each edge once
    const LocalIndex first = corner_of(v);
    LocalIndex t = first;
    do {
      const Triangle& at = triangle(t);
      const int k = place_of(triangle(t), v);
      const LocalIndex u = at.vertex[static_cast<std::size_t>(next(k))];
      const LocalIndex w = at.vertex[static_cast<std::size_t>(previous(k))];
      if (!is_shifted(u) && !is_shifted(w))
        work_.suspects.push_back({t, k});
      if (!is_shifted(u) || v < u)
        work_.suspects.push_back({t, previous(k)}); // the edge v-u
      t = at.neighbour[static_cast<std::size_t>(next(k))];
    } while (t != first && t >= 0);
  }
  for (const LocalIndex v : shifted)
    work_.is_shifted[static_cast<std::size_t>(v)] = 0;
  legalize();
}

bool PatchMesh::move(LocalIndex v, Vec2 to) {
  collect_ring(v, work_.ring);
  for (std::size_t k = 0; k < work_.ring.size(); ++k)
    if (geometry::orient2d(to, position(work_.ring[k]), position(work_.ring[k + 1 == work_.ring.size() ? 0 : k + 1])) <=
        0)
      return false;
  positions_[static_cast<std::size_t>(v)] = to;
  const LocalIndex first = corner_of(v);
  LocalIndex t = first;
  do { // all edges of the triangles around v
    const int k = place_of(triangle(t), v);
    work_.suspects.push_back({t, k});
    work_.suspects.push_back({t, next(k)});
    t = triangle(t).neighbour[static_cast<std::size_t>(next(k))];
  } while (t != first && t >= 0);
  legalize();
  return true;
}

/// Flips the first edge at v, of `degree` ones, behind which an ear of the ring can be cut off: with four edges left
/// two corners of the ring may be in line with v. Returns false if there is no such edge
bool PatchMesh::cut_ear(LocalIndex v, LocalIndex degree) {
  LocalIndex t = corner_of(v);
  for (LocalIndex k = 0; k < degree; ++k) { // the edge between this triangle and the next one
    const int at = place_of(triangle(t), v);
    const LocalIndex u = triangle(t).neighbour[static_cast<std::size_t>(next(at))];
    const LocalIndex a = triangle(t).vertex[static_cast<std::size_t>(next(at))];
    const LocalIndex b = triangle(t).vertex[static_cast<std::size_t>(previous(at))];
    const LocalIndex c = triangle(u).vertex[static_cast<std::size_t>(previous(place_of(triangle(u), v)))];
    if (geometry::orient2d(position(a), position(b), position(c)) > 0 &&
        geometry::orient2d(position(v), position(a), position(c)) >= (degree > 4)) {
      flip(t, next(at));
      for (int side = 0; side < 3; ++side) // t is the ear now
        work_.suspects.push_back({t, side});
      return true;
    }
    t = u;
  }
  return false;
}

/// Cuts off ears of the ring until a triangle is left, in which v lies.
bool PatchMesh::remove(LocalIndex v) {
  for (LocalIndex left = degree(v); left > 3; --left)
    if (!cut_ear(v, left)) {
      work_.suspects.clear();
      return false;
    }
  const LocalIndex t = corner_of(v);
  const int k = place_of(triangle(t), v);
  const LocalIndex u = triangle(t).neighbour[static_cast<std::size_t>(next(k))];
  const LocalIndex w = triangle(t).neighbour[static_cast<std::size_t>(previous(k))];
  const LocalIndex a = triangle(t).vertex[static_cast<std::size_t>(next(k))];
  const LocalIndex b = triangle(t).vertex[static_cast<std::size_t>(previous(k))];
  const LocalIndex c = triangle(u).vertex[static_cast<std::size_t>(previous(place_of(triangle(u), v)))];
  const LocalIndex beyond_t = triangle(t).neighbour[static_cast<std::size_t>(k)];
  const LocalIndex beyond_u = triangle(u).neighbour[static_cast<std::size_t>(place_of(triangle(u), v))];
  const LocalIndex beyond_w = triangle(w).neighbour[static_cast<std::size_t>(place_of(triangle(w), v))];
  changed_.push_back(t);
  triangle(t) = {{a, b, c}, {-1, -1, -1}};
  link(t, 0, beyond_u, u);
  link(t, 1, beyond_w, w);
  link(t, 2, beyond_t, t);
  for (const LocalIndex gone : {u, w}) {
    triangle(gone).vertex[0] = -1;
    unused_.push_back(gone);
  }
  corner_of(a) = corner_of(b) = corner_of(c) = last_ = t;
  corner_of(v) = -1;
  for (int side = 0; side < 3; ++side)
    work_.suspects.push_back({t, side});
  legalize();
  return true;
}

} // namespace trime::cleanup
