// SPDX-License-Identifier: BSD-3-Clause
// Computes the stars of many sites of a tile at once. Groups of nearby sites share the sites that may be their
// neighbours (see wrap.hpp).
#pragma once

#include "delaunay/star_table.hpp"
#include "delaunay/wrap.hpp"
#include "mesh/binned_points.hpp"
#include "trime/geometry/lattice.hpp"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace trime::delaunay {

/// Chooses at which of three distances a search begins: the one that was enough for most of the last stars.
class ReachChoice {
public:
  /// Returns the number of the distance: 0, 1 or 2, ascending.
  std::size_t level() const { return level_; }
  /// Counts the result of a search.
  /// @param stars number of computed stars
  /// @param larger how many of them needed a longer distance
  void learn(std::size_t stars, std::size_t larger);

private:
  std::size_t level_ = 0;
  double stars_ = 0, larger_ = 0; // counts since the last change of the level
};

/// Skips groups of sites for a while if almost all of their stars have ties, as in a regular lattice. The pause becomes
/// longer each time.
class TiePause {
public:
  /// Returns whether the next group is skipped, and counts this group.
  bool skips_group();
  /// Counts the result of a group.
  /// @param stars number of computed stars
  /// @param undecided how many of them float32 could not decide
  void learn(std::size_t stars, std::size_t undecided);

private:
  int left_ = 0; // groups that are still to be skipped
  int last_ = 0; // length of the last pause
};

/// The largest circumradius (cap) in each wanted star of a tile; 0 for stars that are not wanted or already done.
struct WantedStars {
  std::span<double> caps; ///< cap of each site of the tile
  LocalIndex first = 0;   ///< first site of the tile

  double& cap(LocalIndex i) const { return caps[static_cast<std::size_t>(i - first)]; }
};

/// Computes stars on one thread, and holds the work space for that.
class TileWrapper {
public:
  TileWrapper(const mesh::BinnedPoints& points, StarTable& stars, const geometry::Lattice& lattice, SimdLevel level);

  /// @brief Computes the stars of sites of a tile. Stores the stars that it can prove to be right, and marks them as
  /// certain.
  /// @param caps cap of the star of each site of the tile; 0 for stars that are not wanted. Becomes 0 when a star is
  /// done
  /// @return number of stars that have changed
  std::int64_t compute(LocalIndex tile, std::span<double> caps);

private:
  /// Some nearby sites, and their bounding box.
  struct Group {
    std::size_t begin, end; // range of indices into order_
    geometry::Box box;
  };

  void order_sites(LocalIndex tile);
  void append_column(LocalIndex tile, int column, int first_row, int last_row, bool backwards);
  Group next_group(std::size_t begin) const;
  void wrap_groups(double reach);
  bool pays(const Group& group) const;
  bool prepare(const Group& group, double reach);
  void collect(geometry::Vec2 half);
  geometry::Box box_of(mesh::BinRef bin) const;
  bool meets_missing_bin(int lane) const;
  void take(const Group& group);
  bool prove(LocalIndex site, int lane, int degree);
  void store(LocalIndex site, int lane, int degree);

  const mesh::BinnedPoints& points_;
  const geometry::Vec2* positions_;
  StarTable& stars_;
  geometry::Lattice lattice_;
  WrapKernel kernel_;
  std::unique_ptr<WrapGroup> group_;

  // The data of the current tile.
  WantedStars wanted_;
  double spacing_ = 0; // square root of the area per site
  std::vector<LocalIndex> order_, again_;
  std::int64_t changed_ = 0;

  // The data of the current group of sites.
  geometry::Vec2 center_;
  double scale_ = 1; // a power of two
  std::vector<LocalIndex> candidate_;
  std::vector<mesh::BinRef> missing_;
  struct {
    std::vector<LocalIndex> before, now;
  } rings_; // buffers for rings with more neighbours than StarTable has slots
  struct {
    std::array<double, WrapGroup::most_candidates + 2> x, y;
  } near_; // sites that may lie in a circumcircle of a star, relative to the star's site

  // Choices that adapt to earlier results. These choices change only the computing time, never a star.
  ReachChoice reach_;
  TiePause ties_;
};

} // namespace trime::delaunay
