// SPDX-License-Identifier: BSD-3-Clause
// The contest of the operations at a bad triangle: which are tried how far, and which one is kept.
#include "meshing/patch.hpp"

#include "trime/mesh/quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace trime::meshing {
namespace {

using geometry::Vec2;

constexpr double least_gain = 0.02;
/// After each of the first sweeps a trial is given up that is so much worse than what it has to be, and in the last
/// ones if it is than the best.
constexpr double hopeless_at_first = 2.5, hopeless_then = 1.2, hopeless_at_last = 1.1;
constexpr double least_fall = 0.97; // of the sum, in a last sweep: then one more is worth it; all where is_thorough_
/// Of what a trial has to be: no others are tried then. The second where is_thorough_.
constexpr double excellent = 0.7, excellent_if_thorough = 0.6;
constexpr double nearest_reach = 2, near_reach = 2.8; // h: sites that move in the first sweeps, and in the last
constexpr double score_reach = 4;                     // h: triangles of sites that count
constexpr double bent_at_first = 1.01, bent_at_last = 1.25, bend_alpha = 1.1; // see patch_moves.cpp
constexpr double refine_gain = 0.01; // of the excess of alpha: the next try begins at what is worst then
/// Smaller triangles take many sites: the worst places come first.
constexpr double refine_alpha_at_first = 1.45, refine_alpha = 1.3;
constexpr int refine_sweeps = 20;
constexpr std::size_t few_runners = 3, few_finalists = 2;
constexpr double middle_reach = 1.5; // h
/// Alpha from which a triangle with 0, 1, 2, 3 vertices on the boundary is worth a contest beside a worse one.
constexpr std::array<double, 4> least_beside_worse{1.1, 1.1, 1.12, 1.15};
constexpr int most_tried = 200; // triangles
constexpr int most_strain = 2;  // see strain_added: one winner in twenty adds more, and every third operation
constexpr double patience = 2;  // factor on what is hopeless, for very bad triangles

} // namespace

/// Where a site is missing or one too many, moves alone would spread what is wrong until no triangle is bad enough for
/// an operation: there operations come first. Each has to be better than such moves.
void PatchOptimizer::operate_first(const PatchBudget& budget) {
  longest_bent_ = bent_at_first;
  tried_.clear();
  bad_is_known_ = false;
  for (int k = 0; k < most_tried; ++k) {
    const std::optional<Corners> worst = worst_untried(options_.first_alpha);
    if (!worst)
      return;
    if (!try_at(*worst, budget, true))
      tried_.push_back(*worst);
  }
}

/// From the worst triangle on, each once, and as long as something helps.
void PatchOptimizer::operate(const PatchBudget& budget) {
  tried_.clear();
  bad_is_known_ = false;
  for (int k = 0; k < most_tried; ++k) {
    const std::optional<Corners> worst = worst_untried(budget.is_again ? budget.again_alpha : options_.operate_alpha);
    if (!worst)
      return;
    if (try_at(*worst, budget, false))
      continue;
    if (!is_settled(*worst))
      tried_.push_back(*worst);
    else
      for (const LocalIndex v : *worst)
        rests_[at(v)] = 1;
  }
}

/// Of the triangles in the middle of the patch that are left for operations.
std::optional<PatchOptimizer::Corners> PatchOptimizer::worst_untried(double above) {
  if (!bad_is_known_)
    list_bad(above);
  const Bad* worst = nullptr;
  for (const Bad& bad : bad_)
    if ((!worst || bad.alpha > worst->alpha) && !rest(bad.corners) && !is_tried(bad.corners))
      worst = &bad;
  return worst ? std::optional(worst->corners) : std::nullopt;
}

/// The triangles in the middle that are worse, whatever way the triangulation holds them.
void PatchOptimizer::list_bad(double above) {
  bad_.clear();
  bad_is_known_ = true;
  for (const PatchMesh::Triangle& triangle : now_.mesh.triangles()) {
    const auto& vertex = triangle.vertex;
    if (vertex[0] < 0 || !is_in_core(middle_of(now_, vertex)) ||
        mesh::is_surely_below(above, now_.mesh.position(vertex[0]), now_.mesh.position(vertex[1]),
                              now_.mesh.position(vertex[2])) ||
        !counts(now_, triangle))
      continue;
    if (const double its_alpha = alpha(now_, triangle); its_alpha > above)
      bad_.push_back({largest_first(vertex), its_alpha});
  }
}

/// @param is_first before all moves @return whether something helped
bool PatchOptimizer::try_at(const Corners& worst, const PatchBudget& budget, bool is_first) {
  Contest contest{worst, middle_of(now_, worst), alpha(now_, {worst, {}}), 0, 0, 0, 0, 0};
  for (const LocalIndex v : worst)
    contest.size += now_.size[at(v)] / 3;
  place_size_ = contest.size;
  is_thorough_ = !is_first && contest.alpha > (budget.is_again ? budget.again_alpha : options_.very_bad_alpha);
  // Rather longer chords on curves than a bad triangle.
  longest_bent_ = contest.alpha >= bend_alpha ? bent_at_last : bent_at_first;
  list_near(contest);
  const Score before = note_terms();
  if (!is_first && !is_worth(contest, before.max, budget))
    return false;
  contest.first = contest.least = (1 - least_gain) * before.sum;
  contest.before = contest.largest = before.max;
  if (is_first && !set_bar_by_moves(contest))
    return false;
  list_operations(contest);
  try_everything(budget, contest);
  const double least_bad = budget.is_again ? refine_alpha : refine_alpha_at_first;
  if (!is_first && std::fmin(contest.alpha, contest.largest) > least_bad && !operations_.empty())
    try_refining(budget, contest);
  if (contest.found) {
    std::swap(now_, best_);
    bad_is_known_ = false;
    wake_moved(best_);
    for (const LocalIndex v : near_)
      rests_[at(v)] = 0;
  }
  return contest.found;
}

/// An operation with moves has to be better than the same moves alone. @return false if these do
bool PatchOptimizer::set_bar_by_moves(Contest& contest) {
  Runner& moves = runners_.front();
  moves.patch = now_;
  for (int sweep = 0; sweep < 2; ++sweep)
    relax_near(moves.patch, nearest_);
  for (int sweep = 0; sweep < options_.trial_sweeps; ++sweep)
    relax_near(moves.patch, near_);
  if (moves.patch.broken || !chords_hold(moves.patch))
    return true;
  const Score after = score_near(moves.patch);
  contest.first = contest.least = std::min(contest.first, (1 - least_gain) * after.sum);
  contest.before = contest.largest = std::min(contest.before, after.max);
  return after.max > options_.operate_alpha;
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

/// Beside a worse triangle, and along the boundary, a slightly bad one hardly ever becomes better; in a patch that is
/// tried again hardly any that is not to be refined.
bool PatchOptimizer::is_worth(const Contest& contest, double largest_near, const PatchBudget& budget) const {
  constexpr double as_bad = 1 + 1e-12; // alpha of one triangle, from whichever corner on
  if (largest_near <= as_bad * contest.alpha)
    return true;
  const auto on_boundary = static_cast<std::size_t>(
      std::count_if(contest.corners.begin(), contest.corners.end(), [&](LocalIndex v) { return now_.on_boundary(v); }));
  return contest.alpha > (budget.is_again ? refine_alpha : least_beside_worse[on_boundary]);
}

/// What each triangle near the place of the trials adds to the sum now. @return all of it, as score_near
PatchOptimizer::Score PatchOptimizer::note_terms() {
  const std::span<const PatchMesh::Triangle> triangles = now_.mesh.triangles();
  terms_.clear();
  is_noted_.assign(triangles.size(), 0);
  Score all;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& vertex = triangles[t].vertex;
    if (vertex[0] < 0 || !(in_score_[at(vertex[0])] | in_score_[at(vertex[1])] | in_score_[at(vertex[2])]))
      continue;
    Score score;
    if (counts(now_, triangles[t]))
      add_to(score, alpha(now_, triangles[t]));
    terms_.push_back({vertex, static_cast<LocalIndex>(t), score.sum});
    is_noted_[t] = 1;
    all.sum += score.sum;
    all.max = std::max(all.max, score.max);
  }
  now_.mesh.forget_changes();
  return all;
}

/// As score_near, for a trial: most of its triangles are those of now_. Of triangles on the boundary with all vertices,
/// it does not see when a chord that has come or gone turns them inside out; score_near has the last word.
double PatchOptimizer::sum_near(const Patch& patch) {
  const std::span<const PatchMesh::Triangle> triangles = patch.mesh.triangles();
  mark_.assign(at(patch.mesh.vertices()), 1); // new ones count, too
  std::fill_n(mark_.begin(), now_.mesh.vertices(), 0);
  for (const LocalIndex v : near_)
    mark_[at(v)] = patch.mesh.position(v) != now_.mesh.position(v);
  double sum = 0;
  other_.clear();
  for (const Term& term : terms_) {
    const auto& [a, b, c] = term.vertex;
    const auto& vertex = triangles[at(term.triangle)].vertex;
    if (((vertex[0] ^ a) | (vertex[1] ^ b) | (vertex[2] ^ c)) == 0 && !(mark_[at(a)] | mark_[at(b)] | mark_[at(c)]))
      sum += term.value;
    else
      other_.push_back(term.triangle);
  }
  const std::ptrdiff_t noted = std::ssize(other_); // in ascending order
  for (const LocalIndex t : patch.mesh.changed())
    if (at(t) >= is_noted_.size() || !is_noted_[at(t)])
      other_.push_back(t);
  std::sort(other_.begin() + noted, other_.end());
  std::inplace_merge(other_.begin(), other_.begin() + noted, other_.end());
  const auto end = std::unique(other_.begin(), other_.end());
  const auto is_near = [&](LocalIndex v) { return at(v) >= in_score_.size() || in_score_[at(v)]; };
  Score changed;
  for (auto t = other_.begin(); t != end; ++t) {
    const PatchMesh::Triangle& triangle = triangles[at(*t)];
    const auto& vertex = triangle.vertex;
    if (vertex[0] >= 0 && (is_near(vertex[0]) || is_near(vertex[1]) || is_near(vertex[2])) && counts(patch, triangle))
      add_to(changed, alpha(patch, triangle));
  }
  return sum + changed.sum;
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

/// Has the trial a number of sites that is allowed?
bool PatchOptimizer::is_within(GlobalId may_insert, const PatchBudget& budget) const {
  return trial_.gain <= may_insert && -trial_.gain <= budget.may_delete;
}

/// Those of the list and the new ones.
void PatchOptimizer::relax_near(Patch& patch, std::span<const LocalIndex> near) {
  relax(patch, near);
  for (LocalIndex v = now_.mesh.vertices(); v < patch.mesh.vertices(); ++v)
    relax(patch, {&v, 1});
}

/// One more sweep near the middle; then the trial enters the list, if there is hope and it is good enough for that.
/// @param share of what it has to be in the end, that it may be now
void PatchOptimizer::run(Patch& patch, double handicap, double share, const Contest& contest, std::span<Runner> list) {
  relax_near(patch, nearest_);
  if (patch.broken)
    return;
  const double sum = handicap * sum_near(patch);
  if (sum <= (is_thorough_ ? patience : 1) * share * contest.first && sum < list.back().sum && chords_hold(patch))
    enter(list, patch, sum, handicap);
}

/// The patch takes its place in a list by sum, the last one falls out. @pre it is better than that
void PatchOptimizer::enter(std::span<Runner> list, Patch& patch, double sum, double handicap) {
  auto place = list.end() - 1;
  while (place != list.begin() && sum < (place - 1)->sum)
    --place;
  std::rotate(place, list.end() - 1, list.end());
  place->sum = sum;
  place->handicap = handicap;
  std::swap(place->patch, patch);
}

/// The other sweeps; keeps the trial if it is better than what there was.
void PatchOptimizer::finish(Runner& finalist, Contest& contest) {
  Patch& trial = finalist.patch;
  double last = INFINITY; // sum
  for (int sweep = 0; sweep < (is_thorough_ ? 2 : 1) * options_.trial_sweeps; ++sweep) {
    relax_near(trial, near_);
    if (trial.broken)
      return;
    const double before = std::exchange(last, sum_near(trial));
    if (!(finalist.handicap * last < hopeless_at_last * contest.least))
      return;
    if (!is_thorough_ && last > least_fall * before)
      break;
  }
  const Score after = score_near(trial);
  const double sum = std::fmax(finalist.handicap, 1) * after.sum; // a preference makes nothing better that is not
  if (!(finalist.handicap * after.sum < contest.least) || !(sum < contest.first) || after.max > contest.before ||
      !chords_hold(trial))
    return;
  contest.least = finalist.handicap * after.sum;
  contest.largest = after.max;
  contest.found = true;
  std::swap(best_, trial);
}

/// By how much the operation has raised the sum of (degree - 6)^2 over the vertices inside. Few degrees are not 6 in
/// a good mesh; moves cannot mend them.
int PatchOptimizer::strain_added(const Operation& operation) {
  touched_.clear();
  const auto note = [&] {
    for (const LocalIndex u : ring_)
      if (u >= PatchMesh::frame && std::find(touched_.begin(), touched_.end(), u) == touched_.end())
        touched_.push_back(u);
  };
  for (const LocalIndex v : operation.removed)
    if (v >= 0) {
      now_.mesh.collect_ring(v, ring_);
      ring_.push_back(v);
      note();
    }
  for (LocalIndex v = now_.mesh.vertices(); v < trial_.mesh.vertices(); ++v) {
    trial_.mesh.collect_ring(v, ring_);
    ring_.push_back(v);
    note();
  }
  const auto strain = [](const Patch& patch, LocalIndex v) {
    if (v >= patch.mesh.vertices() || patch.on_boundary(v) || patch.role[at(v)] == Role::gone)
      return 0;
    const int excess = patch.mesh.degree(v) - 6;
    return excess * excess;
  };
  int added = 0;
  for (const LocalIndex v : touched_)
    added += strain(trial_, v) - strain(now_, v);
  return added;
}

/// Few of the operations get the second sweep, fewer the last ones.
void PatchOptimizer::try_everything(const PatchBudget& budget, Contest& contest) {
  const auto best_of = [&](std::vector<Runner>& all, std::size_t few) {
    for (Runner& runner : all)
      runner.sum = INFINITY;
    return std::span(all).first(is_thorough_ ? all.size() : std::min(few, all.size()));
  };
  const std::span<Runner> runners = best_of(runners_, few_runners), finalists = best_of(finalists_, few_finalists);
  const double no_others_below = (is_thorough_ ? excellent_if_thorough : excellent) * contest.first;
  for (const Operation& operation : operations_) {
    trial_ = now_;
    const double handicap = operation.inserts() ? 1 : budget.deletion_handicap;
    if (apply(operation) && is_within(budget.may_insert, budget) &&
        (is_thorough_ || strain_added(operation) <= most_strain))
      run(trial_, handicap, hopeless_at_first, contest, runners);
    if (runners.front().sum < no_others_below)
      break;
  }
  for (Runner& runner : runners)
    if (runner.sum < INFINITY)
      run(runner.patch, runner.handicap, hopeless_then, contest, finalists);
  for (Runner& finalist : finalists)
    if (finalist.sum < INFINITY)
      finish(finalist, contest);
}

/// Smaller triangles where nothing else helps: more of them, so their largest alpha decides and not the sum.
void PatchOptimizer::try_refining(const PatchBudget& budget, Contest& contest) {
  trial_ = now_;
  if (!refine(contest.corners) || !is_within(std::max(budget.may_insert, budget.may_refine), budget))
    return;
  for (int sweep = 0; sweep < refine_sweeps; ++sweep) {
    relax_near(trial_, near_);
    if (trial_.broken || (sweep == refine_sweeps / 2 && !(score_near(trial_).max < contest.largest)))
      return;
  }
  const double largest = score_near(trial_).max;
  if (largest - 1 > (1 - refine_gain) * (contest.largest - 1) || !chords_hold(trial_))
    return;
  contest.largest = largest;
  contest.found = true;
  std::swap(best_, trial_);
}

} // namespace trime::meshing
