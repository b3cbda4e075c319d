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
  void learn_reach(std::size_t stars, std::size_t larger);
  bool prepare(const Group& group, double reach);
  void collect(geometry::Vec2 half);
  geometry::Box box_of(mesh::BinRef bin) const;
  bool meets_missing_bin(int lane) const;
  void take(const Group& group);
  bool prove(LocalIndex site, int lane, int degree);
  void store(LocalIndex site, int lane, int degree);
  double& cap(LocalIndex i) { return caps_[static_cast<std::size_t>(i - first_site_)]; }

  const mesh::BinnedPoints& points_;
  const geometry::Vec2* positions_;
  StarTable& stars_;
  geometry::Lattice lattice_;
  WrapKernel kernel_;
  std::unique_ptr<WrapGroup> group_;

  // Of the tile.
  std::span<double> caps_;
  LocalIndex first_site_ = 0;
  double spacing_ = 0; // the root of the area of a site
  std::vector<LocalIndex> order_, again_;
  std::int64_t changed_ = 0;

  // Of the group.
  geometry::Vec2 center_;
  double scale_ = 1; // a power of two
  std::vector<LocalIndex> candidate_;
  std::vector<mesh::BinRef> missing_;
  std::vector<LocalIndex> old_ring_, long_ring_;
  std::array<double, WrapGroup::most_candidates + 2> near_x_, near_y_;

  // Learnt on the way; none of it can change a star.
  std::size_t level_ = 0;              // of the reach
  double stars_seen_ = 0, larger_ = 0; // stars, and those that needed a longer reach
  int skipped_ = 0;                    // groups that are still left alone since ties were everywhere
  int patience_ = 0;                   // how many were, last time
};

} // namespace trime::delaunay
