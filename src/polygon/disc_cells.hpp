// SPDX-License-Identifier: BSD-3-Clause
// A grid of square cells that lists the diametral circles of chords (boundary edges) that reach into each cell. Loops
// that test many points get the states of the cells as plain numbers. Another function completes segments in a window
// to closed polygons.
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

/// The grid as plain data: rows of `columns` cells, beginning at `corner`. The pointer refers to data of the
/// BoundaryGuard.
struct GuardCells {
  /// A point in a cell with a positive state need not be pushed. Null if there are no boundary sites; then no point
  /// needs a push.
  const std::int8_t* states = nullptr;
  geometry::Vec2 corner;
  double inverse_side = 1;
  int columns = 0, rows = 0;
};

/// Returns a radius around the middle of a chord that covers its diametral circle and all places nearer to the chord
/// than PolygonRules::near_chord.
double reach_of(const geometry::Segment& chord);

/// Number of rows of cells that one thread processes: as many as a word has bits, so that two threads never write to
/// the same word.
constexpr int strip_rows = 64;

/// The cells and their lists of circles. Immutable once the circles are listed; thread-safe.
class DiscCells {
public:
  DiscCells() = default;
  /// Makes cells with this side that cover a box and a margin around it.
  DiscCells(const geometry::Box& box, double side);

  /// @brief Lists the diametral circles of `chords`, then those of `more`, under consecutive numbers. Cost: O(cells +
  /// entries), by all threads.
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

  /// Returns the index of the cell of p, counted row by row; -1 outside of the grid, where no circle lies.
  std::int64_t cell_at(geometry::Vec2 p) const {
    const double x = (p.x - corner_.x) * inverse_side_, y = (p.y - corner_.y) * inverse_side_;
    if (!(x >= 0 && y >= 0 && x < columns_ && y < rows_))
      return -1;
    return static_cast<std::int64_t>(y) * columns_ + static_cast<std::int64_t>(x);
  }
  /// Returns the numbers of the circles that reach into a cell, in ascending order; an empty list for cell -1.
  std::span<const LocalIndex> discs_at(std::int64_t cell) const {
    if (cell < 0 || !has_disc(static_cast<std::size_t>(cell)))
      return {};
    const std::size_t k = rank(static_cast<std::size_t>(cell));
    return std::span(discs_).subspan(static_cast<std::size_t>(starts_[k]), starts_[k + 1] - starts_[k]);
  }
  bool has_disc(std::size_t cell) const { return (bits_[cell / word] >> (cell % word) & 1) != 0; }
  /// Sets the mark of each cell in a row: 0 if a circle reaches into the cell, otherwise `none`.
  void mark_discs(int row, std::uint8_t none, std::span<std::uint8_t> marks) const;

  std::size_t memory_bytes() const {
    return bits_.capacity() * sizeof(std::uint64_t) +
           (ranks_.capacity() + starts_.capacity() + discs_.capacity()) * sizeof(LocalIndex);
  }

private:
  /// A circle that covers the diametral circle of a chord and the places near the chord.
  struct Reach {
    geometry::Vec2 middle;
    double radius;
  };
  std::pair<int, int> rows_of(const Reach& disc) const;
  template <class Visit>
  void for_each_cell_of(const Reach& disc, int first_row, int last_row, const Visit& visit) const;

  /// Returns how many cells before this one have a circle.
  std::size_t rank(std::size_t cell) const {
    const std::uint64_t below = bits_[cell / word] & ((std::uint64_t{1} << (cell % word)) - 1);
    return static_cast<std::size_t>(ranks_[cell / word]) + static_cast<std::size_t>(std::popcount(below));
  }
  /// The circles, and for each strip of rows the circles that reach into it.
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

  static constexpr std::size_t word = 64; // number of cells that one word of bits stands for

  geometry::Vec2 corner_;
  double side_ = 1, inverse_side_ = 1; // side of a cell
  int columns_ = 0, rows_ = 0;
  // Most cells have no circle; each of them takes one bit.
  std::vector<std::uint64_t> bits_; // by cell: whether a circle reaches into it
  std::vector<LocalIndex> ranks_;   // by word of bits_: the number of bits that are set in earlier words
  std::vector<LocalIndex> starts_,
      discs_; // starts_: for each cell with circles, the index in discs_ at which its list begins
};

} // namespace trime::polygon
