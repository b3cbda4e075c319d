// SPDX-License-Identifier: BSD-3-Clause
// How the sites of a patch move: freely inside, along their curve on the boundary.
#include "meshing/patch.hpp"

#include "meshing/star_energy.hpp"
#include "trime/geometry/diametral.hpp"

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Vec2;

constexpr double longest_step = 0.25;  // h, of one Newton step
constexpr double shortest_step = 3e-3; // h: not worth a move
constexpr double good_enough = 2e-4;   // energy of a star: six triangles with eta below 1.006
constexpr double nearly_flat = 1e20;   // energy of a star: below, rounding cannot change the signs of its areas
constexpr int halvings = 3;
constexpr double most_outwards = 0.5; // h: how far a free site may go towards the rim
constexpr double longest_slide = 0.2; // h, of one step
constexpr double nearest_share = 0.4; // of the way to a neighbour along the boundary, at most, in one step
constexpr double straight_share = 1 + 1e-9;
constexpr double bent_at_first = 1.01, unseen = 0.001; // h: longest chords of curves that stray by more than `unseen`
constexpr double largest_arc_share = 1.05;             // arc over chord: a turn by 60 degrees
constexpr double least_gain = 0.02;                    // of a sweep; then one more is worth it

} // namespace

/// Sweeps over the free sites of bad triangles and their neighbours.
void PatchOptimizer::move_bad_sites() {
  longest_bent_ = bent_at_first;
  is_thorough_ = false;
  Score before;
  if (!mark_bad_sites(before))
    return;
  const Score first = before;
  double least = first.sum;
  best_ = now_;
  for (int sweep = 0; sweep < options_.moving_sweeps; ++sweep) {
    relax(now_, movers_);
    Score after;
    const bool any = !now_.broken && mark_bad_sites(after);
    if (now_.broken || after.max > first.max || !chords_hold(now_))
      break;
    if (after.sum < least) {
      least = after.sum;
      best_ = now_;
    }
    if (!any || after.sum > (1 - least_gain) * before.sum)
      break;
    before = after;
  }
  std::swap(now_, best_);
}

/// Lists them in movers_. @return whether there are any
bool PatchOptimizer::mark_bad_sites(Score& score) {
  mark_.assign(at(now_.mesh.vertices()), 0);
  score = {};
  bool any = false;
  for (const PatchMesh::Triangle& triangle : now_.mesh.triangles()) {
    if (!counts(now_, triangle))
      continue;
    const double its_alpha = alpha(now_, triangle);
    add_to(score, its_alpha);
    if (its_alpha > options_.bad_alpha && !rest(triangle.vertex)) {
      any = true;
      for (const LocalIndex v : triangle.vertex)
        mark_[at(v)] = 2;
    }
  }
  for (const PatchMesh::Triangle& triangle : now_.mesh.triangles())
    if (triangle.vertex[0] >= 0 &&
        std::any_of(triangle.vertex.begin(), triangle.vertex.end(), [&](LocalIndex v) { return mark_[at(v)] == 2; }))
      for (const LocalIndex v : triangle.vertex)
        mark_[at(v)] = std::max<std::uint8_t>(mark_[at(v)], 1);
  movers_.clear();
  for (LocalIndex v = PatchMesh::frame; v < now_.mesh.vertices(); ++v)
    if (mark_[at(v)] > 0 && now_.role[at(v)] == Role::free)
      movers_.push_back(v);
  return any;
}

/// One sweep: first inside, with the edges as they are, then on the boundary.
void PatchOptimizer::relax(Patch& patch, std::span<const LocalIndex> vertices) {
  if (patch.broken)
    return;
  shifted_.clear();
  for (const LocalIndex v : vertices)
    if (patch.role[at(v)] == Role::free && !patch.on_boundary(v) && relax_vertex(patch, v))
      shifted_.push_back(v);
  patch.mesh.restore(shifted_);
  for (const LocalIndex v : vertices)
    if (patch.role[at(v)] == Role::free && patch.on_boundary(v) && !patch.broken)
      slide_vertex(patch, v);
}

/// @return whether it has been shifted
bool PatchOptimizer::relax_vertex(Patch& patch, LocalIndex v) {
  patch.mesh.collect_ring(v, ring_);
  around_.clear();
  for (const LocalIndex u : ring_) {
    if (u < PatchMesh::frame)
      return false;
    around_.push_back(patch.mesh.position(u));
  }
  const Vec2 from = patch.mesh.position(v);
  const double h = patch.size[at(v)];
  const EnergyModel model = star_energy_model(from, around_, true);
  if (model.value < good_enough)
    return false;
  const bool is_flat = !(model.value < nearly_flat);
  Vec2 step = newton_step(model, longest_step * h);
  for (int halving = 0; halving <= halvings; ++halving, step = 0.5 * step) {
    if (geometry::squared_length(step) < shortest_step * shortest_step * h * h)
      return false;
    const Vec2 to = lattice_.snap(from + step);
    if (!(star_energy(to, around_, true, model.value) < model.value) || !keeps_clear(patch, to))
      continue;
    if (is_flat) { // the signs of the areas are not certain
      patch.mesh.move(v, to);
      return false;
    }
    patch.mesh.shift(v, to);
    return true;
  }
  return false;
}

/// Does a place within the ring keep off the discs of the chords in it, and off the rim of the patch?
bool PatchOptimizer::keeps_clear(const Patch& patch, Vec2 to) const {
  if (geometry::length(to - center_) > (options_.reach - PatchOptions::clearance + most_outwards) * size_)
    return false;
  for (std::size_t k = 0; k < ring_.size() && !patch.rim.empty(); ++k) {
    const LocalIndex u = ring_[k], w = ring_[k + 1 == ring_.size() ? 0 : k + 1];
    if ((patch.is_chord(u, w) || patch.is_chord(w, u)) &&
        geometry::diametral_side(patch.mesh.position(u), patch.mesh.position(w), to) <= 0)
      return false;
  }
  return true;
}

/// Along the boundary, its neighbours there stay where they are.
void PatchOptimizer::slide_vertex(Patch& patch, LocalIndex v) {
  BoundaryVertex& own = patch.boundary[at(v)];
  patch.mesh.collect_ring(v, ring_);
  const auto first = std::find(ring_.begin(), ring_.end(), own.next);
  if (first == ring_.end())
    return;
  std::rotate(ring_.begin(), first, ring_.end());
  const auto last = std::find(ring_.begin(), ring_.end(), own.previous);
  if (last == ring_.end())
    return;
  around_.clear();
  for (auto u = ring_.begin(); u <= last; ++u)
    around_.push_back(patch.mesh.position(*u));
  const Vec2 from = patch.mesh.position(v);
  const double h = patch.size[at(v)];
  const EnergyModel model = star_energy_model(from, around_, false);
  if (model.value < good_enough)
    return;
  const Vec2 along = curve_.place(own.loop, own.arc).tangent;
  const double slope = geometry::dot(model.gradient, along);
  const double bend = model.xx * along.x * along.x + 2 * model.xy * along.x * along.y + model.yy * along.y * along.y;
  const double limit = std::fmin(longest_slide * h, nearest_share * std::fmin(geometry::length(around_.front() - from),
                                                                              geometry::length(around_.back() - from)));
  double step = bend > 0 ? -slope / bend : slope < 0 ? limit : -limit;
  step = std::clamp(step, -limit, limit);
  const double length = curve_.length(own.loop);
  for (int halving = 0; halving <= (is_thorough_ ? halvings : 1); ++halving, step *= 0.5) {
    if (std::fabs(step) < shortest_step * h)
      return;
    const double arc = own.arc + step;
    const Vec2 to = boundary_.periods.nearest_image(lattice_.snap(curve_.place(own.loop, arc).point), from);
    BoundaryVertex moved = own;
    moved.arc = arc >= length ? arc - length : arc < 0 ? arc + length : arc;
    if (!(star_energy(to, around_, false, model.value) < model.value) || !leaves_discs_empty(patch, v, to) ||
        !stands_for_curve(moved, patch.boundary[at(own.next)], {to, around_.front()}, h) ||
        !stands_for_curve(patch.boundary[at(own.previous)], moved, {around_.back(), to}, patch.size[at(own.previous)]))
      continue;
    if (!patch.mesh.move(v, to) && !patch.mesh.replace(v, to)) {
      patch.broken = true;
      return;
    }
    own.arc = moved.arc;
    own.changed = patch.boundary[at(own.previous)].changed = true;
    return;
  }
}

/// Of the chords around, when a vertex of the boundary comes to lie elsewhere? Its neighbours tell; chords_hold does
/// for certain.
bool PatchOptimizer::leaves_discs_empty(const Patch& patch, LocalIndex v, Vec2 to) const {
  const BoundaryVertex& own = patch.boundary[at(v)];
  const Vec2 behind = patch.mesh.position(own.previous), ahead = patch.mesh.position(own.next);
  for (const LocalIndex u : ring_) {
    const Vec2 p = patch.mesh.position(u);
    if ((u != own.previous && geometry::diametral_side(behind, to, p) <= 0) ||
        (u != own.next && geometry::diametral_side(to, ahead, p) <= 0))
      return false;
  }
  return keeps_clear(patch, to);
}

/// May the chord between two vertices on the boundary take the place of the curve?
bool PatchOptimizer::stands_for_curve(const BoundaryVertex& from, const BoundaryVertex& to,
                                      const geometry::Segment& chord, double size) const {
  double arc = to.arc - from.arc;
  if (arc < 0)
    arc += curve_.length(from.loop);
  const double length = geometry::length(chord.b - chord.a);
  if (arc <= straight_share * length)
    return true; // as on a straight side
  const BoundaryCurve::Strayed strayed = curve_.strayed(from.loop, from.arc, to.arc, chord);
  const bool tolerated = strayed.bent && strayed.deviation <= from.tolerance;
  if (strayed.leaves_disc || !(tolerated || (!strayed.sharp && arc <= largest_arc_share * length)))
    return false;
  return strayed.deviation <= unseen * size ||
         length <= longest_bent_ * size; // the area that is lost grows with the third power of the length
}

} // namespace trime::meshing
