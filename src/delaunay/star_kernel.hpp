// SPDX-License-Identifier: BSD-3-Clause
// Computes the Voronoi cell of one site by cutting it with other sites. One thread reuses the object for all its sites.
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
/// of consecutive neighbours it holds the circumcentre of the site and the two, with an error bound.
///
/// All values lie in separate arrays, so that loops over the neighbours have no branches. geometry::in_circle decides
/// cases that floating-point numbers cannot decide.
class StarKernel {
public:
  explicit StarKernel(const geometry::Lattice& lattice, const geometry::Periods& periods = {});

  /// @brief Starts around `center` with four virtual neighbours at `distance` along the axes; virtual neighbours have
  /// negative ids.
  /// @pre `distance` is a multiple of the lattice step
  void start_virtual(geometry::Vec2 center, double distance);
  /// @brief Starts around `center` with at least 3 real neighbours at `positions`. Returns false if they no longer form
  /// a star: they do not wind once counter-clockwise, or are not locally convex. Cost: O(degree).
  bool start_ring(std::span<const LocalIndex> ids, const geometry::Vec2* positions, geometry::Vec2 center);
  /// Cuts the cell with a site at `offset` from its centre. Returns true if the site became a neighbour. Cost:
  /// O(degree).
  /// @pre the site is neither the centre nor a neighbour
  bool insert(LocalIndex id, geometry::Vec2 offset);
  bool contains(LocalIndex id) const {
    bool found = false;
    for (std::size_t k = 0; k < degree_; ++k)
      found |= id_[k] == id;
    return found;
  }

  /// Returns the square of an upper bound on the largest circumradius.
  double squared_radius();
  std::size_t degree() const { return degree_; }
  /// Return the index of neighbour k (negative if it is virtual) and its offset from the centre.
  LocalIndex id(std::size_t k) const { return id_[k]; }
  geometry::Vec2 offset(std::size_t k) const { return {x_[k], y_[k]}; }
  /// Returns an upper bound on the squared circumradius of the triangle of the centre and the neighbours k and k+1.
  double squared_radius(std::size_t k) {
    if (!vertices_known_)
      find_vertices();
    return vertex_r2_[k];
  }
  /// Counts the neighbours whose squared distance from the centre is at most r2.
  std::ptrdiff_t members_within(double r2) const {
    std::ptrdiff_t n = 0;
    for (std::size_t k = 0; k < degree_; ++k)
      n += x_[k] * x_[k] + y_[k] * y_[k] <= r2;
    return n;
  }
  /// Returns the number k of the lexicographically smallest neighbour.
  std::size_t smallest() const;

private:
  void reserve(std::size_t degree);
  /// Computes the circumcentre of the centre and the neighbours k and next.
  void set_vertex(std::size_t k, std::size_t next);
  /// Returns whether the site at q, for which depth_ and tolerance_ were computed, lies in the circumcircle number k.
  /// Exact.
  bool is_cut(std::size_t k, geometry::Vec2 q) const;
  /// Returns whether q lies in the circle through the origin, a and b. Exact; all points are offsets from the centre.
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
  geometry::Periods periods_; // the position of the centre is needed only if the container is periodic
  geometry::Vec2 center_;
  double virtual_distance_ = 0; // distance of the last start_virtual, whose cell has the corner corner_
  geometry::Vec2 corner_;
  double corner_error_ = 0, corner_r2_ = 0;
  double squared_radius_ = -1; // negative if not known
  std::size_t degree_ = 0;
  bool vertices_known_ = false; // circumcentres are computed only when they are needed
  std::vector<LocalIndex> id_;
  std::vector<double> x_, y_; // offsets of the neighbours
  std::vector<double> vertex_x_, vertex_y_;
  std::vector<double> vertex_error_; // 2 c.q - |q|^2 has an error of at most vertex_error |q|_1 + 8 eps |q|_1^2
  std::vector<double> vertex_r2_;
  std::vector<double> depth_,
      tolerance_; // how far the last site lies inside of each circumcircle, and the error of this number
};

} // namespace trime::delaunay
