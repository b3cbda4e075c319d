// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/patch_mover.hpp"

#include "cleanup/rules.hpp"
#include "core/angle.hpp"
#include "geometry/predicates.hpp"

#include <algorithm>
#include <cmath>

namespace trime::cleanup {

using geometry::Vec2;
using polygon::BoundaryCurve;

/// @param arc length of the curve between the ends @param length of the chord
bool PatchChords::stands_for_bent_curve(const BoundaryVertex& from, const BoundaryVertex& to,
                                        const geometry::Segment& chord, double size, double arc, double length) const {
  const BoundaryCurve::Strayed strayed = start_.curve().strayed(from.loop, from.arc, to.arc, chord);
  const bool tolerated = strayed.bent && strayed.deviation <= from.tolerance;
  if (strayed.leaves_disc || !(tolerated || (!strayed.sharp && arc <= CleanupRules::largest_arc_share * length)))
    return false;
  return strayed.deviation <= CleanupRules::unseen_stray * size || length <= longest_bent_ * size;
}

/// If a vertex lies in the disc of an edge of a Delaunay triangulation, the third vertex of one of its triangles does.
bool PatchChords::holds(const Patch& patch, LocalIndex v, const PatchMesh::Apexes& apexes) const {
  const BoundaryVertex& own = patch.boundary[at(v)];
  if (own.changed && !stands_for_curve(patch, v))
    return false;
  const auto [a, b] = patch.chord(v);
  for (const LocalIndex apex : {apexes.left, apexes.right}) {
    if (apex < PatchMesh::frame || !(own.changed || start_.has_changed(patch, apex)))
      continue; // near the rim, not all that lies between is known
    if ((apex == apexes.right && !patch.on_boundary(apex)) ||
        geometry::diametral_side(a, b, patch.mesh.position(apex)) <= 0)
      return false;
  }
  return true;
}

/// Returns whether a chord of a curve inside the shape holds.
bool PatchChords::wall_holds(const Patch& patch, LocalIndex u, LocalIndex w, const PatchMesh::Apexes& apexes) const {
  const bool has_changed = start_.has_changed(patch, u) || start_.has_changed(patch, w);
  for (const LocalIndex apex : {apexes.left, apexes.right})
    if (apex >= PatchMesh::frame && (has_changed || start_.has_changed(patch, apex)) &&
        geometry::diametral_side(patch.mesh.position(u), patch.mesh.position(w), patch.mesh.position(apex)) <= 0)
      return false;
  return true;
}

bool PatchChords::hold(const Patch& patch) const {
  LocalIndex missing = 0;
  for (const LocalIndex v : patch.rim) {
    const LocalIndex next = patch.boundary[at(v)].next;
    if (next < 0 || patch.is_gone(v))
      continue;
    const auto apexes = patch.mesh.apexes(v, next);
    if (!apexes)
      ++missing;
    else if (!holds(patch, v, *apexes))
      return false;
  }
  for (const auto& [u, w] : patch.walls) {
    const auto apexes = patch.mesh.apexes(u, w);
    if (!apexes)
      ++missing;
    else if (!wall_holds(patch, u, w, *apexes))
      return false;
  }
  return missing <= start_.missing_chords();
}

namespace {

using geometry::Vec2;
using polygon::BoundaryCurve;
using Rules = CleanupRules;

// Least determinant of the second derivatives over their squares for a Newton step. Only rounding is kept out.
constexpr double least_convexity = 1e-6;
constexpr double flat_energy = 1e20; // Energy of a star from which rounding may change the signs of its areas
// Longest step along the boundary over the way to the next site there. Order must be kept.
constexpr double slide_share = 0.4;

/// The step along a tangent that Newton's method asks for, or the longest one downwards.
double step_along(const EnergyModel& model, Vec2 along, double limit) {
  const double slope = geometry::dot(model.gradient, along);
  const double bend = model.xx * along.x * along.x + 2 * model.xy * along.x * along.y + model.yy * along.y * along.y;
  const double step = bend > 0 ? -slope / bend : slope < 0 ? limit : -limit;
  return std::clamp(step, -limit, limit);
}

} // namespace

using geometry::Vec2;

namespace {

constexpr double c = 0.28867513459481287; // 1 / (2 sqrt(3)): eta = c (sum of squared edges) / (2 area)

/// row_height is the sine of 60 degrees.
Vec2 turned_by_60(Vec2 v) {
  return {0.5 * v.x - row_height * v.y, row_height * v.x + 0.5 * v.y};
}

double energy_of(double excess) {
  return excess * excess * (1 + CleanupRules::quartic_weight * (excess * excess));
}

} // namespace

// A triangle has its corners at p, p + u and p + v. With w = u turned by 60 degrees - v, the sum of its squared edges
// is 2 w.w + 2 sqrt(3) (u x v), so that eta - 1 = 2 c w.w / (u x v): nothing cancels, however good the triangle is.

double star_energy(Vec2 p, std::span<const Vec2> ring, bool closed, double limit) {
  double sum = 0;
  Vec2 u = (closed ? ring.back() : ring.front()) - p;
  for (std::size_t k = !closed; k < ring.size(); ++k) {
    const Vec2 v = ring[k] - p;
    const double area = geometry::cross(u, v);
    if (!(area > 0))
      return INFINITY;
    sum += energy_of(2 * c * geometry::squared_length(turned_by_60(u) - v) / area);
    if (!(sum < limit))
      return INFINITY;
    u = v;
  }
  return sum;
}

EnergyModel star_energy_model(Vec2 p, std::span<const Vec2> ring, bool closed) {
  EnergyModel model;
  Vec2 u = (closed ? ring.back() : ring.front()) - p;
  for (std::size_t k = !closed; k < ring.size(); ++k) {
    const Vec2 v = ring[k] - p, w = turned_by_60(u) - v;
    const double inverse = 1 / geometry::cross(u, v), scale = 2 * c * inverse;
    const double excess = scale * geometry::squared_length(w);
    const Vec2 of_square = 2 * turned_by_60(w), of_area = inverse * Vec2{u.y - v.y, v.x - u.x}; // relative to the area
    const Vec2 g = scale * of_square - excess * of_area;
    const double hxx = 2 * (scale - g.x * of_area.x);
    const double hyy = 2 * (scale - g.y * of_area.y);
    const double hxy = -(g.x * of_area.y + g.y * of_area.x);
    const double square = CleanupRules::quartic_weight * (excess * excess);
    const double first = excess * (2 + 4 * square), second = 2 + 12 * square;
    model.value += energy_of(excess);
    model.gradient = model.gradient + first * g;
    model.xx += second * g.x * g.x + first * hxx;
    model.xy += second * g.x * g.y + first * hxy;
    model.yy += second * g.y * g.y + first * hyy;
    u = v;
  }
  return model;
}

namespace {

/// Calls visit(cotangent, gradient) for each steep angle of the triangles (p, ring[k], ring[k+1]); the gradient is with
/// respect to p.
void for_each_steep(Vec2 p, std::span<const Vec2> ring, bool closed, const auto& visit) {
  Vec2 u = (closed ? ring.back() : ring.front()) - p;
  for (std::size_t k = !closed; k < ring.size(); ++k) {
    const Vec2 v = ring[k] - p;
    const double inverse = 1 / geometry::cross(u, v), uv = geometry::dot(u, v);
    const Vec2 of_area = inverse * Vec2{u.y - v.y, v.x - u.x}; // relative to the area
    const auto visit_angle = [&](double product, Vec2 of_product) {
      const double cotangent = inverse * product;
      if (cotangent < CleanupRules::steep_cotangent)
        visit(cotangent, inverse * of_product - cotangent * of_area);
    };
    visit_angle(uv, -1.0 * (u + v));
    visit_angle(geometry::squared_length(u) - uv, v - u);
    visit_angle(geometry::squared_length(v) - uv, u - v);
    u = v;
  }
}

} // namespace

double steep_energy(Vec2 p, std::span<const Vec2> ring, bool closed) {
  double sum = 0;
  for_each_steep(p, ring, closed, [&](double cotangent, Vec2) {
    const double lack = CleanupRules::steep_cotangent - cotangent;
    sum += CleanupRules::steep_weight * lack * lack;
  });
  return sum;
}

void add_steep_energy(EnergyModel& model, Vec2 p, std::span<const Vec2> ring, bool closed) {
  for_each_steep(p, ring, closed, [&](double cotangent, Vec2 gradient) {
    const double lack = CleanupRules::steep_cotangent - cotangent, twice = 2 * CleanupRules::steep_weight;
    model.value += CleanupRules::steep_weight * lack * lack;
    model.gradient = model.gradient - (twice * lack) * gradient;
    model.xx += twice * gradient.x * gradient.x;
    model.xy += twice * gradient.x * gradient.y;
    model.yy += twice * gradient.y * gradient.y;
  });
}

Vec2 newton_step(const EnergyModel& model, double limit) {
  const double determinant = model.xx * model.yy - model.xy * model.xy;
  Vec2 step;
  if (determinant > least_convexity * (model.xx * model.xx + model.yy * model.yy) && model.xx > 0)
    step = (-1 / determinant) * Vec2{model.yy * model.gradient.x - model.xy * model.gradient.y,
                                     model.xx * model.gradient.y - model.xy * model.gradient.x};
  else
    step = -1e300 * model.gradient;
  const double length = geometry::length(step);
  if (!(length > limit))
    return step;
  const double steepness = geometry::length(model.gradient);
  if (!std::isfinite(length))
    return steepness > 0 ? (-limit / steepness) * model.gradient : Vec2{};
  return (limit / length) * step;
}

void PatchMover::relax(Patch& patch, std::span<const LocalIndex> vertices) {
  if (patch.broken)
    return;
  shifted_.clear();
  for (const LocalIndex v : vertices)
    if (patch.role[at(v)] == VertexRole::free && !patch.on_boundary(v) && !patch.on_curve(v) && relax_inside(patch, v))
      shifted_.push_back(v);
  patch.mesh.restore(shifted_);
  for (const LocalIndex v : vertices) {
    if (patch.role[at(v)] != VertexRole::free || patch.broken)
      continue;
    if (patch.on_boundary(v))
      slide(patch, v);
    else if (patch.on_curve(v))
      slide_inside(patch, v);
  }
}

/// @return false if a neighbour is a vertex of the frame
bool PatchMover::load_ring(const Patch& patch, LocalIndex v) {
  patch.mesh.collect_ring(v, ring_);
  around_.clear();
  for (const LocalIndex u : ring_) {
    if (u < PatchMesh::frame)
      return false;
    around_.push_back(patch.mesh.position(u));
  }
  return true;
}

/// The energy of the star whose ring has been loaded.
EnergyModel PatchMover::model_at(Vec2 p, bool closed) const {
  EnergyModel model = star_energy_model(p, around_, closed);
  if (is_against_obtuse_)
    add_steep_energy(model, p, around_, closed);
  return model;
}

/// Is the energy below the limit?
bool PatchMover::is_better(Vec2 p, bool closed, double limit) const {
  const double energy = star_energy(p, around_, closed, limit);
  return energy < limit && (!is_against_obtuse_ || energy + steep_energy(p, around_, closed) < limit);
}

/// @return whether the vertex has been shifted; then PatchMesh::restore must follow
bool PatchMover::relax_inside(Patch& patch, LocalIndex v) {
  if (!load_ring(patch, v))
    return false;
  const Vec2 from = patch.mesh.position(v);
  const double h = patch.size[at(v)];
  const EnergyModel model = model_at(from, true);
  if (model.value < Rules::rest_energy)
    return false;
  const bool is_flat = !(model.value < flat_energy);
  Vec2 step = newton_step(model, Rules::longest_move * h);
  for (int halving = 0; halving <= Rules::halvings; ++halving, step = 0.5 * step) {
    if (geometry::squared_length(step) < Rules::shortest_move * Rules::shortest_move * h * h)
      return false;
    const Vec2 to = start_.lattice().snap(from + step);
    if (!is_better(to, true, model.value) || !keeps_clear(patch, to))
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

/// Does a place within the ring lie outside of the discs of its chords, and far enough from the rim of the patch?
bool PatchMover::keeps_clear(const Patch& patch, Vec2 to) const {
  if (!start_.is_off_rim(to))
    return false;
  for (std::size_t k = 0; k < ring_.size() && !(patch.rim.empty() && patch.walls.empty()); ++k) {
    const LocalIndex u = ring_[k], w = ring_[k + 1 == ring_.size() ? 0 : k + 1];
    if ((patch.is_chord(u, w) || patch.is_chord(w, u) || patch.is_wall(u, w)) &&
        geometry::diametral_side(patch.mesh.position(u), patch.mesh.position(w), to) <= 0)
      return false;
  }
  return true;
}

/// The neighbours of a vertex on the boundary, from its next one there to its previous one, in `around_`.
/// @return false if one of the two is not a neighbour in the triangulation
bool PatchMover::load_fan(const Patch& patch, LocalIndex v) {
  const BoundaryVertex& own = patch.boundary[at(v)];
  patch.mesh.collect_ring(v, ring_);
  const auto first = std::find(ring_.begin(), ring_.end(), own.next);
  if (first == ring_.end())
    return false;
  std::rotate(ring_.begin(), first, ring_.end());
  const auto last = std::find(ring_.begin(), ring_.end(), own.previous);
  if (last == ring_.end())
    return false;
  around_.clear();
  for (auto u = ring_.begin(); u <= last; ++u)
    around_.push_back(patch.mesh.position(*u));
  return true;
}

/// Moves a vertex along the boundary; its neighbours there stay where they are.
void PatchMover::slide(Patch& patch, LocalIndex v) {
  if (!load_fan(patch, v))
    return;
  BoundaryVertex& own = patch.boundary[at(v)];
  const Vec2 from = patch.mesh.position(v);
  const double h = patch.size[at(v)];
  const EnergyModel model = model_at(from, false);
  if (model.value < Rules::rest_energy)
    return;
  const BoundaryCurve& curve = start_.curve();
  const double limit =
      std::fmin(Rules::longest_slide * h, slide_share * std::fmin(geometry::length(around_.front() - from),
                                                                  geometry::length(around_.back() - from)));
  double step = step_along(model, curve.place(own.loop, own.arc).tangent, limit);
  const double length = curve.length(own.loop);
  const int halvings = is_thorough_ ? Rules::halvings : Rules::slide_halvings;
  for (int halving = 0; halving <= halvings; ++halving, step *= 0.5) {
    if (std::fabs(step) < Rules::shortest_move * h)
      return;
    const double arc = own.arc + step;
    const Vec2 to = start_.periods().nearest_image(start_.lattice().snap(curve.place(own.loop, arc).point), from);
    BoundaryVertex moved = own;
    moved.arc = arc >= length ? arc - length : arc < 0 ? arc + length : arc;
    if (!is_better(to, false, model.value) || !may_slide(patch, v, moved, to))
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

/// Finds the neighbours of a vertex on a curve inside. @return false if one of the two chords is not in the patch
bool PatchMover::load_chords(const Patch& patch, LocalIndex v) {
  on_curve_.clear();
  for (const auto& [u, w] : patch.walls)
    if (u == v || w == v)
      on_curve_.push_back(u == v ? w : u);
  return on_curve_.size() == 2;
}

/// The place of a vertex on a curve inside after a step along the curve; nothing if the place is too far from it.
std::optional<Vec2> PatchMover::stepped(const Patch& patch, LocalIndex v, double step) const {
  using polygon::InnerChords;
  const Vec2 from = patch.mesh.position(v);
  const LocalIndex site = index_on_curve(patch.boundary[at(v)].site);
  const std::int32_t track = start_.inner().track[at(site)];
  const Vec2 beyond = from + step * tangent_;
  if (track >= 0) {
    const polygon::SlideCircle& circle = start_.inner().circles[at(track)];
    const Vec2 arm = beyond - circle.center;
    return start_.lattice().snap(circle.center + (circle.radius / geometry::length(arm)) * arm);
  }
  const Vec2 to = start_.lattice().snap(beyond);
  if (track == InnerChords::bent &&
      geometry::length(to - start_.inner().sites[at(site)]) > Rules::longest_bent_slide * patch.size[at(v)])
    return std::nullopt;
  return to;
}

/// The unit vector along the curve at a vertex: the tangent of the circle, or the direction from one neighbour to the
/// other. A step from one neighbour towards the other leaves the areas on both sides as they are; steps along a circle
/// change them, see polygon::InnerChords::move_sites.
Vec2 PatchMover::tangent_at(const Patch& patch, LocalIndex v) const {
  const std::int32_t track = start_.inner().track[at(index_on_curve(patch.boundary[at(v)].site))];
  const Vec2 along = track >= 0
                         ? geometry::left_normal(patch.mesh.position(v) - start_.inner().circles[at(track)].center)
                         : patch.mesh.position(on_curve_[1]) - patch.mesh.position(on_curve_[0]);
  return (1 / geometry::length(along)) * along;
}

/// Moves a vertex along a curve inside; its neighbours there stay where they are.
void PatchMover::slide_inside(Patch& patch, LocalIndex v) {
  if (!load_ring(patch, v) || !load_chords(patch, v))
    return;
  const Vec2 from = patch.mesh.position(v);
  const double h = patch.size[at(v)];
  const EnergyModel model = model_at(from, true);
  if (model.value < Rules::rest_energy)
    return;
  const Vec2 a = patch.mesh.position(on_curve_[0]), b = patch.mesh.position(on_curve_[1]);
  const double to_a = geometry::length(a - from), to_b = geometry::length(b - from);
  tangent_ = tangent_at(patch, v);
  double step = step_along(model, tangent_, std::fmin(Rules::longest_slide * h, slide_share * std::fmin(to_a, to_b)));
  const int halvings = is_thorough_ ? Rules::halvings : Rules::slide_halvings;
  for (int halving = 0; halving <= halvings; ++halving, step *= 0.5) {
    if (std::fabs(step) < Rules::shortest_move * h)
      return;
    const std::optional<Vec2> to = stepped(patch, v, step);
    if (!to || !is_better(*to, true, model.value) || !may_slide_inside(patch, v, *to))
      continue;
    if (!patch.mesh.move(v, *to) && !patch.mesh.replace(v, *to))
      patch.broken = true;
    return;
  }
}

/// Is a new length of a chord of a bent curve near h, or nearer than the old one?
bool PatchMover::may_be_as_long(double before, double after, double size) {
  return (after <= before || after <= Rules::longest_bent_chord * size) &&
         (after >= before || after >= Rules::shortest_bent_chord * size);
}

/// Would the chords on both sides of a vertex on a curve inside have empty discs, and would it stay out of the discs of
/// the others? Looks at its neighbours only; PatchChords::hold is certain.
bool PatchMover::may_slide_inside(const Patch& patch, LocalIndex v, Vec2 to) const {
  const bool is_bent =
      start_.inner().track[at(index_on_curve(patch.boundary[at(v)].site))] != polygon::InnerChords::straight;
  for (const LocalIndex end : on_curve_) {
    const Vec2 p = patch.mesh.position(end);
    if (is_bent &&
        !may_be_as_long(geometry::length(patch.mesh.position(v) - p), geometry::length(to - p), patch.size[at(v)]))
      return false;
    for (const LocalIndex u : ring_)
      if (u != end && geometry::diametral_side(p, to, patch.mesh.position(u)) <= 0)
        return false;
  }
  return keeps_clear(patch, to);
}

/// Would the chords on both sides of a vertex be allowed?
bool PatchMover::may_slide(const Patch& patch, LocalIndex v, const BoundaryVertex& moved, Vec2 to) const {
  return leaves_discs_empty(patch, v, to) &&
         chords_.stands_for_curve(moved, patch.boundary[at(moved.next)], {to, around_.front()}, patch.size[at(v)]) &&
         chords_.stands_for_curve(patch.boundary[at(moved.previous)], moved, {around_.back(), to},
                                  patch.size[at(moved.previous)]);
}

/// Are the discs of the chords around empty after a vertex of the boundary has moved? Looks at its neighbours only;
/// PatchChords::hold is certain.
bool PatchMover::leaves_discs_empty(const Patch& patch, LocalIndex v, Vec2 to) const {
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

} // namespace trime::cleanup
