// SPDX-License-Identifier: BSD-3-Clause
#include "polygon/disc_cells.hpp"

#include "core/thread_loop.hpp"
#include "polygon/rules.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <array>

namespace trime::polygon {

using geometry::Segment;
using geometry::Vec2;

namespace {

constexpr double rounding = 1e-9; // far above that of distances, relative to a chord or to the side of a cell

} // namespace

double reach_of(const Segment& chord) {
  return (0.5 + PolygonRules::near_chord) * geometry::length(chord.b - chord.a) * (1 + rounding);
}

DiscCells::DiscCells(const geometry::Box& box, double side)
    : corner_(box.min - Vec2{side, side}), side_(side), inverse_side_(1 / side),
      columns_(static_cast<int>(box.width() * inverse_side_) + 3),
      rows_(static_cast<int>(box.height() * inverse_side_) + 3) {}

/// First and last row that a disc, a little enlarged, may meet.
std::pair<int, int> DiscCells::rows_of(const Reach& disc) const {
  const auto row = [this](double y) {
    return static_cast<int>(std::clamp((y - corner_.y) * inverse_side_, 0.0, rows_ - 1.0));
  };
  const double enlarged = disc.radius + rounding * side_;
  return {row(disc.middle.y - enlarged), row(disc.middle.y + enlarged)};
}

/// Calls visit(cell) for the cells of rows [first_row, last_row) that a disc, a little enlarged, may meet.
template <class Visit>
void DiscCells::for_each_cell_of(const Reach& disc, int first_row, int last_row, const Visit& visit) const {
  const Vec2 middle = disc.middle - corner_;
  const double reach = disc.radius + rounding * side_;
  const auto column = [this](double x) { return static_cast<int>(std::clamp(x * inverse_side_, 0.0, columns_ - 1.0)); };
  const auto [low, high] = rows_of(disc);
  const int i0 = column(middle.x - reach), i1 = column(middle.x + reach);
  for (int j = std::max(low, first_row); j <= std::min(high, last_row - 1); ++j) {
    const double dy = std::max(0.0, std::max(j * side_ - middle.y, middle.y - (j + 1) * side_));
    for (int i = i0; i <= i1; ++i) {
      const double dx = std::max(0.0, std::max(i * side_ - middle.x, middle.x - (i + 1) * side_));
      if (dx * dx + dy * dy <= reach * reach)
        visit(static_cast<std::size_t>(j) * columns_ + i);
    }
  }
}

DiscCells::Strips DiscCells::strips_of(std::span<const Segment> chords, std::span<const Segment> more) const {
  Strips strips;
  strips.reaches.reserve(chords.size() + more.size());
  strips.discs.resize(static_cast<std::size_t>((rows_ - 1) / strip_rows + 1));
  for (const std::span<const Segment> list : {chords, more})
    for (const Segment& chord : list) {
      strips.reaches.push_back({0.5 * (chord.a + chord.b), reach_of(chord)});
      const auto [first, last] = rows_of(strips.reaches.back());
      for (int strip = first / strip_rows; strip <= last / strip_rows; ++strip)
        strips.discs[static_cast<std::size_t>(strip)].push_back(static_cast<LocalIndex>(strips.reaches.size()) - 1);
    }
  return strips;
}

/// Calls body(strip, first row, end of its rows) for all strips at the same time.
template <class Body>
void DiscCells::for_each_strip(const Body& body) const {
  thread_loop((rows_ - 1) / strip_rows + 1, 1, [&](std::ptrdiff_t k, int) {
    const int first = static_cast<int>(k) * strip_rows, last = std::min(rows_, first + strip_rows);
    body(static_cast<std::size_t>(k), first, last);
  });
}

void DiscCells::mark_cells(const Strips& strips) {
  static_assert(strip_rows % word == 0);
  bits_.assign((count() + word - 1) / word, 0);
  for_each_strip([&](std::size_t strip, int first, int last) {
    for (const LocalIndex k : strips.discs[strip])
      for_each_cell_of(strips.reaches[static_cast<std::size_t>(k)], first, last,
                       [&](std::size_t cell) { bits_[cell / word] |= std::uint64_t{1} << (cell % word); });
  });
}

/// Cells with a disc above this row, where a word begins or the grid ends.
std::size_t DiscCells::ranks_before(int row) const {
  return static_cast<std::size_t>(
      ranks_[std::min(bits_.size(), (static_cast<std::size_t>(row) * columns_ + word - 1) / word)]);
}

void DiscCells::list_discs(std::span<const Segment> chords, std::span<const Segment> more) {
  const Strips strips = strips_of(chords, more);
  mark_cells(strips);
  rank_cells();
  starts_.assign(static_cast<std::size_t>(ranks_.back()) + 1, 0);
  std::vector<LocalIndex> entries_of(strips.discs.size() + 1, 0);
  for_each_strip([&](std::size_t strip, int first, int last) {
    for (const LocalIndex k : strips.discs[strip])
      for_each_cell_of(strips.reaches[static_cast<std::size_t>(k)], first, last,
                       [&](std::size_t cell) { ++starts_[rank(cell)]; });
    for (std::size_t k = ranks_before(first); k < ranks_before(last); ++k)
      entries_of[strip + 1] += starts_[k];
  });
  for (std::size_t strip = 0; strip < strips.discs.size(); ++strip)
    entries_of[strip + 1] += entries_of[strip];
  discs_.resize(static_cast<std::size_t>(entries_of.back()));
  starts_.back() = entries_of.back();
  // Each list is filled from its end; then its start is known.
  for_each_strip([&](std::size_t strip, int first, int last) {
    LocalIndex end = entries_of[strip];
    for (std::size_t k = ranks_before(first); k < ranks_before(last); ++k)
      starts_[k] = end += starts_[k];
    for (auto k = strips.discs[strip].rbegin(); k != strips.discs[strip].rend(); ++k)
      for_each_cell_of(strips.reaches[static_cast<std::size_t>(*k)], first, last,
                       [&](std::size_t cell) { discs_[static_cast<std::size_t>(--starts_[rank(cell)])] = *k; });
  });
}

void DiscCells::rank_cells() {
  ranks_.resize(bits_.size() + 1);
  LocalIndex set = 0;
  for (std::size_t k = 0; k < bits_.size(); ++k) {
    ranks_[k] = set;
    set += static_cast<LocalIndex>(std::popcount(bits_[k]));
  }
  ranks_.back() = set;
}

void DiscCells::mark_discs(int row, std::uint8_t none, std::span<std::uint8_t> marks) const {
  std::fill(marks.begin(), marks.end(), none);
  const std::size_t first = static_cast<std::size_t>(row) * columns_, last = first + marks.size();
  for (std::size_t k = first / word; k * word < last; ++k)
    for (std::uint64_t left = bits_[k]; left != 0; left &= left - 1)
      if (const std::size_t cell = k * word + static_cast<std::size_t>(std::countr_zero(left));
          cell >= first && cell < last)
        marks[cell - first] = 0;
}

} // namespace trime::polygon
