// SPDX-License-Identifier: BSD-3-Clause
// Regions from a raster of labels, such as land cover or a micrograph: the cells of one label are one polygon.
#include "contours/ascii_grid.hpp"
#include "contours/faults.hpp"
#include "contours/segment_rings.hpp"
#include "trime/contours/contour.hpp"
#include "trime/core/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace trime::contours {
namespace {

/// A side of a cell, walked with the cell on the left.
enum Side : std::uint8_t { south, east, north, west };

struct CellSide {
  int column, row;
  Side side;
};

/// The labels of the cells as markers from 1; 0: no data, and outside of the raster.
class Labels {
public:
  /// @param marker_of returns the marker of a value
  template <class MarkerOf>
  Labels(const AsciiGrid& grid, const MarkerOf& marker_of) : grid_(grid) {
    for (const double value : grid.values)
      markers_.push_back(std::isnan(value) ? 0 : marker_of(value));
  }

  int at(int column, int row) const {
    const bool is_inside = column >= 0 && column < grid_.columns && row >= 0 && row < grid_.rows;
    return is_inside ? markers_[grid_.index(column, row)] : 0;
  }
  const AsciiGrid& grid() const { return grid_; }

private:
  const AsciiGrid& grid_;
  std::vector<int> markers_;
};

constexpr std::array<std::array<int, 2>, 4> outwards{{{0, 1}, {1, 0}, {0, -1}, {-1, 0}}}; // column, row: rows go south
constexpr std::array<std::array<int, 2>, 4> onwards{{{1, 0}, {0, -1}, {-1, 0}, {0, 1}}};

Side turned(Side side, int left) {
  return static_cast<Side>((side + left + 4) % 4);
}

/// Follows the borders of the labels along the sides of cells. Where two cells of one label meet in a corner only, the
/// border stays at its cell, so that the cells of a ring are connected by their sides.
class BorderTracer {
public:
  BorderTracer(const Labels& labels, RingBuilder& builder)
      : labels_(labels), builder_(builder), is_done_(labels.grid().values.size(), 0) {}

  /// Adds the rings of all labels.
  void trace() {
    const AsciiGrid& grid = labels_.grid();
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column)
        for (const Side side : {south, east, north, west})
          if (const CellSide first{column, row, side}; is_border(first) && !is_done(first))
            trace_ring(first);
  }

private:
  int label(const CellSide& at) const { return labels_.at(at.column, at.row); }
  int label_beside(const CellSide& at) const {
    return labels_.at(at.column + outwards[at.side][0], at.row + outwards[at.side][1]);
  }
  bool is_border(const CellSide& at) const { return label(at) != 0 && label_beside(at) != label(at); }
  bool is_done(const CellSide& at) const { return (done(at) >> at.side & 1) != 0; }
  std::uint8_t done(const CellSide& at) const { return is_done_[labels_.grid().index(at.column, at.row)]; }
  void mark(const CellSide& at) {
    std::uint8_t& sides = is_done_[labels_.grid().index(at.column, at.row)];
    sides = static_cast<std::uint8_t>(sides | 1U << at.side);
  }

  /// The side of the border that follows.
  CellSide after(const CellSide& at) const {
    const CellSide ahead{at.column + onwards[at.side][0], at.row + onwards[at.side][1], at.side};
    if (label(ahead) != label(at))
      return {at.column, at.row, turned(at.side, 1)};
    if (label_beside(ahead) != label(at))
      return ahead;
    return {ahead.column + outwards[at.side][0], ahead.row + outwards[at.side][1], turned(at.side, -1)};
  }

  /// A vertex where the ring turns, and where another border ends at it.
  bool is_vertex(const CellSide& at, const CellSide& next) const {
    return next.side != at.side || label_beside(next) != label_beside(at);
  }

  void trace_ring(const CellSide& first) {
    const int marker = label(first);
    builder_.set_polygon(marker);
    CellSide at = first;
    do {
      mark(at);
      const CellSide next = after(at);
      if (is_vertex(at, next))
        builder_.add(end_of(at), labels_.grid().first_line + at.row, marker);
      at = next;
    } while (!is_done(at));
    builder_.end_ring();
  }

  /// The corner of the raster at which a side ends. The same corner has the same bits for all cells around it.
  geometry::Vec2 end_of(const CellSide& at) const {
    const AsciiGrid& grid = labels_.grid();
    const int column = at.column + (at.side == south || at.side == east ? 1 : 0);
    const int row = grid.rows - at.row - (at.side == south || at.side == west ? 1 : 0);
    return {grid.corner.x + column * grid.cell.x, grid.corner.y + row * grid.cell.y};
  }

  const Labels& labels_;
  RingBuilder& builder_;
  std::vector<std::uint8_t> is_done_; // a bit for each side of each cell
};

constexpr std::size_t most_labels = 10'000; // more are hardly labels

/// Returns the marker of each label: the labels are numbered in ascending order.
std::map<double, int> markers_of(const AsciiGrid& grid, const std::string& source) {
  std::map<double, int> markers;
  for (std::size_t k = 0; k < grid.values.size(); ++k) {
    const double value = grid.values[k];
    if (std::isnan(value))
      continue;
    if (value != std::trunc(value) || markers.size() > most_labels)
      throw GeometryError(
          fmt::format("{}: expected integers as labels, at most {} different ones; found {} in row {}, column {}",
                      source, most_labels, value, k / static_cast<std::size_t>(grid.columns) + 1,
                      k % static_cast<std::size_t>(grid.columns) + 1));
    markers[value] = 0;
  }
  int number = 0;
  for (auto& [value, marker] : markers)
    marker = ++number;
  return markers;
}

} // namespace

Contour parse_grid_regions(std::string_view text, const std::string& source) {
  const AsciiGrid grid = read_ascii_grid(text, source);
  const std::map<double, int> markers = markers_of(grid, source);
  Contour contour;
  contour.source = source;
  contour.is_raster = true;
  for (const auto& [value, marker] : markers)
    contour.marker_names.push_back(fmt::format("{:.0f}", value));
  RingBuilder builder(contour);
  BorderTracer(Labels(grid, [&](double value) { return markers.at(value); }), builder).trace();
  builder.finish();
  std::ranges::stable_sort(contour.rings, {}, [](const ContourRing& ring) { return ring.markers.front(); });
  check_reading(contour, Faults::refuse, "cells with a label");
  return contour;
}

Contour parse_grid(std::string_view text, const std::string& source, Faults faults) {
  const AsciiGrid grid = read_ascii_grid(text, source);
  Contour contour;
  contour.source = source;
  contour.is_raster = true;
  RingBuilder builder(contour);
  BorderTracer(Labels(grid, [](double) { return 1; }), builder).trace();
  builder.finish();
  for (ContourRing& ring : contour.rings) { // one outline without names
    ring.markers.clear();
    ring.polygon = 0;
  }
  check_reading(contour, faults, "cells with data");
  return contour;
}

} // namespace trime::contours
