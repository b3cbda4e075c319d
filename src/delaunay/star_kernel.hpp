// SPDX-License-Identifier: BSD-3-Clause
// The Voronoi cell of one site while it is cut. One thread reuses the object for all its sites.
#pragma once

#include "delaunay/star_table.hpp"
#include "geometry/predicates.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace trime::delaunay {

/// @brief Holds the neighbours of a site counter-clockwise, with exact coordinates relative to the site. For each pair
/// of consecutive neighbours it holds their circumcentre with the site and a bound on its error.
///
/// All values lie in separate arrays, so that loops over the ring have no branches. geometry::in_circle decides the
/// remaining cases.
class StarKernel {
public:
  explicit StarKernel(const geometry::Lattice& lattice, const geometry::Periods& periods = {});

  /// @brief Starts around `center` with four virtual neighbours at `distance` along the axes; their ids are negative.
  /// @pre `distance` is a multiple of the lattice step
  void start_virtual(geometry::Vec2 center, double distance);
  /// @brief Starts with a ring of at least 3 real neighbours at `positions`, around `center`. Returns false if they are
  /// no longer a star: they do not wind once counter-clockwise, or are not locally convex. O(degree).
  bool start_ring(std::span<const LocalIndex> ids, const geometry::Vec2* positions, geometry::Vec2 center);
  /// Cuts the cell with a site at `offset`. Returns true if the site became a neighbour. O(degree). @pre the site is
  /// not the origin and not a neighbour
  bool insert(LocalIndex id, geometry::Vec2 offset);
  bool contains(LocalIndex id) const {
    bool found = false;
    for (std::size_t k = 0; k < degree_; ++k)
      found |= id_[k] == id;
    return found;
  }

  /// Returns the square of an upper bound of the largest circumradius.
  double squared_radius();
  std::size_t degree() const { return degree_; }
  /// Index (negative if virtual) and offset of neighbour k.
  LocalIndex id(std::size_t k) const { return id_[k]; }
  geometry::Vec2 offset(std::size_t k) const { return {x_[k], y_[k]}; }
  /// Returns an upper bound of the squared circumradius of the triangle between neighbours k and k+1.
  double squared_radius(std::size_t k) {
    if (!vertices_known_)
      find_vertices();
    return vertex_r2_[k];
  }
  /// Counts the neighbours at squared distance at most r2.
  std::ptrdiff_t members_within(double r2) const {
    std::ptrdiff_t n = 0;
    for (std::size_t k = 0; k < degree_; ++k)
      n += x_[k] * x_[k] + y_[k] * y_[k] <= r2;
    return n;
  }
  /// Returns the number of the lexicographically smallest neighbour.
  std::size_t smallest() const;

private:
  void reserve(std::size_t degree);
  /// Computes the circumcentre between neighbours k and next.
  void set_vertex(std::size_t k, std::size_t next);
  /// Returns whether the site at q, for which depth_ and tolerance_ were computed, lies in the disc of vertex k. Exact.
  bool is_cut(std::size_t k, geometry::Vec2 q) const;
  /// Returns whether q lies in the disc through the origin, a and b. Exact; all points are offsets.
  bool in_disc(geometry::Vec2 a, geometry::Vec2 b, geometry::Vec2 q) const {
    if (!periods_.any())
      return geometry::in_circle(geometry::Vec2{}, a, b, q, lattice_) > 0;
    return geometry::in_circle(center_, center_ + a, center_ + b, center_ + q, lattice_, periods_) > 0;
  }
  bool is_locally_convex();
  void find_vertices();
  void replace(std::size_t first_cut, std::size_t cuts, LocalIndex id, geometry::Vec2 q);
  void shift(std::size_t from, std::size_t to, std::size_t count);
  std::size_t next(std::size_t k) const { return k + 1 == degree_ ? 0 : k + 1; }
  std::size_t previous(std::size_t k) const { return k == 0 ? degree_ - 1 : k - 1; }

  geometry::Lattice lattice_;
  geometry::Periods periods_; // only periods need the place of the center
  geometry::Vec2 center_;
  double virtual_distance_ = 0; // distance of the last start_virtual, whose cell has corner_
  geometry::Vec2 corner_;
  double corner_error_ = 0, corner_r2_ = 0;
  double squared_radius_ = -1; // negative if not known
  std::size_t degree_ = 0;
  bool vertices_known_ = false; // a ring that is only checked needs no vertices
  std::vector<LocalIndex> id_;
  std::vector<double> x_, y_; // neighbours
  std::vector<double> vertex_x_, vertex_y_;
  std::vector<double> vertex_error_; // 2 c.q - |q|^2 is known to vertex_error |q|_1 + 8 eps |q|_1^2
  std::vector<double> vertex_r2_;
  std::vector<double> depth_,
      tolerance_; // depth of the last site in the disc of each vertex, and the error of the depth
};

} // namespace trime::delaunay
