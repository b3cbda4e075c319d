// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/patch.hpp"

#include "meshing/star_energy.hpp"
#include "trime/geometry/diametral.hpp"
#include "trime/mesh/quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Vec2;

constexpr double clearance_of_score = 1.5; // h, from the rim of what is read
constexpr double widest_frame = 0x1.8p44;  // lattice steps: 1.5 sides of the container at least; predicates are exact
constexpr double weight_of_bad = 10;
constexpr double least_gain = 0.02;
constexpr std::array<double, 2> hopeless_shares{4, 2};  // after each of the first sweeps a trial is given up that is
                                                        // so much worse than what it has to be
constexpr double near_sweeps = 2;                       // h: how far from the middle the first sweeps reach
constexpr double longest_step = 0.25;                   // h, of one Newton step
constexpr double most_off_middle = 0.3;                 // of a chord, where it is divided
constexpr double refine_alpha = 1.3, refine_gain = 0.1; // of the excess of alpha
constexpr int refine_sweeps = 20;
constexpr LocalIndex most_refined = 40; // new sites on the boundary
constexpr int halvings = 3;
constexpr double longest_slide = 0.2; // h, of one step
constexpr double nearest_share = 0.4; // of the way to a neighbour along the boundary, at most, in one step
constexpr double straight_share = 1 + 1e-9;
/// h: chords of curves that stray by more than `unseen` are no longer than that; where a triangle above `bend_alpha`
/// would be left, the second limit holds.
constexpr double bent_at_first = 1.01, bent_at_last = 1.25, unseen = 0.001, bend_alpha = 1.1;
constexpr double largest_arc_share = 1.05; // arc over chord: a turn by 60 degrees

} // namespace

LocalIndex PatchOptimizer::Patch::add(Vec2 p, double h, const BoundaryVertex& on_boundary, Role its_role) {
  const LocalIndex v = mesh.insert(p);
  if (v < 0)
    return v;
  role.push_back(its_role);
  size.push_back(h);
  boundary.push_back(on_boundary);
  return v;
}

/// The triangulation of the sites. @return false if there is nothing to be done
bool PatchOptimizer::build(Vec2 center, double size, std::span<const PatchSite> sites) {
  center_ = center;
  size_ = size;
  if (sites.size() > options_.most_sites)
    return false;
  const double reach = options_.reach * size;
  base_.broken = base_.divided = false;
  base_.mesh.start(center, std::min(lattice_.snap(3 * reach), widest_frame * lattice_.step()));
  base_.role.assign(PatchMesh::frame, Role::held);
  base_.size.assign(PatchMesh::frame, size);
  base_.boundary.assign(PatchMesh::frame, {});
  for (const PatchSite& site : sites) {
    const double distance = geometry::length(site.position - center);
    const double coarser = std::fmax(site.size, size);
    Role role = Role::held;
    if (distance + PatchOptions::clearance * coarser < reach && site.boundary != mesh::fixed_site)
      role = Role::free;
    else if (distance + clearance_of_score * coarser < reach)
      role = Role::scored;
    BoundaryVertex on_boundary;
    if (site.boundary >= 0) {
      const BoundarySite& its = boundary_.sites[at(site.boundary)];
      on_boundary.site = site.boundary;
      on_boundary.tolerance = site.tolerance;
      on_boundary.loop = loop_of(boundary_, site.boundary);
      on_boundary.arc = curve_.arc(on_boundary.loop, its);
      if (its.corner)
        role = std::min(role, Role::scored);
    }
    base_.add(site.position, site.size, on_boundary, role);
  }
  link_boundary();
  return std::find(base_.role.begin(), base_.role.end(), Role::free) != base_.role.end();
}

/// Joins neighbours along the boundary. Who has none in the patch is held.
void PatchOptimizer::link_boundary() {
  for (LocalIndex v = PatchMesh::frame; v < base_.mesh.vertices(); ++v) {
    BoundaryVertex& own = base_.boundary[at(v)];
    if (own.site < 0)
      continue;
    const geometry::Segment chord = boundary_.chord(own.site);
    const Vec2 end = base_.mesh.position(v) + (chord.b - chord.a);
    for (LocalIndex u = PatchMesh::frame; u < base_.mesh.vertices(); ++u)
      if (base_.boundary[at(u)].site == boundary_.sites[at(own.site)].next && base_.mesh.position(u) == end) {
        own.next = u;
        base_.boundary[at(u)].previous = v;
      }
  }
  for (LocalIndex v = PatchMesh::frame; v < base_.mesh.vertices(); ++v) {
    const BoundaryVertex& own = base_.boundary[at(v)];
    if (own.site >= 0 && (own.next < 0 || own.previous < 0))
      base_.role[at(v)] = std::min(base_.role[at(v)], Role::scored);
  }
}

/// Inside the shape, and with a vertex whose triangles count.
bool PatchOptimizer::counts(const Patch& patch, const PatchMesh::Triangle& triangle) const {
  if (triangle.vertex[0] < 0)
    return false;
  bool near = false;
  for (const LocalIndex v : triangle.vertex) {
    if (v < PatchMesh::frame)
      return false;
    near |= patch.role[at(v)] >= Role::scored;
  }
  return near && lies_inside(patch, triangle);
}

/// Who has a vertex inside lies inside; else an edge on the boundary tells, or the place.
bool PatchOptimizer::lies_inside(const Patch& patch, const PatchMesh::Triangle& triangle) const {
  for (const LocalIndex v : triangle.vertex)
    if (patch.boundary[at(v)].site < 0)
      return true;
  for (std::size_t k = 0; k < 3; ++k) {
    const LocalIndex from = triangle.vertex[k], to = triangle.vertex[(k + 1) % 3];
    if (patch.boundary[at(from)].next == to)
      return true;
    if (patch.boundary[at(from)].previous == to)
      return false;
  }
  const Vec2 middle = (1.0 / 3) * (patch.mesh.position(triangle.vertex[0]) + patch.mesh.position(triangle.vertex[1]) +
                                   patch.mesh.position(triangle.vertex[2]));
  return guard_.inside(lattice_.snap(middle));
}

PatchOptimizer::Score PatchOptimizer::score(const Patch& patch) const {
  Score score;
  for (const PatchMesh::Triangle& triangle : patch.mesh.triangles()) {
    if (!counts(patch, triangle))
      continue;
    const double alpha =
        mesh::aspect_ratio(patch.mesh.position(triangle.vertex[0]), patch.mesh.position(triangle.vertex[1]),
                           patch.mesh.position(triangle.vertex[2]));
    const double excess = alpha - 1, bad = std::fmax(0, alpha - options_.bad_alpha);
    score.sum += excess * excess + weight_of_bad * bad * bad;
    score.max = std::fmax(score.max, alpha);
  }
  return score;
}

/// Of the triangles at the middle that count: the one that made this patch.
const PatchMesh::Triangle* PatchOptimizer::worst_triangle() const {
  const PatchMesh::Triangle* worst = nullptr;
  double largest = 1;
  for (const PatchMesh::Triangle& triangle : base_.mesh.triangles()) {
    if (!counts(base_, triangle))
      continue;
    const Vec2 a = base_.mesh.position(triangle.vertex[0]), b = base_.mesh.position(triangle.vertex[1]),
               c = base_.mesh.position(triangle.vertex[2]);
    if (a != center_ && b != center_ && c != center_)
      continue;
    const double alpha = mesh::aspect_ratio(a, b, c);
    if (alpha > largest) {
      worst = &triangle;
      largest = alpha;
    }
  }
  return worst;
}

/// What may help the worst triangle.
void PatchOptimizer::list_operations() {
  operations_.clear();
  const PatchMesh::Triangle* worst = worst_triangle();
  if (!worst)
    return;
  const auto place = [&](std::size_t k) { return base_.mesh.position(worst->vertex[k % 3]); };
  const auto insert = [&](Vec2 p) { operations_.push_back({.inserted = p}); };
  const auto remove = [&](LocalIndex v) { operations_.push_back({.removed = {v, -1}}); };
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (geometry::squared_length(place(k + 2) - place(k + 1)) >
        geometry::squared_length(place(longest + 2) - place(longest + 1)))
      longest = k; // the edge opposite of vertex k
  insert(0.5 * (place(longest + 1) + place(longest + 2)));
  for (const LocalIndex v : worst->vertex)
    if (base_.role[at(v)] == Role::free)
      remove(v);
  list_at_boundary(*worst);
  insert((1.0 / 3) * (place(0) + place(1) + place(2)));
  std::vector<LocalIndex> neighbours;
  for (const LocalIndex v : worst->vertex) {
    base_.mesh.collect_ring(v, neighbours);
    if (base_.role[at(v)] == Role::free && base_.boundary[at(v)].site < 0 && neighbours.size() >= 7)
      for (std::size_t k = 0; k < neighbours.size(); k += 2)
        insert(0.5 * (base_.mesh.position(v) + base_.mesh.position(neighbours[k])));
    for (const LocalIndex u : neighbours)
      if (u >= PatchMesh::frame && base_.role[at(u)] == Role::free &&
          (base_.boundary[at(u)].site >= 0 || base_.mesh.degree(u) != 6) &&
          std::find(worst->vertex.begin(), worst->vertex.end(), u) == worst->vertex.end())
        remove(u);
  }
}

/// What may help a triangle with edges on the boundary.
void PatchOptimizer::list_at_boundary(const PatchMesh::Triangle& worst) {
  const Vec2 middle = (1.0 / 3) * (base_.mesh.position(worst.vertex[0]) + base_.mesh.position(worst.vertex[1]) +
                                   base_.mesh.position(worst.vertex[2]));
  for (std::size_t k = 0; k < 3; ++k) {
    const LocalIndex v = worst.vertex[k], next = worst.vertex[(k + 1) % 3], previous = worst.vertex[(k + 2) % 3];
    if (base_.boundary[at(v)].next != next)
      continue;
    operations_.push_back({.divided = {v, -1}});
    operations_.push_back({.divided = {v, -1}, .inserted = middle});
    if (base_.boundary[at(v)].previous != previous)
      continue;
    // A corner with one triangle: a vertex inside must come nearer, or more of them.
    if (base_.role[at(next)] == Role::free && base_.role[at(previous)] == Role::free)
      operations_.push_back({.removed = {next, previous}});
    operations_.push_back({.divided = {v, previous}});
    operations_.push_back({.divided = {v, previous}, .inserted = middle});
  }
}

/// Has the trial a number of sites that is allowed?
bool PatchOptimizer::is_within(const PatchBudget& budget) const {
  const GlobalId removed = std::count(trial_.role.begin(), trial_.role.end(), Role::gone);
  const GlobalId gain = trial_.mesh.vertices() - base_.mesh.vertices() - removed;
  return gain <= budget.may_insert && -gain <= budget.may_delete;
}

/// Carries it out on the trial. @return false if it cannot be done
bool PatchOptimizer::apply(const Operation& operation) {
  for (const LocalIndex v : operation.removed)
    if (v >= 0 && !remove(v))
      return false;
  for (const LocalIndex v : operation.divided)
    if (v >= 0 && !insert_on_boundary(v))
      return false;
  return !operation.inserted || insert(*operation.inserted);
}

/// Divides all edges of the triangles that have a vertex of the worst one: the boundary is too ragged for h there.
bool PatchOptimizer::refine() {
  const PatchMesh::Triangle worst = *worst_triangle();
  const auto is_worst = [&](LocalIndex v) {
    return std::find(worst.vertex.begin(), worst.vertex.end(), v) != worst.vertex.end();
  };
  std::vector<Vec2> middles;
  for (const PatchMesh::Triangle& triangle : base_.mesh.triangles()) {
    if (!counts(base_, triangle) || std::none_of(triangle.vertex.begin(), triangle.vertex.end(), is_worst))
      continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const LocalIndex v = triangle.vertex[k], next = triangle.vertex[(k + 1) % 3];
      if (base_.boundary[at(v)].next == next) {
        if (base_.role[at(v)] < Role::scored || base_.role[at(next)] < Role::scored || !insert_on_boundary(v))
          return false;
      } else if (base_.boundary[at(v)].previous != next) {
        const Vec2 middle = 0.5 * (base_.mesh.position(v) + base_.mesh.position(next));
        if (std::find(middles.begin(), middles.end(), middle) == middles.end())
          middles.push_back(middle);
      }
    }
  }
  if (!divide_where_encroached())
    return false;
  for (const Vec2 middle : middles)
    insert(middle); // where there is room
  return true;
}

/// Divides chords with a vertex of the boundary in their discs.
bool PatchOptimizer::divide_where_encroached() {
  for (LocalIndex v = PatchMesh::frame; v < trial_.mesh.vertices(); ++v) {
    if (trial_.mesh.vertices() > base_.mesh.vertices() + most_refined)
      return false;
    const LocalIndex next = trial_.boundary[at(v)].next;
    if (next < 0 || trial_.role[at(v)] < Role::scored || trial_.role[at(next)] < Role::scored)
      continue;
    for (LocalIndex u = PatchMesh::frame; u < trial_.mesh.vertices(); ++u)
      if (u != v && u != next && trial_.boundary[at(u)].site >= 0 &&
          geometry::diametral_side(trial_.mesh.position(v), trial_.mesh.position(next), trial_.mesh.position(u)) <= 0) {
        if (!insert_on_boundary(v))
          return false;
        v = PatchMesh::frame - 1; // from the beginning
        break;
      }
  }
  return true;
}

/// Does p keep off the discs of all chords?
bool PatchOptimizer::is_clear(const Patch& patch, Vec2 p, double h) const {
  if (!patch.divided)
    return !guard_.correct(p, h, lattice_);
  for (LocalIndex v = PatchMesh::frame; v < patch.mesh.vertices(); ++v)
    if (const LocalIndex next = patch.boundary[at(v)].next;
        next >= 0 && patch.role[at(v)] != Role::gone &&
        geometry::diametral_side(patch.mesh.position(v), patch.mesh.position(next), p) <= 0)
      return false;
  return true;
}

/// Is a new site there far enough from the rim?
bool PatchOptimizer::is_within_reach(Vec2 p, double h) const {
  return geometry::length(p - center_) + PatchOptions::clearance * std::fmax(h, size_) < options_.reach * size_;
}

bool PatchOptimizer::insert(Vec2 place) {
  Vec2 p = lattice_.snap(place);
  if (!is_within_reach(p, size_))
    return false;
  if (trial_.divided)
    return is_clear(trial_, p, size_) && trial_.add(p, size_, {}, Role::free) >= 0;
  if (const auto pushed = guard_.correct(p, size_, lattice_)) { // such as in the corner of a square
    p = lattice_.snap(*pushed);
    if (guard_.correct(p, size_, lattice_) || !is_within_reach(p, size_))
      return false;
  }
  return trial_.add(p, size_, {}, Role::free) >= 0;
}

bool PatchOptimizer::remove(LocalIndex v) {
  const BoundaryVertex& own = trial_.boundary[at(v)];
  if (own.site >= 0) {
    if (own.previous < 0 || own.next < 0 ||
        boundary_.loop_start[at(own.loop) + 1] - boundary_.loop_start[at(own.loop)] < 8)
      return false;
    trial_.boundary[at(own.previous)].next = own.next;
    trial_.boundary[at(own.previous)].changed = true;
    trial_.boundary[at(own.next)].previous = own.previous;
  }
  trial_.role[at(v)] = Role::gone;
  return trial_.mesh.remove(v);
}

bool PatchOptimizer::insert_on_boundary(LocalIndex before) {
  const BoundaryVertex own = trial_.boundary[at(before)];
  const LocalIndex after = own.next;
  if (after < 0)
    return false;
  double end = trial_.boundary[at(after)].arc;
  if (end <= own.arc)
    end += curve_.length(own.loop);
  BoundaryVertex made{own.site, before, after, own.loop, 0.5 * (own.arc + end), own.tolerance, true};
  const BoundaryCurve::Strayed strayed =
      curve_.strayed(own.loop, own.arc, end, {trial_.mesh.position(before), trial_.mesh.position(after)});
  if (strayed.bent && std::fabs(strayed.farthest - made.arc) < most_off_middle * (end - own.arc))
    made.arc = strayed.farthest; // a corner that was left out
  const Vec2 p = boundary_.periods.nearest_image(lattice_.snap(curve_.place(own.loop, made.arc).point), center_);
  if (made.arc >= curve_.length(own.loop))
    made.arc -= curve_.length(own.loop);
  const double h = 0.5 * (trial_.size[at(before)] + trial_.size[at(after)]);
  const LocalIndex v = is_within_reach(p, h) ? trial_.add(p, h, made, Role::free) : -1;
  if (v < 0)
    return false;
  trial_.boundary[at(before)].next = v;
  trial_.boundary[at(before)].changed = true;
  trial_.boundary[at(after)].previous = v;
  trial_.divided = true;
  return true;
}

void PatchOptimizer::relax_vertex(Patch& patch, LocalIndex v) {
  patch.mesh.collect_ring(v, ring_);
  around_.clear();
  for (const LocalIndex u : ring_) {
    if (u < PatchMesh::frame)
      return;
    around_.push_back(patch.mesh.position(u));
  }
  const Vec2 from = patch.mesh.position(v);
  const double h = patch.size[at(v)];
  const EnergyModel model = star_energy_model(from, around_, true);
  Vec2 step = newton_step(model, longest_step * h);
  for (int halving = 0; halving <= halvings; ++halving, step = 0.5 * step) {
    const Vec2 to = lattice_.snap(from + step);
    if (to == from)
      return;
    if (star_energy(to, around_, true) < model.value && is_clear(patch, to, h)) {
      patch.mesh.move(v, to);
      return;
    }
  }
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
  const EnergyModel model = star_energy_model(from, around_, false);
  const Vec2 along = curve_.place(own.loop, own.arc).tangent;
  const double slope = geometry::dot(model.gradient, along);
  const double bend = model.xx * along.x * along.x + 2 * model.xy * along.x * along.y + model.yy * along.y * along.y;
  const double limit =
      std::fmin(longest_slide * patch.size[at(v)], nearest_share * std::fmin(geometry::length(around_.front() - from),
                                                                             geometry::length(around_.back() - from)));
  double step = bend > 0 ? -slope / bend : slope < 0 ? limit : -limit;
  step = std::clamp(step, -limit, limit);
  const double length = curve_.length(own.loop);
  for (int halving = 0; halving <= halvings; ++halving, step *= 0.5) {
    const double arc = own.arc + step;
    const Vec2 to = boundary_.periods.nearest_image(lattice_.snap(curve_.place(own.loop, arc).point), from);
    if (to == from)
      return;
    BoundaryVertex moved = own;
    moved.arc = arc >= length ? arc - length : arc < 0 ? arc + length : arc;
    if (!(star_energy(to, around_, false) < model.value) ||
        !stands_for_curve(moved, patch.boundary[at(own.next)], {to, around_.front()}, patch.size[at(v)]) ||
        !stands_for_curve(patch.boundary[at(own.previous)], moved, {around_.back(), to}, patch.size[at(v)]) ||
        !leaves_discs_empty(patch, v, to))
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

/// Of the chords, when a vertex of the boundary comes to lie elsewhere.
bool PatchOptimizer::leaves_discs_empty(const Patch& patch, LocalIndex v, Vec2 to) const {
  const BoundaryVertex& own = patch.boundary[at(v)];
  const Vec2 behind = patch.mesh.position(own.previous), ahead = patch.mesh.position(own.next);
  for (LocalIndex u = PatchMesh::frame; u < patch.mesh.vertices(); ++u) {
    if (u == v || patch.role[at(u)] == Role::gone)
      continue;
    const Vec2 p = patch.mesh.position(u);
    const LocalIndex next = patch.boundary[at(u)].next;
    if ((u != own.previous && geometry::diametral_side(behind, to, p) <= 0) ||
        (u != own.next && geometry::diametral_side(to, ahead, p) <= 0) ||
        (next >= 0 && next != v && geometry::diametral_side(p, patch.mesh.position(next), to) <= 0))
      return false;
  }
  return true;
}

void PatchOptimizer::relax(Patch& patch, int sweeps, double radius) {
  for (int sweep = 0; sweep < sweeps && !patch.broken; ++sweep)
    for (LocalIndex v = PatchMesh::frame; v < patch.mesh.vertices() && !patch.broken; ++v)
      if (patch.role[at(v)] == Role::free &&
          geometry::squared_length(patch.mesh.position(v) - center_) < radius * radius) {
        if (patch.boundary[at(v)].site >= 0)
          slide_vertex(patch, v);
        else
          relax_vertex(patch, v);
      }
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
  if (strayed.deviation <= unseen * size || length <= longest_bent_ * size)
    return true;
  too_long_ |= length <= bent_at_last * size;
  return false; // the area that is lost grows with the third power of the length
}

/// Has a triangle behind a chord, seen from inside, a vertex that lies inside? It would have crossed the chord.
bool PatchOptimizer::is_crossed(const Patch& patch) const {
  for (const PatchMesh::Triangle& triangle : patch.mesh.triangles())
    for (std::size_t k = 0; k < 3 && triangle.vertex[0] >= 0; ++k) {
      const LocalIndex from = triangle.vertex[k], to = triangle.vertex[(k + 1) % 3],
                       third = triangle.vertex[(k + 2) % 3];
      if (patch.boundary[at(to)].next == from && third >= PatchMesh::frame && patch.boundary[at(third)].site < 0)
        return true;
    }
  return false;
}

/// Is the closed diametral disc of each chord that has changed free, and does it stand for its curve? Is that of
/// each other chord free of what has changed on the boundary? The guard keeps the vertices inside off those.
bool PatchOptimizer::chords_hold(const Patch& patch) const {
  const auto is_moved = [&](LocalIndex u) { // on the boundary
    return patch.boundary[at(u)].site >= 0 &&
           (u >= base_.mesh.vertices() || patch.mesh.position(u) != base_.mesh.position(u));
  };
  for (LocalIndex v = PatchMesh::frame; v < patch.mesh.vertices(); ++v) {
    const BoundaryVertex& own = patch.boundary[at(v)];
    if (patch.role[at(v)] == Role::gone || own.next < 0)
      continue;
    const Vec2 a = patch.mesh.position(v), b = patch.mesh.position(own.next);
    if (own.changed && !stands_for_curve(own, patch.boundary[at(own.next)], {a, b}, patch.size[at(v)]))
      return false;
    for (LocalIndex u = PatchMesh::frame; u < patch.mesh.vertices(); ++u)
      if (u != v && u != own.next && patch.role[at(u)] != Role::gone && (own.changed || is_moved(u)) &&
          geometry::diametral_side(a, b, patch.mesh.position(u)) <= 0)
        return false;
  }
  return !patch.divided || !is_crossed(patch);
}

/// The difference between the sites and the best trial.
void PatchOptimizer::collect_edits(std::vector<SiteEdit>& edits) const {
  for (LocalIndex v = PatchMesh::frame; v < best_.mesh.vertices(); ++v) {
    const bool is_new = v >= base_.mesh.vertices();
    const Vec2 to = best_.mesh.position(v), from = is_new ? to : base_.mesh.position(v);
    const BoundaryVertex& on_boundary = best_.boundary[at(v)];
    if (is_new)
      edits.push_back({to, to, SiteEdit::Kind::insert, on_boundary.site, on_boundary.arc});
    else if (best_.role[at(v)] == Role::gone)
      edits.push_back({from, from, SiteEdit::Kind::remove, on_boundary.site, on_boundary.arc});
    else if (to != from)
      edits.push_back({from, to, SiteEdit::Kind::move, on_boundary.site, on_boundary.arc});
  }
}

/// A few sweeps near the middle. @return the sum then, infinite if there is no hope
double PatchOptimizer::begin_trial(double handicap, const Best& best) {
  double sum = INFINITY;
  for (const double hopeless : hopeless_shares) {
    relax(trial_, 1, near_sweeps * size_);
    sum = handicap * score(trial_).sum;
    if (trial_.broken || !(sum <= hopeless * best.first))
      return INFINITY;
  }
  return sum;
}

/// The other sweeps; keeps the trial if it is better than what there was.
void PatchOptimizer::finish_trial(Patch& trial, double handicap, Best& best) {
  relax(trial, options_.trial_sweeps - static_cast<int>(hopeless_shares.size()), INFINITY);
  if (trial.broken)
    return;
  const Score after = score(trial);
  const double sum = std::fmax(handicap, 1) * after.sum; // a preference makes nothing better that is not
  if (!(handicap * after.sum < best.least) || !(sum < best.first) || after.max > best.before || !chords_hold(trial))
    return;
  best.least = handicap * after.sum;
  best.largest = after.max;
  best.found = true;
  std::swap(best_, trial);
}

/// The trial takes its place among the finalists, if it is good enough for one.
void PatchOptimizer::enter_finals(double sum, double handicap) {
  std::size_t place = finalists_.size();
  while (place > 0 && sum < finalists_[place - 1].sum)
    --place;
  if (place == finalists_.size())
    return;
  std::rotate(finalists_.begin() + static_cast<std::ptrdiff_t>(place), finalists_.end() - 1, finalists_.end());
  finalists_[place].sum = sum;
  finalists_[place].handicap = handicap;
  std::swap(finalists_[place].patch, trial_);
}

void PatchOptimizer::try_everything(const PatchBudget& budget, Best& best) {
  trial_ = base_;
  if (begin_trial(1, best) < INFINITY)
    finish_trial(trial_, 1, best);
  if (best.found && best.largest < options_.operate_alpha)
    return;
  for (Finalist& finalist : finalists_)
    finalist.sum = INFINITY;
  for (const Operation& operation : operations_) {
    trial_ = base_;
    const double handicap = operation.inserts() ? 1 : budget.deletion_handicap;
    if (apply(operation) && is_within(budget))
      enter_finals(begin_trial(handicap, best), handicap);
  }
  for (Finalist& finalist : finalists_)
    if (finalist.sum < INFINITY)
      finish_trial(finalist.patch, finalist.handicap, best);
}

/// Smaller triangles where nothing else helps: more of them, so their largest alpha decides and not the sum.
void PatchOptimizer::try_refining(const PatchBudget& budget, Best& best) {
  trial_ = base_;
  if (!refine() || !is_within(budget))
    return;
  relax(trial_, refine_sweeps, INFINITY);
  if (trial_.broken)
    return;
  const double largest = score(trial_).max;
  if (largest - 1 > (1 - refine_gain) * (best.largest - 1) || !chords_hold(trial_))
    return;
  best.largest = largest;
  best.found = true;
  std::swap(best_, trial_);
}

bool PatchOptimizer::improve(Vec2 center, double size, std::span<const PatchSite> sites, const PatchBudget& budget,
                             std::vector<SiteEdit>& edits) {
  if (!build(center, size, sites)) {
    edits.push_back({center, center, SiteEdit::Kind::none, mesh::free_site, size});
    return false;
  }
  const Score before = score(base_);
  const double least = (1 - least_gain) * before.sum;
  Best best{least, least, before.max, before.max};
  list_operations();
  longest_bent_ = bent_at_first;
  too_long_ = false;
  try_everything(budget, best);
  if (best.largest >= bend_alpha && too_long_) { // rather longer chords on curves than a bad triangle
    longest_bent_ = bent_at_last;
    try_everything(budget, best);
  }
  if (best.largest > refine_alpha && !operations_.empty())
    try_refining(budget, best);
  if (best.found) {
    collect_edits(edits);
    return true;
  }
  edits.push_back({center, center, SiteEdit::Kind::none, mesh::free_site, size});
  if (const PatchMesh::Triangle* worst = worst_triangle())
    for (const LocalIndex v : worst->vertex)
      edits.push_back({base_.mesh.position(v), base_.mesh.position(v), SiteEdit::Kind::none});
  return false;
}

} // namespace trime::meshing
