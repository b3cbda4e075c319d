// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/patch_score.hpp"

#include <algorithm>

namespace trime::cleanup {
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
    if (!is_within(squared, CleanupRules::score_reach))
      continue;
    in_score_[at(v)] = now.role[at(v)] >= VertexRole::scored;
    if (now.role[at(v)] != VertexRole::free || !is_within(squared, CleanupRules::near_reach))
      continue;
    near_.push_back(v);
    if (is_within(squared, CleanupRules::nearest_reach))
      nearest_.push_back(v);
  }
}

AlphaScore PatchScore::begin(Patch& now, const BadPlace& place) {
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
      own.add(now.alpha(vertex), bad_alpha_);
    terms_.push_back({vertex, static_cast<LocalIndex>(t), own.sum});
    has_term_[t] = 1;
    all.sum += own.sum;
    all.max = std::max(all.max, own.max);
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
      changed.add(trial.alpha(triangle.vertex), bad_alpha_);
  }
  return unchanged + changed.sum;
}

AlphaScore PatchScore::score(const Patch& trial) const {
  AlphaScore score;
  for (const PatchMesh::Triangle& triangle : trial.mesh.triangles())
    if (triangle.vertex[0] >= 0 && is_near(triangle.vertex) && trial.counts(triangle))
      score.add(trial.alpha(triangle.vertex), bad_alpha_);
  return score;
}

} // namespace trime::cleanup
