// SPDX-License-Identifier: BSD-3-Clause
// A small Delaunay triangulation of one thread: the surroundings of a bad triangle, on which changes are tried.
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

/// @brief Delaunay triangulation of lattice points inside a square frame of four virtual vertices (0 to 3; points
/// count from 4). Exact: the predicates and the tie rule of the stars, so whatever lies clear of the frame is what the
/// stars of the whole mesh find.
///
/// Points come by insertion (Bowyer 1981, Watson 1981), go by flips, and move with the edges around them flipped back
/// (Lawson 1977). Plain arrays: copying a mesh is how a trial is taken back.
class PatchMesh {
public:
  static constexpr LocalIndex frame = 4; ///< vertices before the first point
  struct Triangle {
    std::array<LocalIndex, 3> vertex;    ///< counter-clockwise; vertex[0] < 0: not in use
    std::array<LocalIndex, 3> neighbour; ///< across the edge opposite of each vertex, -1 outside of the frame
  };

  PatchMesh(const geometry::Lattice& lattice, const geometry::Periods& periods)
      : lattice_(lattice), periods_(periods) {}

  /// Empties the mesh and puts the frame at the corners of the square around `center`, `half_width` being a lattice
  /// multiple.
  void start(geometry::Vec2 center, double half_width);
  /// Adds a point without triangles; no other lies there. connect_all must follow before anything else.
  LocalIndex append(geometry::Vec2 p);
  /// Inserts the points that have been appended since start, along a Hilbert curve.
  void connect_all();
  /// @brief Adds a point inside the frame. @return its vertex, or -1 if a vertex lies there already. About 0.5
  /// microseconds near the last one.
  LocalIndex insert(geometry::Vec2 p);
  /// Removes vertex v, not one of the frame.
  /// @return false if it cannot be done; then the mesh can no longer be used
  bool remove(LocalIndex v);
  /// Moves vertex v. @return false, and nothing is done, if a triangle around v would turn over
  bool move(LocalIndex v, geometry::Vec2 to);
  /// @brief Puts vertex v elsewhere within its star and leaves the edges as they are: restore must follow.
  /// @pre no triangle around v turns over
  void shift(LocalIndex v, geometry::Vec2 to) { positions_[static_cast<std::size_t>(v)] = to; }
  /// Flips edges around these vertices, all that have been shifted, until the triangulation is Delaunay again.
  void restore(std::span<const LocalIndex> shifted);
  /// Takes vertex v out and puts it in again elsewhere, where no vertex is: also past triangles of no area.
  /// @return false if it cannot be done; then the mesh can no longer be used
  bool replace(LocalIndex v, geometry::Vec2 to);

  LocalIndex vertices() const { return static_cast<LocalIndex>(positions_.size()); }
  geometry::Vec2 position(LocalIndex v) const { return positions_[static_cast<std::size_t>(v)]; }
  std::span<const Triangle> triangles() const { return triangles_; }
  /// Returns the triangles that got vertices since the last call of forget_changes, in any order, some several times;
  /// without those that have gone.
  std::span<const LocalIndex> changed() const { return changed_; }
  void forget_changes() { changed_.clear(); }
  /// The neighbours of v, counter-clockwise, replacing the content of `ring`.
  void collect_ring(LocalIndex v, std::vector<LocalIndex>& ring) const;
  LocalIndex degree(LocalIndex v) const;
  /// The vertices opposite of the edge between two vertices: left of the way, and right of it (-1 beyond the frame).
  struct Apexes {
    LocalIndex left, right;
  };
  /// Nothing if the two are no neighbours.
  std::optional<Apexes> apexes(LocalIndex from, LocalIndex to) const;

private:
  struct Side { // the edge of triangle t opposite of its vertex k
    LocalIndex t;
    int k;
  };
  struct Rim { // of a cavity: an edge and the triangle beyond
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
  std::vector<LocalIndex> corner_of_; // of each vertex a triangle that has it
  std::vector<Triangle> triangles_;
  std::vector<LocalIndex> unused_;
  LocalIndex last_ = 0;             // where the next search begins
  std::vector<LocalIndex> changed_; // triangles
  struct OnCurve {
    std::uint32_t key;
    LocalIndex vertex;
  };
  struct WorkSpace { // nothing of it is worth a copy
    WorkSpace() = default;
    WorkSpace(const WorkSpace&) {}
    WorkSpace& operator=(const WorkSpace&) { return *this; }
    ~WorkSpace() = default;
    std::vector<OnCurve> on_curve;
    std::vector<LocalIndex> cavity;
    std::vector<Rim> rim;
    std::vector<Side> suspects;
    std::vector<std::uint8_t> is_shifted; // by vertex, all 0 between calls
    std::vector<LocalIndex> ring;
  };
  WorkSpace work_;
};

} // namespace trime::cleanup
