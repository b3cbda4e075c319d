// SPDX-License-Identifier: BSD-3-Clause
// For which stars the Delaunay lemma does: what the sweeps know of chords and ghosts.
#include "meshing/sweeper.hpp"

#include "meshing/tiles_around.hpp"
#include "trime/core/thread_loop.hpp"

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Vec2;

std::size_t at(LocalIndex i) {
  return static_cast<std::size_t>(i);
}

} // namespace

/// Does the star of a neighbour know the triangles at its edge to site i? Not if it was lost when sites were sorted,
/// nor if they are too large for it: its cap may be lower. Whoever comes into such a triangle may change the one star
/// only.
bool Sweeper::vouches_for(LocalIndex neighbour, LocalIndex i) const {
  const delaunay::StarTable& stars = state_.stars();
  if (!stars.has_gap(neighbour))
    return stars.degrees()[neighbour] > 0;
  const std::span<const LocalIndex> ring = stars.ring(neighbour);
  const auto found = std::find(ring.begin(), ring.end(), i);
  return found != ring.end() && *(found == ring.begin() ? ring.end() - 1 : found - 1) != delaunay::gap &&
         *(found + 1 == ring.end() ? ring.begin() : found + 1) != delaunay::gap;
}

/// Does the lemma do for the star of site i?
SiteClass Sweeper::class_of(LocalIndex i, LocalIndex tile) const {
  const mesh::BinnedPoints& points = state_.points();
  if (const std::int32_t boundary = points.boundary(i); boundary != mesh::free_site)
    return boundary >= 0 ? SiteClass::held : SiteClass::fixed;
  const std::span<const LocalIndex> ring = state_.stars().ring(i);
  if (lemma_ == Lemma::nowhere || ring.size() < 3 || ring.size() > delaunay::StarTable::slots)
    return SiteClass::exact;
  bool beside_boundary = false;
  for (const LocalIndex neighbour : ring) {
    if (neighbour < 0 || neighbour >= points.owned())
      return SiteClass::exact;
    if (points.boundary(neighbour) >= 0)
      beside_boundary = true;
    else if (!vouches_for(neighbour, i))
      return SiteClass::exact;
  }
  return !beside_boundary ? SiteClass::local : may_be_bordered(i, tile) ? SiteClass::bordered : SiteClass::exact;
}

/// Two boundary sites in a row must be the ends of a chord: other edges between boundary sites have no star at either
/// end that would vouch for them.
bool Sweeper::may_be_bordered(LocalIndex i, LocalIndex tile) const {
  const mesh::BinnedPoints& points = state_.points();
  if (lemma_ != Lemma::up_to_chords || state_.grid().periods().any() ||
      kinds_[at(tile - points.first_tile())] != Tiles::inner)
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
bool Sweeper::is_chord_within_reach(LocalIndex from, LocalIndex to, LocalIndex tile) const {
  const mesh::BinnedPoints& points = state_.points();
  const geometry::Segment& chord = context_.guard.chords().segments()[points.boundary(from)];
  const Vec2 a = points.position(from), b = points.position(to), middle = 0.5 * (a + b);
  if (chord.a != a || chord.b != b)
    return false;
  const geometry::Box box = state_.grid().tile_box(tile);
  const double margin = drift_allowed * std::min(box.width(), box.height()), radius = 0.5 * geometry::length(b - a);
  const double x = box.width() - margin - radius, y = box.height() - margin - radius;
  return middle.x > box.min.x - x && middle.x < box.max.x + x && middle.y > box.min.y - y && middle.y < box.max.y + y;
}

void Sweeper::find_encroached_tiles() {
  const mesh::BinnedPoints& points = state_.points();
  encroached_.assign(kinds_.size(), 0);
  if (lemma_ != Lemma::up_to_chords)
    return;
  thread_loop(static_cast<std::ptrdiff_t>(encroached_.size()), 4, [&](std::ptrdiff_t t, int) {
    const auto [begin, end] = points.tile_range(points.first_tile() + static_cast<LocalIndex>(t));
    for (LocalIndex i = begin; i < end && !encroached_[static_cast<std::size_t>(t)]; ++i)
      if (points.boundary(i) == mesh::free_site)
        encroached_[static_cast<std::size_t>(t)] = context_.guard.pushes(points.position(i));
  });
}

/// No owned site near this tile is in the disc of a chord, nor any other site if the tile is an inner one.
bool Sweeper::trusts_boundary(LocalIndex tile) const {
  const mesh::BinnedPoints& points = state_.points();
  if (kinds_[at(tile - points.first_tile())] != Tiles::inner)
    return false;
  bool trusts = true;
  for_tiles_around(state_.grid(), tile,
                   [&](LocalIndex other) { trusts = trusts && !encroached_[at(other - points.first_tile())]; });
  return trusts;
}

} // namespace trime::meshing
