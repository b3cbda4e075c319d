// SPDX-License-Identifier: BSD-3-Clause
#include "refinement/children.hpp"

#include "geometry/predicates.hpp"
#include "trime/mesh/quality.hpp"

#include <algorithm>

namespace trime::refinement {

using geometry::is_inside_circle;
using geometry::Vec2;

Children::Children(const std::array<Vec2, 3>& corners, const std::array<Vec2, 3>& middles,
                   const geometry::Lattice& lattice)
    : places_{corners[0], corners[1], corners[2], middles[0], middles[1], middles[2]} {
  for (int corner = 0; corner < 3 && turned_ < 0; ++corner)
    if (wants_turn(corner, lattice))
      turned_ = corner;
}

bool Children::is_positive(const Triangle& t) const {
  return geometry::orient2d(at(t[0]), at(t[1]), at(t[2])) > 0;
}

bool Children::wants_turn(int corner, const geometry::Lattice& lattice) const {
  const Code ahead = middle(corner), opposite = middle(corner + 1), back = middle(corner + 2);
  return is_positive({corner, ahead, back}) &&
         is_inside_circle(at(corner), at(ahead), at(back), at(opposite), lattice) &&
         is_positive({corner, ahead, opposite}) && is_positive({corner, opposite, back});
}

std::array<Children::Triangle, 4> Children::triangles() const {
  if (turned_ < 0)
    return {{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
  const int k = turned_, next = (k + 1) % 3, last = (k + 2) % 3;
  return {{{k, middle(k), middle(k + 1)},
           {k, middle(k + 1), middle(k + 2)},
           {middle(k), next, middle(k + 1)},
           {middle(k + 1), last, middle(k + 2)}}};
}

std::array<std::array<Children::Code, 2>, 3> Children::inner_edges() const {
  if (turned_ < 0)
    return {{{3, 4}, {4, 5}, {5, 3}}};
  return {{{turned_, middle(turned_ + 1)},
           {middle(turned_), middle(turned_ + 1)},
           {middle(turned_ + 1), middle(turned_ + 2)}}};
}

Children::Code Children::across(int edge, int half) const {
  if (half == 0)
    return turned_ == edge ? middle(edge + 1) : middle(edge + 2);
  return turned_ == (edge + 1) % 3 ? middle(edge + 2) : middle(edge + 1);
}

bool Children::is_sound(const geometry::Lattice& lattice) const {
  const std::array<Triangle, 4> all = triangles();
  if (!std::ranges::all_of(all, [&](const Triangle& t) { return is_positive(t); }))
    return false;
  const auto is_delaunay = [&](const Triangle& t, Code beyond) {
    return !is_inside_circle(at(t[0]), at(t[1]), at(t[2]), at(beyond), lattice);
  };
  if (turned_ < 0)
    return is_delaunay(all[0], 4) && is_delaunay(all[1], 5) && is_delaunay(all[2], 3);
  return is_delaunay(all[0], middle(turned_ + 2)) && is_delaunay(all[2], turned_) && is_delaunay(all[3], turned_);
}

double Children::alpha() const {
  double largest = 1;
  for (const Triangle& t : triangles())
    largest = std::max(largest, mesh::aspect_ratio(at(t[0]), at(t[1]), at(t[2])));
  return largest;
}

} // namespace trime::refinement
