// SPDX-License-Identifier: BSD-3-Clause
#include "trime/meshing/start.hpp"

#include "trime/core/thread_loop.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trime::meshing {
namespace {

using geometry::Vec2;

constexpr double row_height = 0.8660254037844386; // of the spacing: sqrt(3)/2
constexpr double clearance = 0.45;                // of the spacing: experiments give 0.4 to 0.55 as best

/// Which bins of a tile have a chord of the boundary within a margin: only there distances need a look.
class NearBins {
public:
  NearBins(const mesh::TileGrid& grid, LocalIndex tile, const BoundaryGuard& guard, double margin)
      : side_(grid.bins_per_side()), near_(static_cast<std::size_t>(side_) * side_, 0) {
    const geometry::Box box = grid.tile_box(tile);
    const double width = box.width() / side_, height = box.height() / side_;
    for (int y = 0; y < side_; ++y)
      for (int x = 0; x < side_; ++x) {
        const Vec2 corner{box.min.x + x * width, box.min.y + y * height};
        // The margin is doubled: rounding in the corners of a bin is far below it.
        const geometry::Box reach{corner - Vec2{2 * margin, 2 * margin},
                                  corner + Vec2{width + 2 * margin, height + 2 * margin}};
        near_[static_cast<std::size_t>(y) * side_ + x] = guard.may_meet_chord(reach) ? 1 : 0;
      }
  }
  bool at(int bin) const { return near_[static_cast<std::size_t>(bin)] != 0; }

private:
  int side_;
  std::vector<std::uint8_t> near_;
};

/// Smallest and largest t with from + t * direction inside the box; empty (first > second) if the line misses it.
std::pair<double, double> clip_line(Vec2 from, Vec2 direction, const geometry::Box& box) {
  double low = -INFINITY, high = INFINITY;
  const auto clip = [&](double start, double slope, double min, double max) {
    if (std::fabs(slope) < 1e-12) {
      if (start < min || start > max)
        low = INFINITY;
      return;
    }
    const double a = (min - start) / slope, b = (max - start) / slope;
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
  };
  clip(from.x, direction.x, box.min.x, box.max.x);
  clip(from.y, direction.y, box.min.y, box.max.y);
  return {low, high};
}

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
/// columns reach a little beyond the tile's box, so rounding cannot lose any.
template <class Visit>
void LatticeStart::for_each_in_tile(const mesh::TileGrid& grid, LocalIndex tile, double spacing,
                                    const Visit& visit) const {
  geometry::Box box = grid.tile_box(tile);
  box = {box.min - Vec2{0.1 * spacing, 0.1 * spacing}, box.max + Vec2{0.1 * spacing, 0.1 * spacing}};
  const Vec2 across = geometry::left_normal(along_);
  const double height = row_height * spacing, free = clearance * spacing;
  double low = INFINITY, high = -INFINITY;
  for (const Vec2 corner : {box.min, Vec2{box.max.x, box.min.y}, box.max, Vec2{box.min.x, box.max.y}}) {
    low = std::min(low, geometry::dot(corner - origin_, across));
    high = std::max(high, geometry::dot(corner - origin_, across));
  }
  const NearBins near(grid, tile, guard_, free);
  const auto last_row = static_cast<std::int64_t>(std::ceil(high / height));
  for (auto row = static_cast<std::int64_t>(std::floor(low / height)); row <= last_row; ++row) {
    const Vec2 start = origin_ + (static_cast<double>(row) * height) * across;
    const double shift = 0.5 * static_cast<double>(row & 1);
    const auto [first, last] = clip_line(start, along_, box);
    if (!(first <= last))
      continue;
    const auto last_column = static_cast<std::int64_t>(std::ceil(last / spacing - shift));
    for (auto column = static_cast<std::int64_t>(std::floor(first / spacing - shift)); column <= last_column;
         ++column) {
      const Vec2 p = lattice_.snap(start + ((static_cast<double>(column) + shift) * spacing) * along_);
      if (!grid.container().contains(p))
        continue;
      const mesh::TileGrid::Place place = grid.place(p);
      if (place.tile != tile || !guard_.inside(p))
        continue;
      if (near.at(place.bin) && (guard_.distance(p, free) < free || guard_.encroaches(p)))
        continue;
      visit(p);
    }
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
