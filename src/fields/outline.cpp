// SPDX-License-Identifier: BSD-3-Clause
#include "fields/outline.hpp"

#include "trime/core/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trime::fields {
namespace {

using geometry::Vec2;

// [width of the raster] How far a shape may reach beyond the cells: coordinates in single precision are rounded.
constexpr double cover_slack = 1e-6;

// [halvings] Of a part of a piece, until its ends are half a cell apart: 16 million places.
constexpr int most_halvings = 24;

// [1] Parts of an arc, and of an edge that may be as long as a period, before they are halved.
constexpr int first_parts = 16;

/// Appends places along the curve of one piece.
class PieceWalker {
public:
  PieceWalker(const ToFile& to_file, Vec2 cell, double period, std::vector<Vec2>& chain, std::vector<Vec2>& in_plane)
      : to_file_(to_file), cell_(cell), period_(period), chain_(chain), in_plane_(in_plane) {}

  /// Appends the places of a piece after its start.
  void walk(const geometry::Piece& piece) {
    const double length = piece.length();
    const int parts = piece.circular || period_ > 0 ? first_parts : 1;
    for (int k = 0; k < parts; ++k)
      walk(piece, length * k / parts, length * (k + 1) / parts, most_halvings);
  }
  void append(Vec2 place) {
    const Vec2 in_file = to_file_(place);
    if (std::isnan(in_file.x) || std::isnan(in_file.y))
      throw GeometryError(fmt::format("the place {} of the shape has no longitude and latitude in its projection, so "
                                      "no data can be found there; make the shape smaller, or use another projection",
                                      Place(place, 9)));
    in_plane_.push_back(place);
    chain_.push_back(near(in_file));
  }

private:
  /// Returns the place in the period in which the chain has its last place.
  Vec2 near(Vec2 p) const {
    if (period_ > 0 && !chain_.empty())
      p.x += period_ * std::rint((chain_.back().x - p.x) / period_);
    return p;
  }
  void walk(const geometry::Piece& piece, double from, double to, int halvings) {
    const Vec2 place = piece.point(to), q = near(to_file_(place)), p = chain_.back();
    if (halvings > 0 && (std::fabs(q.x - p.x) > cell_.x / 2 || std::fabs(q.y - p.y) > cell_.y / 2)) {
      walk(piece, from, (from + to) / 2, halvings - 1);
      walk(piece, (from + to) / 2, to, halvings - 1);
      return;
    }
    append(place);
  }

  const ToFile& to_file_;
  Vec2 cell_;
  double period_;
  std::vector<Vec2>&chain_, &in_plane_;
};

double doubled_area(const std::vector<Vec2>& ring) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec2 p = ring[k] - ring[0], q = ring[(k + 1) % ring.size()] - ring[0];
    sum += p.x * q.y - p.y * q.x;
  }
  return sum;
}

/// Returns the part of a ring on one side of a line parallel to an axis (Sutherland, Hodgman 1974).
std::vector<Vec2> clipped(const std::vector<Vec2>& ring, double Vec2::*axis, double bound, double sign) {
  std::vector<Vec2> part;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec2 p = ring[k], q = ring[(k + 1) % ring.size()];
    const double at_p = sign * (p.*axis - bound), at_q = sign * (q.*axis - bound);
    if (at_p <= 0)
      part.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))
      part.push_back(p + (at_p / (at_p - at_q)) * (q - p));
  }
  return part;
}

double share_outside(const Outline& outline, const geometry::Box& box) {
  double all = 0, inside = 0;
  for (const std::vector<Vec2>& ring : outline.loops) {
    all += doubled_area(ring);
    const std::vector<Vec2> in_x = clipped(clipped(ring, &Vec2::x, box.max.x, 1), &Vec2::x, box.min.x, -1);
    if (const auto part = clipped(clipped(in_x, &Vec2::y, box.max.y, 1), &Vec2::y, box.min.y, -1); !part.empty())
      inside += doubled_area(part);
  }
  return std::clamp(1 - inside / all, 0.0, 1.0);
}

/// Finds missing values among those that are needed.
class Missing {
public:
  explicit Missing(const Raster& raster) : raster_(raster), seen_(raster.size(), false) {}

  /// Looks at the values around a place.
  void need(Vec2 p) {
    const std::int64_t column = low(raster_.x, p.x), row = low(raster_.y, p.y);
    need_cell(column, row);
  }
  /// Looks at the values at the corners of the cell between two columns and two rows.
  void need_cell(std::int64_t column, std::int64_t row) {
    for (const std::int64_t j : {row, std::min(row + 1, raster_.y.count - 1)})
      for (const std::int64_t i : {column, std::min(column + 1, raster_.x.count - 1)})
        if (const std::size_t k = raster_.index(i, j); std::isnan(raster_.value(k)) && !seen_[k]) {
          seen_[k] = true;
          if (values_.count++ == 0) {
            values_.column = i;
            values_.row = j;
          }
        }
  }
  const MissingValues& values() const { return values_; }

private:
  static std::int64_t low(const Axis& axis, double coordinate) {
    const double index =
        std::clamp(axis.index(coordinate), 0.0, static_cast<double>(std::max<std::int64_t>(0, axis.count - 2)));
    return static_cast<std::int64_t>(index);
  }
  const Raster& raster_;
  std::vector<bool> seen_;
  MissingValues values_;
};

/// Returns for each row of cells between centres where the outline crosses the middle of the row, in ascending order.
std::vector<std::vector<double>> crossings(const Outline& outline, const Axis& y) {
  std::vector<std::vector<double>> found(static_cast<std::size_t>(std::max<std::int64_t>(0, y.count - 1)));
  for (const std::vector<Vec2>& ring : outline.loops)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec2 p = ring[k], q = ring[(k + 1) % ring.size()];
      const double from = y.index(std::fmin(p.y, q.y)) - 0.5, to = y.index(std::fmax(p.y, q.y)) - 0.5;
      for (double row = std::fmax(0, std::ceil(from)); row < to && row < static_cast<double>(found.size()); ++row) {
        const double share = (y.at(row + 0.5) - p.y) / (q.y - p.y);
        found[static_cast<std::size_t>(row)].push_back(p.x + share * (q.x - p.x));
      }
    }
  for (std::vector<double>& row : found)
    std::sort(row.begin(), row.end());
  return found;
}

/// Returns the outline with loops around the Earth closed beyond the row next to the pole in the shape.
Outline closed_at_pole(Outline outline, const Axis& y) {
  const double pole = outline.box.min.y + outline.box.max.y > 0 ? y.last() + y.step : y.first - y.step;
  for (std::vector<Vec2>& ring : outline.loops)
    if (outline.winds && std::fabs(ring.back().x - ring.front().x) > 0.5 * outline.box.width())
      ring.insert(ring.end(), {{ring.back().x, pole}, {ring.front().x, pole}});
  return outline;
}

} // namespace

Outline outline_of(const geometry::Boundary& boundary, const ToFile& to_file, Vec2 cell, double period) {
  Outline outline;
  double middle = 0;
  for (const geometry::Loop& loop : boundary.loops) {
    std::vector<Vec2>& chain = outline.loops.emplace_back();
    PieceWalker walker(to_file, cell, period, chain, outline.in_plane.emplace_back());
    walker.append(loop.pieces.front().start);
    if (period > 0 && outline.loops.size() > 1)
      chain[0].x += period * std::rint((middle - chain[0].x) / period);
    for (const geometry::Piece& piece : loop.pieces)
      walker.walk(piece);
    if (period > 0 && std::fabs(chain.back().x - chain.front().x) > period / 2)
      outline.winds = true;
    for (const Vec2 p : chain)
      outline.box.include(p);
    middle = (outline.box.min.x + outline.box.max.x) / 2;
  }
  return outline;
}

void check_cover(const Outline& outline, const geometry::Box& cells, const std::string& path) {
  const double slack_x = cover_slack * cells.width(), slack_y = cover_slack * cells.height();
  for (std::size_t loop = 0; loop < outline.loops.size(); ++loop)
    for (std::size_t k = 0; k < outline.loops[loop].size(); ++k) {
      const Vec2 p = outline.loops[loop][k];
      if (p.x >= cells.min.x - slack_x && p.x <= cells.max.x + slack_x && p.y >= cells.min.y - slack_y &&
          p.y <= cells.max.y + slack_y)
        continue;
      throw GeometryError(fmt::format(
          "{}: expected a raster that covers the shape, found x from {:.9g} to {:.9g} and y from {:.9g} to {:.9g}; the "
          "place {} of the shape, which is ({:.9g}, {:.9g}) there, and {:.3g} % of its area lie outside. Use a larger "
          "raster, or set 'outside = nearest'",
          path, cells.min.x, cells.max.x, cells.min.y, cells.max.y, Place(outline.in_plane[loop][k], 9), p.x, p.y,
          100 * share_outside(outline, cells)));
    }
}

MissingValues missing_values(const Outline& outline, const Raster& raster) {
  Missing missing(raster);
  for (const std::vector<Vec2>& ring : outline.loops)
    for (const Vec2 p : ring)
      missing.need(p);
  if (raster.x.count == 1)
    return missing.values();
  const std::vector<std::vector<double>> rows = crossings(closed_at_pole(outline, raster.y), raster.y);
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (std::size_t k = 0; k + 1 < rows[row].size(); k += 2) {
      const double first = std::fmax(0, std::ceil(raster.x.index(rows[row][k]) - 0.5));
      const double last = std::fmin(static_cast<double>(raster.x.count - 2), raster.x.index(rows[row][k + 1]) - 0.5);
      for (double column = first; column <= last; ++column)
        missing.need_cell(static_cast<std::int64_t>(column), static_cast<std::int64_t>(row));
    }
  return missing.values();
}

} // namespace trime::fields
