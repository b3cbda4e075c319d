// SPDX-License-Identifier: BSD-3-Clause
// A grid of square cells that lists the discs of chords that reach into each of them. Loops that look for the clear
// cells themselves get them as plain numbers. Another function closes polygons that consist of the segments that meet
// a window.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace trime::polygon {

/// Rows of `columns` cells, beginning at `corner`. The pointer points into the guard.
struct GuardCells {
  /// A point in a cell with a positive state needs no push. Null if there are no sites, when no point needs one.
  const std::int8_t* states = nullptr;
  geometry::Vec2 corner;
  double inverse_side = 1;
  int columns = 0, rows = 0;
};

/// Returns a radius around the middle of a chord that covers its disc and everything nearer to the chord than
/// PolygonRules::near_chord.
double reach_of(const geometry::Segment& chord);

/// Number of rows of cells for one thread: as many as a word has bits, so that no word has bits of two threads.
constexpr int strip_rows = 64;

/// Immutable once the discs are listed; thread-safe.
class DiscCells {
public:
  DiscCells() = default;
  /// Makes cells of this side that cover a box and a margin around it.
  DiscCells(const geometry::Box& box, double side);

  /// @brief Lists the discs of `chords`, then of `more`, under consecutive numbers. O(cells + entries), by all threads.
  void list_discs(std::span<const geometry::Segment> chords, std::span<const geometry::Segment> more);

  double side() const { return side_; }
  double inverse_side() const { return inverse_side_; }
  geometry::Vec2 corner() const { return corner_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  std::size_t count() const { return static_cast<std::size_t>(columns_) * rows_; }
  geometry::Vec2 middle(int column, int row) const {
    return corner_ + geometry::Vec2{(column + 0.5) * side_, (row + 0.5) * side_};
  }

  /// Returns the index of the cell of p, row by row; -1 outside the grid, where there is no disc.
  std::int64_t cell_at(geometry::Vec2 p) const {
    const double x = (p.x - corner_.x) * inverse_side_, y = (p.y - corner_.y) * inverse_side_;
    if (!(x >= 0 && y >= 0 && x < columns_ && y < rows_))
      return -1;
    return static_cast<std::int64_t>(y) * columns_ + static_cast<std::int64_t>(x);
  }
  /// Returns the discs that reach into a cell, in ascending order; none for cell -1.
  std::span<const LocalIndex> discs_at(std::int64_t cell) const {
    if (cell < 0 || !has_disc(static_cast<std::size_t>(cell)))
      return {};
    const std::size_t k = rank(static_cast<std::size_t>(cell));
    return std::span(discs_).subspan(static_cast<std::size_t>(starts_[k]), starts_[k + 1] - starts_[k]);
  }
  bool has_disc(std::size_t cell) const { return (bits_[cell / word] >> (cell % word) & 1) != 0; }
  /// Sets the mark of each cell of a row to 0 if a disc reaches into it, otherwise to `none`.
  void mark_discs(int row, std::uint8_t none, std::span<std::uint8_t> marks) const;

  std::size_t memory_bytes() const {
    return bits_.capacity() * sizeof(std::uint64_t) +
           (ranks_.capacity() + starts_.capacity() + discs_.capacity()) * sizeof(LocalIndex);
  }

private:
  /// A disc that covers the diametral disc of a chord and what is near the chord.
  struct Reach {
    geometry::Vec2 middle;
    double radius;
  };
  std::pair<int, int> rows_of(const Reach& disc) const;
  template <class Visit>
  void for_each_cell_of(const Reach& disc, int first_row, int last_row, const Visit& visit) const;

  /// Returns the number of cells with a disc before this one.
  std::size_t rank(std::size_t cell) const {
    const std::uint64_t below = bits_[cell / word] & ((std::uint64_t{1} << (cell % word)) - 1);
    return static_cast<std::size_t>(ranks_[cell / word]) + static_cast<std::size_t>(std::popcount(below));
  }
  /// The discs, and by strip of rows those that reach into it.
  struct Strips {
    std::vector<Reach> reaches;
    std::vector<std::vector<LocalIndex>> discs;
  };
  Strips strips_of(std::span<const geometry::Segment> chords, std::span<const geometry::Segment> more) const;
  template <class Body>
  void for_each_strip(const Body& body) const;
  void mark_cells(const Strips& strips);
  void rank_cells();
  std::size_t ranks_before(int row) const;

  static constexpr std::size_t word = 64; // cells

  geometry::Vec2 corner_;
  double side_ = 1, inverse_side_ = 1; // side of a cell
  int columns_ = 0, rows_ = 0;
  // Most cells have no disc, and take one bit.
  std::vector<std::uint64_t> bits_;        // by cell, whether it has discs
  std::vector<LocalIndex> ranks_;          // by word of these bits, the number of bits that are set before it
  std::vector<LocalIndex> starts_, discs_; // by cell with discs, where its discs begin in discs_
};

/// @brief Returns the segments and additional ones outside `window`, so that every end belongs to an even number of
/// segments. Then the even-odd rule separates inside and outside in the window, but does not say which is which.
/// @param segments an end that belongs to an odd number of them lies outside `window`
/// @param margin distance of the added segments from all others; a multiple of the lattice step, as all ends are
std::vector<geometry::Segment> close_outside(std::vector<geometry::Segment> segments, const geometry::Box& window,
                                             double margin);

} // namespace trime::polygon
