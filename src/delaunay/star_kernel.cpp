// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/star_kernel.hpp"

#include "delaunay/circumcenter.hpp"
#include "delaunay/rules.hpp"

#include <algorithm>
#include <limits>

namespace trime::delaunay {
namespace {

using geometry::Vec2;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t typical_degree = 64; // room at the start; longer rings make more

} // namespace

StarKernel::StarKernel(const geometry::Lattice& lattice, const geometry::Periods& periods)
    : lattice_(lattice), periods_(periods) {
  reserve(typical_degree);
}

void StarKernel::reserve(std::size_t degree) {
  if (degree + 4 <= x_.size())
    return;
  id_.resize(2 * degree + 4);
  for (std::vector<double>* list :
       {&x_, &y_, &vertex_x_, &vertex_y_, &vertex_error_, &vertex_r2_, &depth_, &tolerance_})
    list->resize(2 * degree + 4);
}

void StarKernel::set_vertex(std::size_t k, std::size_t next) {
  const Vertex v = circumcenter(x_[k], y_[k], x_[next], y_[next]);
  // A vertex that is not sound is left to the exact test, whatever is asked about it.
  vertex_x_[k] = v.sound ? v.x : 0;
  vertex_y_[k] = v.sound ? v.y : 0;
  vertex_error_[k] = v.sound ? v.error : infinity;
  vertex_r2_[k] = v.sound ? v.r2 : infinity;
}

bool StarKernel::is_cut(std::size_t k, Vec2 q) const {
  if (depth_[k] > tolerance_[k])
    return true;
  if (depth_[k] < -tolerance_[k])
    return false;
  return in_disc(offset(k), offset(next(k)), q);
}

double StarKernel::squared_radius() {
  if (squared_radius_ < 0) {
    double r2 = 0;
    for (std::size_t k = 0; k < degree_; ++k)
      r2 = std::max(r2, vertex_r2_[k]);
    squared_radius_ = r2;
  }
  return squared_radius_;
}

std::size_t StarKernel::smallest() const {
  std::size_t best = 0;
  for (std::size_t k = 1; k < degree_; ++k)
    if (x_[k] < x_[best] || (x_[k] == x_[best] && y_[k] < y_[best]))
      best = k;
  return best;
}

void StarKernel::start_virtual(Vec2 center, double distance) {
  center_ = center;
  constexpr std::array<Vec2, 4> direction{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  if (distance != virtual_distance_) {
    const Vertex corner = circumcenter(distance, 0, 0, distance); // the other three are its mirror images
    virtual_distance_ = distance;
    corner_ = {corner.x, corner.y};
    corner_error_ = corner.error;
    corner_r2_ = corner.r2;
  }
  degree_ = 4;
  squared_radius_ = -1;
  vertices_known_ = true;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec2 d = direction[k], next = direction[(k + 1) % 4];
    id_[k] = -2 - static_cast<LocalIndex>(k);
    x_[k] = distance * d.x;
    y_[k] = distance * d.y;
    vertex_x_[k] = corner_.x * (d.x + next.x);
    vertex_y_[k] = corner_.y * (d.y + next.y);
    vertex_error_[k] = corner_error_;
    vertex_r2_[k] = corner_r2_;
  }
}

bool StarKernel::start_ring(std::span<const LocalIndex> ids, const Vec2* positions, Vec2 center) {
  const std::size_t n = ids.size();
  center_ = center;
  reserve(n);
  degree_ = n;
  for (std::size_t k = 0; k < n; ++k) {
    id_[k] = ids[k];
    const Vec2 p = positions[ids[k]];
    x_[k] = p.x - center.x;
    y_[k] = p.y - center.y;
  }
  for (std::size_t k = 0; k < 3; ++k) { // cyclic padding for the loops over pairs
    x_[n + k] = x_[k];
    y_[n + k] = y_[k];
  }
  vertices_known_ = false;
  return is_locally_convex();
}

/// @brief Returns whether every neighbour lies outside the disc of the two before it. If the ring also winds once
/// counter-clockwise, it gives the edges of a convex cell in order.
///
/// For consecutive neighbours a, b, q the determinant (positive: q is outside) is |a|^2 b x q + |b|^2 q x a + |q|^2 a x
/// b. The sum of the magnitudes in it is at most |a|^2 |b|^2 + |b|^2 |q|^2 + |q|^2 |a|^2, because |ux vy| + |uy vx| <=
/// (u^2 + v^2) / 2. The squared circumradius |a|^2 |b|^2 |a - b|^2 / (4 (a x b)^2) has a relative error below 1e-8
/// where a x b is at least ConvexityRules::least_turn of |a|^2 + |b|^2; flatter stars are left to the exact path.
bool StarKernel::is_locally_convex() {
  const std::size_t n = degree_;
  Mask2 bad{0, 0}, undecided{0, 0};
  Double2 largest = both(0);
  for (std::size_t k = 0; k < n; k += 2) { // for odd n the last pair repeats the first neighbour
    const Double2 ax = load2(&x_[k]), bx = load2(&x_[k + 1]), qx = load2(&x_[k + 2]);
    const Double2 ay = load2(&y_[k]), by = load2(&y_[k + 1]), qy = load2(&y_[k + 2]);
    const Double2 a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, q2 = qx * qx + qy * qy;
    const Double2 ab = ax * by - ay * bx, bq = bx * qy - by * qx, qa = qx * ay - qy * ax;
    const Double2 determinant = a2 * bq + b2 * qa + q2 * ab;
    const Double2 magnitude = a2 * b2 + b2 * q2 + q2 * a2;
    undecided |= ~(determinant > both(ConvexityRules::error) * magnitude);
    bad |= ~(ab > both(ConvexityRules::least_turn) * (a2 + b2));
    const Double2 ex = ax - bx, ey = ay - by;
    largest = max2(largest, a2 * b2 * (ex * ex + ey * ey) / (both(4) * ab * ab));
  }
  int turns = 0;
  for (std::size_t k = 0; k < n; ++k)
    turns += static_cast<int>(y_[k] < 0 && y_[k + 1] >= 0);
  if (any(bad) || turns != 1)
    return false;
  squared_radius_ = std::max(largest[0], largest[1]) * (1 + 1e-7);
  if (any(undecided))
    for (std::size_t k = 0; k < n; ++k)
      if (in_disc(offset(k), offset(next(k)), {x_[k + 2], y_[k + 2]}))
        return false;
  return true;
}

void StarKernel::find_vertices() {
  for (std::size_t k = 0; k < degree_; ++k)
    set_vertex(k, next(k));
  vertices_known_ = true;
}

bool StarKernel::insert(LocalIndex id, Vec2 q) {
  const double q2 = geometry::dot(q, q), q1 = std::fabs(q.x) + std::fabs(q.y);
  if (!vertices_known_)
    find_vertices();
  const std::size_t n = degree_;
  bool possible = false;
  for (std::size_t k = 0; k < n; ++k) {
    depth_[k] = 2 * (vertex_x_[k] * q.x + vertex_y_[k] * q.y) - q2;
    tolerance_[k] = vertex_error_[k] * q1 + 8 * epsilon * q1 * q1;
    possible |= !(depth_[k] < -tolerance_[k]);
  }
  if (!possible)
    return false;
  std::size_t first = 0;
  while (first < n && !is_cut(first, q))
    ++first;
  if (first == n)
    return false;
  // The cut vertices are one run of the ring: extend it both ways.
  std::size_t cuts = 1;
  if (first == 0)
    while (cuts < n && is_cut(previous(first), q)) {
      first = previous(first);
      ++cuts;
    }
  for (std::size_t k = (first + cuts) % n; cuts < n && is_cut(k, q); k = next(k))
    ++cuts;
  if (cuts == n)
    return false; // impossible in exact arithmetic: a bisector leaves part of a bounded cell
  replace(first, cuts, id, q);
  squared_radius_ = -1;
  return true;
}

/// Moves `count` neighbours with their vertices from place `from` to place `to`.
void StarKernel::shift(std::size_t from, std::size_t to, std::size_t count) {
  const auto copy = [&](std::size_t k) {
    id_[to + k] = id_[from + k];
    x_[to + k] = x_[from + k];
    y_[to + k] = y_[from + k];
    vertex_x_[to + k] = vertex_x_[from + k];
    vertex_y_[to + k] = vertex_y_[from + k];
    vertex_error_[to + k] = vertex_error_[from + k];
    vertex_r2_[to + k] = vertex_r2_[from + k];
  };
  if (to < from)
    for (std::size_t k = 0; k < count; ++k)
      copy(k);
  else if (to > from)
    for (std::size_t k = count; k-- > 0;)
      copy(k);
}

/// Puts q between neighbours `first` and first + cuts + 1 (cyclic); the vertices first .. first + cuts - 1 go, and with
/// them the neighbours first + 1 .. first + cuts - 1.
void StarKernel::replace(std::size_t first, std::size_t cuts, LocalIndex id, Vec2 q) {
  reserve(degree_ + 1);
  std::size_t at = first + 1; // place of q
  if (first + cuts <= degree_) {
    const std::size_t tail = degree_ - (first + cuts);
    shift(first + cuts, first + 2, tail);
    degree_ = first + 2 + tail;
  } else { // neighbours 0 .. m-1 go too: what stays, m .. first, moves to the front
    const std::size_t m = first + cuts - degree_;
    shift(m, 0, first + 1 - m);
    at = first + 1 - m;
    degree_ = at + 1;
  }
  id_[at] = id;
  x_[at] = q.x;
  y_[at] = q.y;
  set_vertex(at - 1, at);
  set_vertex(at, next(at));
}

} // namespace trime::delaunay
