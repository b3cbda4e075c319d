// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/patch_contest.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trime::cleanup {
namespace {

using Rules = CleanupRules;

// [sweeps] Of a trial with smaller triangles. Half of them decide whether it is given up.
constexpr int refine_sweeps = 20;
// [sweeps] Near the middle, of moves alone, which operations that come first have to beat.
constexpr int first_sweeps = 2;
// [alpha] Triangles below it have no angle that counts as obtuse.
constexpr double least_steep_alpha = 1.2;
constexpr std::size_t few_runners = 3; // [operations] That go beyond the first sweep in other trials

/// Returns the squared difference of the degree of an inner vertex from 6.
int strain(const Patch& patch, LocalIndex v) {
  if (v >= patch.mesh.vertices() || patch.on_boundary(v) || patch.is_gone(v))
    return 0;
  const int excess = patch.mesh.degree(v) - 6;
  return excess * excess;
}

/// The corners of a triangle from the largest index on, however the triangulation stores them.
Corners largest_first(Corners corners) {
  std::rotate(corners.begin(), std::max_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// Looks for the worst triangle within two sizes of a place. @return whether an operation may help it; then it becomes
/// the triangle of the place
bool find_worst(const Patch& patch, double above, BadPlace& place) {
  const double reach = 4 * place.size * place.size;
  double worst = above;
  for (const PatchMesh::Triangle& triangle : patch.mesh.triangles()) {
    const Corners corners = triangle.vertex[0] < 0 ? triangle.vertex : largest_first(triangle.vertex);
    if (corners[0] < 0 || patch.is_surely_below(worst, corners) || !patch.counts(triangle) ||
        !(geometry::squared_length(patch.middle_of(corners) - place.middle) < reach))
      continue;
    if (const double alpha = patch.alpha(corners); alpha > worst) {
      worst = place.alpha = alpha;
      place.corners = corners;
    }
  }
  if (!(worst > above))
    return false;
  place.middle = patch.middle_of(place.corners);
  return true;
}

/// Looks for the obtuse triangle nearest to a place, within two sizes. @return whether there is one; then it becomes
/// the triangle of the place
bool find_obtuse(const Patch& patch, BadPlace& place) {
  double least = 4 * place.size * place.size;
  bool found = false;
  for (const PatchMesh::Triangle& triangle : patch.mesh.triangles()) {
    const Corners corners = triangle.vertex[0] < 0 ? triangle.vertex : largest_first(triangle.vertex);
    if (corners[0] < 0 || patch.is_surely_below(least_steep_alpha, corners) || !patch.counts(triangle) ||
        !(patch.least_cotangent(corners) < CleanupRules::obtuse_cotangent))
      continue;
    const double distance = geometry::squared_length(patch.middle_of(corners) - place.middle);
    if (distance < least) {
      least = distance;
      place.corners = corners;
      place.alpha = patch.alpha(corners);
      found = true;
    }
  }
  return found;
}

} // namespace

void PatchScore::list_near(const Patch& now, const BadPlace& place) {
  nearest_.clear();
  near_.clear();
  in_score_.assign(at(now.mesh.vertices()), 0);
  const auto is_within = [&](double squared, double reach) {
    return squared < reach * reach * place.size * place.size;
  };
  for (LocalIndex v = PatchMesh::frame; v < now.mesh.vertices(); ++v) {
    if (now.is_gone(v))
      continue;
    const double squared = geometry::squared_length(now.mesh.position(v) - place.middle);
    if (!is_within(squared, obtuse_weight_ > 0 ? Rules::score_reach_if_obtuse : Rules::score_reach))
      continue;
    in_score_[at(v)] = now.role[at(v)] >= VertexRole::scored;
    if (now.is_behind_wall(place.middle, now.mesh.position(v)))
      continue; // the other side feels little of what happens on this one: sites on walls only slide
    if (now.role[at(v)] != VertexRole::free ||
        !is_within(squared, obtuse_weight_ > 0 ? Rules::near_reach_if_obtuse : Rules::near_reach))
      continue;
    near_.push_back(v);
    if (is_within(squared, CleanupRules::nearest_reach))
      nearest_.push_back(v);
  }
}

void PatchScore::add(AlphaScore& score, const Patch& patch, const Corners& corners) const {
  const double alpha = patch.alpha(corners);
  score.add(alpha, bad_alpha_);
  if (obtuse_weight_ > 0 && alpha > least_steep_alpha)
    score.add_angle(patch.least_cotangent(corners), obtuse_weight_);
}

AlphaScore PatchScore::begin(Patch& now, const BadPlace& place, double obtuse_weight) {
  obtuse_weight_ = obtuse_weight;
  list_near(now, place);
  const std::span<const PatchMesh::Triangle> triangles = now.mesh.triangles();
  terms_.clear();
  has_term_.assign(triangles.size(), 0);
  AlphaScore all;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Corners& vertex = triangles[t].vertex;
    if (vertex[0] < 0 || !(in_score_[at(vertex[0])] | in_score_[at(vertex[1])] | in_score_[at(vertex[2])]))
      continue;
    AlphaScore own;
    if (now.counts(triangles[t]))
      add(own, now, vertex);
    terms_.push_back({vertex, static_cast<LocalIndex>(t), own.sum});
    has_term_[t] = 1;
    all.sum += own.sum;
    all.max = std::max(all.max, own.max);
    all.obtuse += own.obtuse;
  }
  now.mesh.forget_changes();
  return all;
}

/// New vertices count as moved, too.
void PatchScore::mark_moved(const Patch& now, const Patch& trial) {
  has_moved_.assign(at(trial.mesh.vertices()), 1);
  std::fill_n(has_moved_.begin(), now.mesh.vertices(), 0);
  for (const LocalIndex v : near_)
    has_moved_[at(v)] = trial.mesh.position(v) != now.mesh.position(v);
}

/// The terms that the trial shares with the patch; the other triangles begin the list of those that have changed.
double PatchScore::sum_of_unchanged(const Patch& trial) {
  const std::span<const PatchMesh::Triangle> triangles = trial.mesh.triangles();
  double sum = 0;
  changed_.clear();
  for (const Term& term : terms_) {
    const auto& [a, b, c] = term.vertex;
    const Corners& vertex = triangles[at(term.triangle)].vertex;
    if (((vertex[0] ^ a) | (vertex[1] ^ b) | (vertex[2] ^ c)) == 0 &&
        !(has_moved_[at(a)] | has_moved_[at(b)] | has_moved_[at(c)]))
      sum += term.value;
    else
      changed_.push_back(term.triangle);
  }
  return sum;
}

/// Adds the triangles without a term, in ascending order, each once.
void PatchScore::list_changed(const Patch& trial) {
  const std::ptrdiff_t with_term = std::ssize(changed_); // in ascending order
  for (const LocalIndex t : trial.mesh.changed())
    if (at(t) >= has_term_.size() || !has_term_[at(t)])
      changed_.push_back(t);
  std::sort(changed_.begin() + with_term, changed_.end());
  std::inplace_merge(changed_.begin(), changed_.begin() + with_term, changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
}

double PatchScore::sum(const Patch& now, const Patch& trial) {
  mark_moved(now, trial);
  const double unchanged = sum_of_unchanged(trial);
  list_changed(trial);
  AlphaScore changed;
  for (const LocalIndex t : changed_) {
    const PatchMesh::Triangle& triangle = trial.mesh.triangles()[at(t)];
    if (triangle.vertex[0] >= 0 && is_near(triangle.vertex) && trial.counts(triangle))
      add(changed, trial, triangle.vertex);
  }
  return unchanged + changed.sum;
}

AlphaScore PatchScore::score(const Patch& trial) const {
  AlphaScore score;
  for (const PatchMesh::Triangle& triangle : trial.mesh.triangles())
    if (triangle.vertex[0] >= 0 && is_near(triangle.vertex) && trial.counts(triangle))
      add(score, trial, triangle.vertex);
  return score;
}

PatchContest::PatchContest(const PatchStart& start, PatchChords& chords, PatchMover& mover, const PatchOptions& options)
    : operate_alpha_(options.operate_alpha), chords_(chords), mover_(mover), editor_(start, chords),
      refiner_(chords, editor_), score_(options.bad_alpha), trial_(start.patch()), best_(start.patch()),
      runners_(Rules::runners_at_last, Runner{start.patch()}),
      finalists_(Rules::finalists_at_last, Runner{start.patch()}) {}

BadPlace PatchContest::place_of(const Patch& now, const Corners& worst) const {
  BadPlace place{worst, now.middle_of(worst), now.alpha(worst), 0};
  for (const LocalIndex v : worst)
    place.size += now.size[at(v)] / 3;
  return place;
}

bool PatchContest::hold(Patch& now, const Corners& worst, const PatchBudget& budget, Turn turn) {
  const BadPlace place = place_of(now, worst);
  const bool is_first = turn == Turn::before_moves;
  is_against_obtuse_ = budget.obtuse_weight > 0;
  is_thorough_ = is_against_obtuse_ || now.has_wall(worst) ||
                 (!is_first && place.alpha > (budget.is_again ? budget.again_alpha : Rules::very_bad_alpha));
  mover_.set_thorough(is_thorough_);
  mover_.set_against_obtuse(is_against_obtuse_);
  chords_.allow(place.alpha >= Rules::bend_alpha ? Rules::bent_at_last : Rules::bent_at_first);
  const AlphaScore before = score_.begin(now, place, budget.obtuse_weight);
  if (!is_first && !is_against_obtuse_ && !is_worth(now, place, before.max, budget))
    return false;
  const double first = (1 - Rules::least_gain) * before.sum;
  const double most = is_against_obtuse_                        ? std::max(before.max, Rules::alpha_for_obtuse)
                      : now.has_wall(worst) && !budget.is_again ? before.max + Rules::rise_at_curves
                                                                : before.max;
  Bar bar{first, first, most, most, before.obtuse};
  if (is_first && !set_bar_by_moves(now, bar))
    return false;
  operations_.list(now, place, is_thorough_);
  if (is_against_obtuse_)
    operations_.list_against_obtuse(now, place);
  try_operations(now, place, budget, bar);
  if (!bar.found && (is_against_obtuse_ ? budget.is_last : !is_first && now.has_wall(worst))) {
    try_pairs(place, budget, bar);
    score_.begin(now, place, budget.obtuse_weight); // pairs score other patches, which may have more vertices
  }
  const double least_bad = budget.is_again ? Rules::refine_alpha : Rules::refine_alpha_at_first;
  if (!is_first && !is_against_obtuse_ && std::fmin(place.alpha, bar.largest) > least_bad && !operations_.all().empty())
    try_refining(now, place, budget, bar);
  if (bar.found)
    std::swap(now, best_);
  return bar.found;
}

/// An operation with moves has to be better than the same moves alone. @return false if these do
bool PatchContest::set_bar_by_moves(const Patch& now, Bar& bar) {
  Patch& moved = runners_.front().patch;
  moved = now;
  for (int sweep = 0; sweep < first_sweeps; ++sweep)
    relax_near(now, moved, score_.nearest());
  for (int sweep = 0; sweep < Rules::trial_sweeps; ++sweep)
    relax_near(now, moved, score_.near());
  if (moved.broken || !chords_.hold(moved))
    return true;
  const AlphaScore after = score_.score(moved);
  bar.first = bar.least = std::min(bar.first, (1 - Rules::least_gain) * after.sum);
  bar.before = bar.largest = std::min(bar.before, after.max);
  return after.max > operate_alpha_;
}

/// Next to a worse triangle, and along the boundary, a slightly bad one hardly ever improves. In a patch that is tried
/// again, hardly any improves unless it must be refined.
bool PatchContest::is_worth(const Patch& now, const BadPlace& place, double largest_near,
                            const PatchBudget& budget) const {
  constexpr double as_bad = 1 + 1e-12; // alpha of one triangle, from whichever corner on
  if (largest_near <= as_bad * place.alpha)
    return true;
  const auto on_boundary = static_cast<std::size_t>(
      std::count_if(place.corners.begin(), place.corners.end(), [&](LocalIndex v) { return now.on_boundary(v); }));
  return place.alpha > (budget.is_again ? Rules::refine_alpha : Rules::least_beside_worse[on_boundary]);
}

/// Is the number of sites of the trial allowed?
bool PatchContest::is_within(GlobalId may_insert, const PatchBudget& budget) const {
  return trial_.gain <= may_insert && -trial_.gain <= budget.may_delete;
}

/// One sweep over those of the list and the new ones.
void PatchContest::relax_near(const Patch& now, Patch& trial, std::span<const LocalIndex> near) {
  mover_.relax(trial, near);
  for (LocalIndex v = now.mesh.vertices(); v < trial.mesh.vertices(); ++v)
    mover_.relax(trial, {&v, 1});
}

/// One more sweep near the middle; then the trial enters the list, if there is hope and it is good enough for that.
/// @param hopeless_sum a trial above it is given up
void PatchContest::run(const Patch& now, Patch& trial, double handicap, double hopeless_sum, std::span<Runner> list) {
  relax_near(now, trial, score_.nearest());
  if (trial.broken)
    return;
  const double sum = handicap * score_.sum(now, trial);
  if (sum <= hopeless_sum && sum < list.back().sum && chords_.hold(trial))
    enter(list, trial, sum, handicap);
}

/// The trial takes its place in a list by sum, the last one falls out. @pre it is better than that
void PatchContest::enter(std::span<Runner> list, Patch& trial, double sum, double handicap) {
  auto place = list.end() - 1;
  while (place != list.begin() && sum < (place - 1)->sum)
    --place;
  std::rotate(place, list.end() - 1, list.end());
  place->sum = sum;
  place->handicap = handicap;
  std::swap(place->patch, trial);
}

/// @return the sum after the other sweeps, infinite if the trial was given up
double PatchContest::last_sweeps(const Patch& now, const Runner& finalist, Patch& trial, double hopeless_sum) {
  double last = INFINITY;
  const int sweeps = is_against_obtuse_ ? Rules::obtuse_sweeps : (is_thorough_ ? 2 : 1) * Rules::trial_sweeps;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    relax_near(now, trial, score_.near());
    if (trial.broken)
      return INFINITY;
    const double before = std::exchange(last, score_.sum(now, trial));
    if (!(finalist.handicap * last < hopeless_sum))
      return INFINITY;
    if (!is_thorough_ && last > Rules::least_fall * before)
      break;
  }
  return last;
}

/// The last sweeps; keeps the trial if it is better than what there was.
void PatchContest::finish(const Patch& now, Runner& finalist, Bar& bar) {
  Patch& trial = finalist.patch;
  if (!(last_sweeps(now, finalist, trial, Rules::hopeless_at_last * bar.least) < INFINITY))
    return;
  const AlphaScore after = score_.score(trial);
  const double sum = std::fmax(finalist.handicap, 1) * after.sum; // a preference makes nothing better that is not
  if (!(finalist.handicap * after.sum < bar.least) || !(sum < bar.first) || after.max > bar.before ||
      (bar.obtuse > 0 && !(after.obtuse < bar.obtuse)) || !chords_.hold(trial))
    return;
  bar.least = finalist.handicap * after.sum;
  bar.largest = after.max;
  bar.found = true;
  std::swap(best_, trial);
}

/// Returns by how much the operation has raised the sum of (degree - 6)^2 over the inner vertices. Few degrees are not
/// 6 in a good mesh; moves cannot repair them.
int PatchContest::strain_added(const Patch& now, const PatchOperation& operation) {
  touched_.clear();
  const auto touch_around = [&](const Patch& patch, LocalIndex v) {
    patch.mesh.collect_ring(v, ring_);
    ring_.push_back(v);
    for (const LocalIndex u : ring_)
      if (u >= PatchMesh::frame && std::find(touched_.begin(), touched_.end(), u) == touched_.end())
        touched_.push_back(u);
  };
  for (const LocalIndex v : operation.removed)
    if (v >= 0)
      touch_around(now, v);
  for (LocalIndex v = now.mesh.vertices(); v < trial_.mesh.vertices(); ++v)
    touch_around(trial_, v);
  int added = 0;
  for (const LocalIndex v : touched_)
    added += strain(trial_, v) - strain(now, v);
  return added;
}

/// Places for the best trials, all of them free.
std::span<PatchContest::Runner> PatchContest::best_of(std::vector<Runner>& all, std::size_t most) {
  for (Runner& runner : all)
    runner.sum = INFINITY;
  return std::span(all).first(most);
}

void PatchContest::try_operations(const Patch& now, const BadPlace& place, const PatchBudget& budget, Bar& bar) {
  const bool is_wide = is_against_obtuse_ && budget.is_last;
  const std::span<Runner> runners = best_of(runners_, is_wide        ? Rules::runners_at_last
                                                      : is_thorough_ ? Rules::runners
                                                                     : few_runners),
                          finalists = best_of(finalists_, is_wide        ? Rules::finalists_at_last
                                                          : is_thorough_ ? Rules::finalists
                                                                         : Rules::few_finalists);
  const double no_others_below = (is_thorough_ ? Rules::excellent_if_thorough : Rules::excellent) * bar.first;
  const double patience = !is_thorough_ ? 1 : budget.is_again ? Rules::patience_again : Rules::patience;
  for (const PatchOperation& operation : operations_.all()) {
    trial_ = now;
    const double handicap = operation.inserts() ? 1 : budget.deletion_handicap;
    if (editor_.apply(trial_, operation, place.size) && is_within(budget.may_insert, budget) &&
        (is_thorough_ || strain_added(now, operation) <= Rules::most_strain))
      run(now, trial_, handicap, patience * Rules::hopeless_at_first * bar.first, runners);
    if (runners.front().sum < no_others_below)
      break;
  }
  for (Runner& runner : runners)
    if (runner.sum < INFINITY)
      run(now, runner.patch, runner.handicap, patience * Rules::hopeless_then * bar.first, finalists);
  for (Runner& finalist : finalists)
    if (finalist.sum < INFINITY)
      finish(now, finalist, bar);
}

/// Adds second operations to the best trials of a contest that nobody won, at the obtuse triangle that each has left.
void PatchContest::try_pairs(const BadPlace& place, const PatchBudget& budget, Bar& bar) {
  first_of_two_.clear();
  for (const Runner& finalist : finalists_)
    if (finalist.sum < INFINITY && !finalist.patch.broken && first_of_two_.size() < Rules::first_of_two)
      first_of_two_.push_back(finalist.patch);
  for (Patch& first : first_of_two_) {
    BadPlace second = place;
    if (!(is_against_obtuse_ ? find_obtuse(first, second) : find_worst(first, operate_alpha_, second)))
      continue;
    score_.begin(first, is_against_obtuse_ ? second : place, budget.obtuse_weight);
    operations_.list(first, second, is_thorough_);
    if (is_against_obtuse_)
      operations_.list_against_obtuse(first, second);
    try_operations(first, second, budget, bar);
    if (bar.found)
      return;
  }
}

/// Smaller triangles: more of them, so their largest alpha decides and not the sum.
void PatchContest::try_refining(const Patch& now, const BadPlace& place, const PatchBudget& budget, Bar& bar) {
  trial_ = now;
  if (!refiner_.refine(now, trial_, place) || !is_within(std::max(budget.may_insert, budget.may_refine), budget))
    return;
  for (int sweep = 0; sweep < refine_sweeps; ++sweep) {
    relax_near(now, trial_, score_.near());
    if (trial_.broken || (sweep == refine_sweeps / 2 && !(score_.score(trial_).max < bar.largest)))
      return;
  }
  const double largest = score_.score(trial_).max;
  if (largest - 1 > (1 - Rules::refine_gain) * (bar.largest - 1) || !chords_.hold(trial_))
    return;
  bar.largest = largest;
  bar.found = true;
  std::swap(best_, trial_);
}

} // namespace trime::cleanup
