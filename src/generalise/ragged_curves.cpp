// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/ragged_curves.hpp"

#include "generalise/rules.hpp"
#include "polygon/chord_curve.hpp"
#include "trime/core/types.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trime::generalise {
namespace {

using geometry::Loop;
using geometry::Piece;
using geometry::Vec2;

/// A loop whose vertices go one after the other, those with the least turn first.
class LoopThinner {
public:
  LoopThinner(const Loop& loop, const sizing::SizeField& size, double share) : loop_(loop), n_(loop.pieces.size()) {
    turn_.resize(n_);
    close_.resize(n_);
    for (std::size_t k = 0; k < n_; ++k) {
      turn_[k] = turn_at(k);
      close_[k] = share * sizing::checked_size(size, loop.pieces[k].start);
    }
    mark_ragged();
  }

  /// True if any vertex goes.
  bool thin() {
    std::vector<std::size_t> order(n_);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return turn_[a] < turn_[b]; });
    next_.resize(n_);
    previous_.resize(n_);
    for (std::size_t k = 0; k < n_; ++k) {
      next_[k] = (k + 1) % n_;
      previous_[k] = (k + n_ - 1) % n_;
    }
    std::size_t left = n_;
    for (const std::size_t k : order)
      if (ragged_[k] <= ragged && left > GeneraliseRules::least_vertices && may_go(k)) {
        ragged_[nearer_neighbour(k)] = stays;
        next_[previous_[k]] = next_[k];
        previous_[next_[k]] = previous_[k];
        ragged_[k] = gone;
        --left;
      }
    return left < n_;
  }

  Loop result() const {
    Loop thinned = loop_;
    thinned.pieces.clear();
    for (std::size_t k = 0; k < n_; ++k) {
      if (ragged_[k] == gone)
        continue;
      thinned.pieces.push_back(loop_.pieces[k]);
      if (next_[k] != (k + 1) % n_)
        thinned.pieces.back().end = loop_.pieces[next_[k]].start;
    }
    return thinned;
  }

private:
  static constexpr char ragged = 1, stays = 2, gone = 3;
  std::size_t nearer_neighbour(std::size_t k) const {
    const Vec2 p = vertex(k);
    return squared_length(p - vertex(previous_[k])) < squared_length(p - vertex(next_[k])) ? previous_[k] : next_[k];
  }
  Vec2 vertex(std::size_t k) const { return loop_.pieces[k].start; }

  /// 0 straight on, 2 straight back.
  double turn_at(std::size_t k) const {
    const Piece& before = loop_.pieces[(k + n_ - 1) % n_];
    return 1 - dot(before.tangent(before.length()), loop_.pieces[k].tangent(0));
  }

  /// Vertices from which the curve turns much on a short way.
  void mark_ragged() {
    ragged_.assign(n_, 0);
    std::size_t last = 0;   // the window: vertices k + 1 to last, on the unrolled loop
    std::size_t marked = 0; // vertices below are
    double way = 0, turned = 0;
    for (std::size_t k = 0; k < n_; ++k) {
      if (last < k) {
        last = k;
        way = turned = 0;
      }
      while (last < k + n_ && way + loop_.pieces[last % n_].length() < close_[k]) {
        way += loop_.pieces[last % n_].length();
        ++last;
        turned += turn_[last % n_];
      }
      if (turned > GeneraliseRules::ragged_turn)
        for (marked = std::max(marked, k); marked <= last; ++marked)
          ragged_[marked % n_] = ragged;
      if (last > k) {
        way -= loop_.pieces[k].length();
        turned -= turn_[(k + 1) % n_];
      }
    }
  }

  /// A vertex that no user asked for, between straight pieces of one part, with another near that turns as much.
  bool may_go(std::size_t k) const {
    const Piece &before = loop_.pieces[(k + n_ - 1) % n_], &behind = loop_.pieces[k];
    if (behind.corner || behind.circular || before.circular || before.part != behind.part)
      return false;
    const std::size_t nearer = nearer_neighbour(k);
    const double near = (ragged_[k] == ragged ? 1 : GeneraliseRules::dense_share) * close_[k];
    return turn_[k] <= turn_[nearer] && squared_length(vertex(k) - vertex(nearer)) < near * near;
  }

  const Loop& loop_;
  const std::size_t n_;
  std::vector<double> turn_, close_; // by vertex: 1 - cosine of the turn; the way on which raggedness counts
  std::vector<char> ragged_;         // by vertex
  std::vector<std::size_t> next_, previous_;
};

} // namespace

std::unique_ptr<geometry::Boundary> without_ragged_runs(const geometry::Boundary& boundary,
                                                        const sizing::SizeField& size, double share) {
  std::unique_ptr<geometry::Boundary> result;
  for (std::size_t k = 0; k < boundary.loops.size(); ++k) {
    if (boundary.loops[k].pieces.size() <= GeneraliseRules::least_vertices)
      continue;
    LoopThinner thinner(boundary.loops[k], size, share);
    if (!thinner.thin())
      continue;
    if (!result)
      result = std::make_unique<geometry::Boundary>(boundary);
    result->loops[k] = thinner.result();
  }
  if (result)
    result->area = polygon::area_of_loops(*result);
  return result;
}

} // namespace trime::generalise
