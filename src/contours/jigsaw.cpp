// SPDX-License-Identifier: BSD-3-Clause
// The .msh files of JIGSAW (Engwirda, https://github.com/dengwirda/jigsaw/wiki): sections of a plane mesh or geometry.
#include "contours/contour_text.hpp"
#include "contours/faults.hpp"
#include "contours/segment_rings.hpp"
#include "trime/contours/contour.hpp"
#include "trime/core/error.hpp"

namespace trime::contours {
namespace {

class JigsawReader {
public:
  JigsawReader(std::string_view text, const std::string& source) : source_(source), lines_(text, source, ";=,") {}

  Contour read(Faults faults) {
    Contour contour;
    contour.source = source_;
    while (lines_.next())
      read_section();
    if (!is_jigsaw_)
      throw GeometryError(
          fmt::format("{}: expected a .msh of JIGSAW, with a line 'mshid=3;EUCLIDEAN-MESH', found none", source_));
    if (vertices_.empty() && !segments_.empty())
      throw GeometryError(fmt::format("{}: expected points (a section 'point=N') for the {} edges, found none", source_,
                                      segments_.size()));
    for (const FileSegment& s : segments_)
      for (const int end : {s.from, s.to})
        if (end < 0 || end >= static_cast<int>(vertices_.size()))
          throw GeometryError(
              fmt::format("{}:{}: expected points from 0 to {}, found {}", source_, s.line, vertices_.size() - 1, end));
    if (segments_.empty())
      throw GeometryError(fmt::format("{}: expected edges (a section 'edge2=N'), found none", source_));
    if (faults == Faults::repair)
      remove_open_chains(vertices_, segments_, source_, contour.warnings);
    RingBuilder builder(contour);
    for (const auto& ring : rings_of_segments(vertices_, segments_, source_, contour.warnings)) {
      for (const RingVertex& v : ring)
        builder.add(v.position, v.line, v.marker);
      builder.end_ring();
    }
    builder.finish();
    check_reading(contour, faults, "edges that make rings");
    return contour;
  }

private:
  void read_section() {
    std::string name(lines_.words()[0]);
    for (char& c : name)
      c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (name.starts_with("$meshformat"))
      lines_.refuse("a .msh of JIGSAW", "this is a .msh of Gmsh, which the program does not read: write the contour as "
                                        ".poly or .geojson");
    if (name == "mshid") {
      is_jigsaw_ = true;
      if (lines_.words().size() > 2 && lines_.words()[2].find_first_of("lL") == 1)
        lines_.refuse("EUCLIDEAN-MESH",
                      "the program reads neither grids nor meshes on the ellipsoid (in radians): "
                      "write longitude and latitude in degrees as .geojson, and set [shape] projection");
    } else if (name == "ndims") {
      if (lines_.integer_at(1, "'ndims=2'") != 2)
        lines_.refuse("'ndims=2'");
    } else if (name == "point")
      read_points();
    else if (name == "edge2")
      read_edges();
    else
      skip();
  }

  int rows() const {
    const int count = lines_.integer_at(1, "the number of rows of a section");
    if (count < 0)
      lines_.refuse("the number of rows of a section");
    return count;
  }
  void next_row(int row, int rows, const char* what) {
    if (!lines_.next())
      lines_.refuse(fmt::format("{} {} of {}", what, row + 1, rows));
  }

  void read_points() {
    const int count = rows();
    for (int k = 0; k < count; ++k) {
      next_row(k, count, "point");
      constexpr const char* what = "'X;Y;TAG' of a point";
      vertices_.push_back({{lines_.number_at(0, what), lines_.number_at(1, what)}, lines_.number(), k});
      check_coordinates(vertices_.back().position, source_, lines_.number());
    }
  }

  void read_edges() {
    const int count = rows();
    for (int k = 0; k < count; ++k) {
      next_row(k, count, "edge");
      constexpr const char* what = "'POINT;POINT;TAG' of an edge";
      segments_.push_back({lines_.integer_at(0, what), lines_.integer_at(1, what),
                           lines_.words().size() > 2 ? lines_.integer_at(2, what) : 0, lines_.number()});
    }
  }

  /// Triangles, values and others.
  void skip() {
    if (lines_.words().size() < 2)
      lines_.refuse("a section of a .msh of JIGSAW, such as 'point=N' or 'edge2=N'");
    if (const std::string_view name = lines_.words()[0]; name == "radii" || name == "RADII")
      return;
    const int count = rows();
    for (int k = 0; k < count; ++k)
      next_row(k, count, "row");
  }

  const std::string& source_;
  WordLines lines_;
  bool is_jigsaw_ = false;
  std::vector<FileVertex> vertices_;
  std::vector<FileSegment> segments_;
};

} // namespace

Contour parse_jigsaw(std::string_view text, const std::string& source, Faults faults) {
  check_encoding(text, source);
  return JigsawReader(text, source).read(faults);
}

} // namespace trime::contours
