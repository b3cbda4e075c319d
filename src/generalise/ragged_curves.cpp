// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/ragged_curves.hpp"

#include "generalise/rules.hpp"
#include "polygon/chord_curve.hpp"
#include "trime/core/types.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

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
    std::vector<LocalIndex> order(n_);
    std::iota(order.begin(), order.end(), LocalIndex{0});
    std::sort(order.begin(), order.end(), [&](LocalIndex a, LocalIndex b) {
      return turn_[at(a)] != turn_[at(b)] ? turn_[at(a)] < turn_[at(b)] : a < b;
    });
    next_.resize(n_);
    previous_.resize(n_);
    for (std::size_t k = 0; k < n_; ++k) {
      next_[k] = static_cast<LocalIndex>((k + 1) % n_);
      previous_[k] = static_cast<LocalIndex>((k + n_ - 1) % n_);
    }
    std::size_t left = n_;
    for (const LocalIndex vertex : order)
      if (const std::size_t k = at(vertex);
          ragged_[k] <= ragged && left > GeneraliseRules::least_vertices && may_go(k)) {
        ragged_[nearer_neighbour(k)] = stays;
        next_[at(previous_[k])] = next_[k];
        previous_[at(next_[k])] = previous_[k];
        ragged_[k] = gone;
        --left;
      }
    return left < n_;
  }

  Loop result() const {
    Loop thinned{{}, loop_.outer, loop_.tag, loop_.winding};
    thinned.pieces.reserve(n_ - static_cast<std::size_t>(std::count(ragged_.begin(), ragged_.end(), gone)));
    for (std::size_t k = 0; k < n_; ++k) {
      if (ragged_[k] == gone)
        continue;
      thinned.pieces.push_back(loop_.pieces[k]);
      if (at(next_[k]) != (k + 1) % n_)
        thinned.pieces.back().end = loop_.pieces[at(next_[k])].start;
    }
    return thinned;
  }

private:
  static constexpr char ragged = 1, stays = 2, gone = 3;
  std::size_t nearer_neighbour(std::size_t k) const {
    const Vec2 p = vertex(k);
    const std::size_t before = at(previous_[k]), behind = at(next_[k]);
    return squared_length(p - vertex(before)) < squared_length(p - vertex(behind)) ? before : behind;
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
  std::vector<LocalIndex> next_, previous_;
};

/// The loop with fewer vertices; nothing if none goes.
std::optional<Loop> thinned_once(const Loop& loop, const sizing::SizeField& size, double share) {
  if (loop.pieces.size() <= GeneraliseRules::least_vertices)
    return {};
  LoopThinner thinner(loop, size, share);
  if (!thinner.thin())
    return {};
  return thinner.result();
}

/// @brief Does the same, except that a dense loop loses as many vertices as it may. Each time it loses about half of
/// them, since each removed vertex has a neighbour that stays.
std::optional<Loop> thinned_loop(const Loop& loop, const sizing::SizeField& size, double share, Thinning thinning) {
  std::optional<Loop> result = thinned_once(loop, size, share);
  const auto is_dense = [&] {
    return static_cast<double>(result->pieces.size()) <
           (1 - GeneraliseRules::dense_loss) * static_cast<double>(loop.pieces.size());
  };
  if (thinning == Thinning::once || !result)
    return result;
  if (!is_dense())
    return thinning == Thinning::dense ? std::optional<Loop>() : result;
  for (int round = 1; round < GeneraliseRules::dense_rounds; ++round) {
    std::optional<Loop> next = thinned_once(*result, size, share);
    if (!next)
      break;
    result = std::move(next);
  }
  return result;
}

} // namespace

std::unique_ptr<geometry::Boundary> without_ragged_runs(const geometry::Boundary& boundary,
                                                        const sizing::SizeField& size, double share,
                                                        Thinning thinning) {
  std::vector<std::optional<Loop>> thinned;
  for (const Loop& loop : boundary.loops)
    thinned.push_back(thinned_loop(loop, size, share, thinning));
  if (std::none_of(thinned.begin(), thinned.end(), [](const auto& loop) { return loop.has_value(); }))
    return nullptr;
  auto result = std::make_unique<geometry::Boundary>(
      geometry::Boundary{{}, boundary.part_names, 0, boundary.periods, boundary.covers_torus});
  for (std::size_t k = 0; k < thinned.size(); ++k)
    result->loops.push_back(thinned[k] ? *std::move(thinned[k]) : boundary.loops[k]);
  result->area = polygon::area_of_loops(*result);
  return result;
}

} // namespace trime::generalise
