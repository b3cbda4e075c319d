// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/patch_optimizer.hpp"

#include "core/random.hpp"
#include "trime/mesh/quality.hpp"

#include <algorithm>

namespace trime::cleanup {
namespace {

using geometry::Vec2;
using Rules = CleanupRules;

constexpr int most_tried = 200; // [triangles] Tried in one patch, at most
// [h] A very bad triangle counts as tried if it lies so near to the middle of its patch.
constexpr double middle_reach = 1.5;

constexpr std::uint8_t of_bad_triangle = 2, beside_one = 1; // marks of vertices

using polygon::EditKind;

} // namespace

/// The boundary site of a vertex; of a new one on the boundary, that of the last old one before it.
BoundaryName PatchReport::site_before(const Patch& now, LocalIndex v) const {
  while (is_new(v) && !now.is_gone(v) && now.on_boundary(v))
    v = now.boundary[at(v)].previous;
  return now.boundary[at(v)].site;
}

/// This bit distinguishes new sites on the boundary from old ones, whose names are indices.
BoundaryName PatchReport::name(const Patch& now, LocalIndex v, std::uint64_t patch) const {
  constexpr BoundaryName new_site = BoundaryName{1} << 62;
  if (!is_new(v) || !now.on_boundary(v))
    return now.boundary[at(v)].site;
  return new_site | static_cast<BoundaryName>(mix_bits(patch + static_cast<std::uint64_t>(v)) >> 2);
}

std::vector<SiteEdit> PatchReport::edits(const Patch& now, std::uint64_t patch) const {
  std::vector<SiteEdit> edits;
  for (LocalIndex v = PatchMesh::frame; v < now.mesh.vertices(); ++v) {
    const bool is_gone = now.is_gone(v);
    const Vec2 to = now.mesh.position(v), from = is_new(v) ? to : start_.patch().mesh.position(v);
    const BoundaryVertex& its = now.boundary[at(v)];
    if (is_new(v) && !is_gone)
      edits.push_back({to, to, EditKind::insert, its.loop, site_before(now, v), name(now, v, patch), its.arc, patch});
    else if (!is_new(v) && is_gone)
      edits.push_back({from, from, EditKind::remove, its.loop, its.site, mesh::free_site, its.arc, patch});
    else if (to != from)
      edits.push_back({from, to, EditKind::move, its.loop, its.site, mesh::free_site, its.arc, patch});
  }
  return edits;
}

std::vector<BoundaryLink> PatchReport::links(const Patch& now, std::uint64_t patch) const {
  std::vector<BoundaryLink> links;
  for (const LocalIndex v : now.rim) {
    const LocalIndex next = now.boundary[at(v)].next;
    if (!now.is_gone(v) && next >= 0 && (start_.has_changed(now, v) || next != start_.patch().boundary[at(v)].next))
      links.push_back({now.mesh.position(v), name(now, v, patch), name(now, next, patch)});
  }
  return links;
}

void PatchReport::find_worst(const Patch& patch, double bad_alpha, std::vector<Badness>& worst) {
  for (const PatchMesh::Triangle& triangle : patch.mesh.triangles()) {
    if (!patch.is_bad(triangle, bad_alpha))
      continue;
    const double alpha = patch.alpha(triangle.vertex);
    const bool obtuse = alpha > mesh::least_obtuse_alpha && patch.is_obtuse(triangle.vertex);
    for (const LocalIndex v : triangle.vertex) {
      worst[at(v)].alpha = std::max(worst[at(v)].alpha, alpha);
      worst[at(v)].obtuse |= static_cast<std::int64_t>(obtuse);
    }
  }
}

bool PatchReport::is_news(const Patch& now, LocalIndex v) const {
  return start_.has_changed(now, v) || worst_after_[at(v)] != worst_before_[at(v)] || rests_.has_changed(v);
}

std::vector<SiteVerdict> PatchReport::verdicts(const Patch& now, double bad_alpha) {
  worst_before_.assign(at(now.mesh.vertices()), {});
  worst_after_.assign(at(now.mesh.vertices()), {});
  find_worst(start_.patch(), bad_alpha, worst_before_);
  find_worst(now, bad_alpha, worst_after_);
  std::vector<SiteVerdict> verdicts;
  for (LocalIndex v = PatchMesh::frame; v < now.mesh.vertices(); ++v)
    if (now.role[at(v)] >= VertexRole::scored && (worst_before_[at(v)].alpha > 0 || worst_after_[at(v)].alpha > 0) &&
        is_news(now, v))
      verdicts.push_back({now.mesh.position(v), now.size[at(v)], worst_after_[at(v)].alpha, rests_.rests(v),
                          worst_after_[at(v)].obtuse});
  return verdicts;
}

Corners PatchWorst::largest_first(Corners corners) {
  std::rotate(corners.begin(), std::max_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

bool PatchWorst::is_tried(const Corners& corners) const {
  return !tried_.empty() && std::find(tried_.begin(), tried_.end(), largest_first(corners)) != tried_.end();
}

std::optional<Corners> PatchWorst::next(const Patch& now) {
  if (!is_listed_)
    list(now);
  const BadTriangle* worst = nullptr;
  for (const BadTriangle& bad : bad_)
    if ((!worst || bad.alpha > worst->alpha) && !rests_.all_rest(bad.corners) && !is_tried(bad.corners))
      worst = &bad;
  return worst ? std::optional(worst->corners) : std::nullopt;
}

void PatchWorst::list(const Patch& now) {
  bad_.clear();
  is_listed_ = true;
  for (const PatchMesh::Triangle& triangle : now.mesh.triangles()) {
    const Corners& vertex = triangle.vertex;
    if (vertex[0] < 0 || !start_.is_in_core(now.middle_of(vertex)) || now.is_surely_below(above_, vertex) ||
        !now.counts(triangle))
      continue;
    if (const double alpha = now.alpha(vertex); alpha > above_ && (!only_obtuse_ || now.is_obtuse(vertex)))
      bad_.push_back({largest_first(vertex), alpha});
  }
}

PatchResult PatchOptimizer::improve(Vec2 center, double size, std::span<const PatchSite> sites,
                                    const PatchBudget& budget, std::uint64_t patch) {
  if (!start_.build(center, size, sites))
    return give_up(sites);
  now_ = start_.patch();
  rests_.start(sites);
  mover_.set_against_obtuse(false);
  if (!budget.is_again)
    operate_first(budget);
  if (budget.obtuse_weight == 0) {
    move_bad_sites();
    rests_.wake_moved(start_.patch(), now_);
  }
  operate(budget);
  let_failures_rest();
  return {report_.edits(now_, patch), report_.links(now_, patch), report_.verdicts(now_, options_.bad_alpha)};
}

/// Nothing can be done here: the sites around the middle are not to ask for it again.
PatchResult PatchOptimizer::give_up(std::span<const PatchSite> sites) const {
  PatchResult result;
  for (const PatchSite& site : sites)
    if (start_.distance(site.position) < Rules::given_up_share * Rules::reach * start_.size())
      result.verdicts.push_back({site.position, site.size, options_.bad_alpha, 1});
  return result;
}

/// Where a site is missing or one too many, moves alone would spread what is wrong until no triangle is bad enough for
/// an operation: there operations come first. Each has to be better than such moves.
void PatchOptimizer::operate_first(const PatchBudget& budget) {
  worst_.begin(options_.first_alpha);
  for (int k = 0; k < most_tried; ++k) {
    const std::optional<Corners> worst = worst_.next(now_);
    if (!worst)
      return;
    if (!try_at(*worst, budget, PatchContest::Turn::before_moves))
      worst_.set_tried(*worst);
  }
}

/// From the worst triangle on, each once, and as long as something helps.
void PatchOptimizer::operate(const PatchBudget& budget) {
  const bool only_obtuse = budget.obtuse_weight > 0;
  worst_.begin(only_obtuse       ? mesh::least_obtuse_alpha
               : budget.is_again ? budget.again_alpha
                                 : options_.operate_alpha,
               only_obtuse);
  for (int k = 0; k < most_tried; ++k) {
    const std::optional<Corners> worst = worst_.next(now_);
    if (!worst)
      return;
    if (try_at(*worst, budget, PatchContest::Turn::after_moves))
      continue;
    if (is_settled(*worst))
      rests_.let_rest(*worst);
    else
      worst_.set_tried(*worst);
  }
}

/// @return whether something helped
bool PatchOptimizer::try_at(const Corners& worst, const PatchBudget& budget, PatchContest::Turn turn) {
  if (!contest_.hold(now_, worst, budget, turn))
    return false;
  worst_.forget();
  rests_.wake_moved(contest_.before(), now_);
  rests_.wake(contest_.near());
  return true;
}

/// Must a triangle that was tried here without success not be tried elsewhere? Very bad ones are tried again, unless
/// they lie in the middle of this patch.
bool PatchOptimizer::is_settled(const Corners& corners) const {
  return now_.alpha(corners) <= Rules::very_bad_alpha ||
         start_.distance(now_.middle_of(corners)) < middle_reach * start_.size();
}

/// The sites of the bad triangles in the middle that stay, except those that may be tried in another patch.
void PatchOptimizer::let_failures_rest() {
  for (const PatchMesh::Triangle& triangle : now_.mesh.triangles())
    if (now_.is_bad(triangle, options_.bad_alpha) && start_.is_in_core(now_.middle_of(triangle.vertex)) &&
        !worst_.is_tried(triangle.vertex))
      rests_.let_rest(triangle.vertex);
}

/// Sweeps over the free sites of bad triangles and their neighbours.
void PatchOptimizer::move_bad_sites() {
  chords_.allow(Rules::bent_at_first);
  mover_.set_thorough(false);
  alphas_.forget();
  AlphaScore before;
  if (!list_movers(before))
    return;
  const AlphaScore first = before;
  double least = first.sum;
  best_ = now_;
  for (int sweep = 0; sweep < Rules::moving_sweeps; ++sweep) {
    mover_.relax(now_, movers_);
    AlphaScore after;
    const bool any = !now_.broken && list_movers(after);
    if (now_.broken || after.max > first.max || !chords_.hold(now_))
      break;
    if (after.sum < least) {
      least = after.sum;
      best_ = now_;
    }
    if (!any || after.sum > (1 - Rules::least_gain) * before.sum)
      break;
    before = after;
  }
  std::swap(now_, best_);
}

/// Marks the sites of bad triangles that do not rest. @return whether there are any
bool PatchOptimizer::mark_bad(AlphaScore& score) {
  mark_.assign(at(now_.mesh.vertices()), 0);
  score = {};
  alphas_.follow(now_);
  bool any = false;
  for (const PatchMesh::Triangle& triangle : now_.mesh.triangles()) {
    if (!now_.counts(triangle))
      continue;
    const double alpha = alphas_.alpha(now_, triangle);
    score.add(alpha, options_.bad_alpha);
    if (alpha > options_.bad_alpha && !rests_.all_rest(triangle.vertex)) {
      any = true;
      for (const LocalIndex v : triangle.vertex)
        mark_[at(v)] = of_bad_triangle;
    }
  }
  return any;
}

/// @param score of the whole patch @return whether there are bad triangles that do not rest
bool PatchOptimizer::list_movers(AlphaScore& score) {
  const bool any = mark_bad(score);
  for (const PatchMesh::Triangle& triangle : now_.mesh.triangles()) {
    const auto& [a, b, c] = triangle.vertex;
    if (a >= 0 && std::max(mark_[at(a)], std::max(mark_[at(b)], mark_[at(c)])) == of_bad_triangle)
      for (const LocalIndex v : triangle.vertex)
        mark_[at(v)] = std::max(mark_[at(v)], beside_one);
  }
  movers_.clear();
  for (LocalIndex v = PatchMesh::frame; v < now_.mesh.vertices(); ++v)
    if (mark_[at(v)] > 0 && now_.role[at(v)] == VertexRole::free)
      movers_.push_back(v);
  return any;
}

} // namespace trime::cleanup
