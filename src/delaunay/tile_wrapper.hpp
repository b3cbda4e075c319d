// SPDX-License-Identifier: BSD-3-Clause
// Stars of many sites of a tile at once: groups of sites that lie together share their candidates (wrap.hpp).
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

/// Chooses the first of three reaches: the one that most stars need, from what the last ones needed.
class ReachChoice {
public:
  /// 0, 1 or 2, longer ones last.
  std::size_t level() const { return level_; }
  /// @param stars that were computed @param larger those of them that needed a longer reach
  void learn(std::size_t stars, std::size_t larger);

private:
  std::size_t level_ = 0;
  double stars_ = 0, larger_ = 0; // since the last change
};

/// Where ties are everywhere, as in a lattice, groups are left alone for a while: longer each time.
class TiePause {
public:
  /// Is the next group left alone? It is counted.
  bool skips_group();
  /// @param stars that were computed @param undecided those of them that float32 did not decide
  void learn(std::size_t stars, std::size_t undecided);

private:
  int left_ = 0; // groups that are still left alone
  int last_ = 0; // how many were, last time
};

/// The caps of the stars of a tile that are to be computed; 0: not wanted, or done.
struct WantedStars {
  std::span<double> caps; ///< of the sites of the tile
  LocalIndex first = 0;   ///< site of the tile

  double& cap(LocalIndex i) const { return caps[static_cast<std::size_t>(i - first)]; }
};

/// Work space of one thread.
class TileWrapper {
public:
  TileWrapper(const mesh::BinnedPoints& points, StarTable& stars, const geometry::Lattice& lattice, SimdLevel level);

  /// @brief Computes and stores the stars of sites of a tile, as far as they can be proven; makes them certain.
  /// @param caps for each site of the tile the cap of its star, 0: not wanted; becomes 0 where the star is done
  /// @return number of stars that are not what they were
  std::int64_t compute(LocalIndex tile, std::span<double> caps);

private:
  /// Sites that lie together, and the box that holds them.
  struct Group {
    std::size_t begin, end; // in order_
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

  // Data of the current tile.
  WantedStars wanted_;
  double spacing_ = 0; // the root of the area of a site
  std::vector<LocalIndex> order_, again_;
  std::int64_t changed_ = 0;

  // Data of the current group.
  geometry::Vec2 center_;
  double scale_ = 1; // a power of two
  std::vector<LocalIndex> candidate_;
  std::vector<mesh::BinRef> missing_;
  struct {
    std::vector<LocalIndex> before, now;
  } rings_; // of a star with more neighbours than StarTable has slots
  struct {
    std::array<double, WrapGroup::most_candidates + 2> x, y;
  } near_; // candidates that may lie in a disc of a star, from its site

  // Learnt on the way; none of it can change a star.
  ReachChoice reach_;
  TiePause ties_;
};

} // namespace trime::delaunay
