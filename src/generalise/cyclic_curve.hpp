// SPDX-License-Identifier: BSD-3-Clause
// Tools for closed curves with many nodes: systems of equations with neighbours, and sums of the turns near a node.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace trime::generalise {

/// Solves cyclic tridiagonal systems: row i is below[i] x[i-1] + diagonal[i] x[i] + above[i] x[i+1].
class CyclicSystem {
public:
  explicit CyclicSystem(std::size_t n) : below(n), diagonal(n, 1), above(n), n_(n), pivot_(n), share_(n) {}
  std::vector<double> below, diagonal, above;

  /// Once all rows are set. The corners are split off (Sherman and Morrison).
  void factorise() {
    gamma_ = -diagonal[0];
    diagonal[0] -= gamma_;
    diagonal[n_ - 1] -= below[0] * above[n_ - 1] / gamma_;
    pivot_[0] = diagonal[0];
    for (std::size_t i = 1; i < n_; ++i)
      pivot_[i] = diagonal[i] - below[i] * above[i - 1] / pivot_[i - 1];
    share_.assign(n_, 0);
    share_[0] = gamma_;
    share_[n_ - 1] = above[n_ - 1];
    solve_open(share_);
  }
  /// The right-hand side becomes the solution.
  void solve(std::vector<double>& x) const {
    solve_open(x);
    const double ratio = below[0] / gamma_;
    const double factor = (x[0] + ratio * x[n_ - 1]) / (1 + share_[0] + ratio * share_[n_ - 1]);
    for (std::size_t i = 0; i < n_; ++i)
      x[i] -= factor * share_[i];
  }

private:
  void solve_open(std::vector<double>& x) const {
    for (std::size_t i = 1; i < n_; ++i)
      x[i] -= below[i] / pivot_[i - 1] * x[i - 1];
    x[n_ - 1] /= pivot_[n_ - 1];
    for (std::size_t i = n_ - 1; i-- > 0;)
      x[i] = (x[i] - above[i] * x[i + 1]) / pivot_[i];
  }

  std::size_t n_;
  double gamma_ = 0;
  std::vector<double> pivot_, share_;
};

/// The turns near one node of a closed curve after the other.
class TurnWindow {
public:
  /// @param ways from each node to the next
  /// @param turns at the nodes, signed
  TurnWindow(const std::vector<double>& ways, const std::vector<double>& turns)
      : ways_(ways), turns_(turns), n_(std::ssize(ways)) {
    take(0, 1);
  }

  /// By how much the turns within a way of the node add up to more than the turn in all. For node 0 first; the next
  /// call is for the next node.
  double to_and_fro(double reach) {
    while (last_ + 1 < first_ + n_ && after_ + way(last_) <= reach) {
      after_ += way(last_);
      take(++last_, 1);
    }
    for (; last_ > node_ && after_ > reach; after_ -= way(last_))
      take(last_--, -1);
    while (first_ > node_ - n_ / 2 && last_ + 1 < first_ + n_ && before_ + way(first_ - 1) <= reach) {
      before_ += way(first_ - 1);
      take(--first_, 1);
    }
    for (; first_ < node_ && before_ > reach; before_ -= way(first_ - 1))
      take(first_++, -1);
    const double result = all_ - std::fabs(net_);
    go_on();
    return result;
  }

private:
  std::size_t once(std::ptrdiff_t k) const { return static_cast<std::size_t>(k < 0 ? k + n_ : k >= n_ ? k - n_ : k); }
  double way(std::ptrdiff_t k) const { return ways_[once(k)]; }
  void take(std::ptrdiff_t k, double sign) {
    all_ += sign * std::fabs(turns_[once(k)]);
    net_ += sign * turns_[once(k)];
  }
  void go_on() {
    before_ += way(node_);
    after_ -= way(node_);
    if (last_ == node_) {
      take(++last_, 1);
      after_ = 0;
    }
    ++node_;
  }

  const std::vector<double>&ways_, &turns_;
  const std::ptrdiff_t n_;
  std::ptrdiff_t node_ = 0, first_ = 0, last_ = 0; // the stretch, on the unrolled curve; less than once around
  double before_ = 0, after_ = 0;                  // ways from the node to its ends
  double all_ = 0, net_ = 0;                       // turns there
};

} // namespace trime::generalise
