// SPDX-License-Identifier: BSD-3-Clause
// What is tried where moves alone do not help: insertions and deletions inside and on the boundary.
#include "meshing/patch.hpp"

#include "trime/geometry/diametral.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Vec2;

constexpr double least_gain = 0.02;
constexpr std::array<double, 2> hopeless_shares{3, 1.5}; // after each of the first sweeps a trial is given up that is
                                                         // so much worse than what it has to be
constexpr double nearest_reach = 2, near_reach = 3.2;    // h: sites that move in the first sweeps, and in the last
constexpr double score_reach = 4.4;                      // h: triangles of sites that count
constexpr double most_off_middle = 0.3;                  // of a chord, where it is divided
constexpr double push_share = 0.6;                       // of a chord: how far from its middle an insertion keeps
constexpr double bent_at_first = 1.01, bent_at_last = 1.25, bend_alpha = 1.1; // see patch_moves.cpp
constexpr double refine_alpha = 1.3, refine_gain = 0.05;                      // of the excess of alpha
constexpr int refine_sweeps = 20;
constexpr LocalIndex most_refined = 40; // new sites on the boundary
constexpr std::size_t few_finalists = 2;
constexpr double middle_reach = 1.5; // h
constexpr int most_tried = 200;      // triangles
constexpr double divide_alpha = 1.1; // triangles above it may divide chords of the boundary

} // namespace

/// From the worst triangle on, each once, and as long as something helps.
void PatchOptimizer::operate(const PatchBudget& budget) {
  tried_.clear();
  for (int k = 0; k < most_tried; ++k) {
    const std::optional<Corners> worst = worst_untried(budget.is_again ? options_.again_alpha : options_.operate_alpha);
    if (!worst)
      return;
    if (try_at(*worst, budget))
      continue;
    if (!is_settled(*worst))
      tried_.push_back(*worst);
    else
      for (const LocalIndex v : *worst)
        rests_[at(v)] = 1;
  }
}

/// Of the triangles in the middle of the patch that are left for operations.
std::optional<PatchOptimizer::Corners> PatchOptimizer::worst_untried(double above) const {
  std::optional<Corners> worst;
  double largest = above;
  for (const PatchMesh::Triangle& triangle : now_.mesh.triangles()) {
    if (!counts(now_, triangle))
      continue;
    if (const double its_alpha = alpha(now_, triangle);
        its_alpha > largest && !rest(triangle.vertex) && is_in_core(middle_of(now_, triangle.vertex)) &&
        std::find(tried_.begin(), tried_.end(), triangle.vertex) == tried_.end()) {
      worst = triangle.vertex;
      largest = its_alpha;
    }
  }
  return worst;
}

/// @return whether something helped
bool PatchOptimizer::try_at(const Corners& worst, const PatchBudget& budget) {
  Contest contest{worst, middle_of(now_, worst), alpha(now_, {worst, {}}), 0, 0, 0, 0, 0};
  for (const LocalIndex v : worst)
    contest.size += now_.size[at(v)] / 3;
  place_size_ = contest.size;
  is_thorough_ = contest.alpha > (budget.is_again ? options_.again_alpha : options_.very_bad_alpha);
  list_near(contest);
  const Score before = score_near(now_);
  contest.first = contest.least = (1 - least_gain) * before.sum;
  contest.before = contest.largest = before.max;
  list_operations(contest);
  // Rather longer chords on curves than a bad triangle.
  longest_bent_ = contest.alpha >= bend_alpha ? bent_at_last : bent_at_first;
  try_everything(budget, contest);
  if (contest.largest > refine_alpha && !operations_.empty())
    try_refining(budget, contest);
  if (contest.found) {
    std::swap(now_, best_);
    wake_moved(best_);
    for (const LocalIndex v : near_)
      rests_[at(v)] = 0;
  }
  return contest.found;
}

/// Once tried here, is it not to be tried elsewhere? Very bad ones are, from the middle.
bool PatchOptimizer::is_settled(const Corners& corners) const {
  return alpha(now_, {corners, {}}) <= options_.very_bad_alpha ||
         geometry::length(middle_of(now_, corners) - center_) < middle_reach * size_;
}

/// The sites that take part, and those whose triangles count.
void PatchOptimizer::list_near(const Contest& contest) {
  nearest_.clear();
  near_.clear();
  in_score_.assign(at(now_.mesh.vertices()), 0);
  const auto is_within = [&](double squared, double reach) {
    return squared < reach * reach * contest.size * contest.size;
  };
  for (LocalIndex v = PatchMesh::frame; v < now_.mesh.vertices(); ++v) {
    if (now_.role[at(v)] == Role::gone)
      continue;
    const double squared = geometry::squared_length(now_.mesh.position(v) - contest.middle);
    if (!is_within(squared, score_reach))
      continue;
    in_score_[at(v)] = now_.role[at(v)] >= Role::scored;
    if (now_.role[at(v)] != Role::free || !is_within(squared, near_reach))
      continue;
    near_.push_back(v);
    if (is_within(squared, nearest_reach))
      nearest_.push_back(v);
  }
}

/// Over the triangles near the place of the trials.
PatchOptimizer::Score PatchOptimizer::score_near(const Patch& patch) const {
  Score score;
  const auto is_near = [&](LocalIndex v) { return at(v) >= in_score_.size() || in_score_[at(v)]; };
  for (const PatchMesh::Triangle& triangle : patch.mesh.triangles())
    if (triangle.vertex[0] >= 0 && std::any_of(triangle.vertex.begin(), triangle.vertex.end(), is_near) &&
        counts(patch, triangle))
      add_to(score, alpha(patch, triangle));
  return score;
}

/// What may help the worst triangle.
void PatchOptimizer::list_operations(const Contest& contest) {
  operations_.clear();
  const Corners& worst = contest.corners;
  const auto place = [&](std::size_t k) { return now_.mesh.position(worst[k % 3]); };
  const auto insert = [&](Vec2 p) { operations_.push_back({.inserted = p}); };
  const auto remove = [&](LocalIndex v) { operations_.push_back({.removed = {v, -1}}); };
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (geometry::squared_length(place(k + 2) - place(k + 1)) >
        geometry::squared_length(place(longest + 2) - place(longest + 1)))
      longest = k; // the edge opposite of vertex k
  insert(0.5 * (place(longest + 1) + place(longest + 2)));
  for (const LocalIndex v : worst)
    if (now_.role[at(v)] == Role::free)
      remove(v);
  if (contest.alpha > divide_alpha)
    list_at_boundary(contest);
  insert(contest.middle);
  for (const LocalIndex v : worst) {
    now_.mesh.collect_ring(v, ring_);
    if (now_.role[at(v)] == Role::free && !now_.on_boundary(v) && ring_.size() >= 7)
      for (std::size_t k = 0; k < ring_.size(); k += 2)
        insert(0.5 * (now_.mesh.position(v) + now_.mesh.position(ring_[k])));
    for (const LocalIndex u : ring_)
      if (u >= PatchMesh::frame && now_.role[at(u)] == Role::free &&
          (is_thorough_ || (!now_.on_boundary(u) && now_.mesh.degree(u) < 6)) &&
          std::find(worst.begin(), worst.end(), u) == worst.end())
        remove(u);
  }
}

/// What may help a triangle with edges on the boundary.
void PatchOptimizer::list_at_boundary(const Contest& contest) {
  const Corners& worst = contest.corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const LocalIndex v = worst[k], next = worst[(k + 1) % 3], previous = worst[(k + 2) % 3];
    if (!now_.is_chord(v, next))
      continue;
    operations_.push_back({.divided = {v, -1}});
    operations_.push_back({.divided = {v, -1}, .inserted = contest.middle});
    if (!now_.is_chord(previous, v))
      continue;
    // A corner with one triangle: a vertex inside must come nearer, or more of them.
    if (now_.role[at(next)] == Role::free && now_.role[at(previous)] == Role::free)
      operations_.push_back({.removed = {next, previous}});
    operations_.push_back({.divided = {v, previous}});
    operations_.push_back({.divided = {v, previous}, .inserted = contest.middle});
  }
}

/// Has the trial a number of sites that is allowed?
bool PatchOptimizer::is_within(GlobalId may_insert, const PatchBudget& budget) const {
  const GlobalId removed = std::count(trial_.role.begin(), trial_.role.end(), Role::gone);
  const GlobalId gain = trial_.mesh.vertices() - start_.mesh.vertices() - removed;
  return gain <= may_insert && -gain <= budget.may_delete;
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

/// Is a new site there far enough from the rim?
bool PatchOptimizer::is_within_reach(Vec2 p, double h) const {
  return geometry::length(p - center_) + PatchOptions::clearance * std::fmax(h, size_) < options_.reach * size_;
}

/// A chord in whose closed disc p lies.
std::optional<geometry::Segment> PatchOptimizer::entered_disc(const Patch& patch, Vec2 p) const {
  for (LocalIndex v = PatchMesh::frame; v < patch.mesh.vertices(); ++v)
    if (const LocalIndex next = patch.boundary[at(v)].next;
        next >= 0 && patch.role[at(v)] != Role::gone &&
        geometry::diametral_side(patch.mesh.position(v), patch.mesh.position(next), p) <= 0)
      return geometry::Segment{patch.mesh.position(v), patch.mesh.position(next)};
  return std::nullopt;
}

bool PatchOptimizer::insert(Vec2 place) {
  Vec2 p = lattice_.snap(place);
  if (const auto chord = entered_disc(trial_, p)) { // such as in the corner of a square
    p = lattice_.snap(0.5 * (chord->a + chord->b) + push_share * geometry::left_normal(chord->b - chord->a));
    if (entered_disc(trial_, p))
      return false;
  }
  return is_within_reach(p, place_size_) && trial_.add(p, place_size_, {}, Role::free) >= 0;
}

bool PatchOptimizer::remove(LocalIndex v) {
  const BoundaryVertex& own = trial_.boundary[at(v)];
  if (trial_.on_boundary(v)) {
    if (own.previous < 0 || own.next < 0 ||
        boundary_.loop_start[at(own.loop) + 1] - boundary_.loop_start[at(own.loop)] < 8)
      return false;
    trial_.boundary[at(own.previous)].next = own.next;
    trial_.boundary[at(own.previous)].changed = true;
    trial_.boundary[at(own.next)].previous = own.previous;
    const BoundaryVertex &from = trial_.boundary[at(own.previous)], &to = trial_.boundary[at(own.next)];
    if (!stands_for_curve(from, to, {trial_.mesh.position(own.previous), trial_.mesh.position(own.next)},
                          trial_.size[at(own.previous)]))
      return false;
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
  return true;
}

/// Those of the list and the new ones.
void PatchOptimizer::relax_near(Patch& patch, std::span<const LocalIndex> near) {
  relax(patch, near);
  for (LocalIndex v = now_.mesh.vertices(); v < patch.mesh.vertices(); ++v)
    relax(patch, {&v, 1});
}

/// A few sweeps near the middle. @return the sum then, infinite if there is no hope
double PatchOptimizer::begin_trial(double handicap, const Contest& contest) {
  double sum = INFINITY;
  for (const double hopeless : hopeless_shares) {
    relax_near(trial_, nearest_);
    if (trial_.broken)
      return INFINITY;
    sum = handicap * score_near(trial_).sum;
    if (!(sum <= (is_thorough_ ? 1.5 : 1) * hopeless * contest.first) || !chords_hold(trial_))
      return INFINITY;
  }
  return sum;
}

/// The trial takes its place among the finalists, if it is good enough for one.
void PatchOptimizer::enter_finals(double sum, double handicap, std::size_t places) {
  std::size_t place = places;
  while (place > 0 && sum < finalists_[place - 1].sum)
    --place;
  if (place == places)
    return;
  const auto first = finalists_.begin() + static_cast<std::ptrdiff_t>(place);
  const auto end = finalists_.begin() + static_cast<std::ptrdiff_t>(places);
  std::rotate(first, end - 1, end);
  first->sum = sum;
  first->handicap = handicap;
  std::swap(first->patch, trial_);
}

/// The other sweeps; keeps the trial if it is better than what there was.
void PatchOptimizer::finish_trial(Patch& trial, double handicap, Contest& contest) {
  for (int sweep = 0; sweep < (is_thorough_ ? 2 : 1) * options_.trial_sweeps; ++sweep)
    relax_near(trial, near_);
  if (trial.broken)
    return;
  const Score after = score_near(trial);
  const double sum = std::fmax(handicap, 1) * after.sum; // a preference makes nothing better that is not
  if (!(handicap * after.sum < contest.least) || !(sum < contest.first) || after.max > contest.before ||
      !chords_hold(trial))
    return;
  contest.least = handicap * after.sum;
  contest.largest = after.max;
  contest.found = true;
  std::swap(best_, trial);
}

void PatchOptimizer::try_everything(const PatchBudget& budget, Contest& contest) {
  const std::size_t places = is_thorough_ ? finalists_.size() : std::min(few_finalists, finalists_.size());
  for (Finalist& finalist : finalists_)
    finalist.sum = INFINITY;
  for (const Operation& operation : operations_) {
    trial_ = now_;
    const double handicap = operation.inserts() ? 1 : budget.deletion_handicap;
    if (apply(operation) && is_within(budget.may_insert, budget))
      enter_finals(begin_trial(handicap, contest), handicap, places);
  }
  for (Finalist& finalist : finalists_)
    if (finalist.sum < INFINITY)
      finish_trial(finalist.patch, finalist.handicap, contest);
}

/// Smaller triangles where nothing else helps: more of them, so their largest alpha decides and not the sum.
void PatchOptimizer::try_refining(const PatchBudget& budget, Contest& contest) {
  trial_ = now_;
  if (!refine(contest.corners) || !is_within(std::max(budget.may_insert, budget.may_refine), budget))
    return;
  for (int sweep = 0; sweep < refine_sweeps; ++sweep)
    relax_near(trial_, near_);
  if (trial_.broken)
    return;
  const double largest = score_near(trial_).max;
  if (largest - 1 > (1 - refine_gain) * (contest.largest - 1) || !chords_hold(trial_))
    return;
  contest.largest = largest;
  contest.found = true;
  std::swap(best_, trial_);
}

/// Divides all edges of the triangles that have a vertex of the worst one: the boundary is too ragged for h there.
bool PatchOptimizer::refine(const Corners& worst) {
  const auto is_worst = [&](LocalIndex v) { return std::find(worst.begin(), worst.end(), v) != worst.end(); };
  std::vector<Vec2> middles;
  for (const PatchMesh::Triangle& triangle : now_.mesh.triangles()) {
    if (std::none_of(triangle.vertex.begin(), triangle.vertex.end(), is_worst) || !counts(now_, triangle))
      continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const LocalIndex v = triangle.vertex[k], next = triangle.vertex[(k + 1) % 3];
      if (now_.is_chord(v, next)) {
        if (now_.role[at(v)] < Role::scored || now_.role[at(next)] < Role::scored || !insert_on_boundary(v))
          return false;
      } else if (!now_.is_chord(next, v)) {
        const Vec2 middle = 0.5 * (now_.mesh.position(v) + now_.mesh.position(next));
        if (std::find(middles.begin(), middles.end(), middle) == middles.end())
          middles.push_back(middle);
      }
    }
  }
  if (!divide_where_encroached())
    return false;
  for (const Vec2 middle : middles) // where there is room
    if (insert(middle) && is_behind(trial_.mesh.vertices() - 1) && !remove(trial_.mesh.vertices() - 1))
      return false;
  return true;
}

/// Does the vertex lie outside, beyond a chord of the trial? So may the middle of an edge when the boundary comes
/// nearer to its curve.
bool PatchOptimizer::is_behind(LocalIndex v) {
  trial_.mesh.collect_ring(v, ring_);
  for (std::size_t k = 0; k < ring_.size(); ++k) {
    const LocalIndex from = ring_[k], to = ring_[k + 1 == ring_.size() ? 0 : k + 1];
    if (from >= PatchMesh::frame && to >= PatchMesh::frame && trial_.is_chord(to, from))
      return true;
  }
  return false;
}

/// Divides chords with a vertex of the boundary in their discs.
bool PatchOptimizer::divide_where_encroached() {
  for (LocalIndex v = PatchMesh::frame; v < trial_.mesh.vertices(); ++v) {
    if (trial_.mesh.vertices() > now_.mesh.vertices() + most_refined)
      return false;
    const LocalIndex next = trial_.boundary[at(v)].next;
    if (next < 0 || trial_.role[at(v)] < Role::scored || trial_.role[at(next)] < Role::scored)
      continue;
    for (LocalIndex u = PatchMesh::frame; u < trial_.mesh.vertices(); ++u)
      if (u != v && u != next && trial_.role[at(u)] != Role::gone && trial_.on_boundary(u) &&
          geometry::diametral_side(trial_.mesh.position(v), trial_.mesh.position(next), trial_.mesh.position(u)) <= 0) {
        if (!insert_on_boundary(v))
          return false;
        v = PatchMesh::frame - 1; // from the beginning
        break;
      }
  }
  return true;
}

} // namespace trime::meshing
