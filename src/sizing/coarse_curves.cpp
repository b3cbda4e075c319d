// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/coarse_curves.hpp"

#include <algorithm>

namespace trime::sizing {
namespace {

using geometry::Piece;

/// Returns the straight piece from the start of `first` to the end of `last`.
Piece straight_piece(const Piece& first, const Piece& last) {
  Piece piece;
  piece.start = first.start;
  piece.end = last.end;
  piece.part = first.part;
  return piece;
}

/// Replaces pieces of runs of consecutive straight pieces.
class Run {
public:
  Run(const std::vector<Piece>& pieces, std::size_t first, double deviation)
      : pieces_(pieces), deviation_(deviation), end_(first + 1) {
    if (!pieces[first].circular)
      while (end_ < pieces.size() && !pieces[end_].circular && pieces[end_].start == pieces[end_ - 1].end)
        ++end_;
  }

  std::size_t end() const { return end_; }

  /// Returns the end of a long range of pieces from `first` on that one straight piece may replace. The range is
  /// doubled while it may be replaced, and then found by bisection.
  std::size_t longest_range(std::size_t first) const {
    std::size_t good = first + 1, bad = end_ + 1;
    for (std::size_t step = 2; good < end_ && bad > end_; step *= 2) {
      const std::size_t tried = std::min(first + step, end_);
      (is_straight(first, tried) ? good : bad) = tried;
    }
    while (bad <= end_ && bad - good > 1) {
      const std::size_t middle = good + (bad - good) / 2;
      (is_straight(first, middle) ? good : bad) = middle;
    }
    return good;
  }

private:
  /// The curve goes from one end of the new piece to the other and does not leave the strip around it. Therefore each
  /// point of the new piece has a point of the curve nearby as well.
  bool is_straight(std::size_t first, std::size_t end) const {
    const Piece whole = straight_piece(pieces_[first], pieces_[end - 1]);
    return std::all_of(&pieces_[first] + 1, &pieces_[end - 1] + 1,
                       [&](const Piece& piece) { return whole.distance(piece.start) <= deviation_; });
  }

  const std::vector<Piece>& pieces_;
  double deviation_;
  std::size_t end_;
};

} // namespace

std::vector<Piece> coarse_curves(const std::vector<Piece>& pieces, double deviation) {
  std::vector<Piece> coarse;
  for (std::size_t k = 0; k < pieces.size();) {
    const Run run(pieces, k, deviation);
    if (pieces[k].circular) {
      coarse.push_back(pieces[k++]);
      continue;
    }
    while (k < run.end()) {
      const std::size_t end = run.longest_range(k);
      coarse.push_back(straight_piece(pieces[k], pieces[end - 1]));
      k = end;
    }
  }
  return coarse;
}

} // namespace trime::sizing
