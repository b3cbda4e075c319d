// SPDX-License-Identifier: BSD-3-Clause
// The Voronoi cell of one site while it is being cut: work space of one thread, reused from site to site.
#pragma once

#include "trime/delaunay/star_table.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <span>
#include <vector>

namespace trime::delaunay {

/// @brief Ring of neighbours around the origin (coordinates relative to the site, exact), counter-clockwise, and for each
/// pair of consecutive neighbours the circumcentre with the origin and a bound on its error.
class StarKernel {
public:
  /// @param virtual_distance of the four virtual neighbours, a lattice multiple
  StarKernel(const geometry::Lattice& lattice, double virtual_distance);

  /// Starts with the four virtual neighbours.
  void start_virtual();
  /// @brief Starts with a ring of real neighbours; false if it is no star any more: it does not wind once counter-clockwise,
  /// or is not locally convex. O(degree).
  bool start_ring(std::span<const LocalIndex> ids, std::span<const geometry::Vec2> offsets);
  /// Cuts the cell with a site at `offset`, not the origin and not a member; true if it became a neighbour. O(degree).
  bool insert(LocalIndex id, geometry::Vec2 offset);
  bool contains(LocalIndex id) const {
    for (const LocalIndex member : ids_)
      if (member == id)
        return true;
    return false;
  }

  /// Square of an upper bound of the largest circumradius.
  double squared_radius() const { return squared_radius_; }
  std::size_t degree() const { return ids_.size(); }
  /// Neighbour k: its index (negative: virtual) and offset.
  LocalIndex id(std::size_t k) const { return ids_[k]; }
  geometry::Vec2 offset(std::size_t k) const { return offsets_[k]; }
  /// Squared circumradius of the triangle between neighbours k and k+1, and a bound on its relative error.
  double squared_radius(std::size_t k) const { return vertices_[k].squared_radius; }

private:
  struct Vertex { // circumcentre of the origin and neighbours k, k+1
    double x, y;
    double error;          // |2 c.q - |q|^2| is exact to error * |q|_1 + 8 eps |q|_1^2
    double squared_radius; // upper bound
  };
  Vertex vertex(geometry::Vec2 a, geometry::Vec2 b) const;
  /// Does a site at q lie in the disc of vertex k? Exact.
  bool cut(std::size_t k, geometry::Vec2 q, double q2, double q1) const;
  void find_radius();
  void replace(std::size_t first_cut, std::size_t cuts, LocalIndex id, geometry::Vec2 q);
  std::size_t next(std::size_t k) const { return k + 1 == ids_.size() ? 0 : k + 1; }
  std::size_t previous(std::size_t k) const { return k == 0 ? ids_.size() - 1 : k - 1; }

  geometry::Lattice lattice_;
  double virtual_distance_;
  double squared_radius_ = 0;
  std::vector<LocalIndex> ids_;
  std::vector<geometry::Vec2> offsets_;
  std::vector<Vertex> vertices_;
};

} // namespace trime::delaunay
