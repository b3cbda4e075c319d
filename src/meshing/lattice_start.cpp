// SPDX-License-Identifier: BSD-3-Clause
#include "trime/meshing/start.hpp"

#include "trime/core/thread_loop.hpp"

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Vec2;

constexpr double row_height = 0.8660254037844386; // of the spacing: sqrt(3)/2
constexpr double clearance = 0.45;                // of the spacing: experiments give 0.4 to 0.55 as best

} // namespace

LatticeStart::LatticeStart(const geometry::Boundary& boundary, const BoundaryGuard& guard,
                           const geometry::Lattice& lattice)
    : guard_(guard), lattice_(lattice) {
  const geometry::Box box = boundary.bounding_box();
  origin_ = box.min;
  along_ = {1, 0};
  double longest = 0;
  for (const geometry::Loop& loop : boundary.loops)
    for (const geometry::Piece& piece : loop.pieces)
      if (!piece.circular && geometry::squared_length(piece.end - piece.start) > longest) {
        longest = geometry::squared_length(piece.end - piece.start);
        origin_ = piece.start;
        along_ = (1 / std::sqrt(longest)) * (piece.end - piece.start);
      }
}

/// Visits the lattice sites of one tile, row by row. A site belongs to the tile of its snapped coordinates; rows and
/// columns reach one beyond the tile's box, so rounding cannot lose any.
template <class Visit>
void LatticeStart::for_each_in_tile(const mesh::TileGrid& grid, LocalIndex tile, double spacing,
                                    const Visit& visit) const {
  const geometry::Box box = grid.tile_box(tile);
  const Vec2 across = geometry::left_normal(along_);
  const double height = row_height * spacing;
  double low = INFINITY, high = -INFINITY, left = INFINITY, right = -INFINITY;
  for (const Vec2 corner : {box.min, Vec2{box.max.x, box.min.y}, box.max, Vec2{box.min.x, box.max.y}}) {
    low = std::min(low, geometry::dot(corner - origin_, across));
    high = std::max(high, geometry::dot(corner - origin_, across));
    left = std::min(left, geometry::dot(corner - origin_, along_));
    right = std::max(right, geometry::dot(corner - origin_, along_));
  }
  const auto first_row = static_cast<std::int64_t>(std::floor(low / height)) - 1;
  const auto last_row = static_cast<std::int64_t>(std::ceil(high / height)) + 1;
  const auto first_column = static_cast<std::int64_t>(std::floor(left / spacing)) - 1;
  const auto last_column = static_cast<std::int64_t>(std::ceil(right / spacing)) + 1;
  for (std::int64_t row = first_row; row <= last_row; ++row)
    for (std::int64_t column = first_column; column <= last_column; ++column) {
      const double u = (static_cast<double>(column) + 0.5 * static_cast<double>(row & 1)) * spacing;
      const Vec2 p = lattice_.snap(origin_ + u * along_ + (static_cast<double>(row) * height) * across);
      if (!grid.container().contains(p) || grid.place(p).tile != tile)
        continue;
      const double free = clearance * spacing;
      if (guard_.inside(p) && guard_.distance(p, free) >= free && !guard_.encroaches(p))
        visit(p);
    }
}

std::vector<mesh::Site> LatticeStart::sites(const TileRange& tiles, double spacing) const {
  std::vector<std::vector<mesh::Site>> of_tile(static_cast<std::size_t>(tiles.last - tiles.first));
  thread_loop(tiles.last - tiles.first, 1, [&](std::ptrdiff_t t, int) {
    for_each_in_tile(tiles.grid, tiles.first + static_cast<LocalIndex>(t), spacing,
                     [&](Vec2 p) { of_tile[static_cast<std::size_t>(t)].push_back({p}); });
  });
  std::vector<mesh::Site> all;
  for (const std::vector<mesh::Site>& list : of_tile)
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

std::int64_t LatticeStart::count(const TileRange& tiles, double spacing) const {
  std::vector<std::int64_t> of_tile(static_cast<std::size_t>(tiles.last - tiles.first), 0);
  thread_loop(tiles.last - tiles.first, 1, [&](std::ptrdiff_t t, int) {
    for_each_in_tile(tiles.grid, tiles.first + static_cast<LocalIndex>(t), spacing,
                     [&](Vec2) { ++of_tile[static_cast<std::size_t>(t)]; });
  });
  std::int64_t all = 0;
  for (const std::int64_t n : of_tile)
    all += n;
  return all;
}

} // namespace trime::meshing
