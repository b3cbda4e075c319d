// SPDX-License-Identifier: BSD-3-Clause
#include "contours/poly_file.hpp"

#include "contours/contour_text.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace trime::contours {
namespace {

constexpr int most_columns = 1000; // of attributes

/// A head line: how many rows follow, and what each has.
struct Head {
  int rows;
  std::vector<int> columns;
};

Head head_of(WordLines& lines, const char* what, std::size_t columns) {
  if (!lines.next())
    lines.refuse(what);
  Head head{lines.integer_at(0, what), {}};
  for (std::size_t k = 1; k <= columns; ++k) // what is not given is 0
    head.columns.push_back(k < lines.words().size() ? lines.integer_at(k, what) : 0);
  if (head.rows < 0 || std::any_of(head.columns.begin(), head.columns.end(),
                                   [](int column) { return column < 0 || column > most_columns; }))
    lines.refuse(what);
  return head;
}

void next_row(WordLines& lines, int row, int rows, const char* what) {
  if (!lines.next())
    lines.refuse(fmt::format("{} {} of {}", what, row + 1, rows));
}

class PolyReader {
public:
  PolyReader(std::string_view text, const std::string& source, std::string_view nodes)
      : source_(source), lines_(text, source, ","), node_source_(source.substr(0, source.size() - 5) + ".node"),
        node_lines_(nodes, node_source_, ",") {}

  PolyFile read() {
    read_vertices();
    read_segments();
    read_holes();
    read_regions();
    return std::move(file_);
  }

private:
  void read_vertices() {
    constexpr const char* head_text = "'VERTICES 2 ATTRIBUTES MARKERS'";
    Head head = head_of(lines_, head_text, 3);
    WordLines* lines = &lines_;
    if (head.rows == 0) {
      lines = &node_lines_;
      head = head_of(*lines, head_text, 3);
    }
    if (head.columns[0] != 2 && head.columns[0] != 0)
      lines->refuse("a plane .poly, whose first line is 'VERTICES 2 ATTRIBUTES MARKERS'");
    for (int k = 0; k < head.rows; ++k) {
      next_row(*lines, k, head.rows, "vertex");
      constexpr const char* what = "'NUMBER X Y' of a vertex";
      const FileVertex vertex{
          {lines->number_at(1, what), lines->number_at(2, what)}, lines->number(), lines->integer_at(0, what)};
      if (k == 0)
        first_number_ = vertex.number;
      if (vertex.number != first_number_ + k || (first_number_ != 0 && first_number_ != 1))
        lines->refuse(fmt::format("vertex {}: vertices are numbered one by one from 0 or 1", first_number_ + k));
      check_coordinates(vertex.position, lines == &node_lines_ ? node_source_ : source_, vertex.line);
      file_.vertices.push_back(vertex);
    }
  }

  int vertex_at(std::size_t column) const {
    constexpr const char* what = "'NUMBER VERTEX VERTEX MARKER' of a segment";
    const int number = lines_.integer_at(column, what), count = static_cast<int>(file_.vertices.size());
    if (number < first_number_ || number - first_number_ >= count)
      lines_.refuse(fmt::format("vertices from {} to {}", first_number_, first_number_ + count - 1));
    return number - first_number_;
  }

  void read_segments() {
    const Head head = head_of(lines_, "'SEGMENTS MARKERS'", 1);
    for (int k = 0; k < head.rows; ++k) {
      next_row(lines_, k, head.rows, "segment");
      const bool has_marker = head.columns[0] > 0 && lines_.words().size() > 3;
      file_.segments.push_back({vertex_at(1), vertex_at(2),
                                has_marker ? lines_.integer_at(3, "a marker as an integer") : 0, lines_.number()});
    }
  }

  /// Reads the number of rows of a list with which the file may end; many programs leave it out.
  int rows_of(const char* what) { return lines_.next() ? lines_.integer_at(0, what) : 0; }

  void read_holes() {
    constexpr const char* what = "'NUMBER X Y' of a hole";
    const int holes = rows_of("the number of holes");
    for (int k = 0; k < holes; ++k) {
      next_row(lines_, k, holes, "hole");
      file_.holes.push_back({{lines_.number_at(1, what), lines_.number_at(2, what)}, lines_.number()});
    }
  }

  void read_regions() {
    constexpr const char* what = "'NUMBER X Y ATTRIBUTE LARGEST_AREA' of a region";
    const int regions = rows_of("the number of regions");
    for (int k = 0; k < regions; ++k) {
      next_row(lines_, k, regions, "region");
      RegionPoint& point = file_.regions.emplace_back();
      point.at = {{lines_.number_at(1, what), lines_.number_at(2, what)}, lines_.number()};
      if (lines_.words().size() > 3)
        point.attribute = lines_.number_at(3, what);
      if (lines_.words().size() > 4)
        point.largest_area = lines_.number_at(4, what);
    }
  }

  const std::string& source_;
  WordLines lines_;
  std::string node_source_;
  WordLines node_lines_;
  int first_number_ = 1;
  PolyFile file_;
};

} // namespace

PolyFile read_poly_file(std::string_view text, const std::string& source, std::string_view nodes) {
  check_encoding(text, source);
  return PolyReader(text, source, nodes).read();
}

} // namespace trime::contours
