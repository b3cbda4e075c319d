// SPDX-License-Identifier: BSD-3-Clause
#include "polygon/disc_cells.hpp"

#include "core/thread_loop.hpp"
#include "polygon/rules.hpp"

#include <algorithm>

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

/// Strips of rows are filled at the same time.
void DiscCells::list_discs(std::span<const Segment> chords, std::span<const Segment> more) {
  std::vector<Reach> reaches;
  reaches.reserve(chords.size() + more.size());
  const auto strips = static_cast<std::size_t>((rows_ - 1) / strip_rows + 1);
  std::vector<std::vector<LocalIndex>> discs_of(strips);
  for (const std::span<const Segment> list : {chords, more})
    for (const Segment& chord : list) {
      reaches.push_back({0.5 * (chord.a + chord.b), reach_of(chord)});
      const auto [first, last] = rows_of(reaches.back());
      for (int strip = first / strip_rows; strip <= last / strip_rows; ++strip)
        discs_of[static_cast<std::size_t>(strip)].push_back(static_cast<LocalIndex>(reaches.size()) - 1);
    }
  const auto for_each_strip = [&](const auto& body) {
    thread_loop(static_cast<std::ptrdiff_t>(strips), 1, [&](std::ptrdiff_t k, int) {
      const int first = static_cast<int>(k) * strip_rows, last = std::min(rows_, first + strip_rows);
      body(static_cast<std::size_t>(k), first, last);
    });
  };
  const auto cells_before = [this](int row) { return static_cast<std::size_t>(row) * columns_; };
  starts_.assign(count() + 1, 0);
  std::vector<LocalIndex> entries_of(strips + 1, 0);
  for_each_strip([&](std::size_t strip, int first, int last) {
    for (const LocalIndex k : discs_of[strip])
      for_each_cell_of(reaches[static_cast<std::size_t>(k)], first, last, [&](std::size_t cell) { ++starts_[cell]; });
    for (std::size_t cell = cells_before(first); cell < cells_before(last); ++cell)
      entries_of[strip + 1] += starts_[cell];
  });
  for (std::size_t strip = 0; strip < strips; ++strip)
    entries_of[strip + 1] += entries_of[strip];
  discs_.resize(static_cast<std::size_t>(entries_of.back()));
  starts_.back() = entries_of.back();
  // Each list is filled from its end; then its start is known.
  for_each_strip([&](std::size_t strip, int first, int last) {
    LocalIndex end = entries_of[strip];
    for (std::size_t cell = cells_before(first); cell < cells_before(last); ++cell)
      starts_[cell] = end += starts_[cell];
    for (auto k = discs_of[strip].rbegin(); k != discs_of[strip].rend(); ++k)
      for_each_cell_of(reaches[static_cast<std::size_t>(*k)], first, last,
                       [&](std::size_t cell) { discs_[static_cast<std::size_t>(--starts_[cell])] = *k; });
  });
}

} // namespace trime::polygon
