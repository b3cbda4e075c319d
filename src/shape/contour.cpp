// SPDX-License-Identifier: BSD-3-Clause
#include "trime/shape/contour.hpp"

#include "core/read_file.hpp"
#include "shape/rules.hpp"
#include "trime/core/error.hpp"

#include <charconv>
#include <cmath>

namespace trime::shape {

namespace {

using geometry::Box;
using geometry::Vec2;

constexpr int most_warnings = 5;

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && is_space(text.back()))
    text.remove_suffix(1);
  return text;
}

bool ends_with_extension(const std::string& path, std::string_view extension) {
  if (path.size() < extension.size())
    return false;
  for (std::size_t i = 0; i < extension.size(); ++i) {
    const char c = path[path.size() - extension.size() + i];
    if ((c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c) != extension[i])
      return false;
  }
  return true;
}

/// Makes rings out of vertices in reading order; knows about repeated vertices, not about text.
class RingBuilder {
public:
  explicit RingBuilder(Contour& contour) : contour_(contour) {}

  void add(Vec2 p, int line) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y))
      throw GeometryError(
          fmt::format("{}:{}: expected finite coordinates, found ({}, {})", contour_.source, line, p.x, p.y));
    if (!ring_.points.empty() && ring_.points.back() == p) {
      warn(p, line);
      return;
    }
    ring_.points.push_back(p);
    ring_.lines.push_back(line);
  }

  void end_ring() {
    if (ring_.points.empty())
      return;
    if (ring_.points.size() > 1 && ring_.points.front() == ring_.points.back()) {
      ring_.points.pop_back();
      ring_.lines.pop_back();
    }
    if (const int distinct = distinct_vertices(); distinct < 3)
      throw GeometryError(fmt::format("{}:{}: the ring that starts here at ({}, {}) has {} distinct {}; expected at "
                                      "least 3",
                                      contour_.source, ring_.lines[0], ring_.points[0].x, ring_.points[0].y, distinct,
                                      distinct == 1 ? "vertex" : "vertices"));
    contour_.rings.push_back(std::move(ring_));
    ring_ = {};
  }

  void finish() {
    end_ring();
    if (contour_.rings.empty())
      throw GeometryError(
          fmt::format("{}: expected lines 'x y' that make a ring, found no vertex at all", contour_.source));
    if (merged_ > most_warnings)
      contour_.warnings.push_back(
          fmt::format("{}: {} more repeated consecutive vertices merged", contour_.source, merged_ - most_warnings));
  }

private:
  /// 1, 2, or 3 for three and more.
  int distinct_vertices() const {
    const std::vector<Vec2>& p = ring_.points;
    std::size_t other = 1;
    while (other < p.size() && p[other] == p[0])
      ++other;
    if (other >= p.size())
      return 1;
    for (std::size_t k = other + 1; k < p.size(); ++k)
      if (p[k] != p[0] && p[k] != p[other])
        return 3;
    return 2;
  }

  void warn(Vec2 p, int line) {
    if (++merged_ <= most_warnings)
      contour_.warnings.push_back(fmt::format("{}:{}: vertex ({}, {}) repeats the one before it; the two are merged",
                                              contour_.source, line, p.x, p.y));
  }

  Contour& contour_;
  ContourRing ring_;
  int merged_ = 0;
};

/// Reads one number from the front of `text`; false if there is none that a blank or the end follows.
bool take_number(std::string_view& text, double& value) {
  text = trimmed(text);
  if (!text.empty() && text.front() == '+')
    text.remove_prefix(1);
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec == std::errc::result_out_of_range)
    value = HUGE_VAL; // too small counts as not finite, too: nobody means such a number
  else if (result.ec != std::errc{})
    return false;
  text.remove_prefix(static_cast<std::size_t>(result.ptr - text.data()));
  return text.empty() || is_space(text.front());
}

/// What people write instead of 'x y', for the message; empty if it is none of that.
std::string hint_for(std::string_view line) {
  if (line.find(',') != std::string_view::npos)
    return "; separate the numbers by blanks, not commas, and write decimals with a point";
  double number = 0;
  int numbers = 0;
  while (numbers < 4 && take_number(line, number))
    ++numbers;
  return numbers == 3 && trimmed(line).empty() ? "; found three numbers, but points of the plane have two" : "";
}

Vec2 parse_vertex(std::string_view line, const std::string& source, int number) {
  Vec2 p;
  std::string_view rest = line;
  if (!take_number(rest, p.x) || !take_number(rest, p.y) || !trimmed(rest).empty())
    throw GeometryError(fmt::format("{}:{}: expected two numbers 'x y', found '{}'{}", source, number,
                                    line.substr(0, 60), hint_for(line)));
  return p;
}

/// Calls visit(content without comment, number, is the whole line blank?) for every line.
template <class Visit>
void for_each_line(std::string_view text, const Visit& visit) {
  int number = 0;
  if (text.starts_with("\xEF\xBB\xBF")) // byte order mark of some editors
    text.remove_prefix(3);
  while (!text.empty()) {
    const std::size_t length = text.find('\n');
    const std::string_view line = text.substr(0, length);
    text.remove_prefix(length == std::string_view::npos ? text.size() : length + 1);
    visit(trimmed(line.substr(0, line.find_first_of("#;"))), ++number, trimmed(line).empty());
  }
}

} // namespace

Contour parse_xy(std::string_view text, const std::string& source) {
  Contour contour;
  contour.source = source;
  RingBuilder builder(contour);
  for_each_line(text, [&](std::string_view content, int number, bool blank) {
    if (!content.empty())
      builder.add(parse_vertex(content, source, number), number);
    else if (blank)
      builder.end_ring();
  });
  builder.finish();
  return contour;
}

std::vector<FilePoint> parse_points(std::string_view text, const std::string& source) {
  std::vector<FilePoint> points;
  for_each_line(text, [&](std::string_view content, int number, bool) {
    if (content.empty())
      return;
    const Vec2 p = parse_vertex(content, source, number);
    if (!std::isfinite(p.x) || !std::isfinite(p.y))
      throw GeometryError(fmt::format("{}:{}: expected finite coordinates, found ({}, {})", source, number, p.x, p.y));
    points.push_back({p, number});
  });
  if (points.empty())
    throw GeometryError(fmt::format("{}: expected points, one 'x y' a line, found none", source));
  return points;
}

std::string read_contour_text(const std::string& path, const std::string& hint) {
  for (const std::string_view extension : {".poly", ".geojson", ".json"})
    if (ends_with_extension(path, extension))
      throw ConfigError(fmt::format("{}: contours of type '{}' cannot be read by this version; expected an '.xy' file "
                                    "with one 'x y' per line and a blank line between rings",
                                    path, extension));
  return read_file(path, hint);
}

Contour read_xy(const std::string& path) {
  return parse_xy(read_contour_text(path), path);
}

Contour make_contour(const std::vector<std::vector<Vec2>>& rings, const std::string& source) {
  Contour contour;
  contour.source = source;
  RingBuilder builder(contour);
  int number = 0;
  for (const std::vector<Vec2>& ring : rings) {
    for (const Vec2 p : ring)
      builder.add(p, ++number);
    builder.end_ring();
  }
  builder.finish();
  return contour;
}

Normalization fit_to_container(const Contour& contour, const Box& container) {
  Box box;
  for (const ContourRing& ring : contour.rings)
    for (const Vec2 p : ring.points)
      box.include(p);
  Normalization fit;
  fit.from = 0.5 * (box.min + box.max);
  fit.to = 0.5 * (container.min + container.max);
  fit.scale = ShapeRules::normalized_share * std::fmin(container.width(), container.height()) /
              std::fmax(box.width(), box.height());
  return fit;
}

} // namespace trime::shape
