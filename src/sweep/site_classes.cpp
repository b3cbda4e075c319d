// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/site_classes.hpp"

#include "core/thread_loop.hpp"
#include "trime/core/error.hpp"

#include <algorithm>

namespace trime::sweep {

TilesAround::TilesAround(const mesh::BinnedPoints& points) {
  const mesh::TileGrid& grid = points.grid();
  const LocalIndex owned = points.last_tile() - points.first_tile();
  places_.assign(at(owned), TilePlace::inner);
  narrowest_.assign(at(owned), 0);
  first_.push_back(0);
  for (LocalIndex t = 0; t < owned; ++t) {
    const LocalIndex tile = points.first_tile() + t;
    double& narrowest = narrowest_[at(t)] = grid.side_of(tile);
    const mesh::FixedRect rect = mesh::common_part(rect_of(grid.tile(tile)).grown(1), grid.limits());
    grid.for_each_in(rect, [&](LocalIndex number, int, const mesh::FixedRect&) {
      const LocalIndex other = points.known_tile(number);
      TRIME_ASSERT(other >= 0, "no bin of tile {} is known, but it lies next to tile {}", number, tile);
      if (other >= owned)
        places_[at(t)] = TilePlace::at_border;
      tiles_.push_back(other);
      narrowest = std::min(narrowest, grid.side_of(number));
    });
    first_.push_back(tiles_.size());
  }
}

namespace {

using geometry::Vec2;

} // namespace

void SiteClasses::reset() {
  const mesh::BinnedPoints& points = state_.points();
  classes_.resize(at(points.owned()));
  around_ = TilesAround(points);
  thread_loop(static_cast<std::ptrdiff_t>(around_.size()), 4, [&](std::ptrdiff_t t, int) {
    const LocalIndex tile = points.first_tile() + static_cast<LocalIndex>(t);
    const auto [begin, end] = points.tile_range(tile);
    for (LocalIndex i = begin; i < end; ++i)
      classes_[at(i)] = class_of(i, tile);
  });
  find_encroached_tiles();
}

SiteClass SiteClasses::update(LocalIndex i, LocalIndex tile) {
  return classes_[at(i)] = class_of(i, tile);
}

/// Does the star of a neighbour hold both triangles at its edge to site i? It does not if it was lost when sites were
/// sorted, nor if they exceed its cap, which may be lower than that of i. A site that comes into such a triangle may
/// then change the star of i alone.
bool SiteClasses::vouches_for(LocalIndex neighbour, LocalIndex i) const {
  const delaunay::StarTable& stars = state_.stars();
  if (!stars.has_gap(neighbour))
    return stars.degrees()[neighbour] > 0;
  const std::span<const LocalIndex> ring = stars.ring(neighbour);
  const auto found = std::find(ring.begin(), ring.end(), i);
  return found != ring.end() && *(found == ring.begin() ? ring.end() - 1 : found - 1) != delaunay::gap &&
         *(found + 1 == ring.end() ? ring.begin() : found + 1) != delaunay::gap;
}

/// Does the same for a ghost. Its owner keeps its star, with the triangles that count there.
bool SiteClasses::owner_vouches_for(LocalIndex ghost, LocalIndex i) const {
  const mesh::BinnedPoints& points = state_.points();
  const std::span<const LocalIndex> ring = state_.stars().ring(i);
  const auto found = std::find(ring.begin(), ring.end(), ghost);
  const LocalIndex before = *(found == ring.begin() ? ring.end() - 1 : found - 1),
                   after = *(found + 1 == ring.end() ? ring.begin() : found + 1);
  const double cap = builder_.cap(state_.sizes()[ghost]);
  const Vec2 p = points.position(i), q = points.position(ghost);
  const auto counts = [&](LocalIndex corner) {
    return corner != delaunay::gap && delaunay::StarBuilder::counts(p, q, points.position(corner), cap);
  };
  return counts(before) && counts(after);
}

/// Does the lemma do for the star of site i? Ghosts hold still only while the tiles at the border are swept.
SiteClass SiteClasses::class_of(LocalIndex i, LocalIndex tile) const {
  const mesh::BinnedPoints& points = state_.points();
  if (const std::int32_t boundary = points.boundary(i); boundary != mesh::free_site)
    return boundary >= 0 ? SiteClass::held : SiteClass::fixed;
  const std::span<const LocalIndex> ring = state_.stars().ring(i);
  if (reach_ == LemmaReach::nowhere || ring.size() < 3 || ring.size() > delaunay::StarTable::slots)
    return SiteClass::exact;
  const bool may_see_ghosts =
      around_.place(at(tile - points.first_tile())) == TilePlace::at_border && !state_.grid().periods().any();
  bool beside_boundary = false;
  for (const LocalIndex neighbour : ring) {
    const bool is_ghost = neighbour >= points.owned();
    if (neighbour == delaunay::gap || (is_ghost && !may_see_ghosts))
      return SiteClass::exact;
    if (points.boundary(neighbour) >= 0)
      beside_boundary = true;
    else if (is_ghost ? !owner_vouches_for(neighbour, i) : !vouches_for(neighbour, i))
      return SiteClass::exact;
  }
  return !beside_boundary ? SiteClass::local : may_be_bordered(i, tile) ? SiteClass::bordered : SiteClass::exact;
}

/// Two boundary sites in a row must be the ends of a chord: other edges between boundary sites have no star at either
/// end that would vouch for them.
bool SiteClasses::may_be_bordered(LocalIndex i, LocalIndex tile) const {
  const mesh::BinnedPoints& points = state_.points();
  if (reach_ != LemmaReach::up_to_chords || state_.grid().periods().any())
    return false;
  const std::span<const LocalIndex> ring = state_.stars().ring(i);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const LocalIndex a = ring[k], b = ring[k + 1 == ring.size() ? 0 : k + 1];
    if (points.boundary(a) >= 0 && points.boundary(b) >= 0 && !is_chord_within_reach(a, b, tile))
      return false;
  }
  return true;
}

/// Are these sites the ends of a chord with its inside on the left, whose disc no site from beyond the tiles around can
/// reach before the next sorting?
bool SiteClasses::is_chord_within_reach(LocalIndex from, LocalIndex to, LocalIndex tile) const {
  const mesh::BinnedPoints& points = state_.points();
  const geometry::Segment& chord = context_.guard.chords().segments()[points.boundary(from)];
  const Vec2 a = points.position(from), b = points.position(to), middle = 0.5 * (a + b);
  if (chord.a != a || chord.b != b)
    return false;
  const geometry::Box box = state_.grid().tile_box(tile);
  const double reach = (1 - SweepRules::drift_in_tiles) * around_.narrowest(at(tile - points.first_tile())) -
                       0.5 * geometry::length(b - a);
  return middle.x > box.min.x - reach && middle.x < box.max.x + reach && middle.y > box.min.y - reach &&
         middle.y < box.max.y + reach;
}

void SiteClasses::find_encroached_tiles() {
  const mesh::BinnedPoints& points = state_.points();
  encroached_.assign(around_.size(), 0);
  if (reach_ != LemmaReach::up_to_chords)
    return;
  thread_loop(static_cast<std::ptrdiff_t>(encroached_.size()), 4, [&](std::ptrdiff_t t, int) {
    const auto [begin, end] = points.tile_range(points.first_tile() + static_cast<LocalIndex>(t));
    for (LocalIndex i = begin; i < end && !encroached_[static_cast<std::size_t>(t)]; ++i)
      if (points.boundary(i) == mesh::free_site)
        encroached_[static_cast<std::size_t>(t)] = context_.guard.pushes(points.position(i));
  });
}

/// Sites next to chords may be certified where no site near the tile is in the disc of a chord. For tiles of other
/// ranks that is known once their sites have arrived (TileMarks).
SiteClass SiteClasses::least_certified(LocalIndex tile) const {
  const std::span<const LocalIndex> tiles = around_.of(at(tile - state_.points().first_tile()));
  const bool trusts = std::none_of(tiles.begin(), tiles.end(), [&](LocalIndex other) {
    return at(other) < encroached_.size() ? encroached_[at(other)] != 0 : state_.points().marks().of(other);
  });
  return trusts ? SiteClass::bordered : SiteClass::local;
}

LocalIndex tile_of_site(const mesh::BinnedPoints& points, LocalIndex i) {
  LocalIndex low = points.first_tile(), high = points.last_tile(); // the tile lies in [low, high)
  while (high - low > 1) {
    const LocalIndex middle = low + (high - low) / 2;
    (points.tile_range(middle).begin <= i ? low : high) = middle;
  }
  return low;
}

} // namespace trime::sweep
