// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/ragged_curves.hpp"

#include "generalise/rules.hpp"
#include "generalise/vertex_tree.hpp"
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

/// A loop, and for each piece the vertex of the tree where it starts.
struct NumberedLoop {
  Loop loop;
  std::vector<LocalIndex> vertices;
};

/// A loop whose vertices go one after the other, those with the least turn first.
class LoopThinner {
public:
  LoopThinner(const NumberedLoop& numbered, const sizing::SizeField& size, double share, VertexTree& tree)
      : numbered_(numbered), loop_(numbered.loop), n_(loop_.pieces.size()), tree_(tree) {
    turn_.resize(n_);
    close_.resize(n_);
    for (std::size_t k = 0; k < n_; ++k) {
      turn_[k] = turn_at(k);
      close_[k] = share * sizing::checked_size(size, vertex(k));
    }
    mark_ragged();
  }

  /// True if any vertex goes. Those that go are removed from the tree.
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
          ragged_[k] <= ragged && left > GeneraliseRules::least_vertices && may_go(k) && has_way(k)) {
        ragged_[nearer_neighbour(k)] = stays;
        next_[at(previous_[k])] = next_[k];
        previous_[at(next_[k])] = previous_[k];
        ragged_[k] = gone;
        tree_.remove(numbered_.vertices[k]);
        --left;
      }
    return left < n_;
  }

  NumberedLoop result() const {
    NumberedLoop thinned{{{}, loop_.outer, loop_.tag, loop_.winding}, {}};
    const std::size_t left = n_ - static_cast<std::size_t>(std::count(ragged_.begin(), ragged_.end(), gone));
    thinned.loop.pieces.reserve(left);
    thinned.vertices.reserve(left);
    for (std::size_t k = 0; k < n_; ++k) {
      if (ragged_[k] == gone)
        continue;
      thinned.vertices.push_back(numbered_.vertices[k]);
      thinned.loop.pieces.push_back(loop_.pieces[k]);
      if (at(next_[k]) != (k + 1) % n_)
        thinned.loop.pieces.back().end = vertex(at(next_[k]));
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

  /// Nothing else lies where the curve would pass over.
  bool has_way(std::size_t k) const {
    const std::vector<LocalIndex>& vertices = numbered_.vertices;
    return tree_.is_empty({vertices[at(previous_[k])], vertices[k], vertices[at(next_[k])]});
  }

  const NumberedLoop& numbered_;
  const Loop& loop_;
  const std::size_t n_;
  VertexTree& tree_;
  std::vector<double> turn_, close_; // by vertex: 1 - cosine of the turn; the way on which raggedness counts
  std::vector<char> ragged_;         // by vertex
  std::vector<LocalIndex> next_, previous_;
};

/// Thins the loops of a boundary, one after the other.
class BoundaryThinner {
public:
  BoundaryThinner(const sizing::SizeField& size, Thinning thinning, VertexTree& tree)
      : size_(size), thinning_(thinning), tree_(tree) {}

  /// @brief Returns the loop with fewer vertices, or nothing if none goes. A dense loop loses as many vertices as it
  /// may: each time about half of them, since each removed vertex has a neighbour that stays.
  std::optional<Loop> thinned(const Loop& loop, std::size_t number) {
    const NumberedLoop given{loop, tree_.starts_of_loop(number)};
    std::optional<NumberedLoop> result = once(given);
    if (!result)
      return {};
    const bool is_dense = static_cast<double>(result->vertices.size()) <
                          (1 - GeneraliseRules::dense_loss) * static_cast<double>(given.vertices.size());
    if (thinning_.extent == Thinning::dense && !is_dense) {
      for (const LocalIndex vertex : given.vertices)
        tree_.restore(vertex);
      return {};
    }
    if (thinning_.extent == Thinning::once || !is_dense)
      return std::move(result->loop);
    for (int round = 1; round < GeneraliseRules::dense_rounds; ++round) {
      std::optional<NumberedLoop> next = once(*result);
      if (!next)
        break;
      result = std::move(next);
    }
    return std::move(result->loop);
  }

private:
  std::optional<NumberedLoop> once(const NumberedLoop& loop) {
    if (loop.vertices.size() <= GeneraliseRules::least_vertices)
      return {};
    LoopThinner thinner(loop, size_, thinning_.share, tree_);
    if (!thinner.thin())
      return {};
    return thinner.result();
  }

  const sizing::SizeField& size_;
  const Thinning thinning_;
  VertexTree& tree_;
};

} // namespace

std::unique_ptr<geometry::Boundary> without_ragged_runs(const geometry::Boundary& boundary,
                                                        const sizing::SizeField& size, const geometry::Lattice& lattice,
                                                        std::span<const Vec2> inside, Thinning thinning) {
  VertexTree tree(boundary, lattice, inside);
  BoundaryThinner thinner(size, thinning, tree);
  std::vector<std::optional<Loop>> thinned;
  for (std::size_t k = 0; k < boundary.loops.size(); ++k)
    thinned.push_back(thinner.thinned(boundary.loops[k], k));
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
