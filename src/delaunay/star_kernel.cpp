// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/star_kernel.hpp"

#include "trime/geometry/predicates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trime::delaunay {
namespace {

using geometry::cross;
using geometry::dot;
using geometry::Vec2;

constexpr double epsilon = 0x1p-53;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t typical_degree = 64; // room reserved; longer rings still work

} // namespace

StarKernel::StarKernel(const geometry::Lattice& lattice, double virtual_distance)
    : lattice_(lattice), virtual_distance_(virtual_distance) {
  ids_.reserve(typical_degree);
  offsets_.reserve(typical_degree);
  vertices_.reserve(typical_degree);
}

/// Circumcentre c = (|a|^2 b - |b|^2 a) turned, over 2 a x b. With the rounding errors of the two sums of products in
/// the numerators (4 eps S) and of the determinant (2 eps D), S and D being the sums of magnitudes, each coordinate of c
/// is exact to (4 eps S / 2 + |c| (2 eps D)) / det plus a few eps |c|; everything is rounded up generously. A determinant
/// of the order of its own error gives a vertex of unknown place: the exact test decides everything about it.
StarKernel::Vertex StarKernel::vertex(Vec2 a, Vec2 b) const {
  const double a2 = dot(a, a), b2 = dot(b, b);
  const double axby = a.x * b.y, aybx = a.y * b.x;
  const double determinant_size = std::fabs(axby) + std::fabs(aybx);
  if (axby - aybx <= 64 * epsilon * determinant_size)
    return {0, 0, infinity, infinity};
  const double half_inverse = 0.5 / (axby - aybx);
  const double x = (a2 * b.y - b2 * a.y) * half_inverse, y = (b2 * a.x - a2 * b.x) * half_inverse;
  const double size = std::fabs(x) + std::fabs(y);
  const double products = a2 * (std::fabs(b.x) + std::fabs(b.y)) + b2 * (std::fabs(a.x) + std::fabs(a.y));
  const double center_error =
      epsilon * (std::fabs(half_inverse) * (5 * products + 5 * determinant_size * size) + 8 * size);
  return {x, y, 2 * center_error + 8 * epsilon * size,
          (x * x + y * y) * (1 + 1e-12) + 4 * center_error * (size + center_error)};
}

bool StarKernel::cut(std::size_t k, Vec2 q, double q2, double q1) const {
  const Vertex& v = vertices_[k];
  const double depth = 2 * (v.x * q.x + v.y * q.y) - q2;
  const double tolerance = v.error * q1 + 8 * epsilon * q1 * q1;
  if (depth > tolerance)
    return true;
  if (depth < -tolerance)
    return false;
  return geometry::in_circle(Vec2{}, offsets_[k], offsets_[next(k)], q, lattice_) > 0;
}

void StarKernel::find_radius() {
  double r2 = 0;
  for (const Vertex& v : vertices_)
    r2 = std::max(r2, v.squared_radius);
  squared_radius_ = r2;
}

void StarKernel::start_virtual() {
  const double d = virtual_distance_;
  ids_ = {-2, -3, -4, -5};
  offsets_ = {{d, 0}, {0, d}, {-d, 0}, {0, -d}};
  vertices_.clear();
  for (std::size_t k = 0; k < 4; ++k)
    vertices_.push_back(vertex(offsets_[k], offsets_[next(k)]));
  find_radius();
}

bool StarKernel::start_ring(std::span<const LocalIndex> ids, std::span<const Vec2> offsets) {
  const std::size_t n = ids.size();
  ids_.assign(ids.begin(), ids.end());
  offsets_.assign(offsets.begin(), offsets.end());
  vertices_.resize(n);
  int turns = 0; // times the ring passes from below the x axis to above it
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 a = offsets_[k], b = offsets_[next(k)];
    if (geometry::orient2d(Vec2{}, a, b) <= 0)
      return false;
    turns += (a.y < 0) && (b.y >= 0);
    vertices_[k] = vertex(a, b);
  }
  if (turns != 1)
    return false;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 q = offsets_[next(next(k))];
    if (cut(k, q, dot(q, q), std::fabs(q.x) + std::fabs(q.y)))
      return false;
  }
  find_radius();
  return true;
}

bool StarKernel::insert(LocalIndex id, Vec2 q) {
  const double q2 = dot(q, q), q1 = std::fabs(q.x) + std::fabs(q.y);
  const std::size_t n = ids_.size();
  std::size_t first = n;
  for (std::size_t k = 0; k < n; ++k)
    if (cut(k, q, q2, q1)) {
      first = k;
      break;
    }
  if (first == n)
    return false;
  // The cut vertices are one run of the ring: extend it both ways.
  std::size_t cuts = 1;
  if (first == 0)
    while (cuts < n && cut(previous(first), q, q2, q1)) {
      first = previous(first);
      ++cuts;
    }
  for (std::size_t k = (first + cuts) % n; cuts < n && cut(k, q, q2, q1); k = next(k))
    ++cuts;
  if (cuts == n)
    return false; // cannot happen in exact arithmetic: a bisector leaves part of a bounded cell
  replace(first, cuts, id, q);
  find_radius();
  return true;
}

/// Puts q between neighbours `first` and first + cuts + 1, whose vertices in between are cut.
void StarKernel::replace(std::size_t first, std::size_t cuts, LocalIndex id, Vec2 q) {
  const std::size_t n = ids_.size();
  if (first + cuts >= n) { // the run wraps around: turn the ring so that it does not
    const std::ptrdiff_t shift = static_cast<std::ptrdiff_t>(first);
    std::rotate(ids_.begin(), ids_.begin() + shift, ids_.end());
    std::rotate(offsets_.begin(), offsets_.begin() + shift, offsets_.end());
    std::rotate(vertices_.begin(), vertices_.begin() + shift, vertices_.end());
    first = 0;
  }
  // Vertices first .. first+cuts-1 go, and with them the neighbours first+1 .. first+cuts-1.
  const std::size_t at = first + 1, removed = cuts - 1;
  if (removed == 0) {
    const std::ptrdiff_t p = static_cast<std::ptrdiff_t>(at);
    ids_.insert(ids_.begin() + p, id);
    offsets_.insert(offsets_.begin() + p, q);
    vertices_.insert(vertices_.begin() + p, Vertex{});
  } else {
    ids_[at] = id;
    offsets_[at] = q;
    const std::ptrdiff_t from = static_cast<std::ptrdiff_t>(at + 1), to = static_cast<std::ptrdiff_t>(at + removed);
    ids_.erase(ids_.begin() + from, ids_.begin() + to);
    offsets_.erase(offsets_.begin() + from, offsets_.begin() + to);
    vertices_.erase(vertices_.begin() + from, vertices_.begin() + to);
  }
  vertices_[first] = vertex(offsets_[first], q);
  vertices_[at] = vertex(q, offsets_[next(at)]);
}

} // namespace trime::delaunay
