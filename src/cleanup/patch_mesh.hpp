// SPDX-License-Identifier: BSD-3-Clause
// A small Delaunay triangulation on one thread: the surroundings of a bad triangle, in which changes are tried.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief A Delaunay triangulation of points of the coordinate lattice inside a square frame with four virtual vertices
/// (0 to 3; points have numbers from 4). Exact: it uses the same predicates as the Delaunay stars, and the same rule
/// for cocircular points. So away from the frame its triangles are those of the whole mesh.
///
/// Points are inserted by the method of Bowyer (1981) and Watson (1981) and removed by flips. If a point moves, edges
/// around it are flipped (Lawson 1977). The data are plain arrays, because each trial works on a copy.
class PatchMesh {
public:
  static constexpr LocalIndex frame = 4; ///< number of vertices before the first point
  struct Triangle {
    std::array<LocalIndex, 3> vertex;    ///< counter-clockwise; vertex[0] < 0 if the triangle is not in use
    std::array<LocalIndex, 3> neighbour; ///< triangle across the edge opposite each vertex, -1 outside the frame
  };

  PatchMesh(const geometry::Lattice& lattice, const geometry::Periods& periods)
      : lattice_(lattice), periods_(periods) {}

  /// Empties the mesh and puts the frame on the corners of the square around `center`. @pre `half_width` is a multiple
  /// of the step of the coordinate lattice
  void start(geometry::Vec2 center, double half_width);
  /// Adds a point without triangles; connect_all() must be called before any other function. @pre no other point lies
  /// at p
  LocalIndex append(geometry::Vec2 p);
  /// Inserts all points that were appended since start(), in their order along a Hilbert curve.
  void connect_all();
  /// @brief Adds a point inside the frame. @return its vertex, or -1 if a vertex lies there already. Takes about 0.5
  /// microseconds if p is near the point before.
  LocalIndex insert(geometry::Vec2 p);
  /// Removes vertex v. @pre v is not a vertex of the frame
  /// @return false if the removal fails; then the mesh can no longer be used
  bool remove(LocalIndex v);
  /// Moves vertex v. @return false, without any change, if a triangle around v would be inverted
  bool move(LocalIndex v, geometry::Vec2 to);
  /// @brief Moves vertex v within its star without flips; restore() must be called afterwards. @pre no triangle around
  /// v is inverted
  void shift(LocalIndex v, geometry::Vec2 to) { positions_[static_cast<std::size_t>(v)] = to; }
  /// Flips edges around vertices that were shifted until the triangulation is Delaunay again. @param shifted all
  /// vertices that were shifted
  void restore(std::span<const LocalIndex> shifted);
  /// Removes vertex v and inserts it at another place, which may lie beyond triangles without area. @pre no vertex lies
  /// at `to`
  /// @return false if that fails; then the mesh can no longer be used
  bool replace(LocalIndex v, geometry::Vec2 to);

  LocalIndex vertices() const { return static_cast<LocalIndex>(positions_.size()); }
  geometry::Vec2 position(LocalIndex v) const { return positions_[static_cast<std::size_t>(v)]; }
  std::span<const Triangle> triangles() const { return triangles_; }
  /// Returns the existing triangles whose vertices have changed since the last call of forget_changes(), in any order;
  /// a triangle may appear several times.
  std::span<const LocalIndex> changed() const { return changed_; }
  void forget_changes() { changed_.clear(); }
  /// Replaces the content of `ring` by the neighbours of v, counter-clockwise.
  void collect_ring(LocalIndex v, std::vector<LocalIndex>& ring) const;
  LocalIndex degree(LocalIndex v) const;
  /// The vertices opposite an edge, on its left and on its right; -1 outside the frame.
  struct Apexes {
    LocalIndex left, right;
  };
  /// Returns the apexes of an edge, or nothing if the two vertices are not neighbours.
  std::optional<Apexes> apexes(LocalIndex from, LocalIndex to) const;

private:
  struct Side { // the edge of triangle t opposite the vertex with number k
    LocalIndex t;
    int k;
  };
  struct Rim { // an edge of a cavity, and the triangle outside the cavity at this edge
    LocalIndex from, to, outside, created;
  };
  Triangle& triangle(LocalIndex t) { return triangles_[static_cast<std::size_t>(t)]; }
  const Triangle& triangle(LocalIndex t) const { return triangles_[static_cast<std::size_t>(t)]; }
  LocalIndex& corner_of(LocalIndex v) { return corner_of_[static_cast<std::size_t>(v)]; }
  LocalIndex locate(geometry::Vec2 p) const;
  bool disc_holds(LocalIndex t, geometry::Vec2 p) const;
  void open_cavity(LocalIndex t, geometry::Vec2 p);
  void close_cavity(LocalIndex v);
  LocalIndex new_triangle();
  void link(LocalIndex t, int k, LocalIndex other, LocalIndex old);
  void flip(LocalIndex t, int k);
  bool place(LocalIndex v);
  bool cut_ear(LocalIndex v, LocalIndex degree);
  void legalize();

  geometry::Lattice lattice_;
  geometry::Periods periods_;
  std::vector<geometry::Vec2> positions_;
  std::vector<LocalIndex> corner_of_; // one triangle of each vertex
  std::vector<Triangle> triangles_;
  std::vector<LocalIndex> unused_;
  LocalIndex last_ = 0;             // triangle with which the next search begins
  std::vector<LocalIndex> changed_; // triangles whose vertices have changed
  struct OnCurve {
    std::uint32_t key;
    LocalIndex vertex;
  };
  struct WorkSpace { // a copy of the mesh gets an empty work space
    WorkSpace() = default;
    WorkSpace(const WorkSpace&) {}
    WorkSpace& operator=(const WorkSpace&) { return *this; }
    ~WorkSpace() = default;
    std::vector<OnCurve> on_curve;
    std::vector<LocalIndex> cavity;
    std::vector<Rim> rim;
    std::vector<Side> suspects;
    std::vector<std::uint8_t> is_shifted; // by vertex; all are 0 between calls
    std::vector<LocalIndex> ring;
  };
  WorkSpace work_;
};

} // namespace trime::cleanup
