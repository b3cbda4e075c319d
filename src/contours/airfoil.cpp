// SPDX-License-Identifier: BSD-3-Clause
// Coordinates of airfoils as collections of them have them, in the formats of Selig and of Lednicer.
#include "contours/airfoil.hpp"

#include <algorithm>
#include <cmath>

namespace trime::contours {
namespace {

using geometry::Vec2;

constexpr double near_end = 0.05; // lengths of the airfoil between its end and a first or last vertex

/// The lines of a text: a name, if there is one, and pairs of numbers.
struct Rows {
  std::vector<FilePoint> points;
  std::string name;
  int blocks = 1; // groups of rows with blank lines between them
};

std::optional<Rows> rows_of(std::string_view text) {
  Rows rows;
  bool good = true, blank = false;
  for_each_line(text, [&](std::string_view content, int number, bool separates) {
    blank = (blank || separates) && !rows.points.empty();
    if (content.empty() || !good)
      return;
    if (const auto p = pair_of_numbers(content)) {
      rows.blocks += blank ? 1 : 0;
      blank = false;
      rows.points.push_back({*p, number});
    } else if (rows.name.empty() && rows.points.empty()) {
      rows.name = content;
    } else {
      good = false;
    }
  });
  return good && rows.points.size() > 4 ? std::optional(std::move(rows)) : std::nullopt;
}

/// From the trailing edge around the nose and back, or from the nose to the trailing edge?
struct Span {
  explicit Span(const std::vector<FilePoint>& points) {
    for (const FilePoint& p : points) {
      low = std::fmin(low, p.position.x);
      high = std::fmax(high, p.position.x);
    }
  }
  bool at_nose(Vec2 p) const { return p.x <= low + near_end * (high - low); }
  bool at_tail(Vec2 p) const { return p.x >= high - near_end * (high - low); }
  double low = HUGE_VAL, high = -HUGE_VAL;
};

std::optional<Airfoil> selig(Rows& rows) {
  const Span span(rows.points);
  const auto nose =
      std::min_element(rows.points.begin(), rows.points.end(),
                       [](const FilePoint& a, const FilePoint& b) { return a.position.x < b.position.x; });
  const bool turns = nose != rows.points.begin() && nose + 1 != rows.points.end();
  if (rows.name.empty() || rows.blocks != 1 || !turns || !span.at_tail(rows.points.front().position) ||
      !span.at_tail(rows.points.back().position))
    return std::nullopt;
  return Airfoil{std::move(rows.points), std::move(rows.name), "Selig"};
}

/// The first row says how many rows the upper and the lower side have.
std::optional<Airfoil> lednicer(Rows& rows) {
  const Vec2 counts = rows.points[0].position;
  const double all = static_cast<double>(rows.points.size() - 1);
  if (!(counts.x >= 2 && counts.y >= 2) || counts.x != std::trunc(counts.x) || counts.x + counts.y != all)
    return std::nullopt;
  const auto upper = rows.points.begin() + 1, lower = upper + static_cast<std::ptrdiff_t>(counts.x);
  const std::vector<FilePoint> points(upper, rows.points.end());
  const Span span(points);
  if (!span.at_nose(upper->position) || !span.at_tail((lower - 1)->position) || !span.at_nose(lower->position) ||
      !span.at_tail(rows.points.back().position))
    return std::nullopt;
  Airfoil foil{{upper, lower}, std::move(rows.name), "Lednicer"};
  std::reverse(foil.points.begin(), foil.points.end());
  foil.points.insert(foil.points.end(), lower + (lower->position == upper->position ? 1 : 0), rows.points.end());
  return foil;
}

} // namespace

std::optional<Airfoil> airfoil_of(std::string_view text) {
  std::optional<Rows> rows = rows_of(text);
  if (!rows)
    return std::nullopt;
  if (auto foil = lednicer(*rows))
    return foil;
  return selig(*rows);
}

} // namespace trime::contours
