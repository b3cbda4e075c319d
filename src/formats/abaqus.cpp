// SPDX-License-Identifier: BSD-3-Clause
// Abaqus's input file, which CalculiX reads, too: an element set for each region, and for each label a surface, made of
// the sides of triangles, and a set of points. The elements are CPS3, the plane triangle for plane stress: both
// programs know it, and meshio takes it for a triangle. Whoever needs plane strain (CPE3), axial symmetry (CAX3) or
// heat (DC2D3) replaces this word; S3, a shell, would need a third coordinate.
#include "formats/edge_sides.hpp"
#include "formats/rows_by_number.hpp"
#include "formats/solver_names.hpp"

#include <fmt/format.h>

#include <charconv>

namespace trime::formats {
namespace {

/// Appends the entries of a data line, with a comma and a blank between them.
template <class... T>
void append_entries(std::string& text, T... values) {
  ((io::append_number(text, values), text += ", "), ...);
  text.resize(text.size() - 2);
  text += '\n';
}

/// Appends a coordinate. Both programs read only the first 20 characters of a number, so those with many digits lose
/// their last ones.
void append_coordinate(std::string& text, double value) {
  constexpr std::ptrdiff_t longest = 20;
  char digits[32];
  char* end = std::to_chars(digits, digits + sizeof digits, value).ptr; // reading it gives the same double
  for (int precision = 16; end - digits > longest; --precision)
    end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, precision).ptr;
  text.append(digits, end);
}

/// Names of the sets: first those of the regions, then those of the labels.
struct SetNames {
  std::vector<std::string> regions, labels;
};

SetNames set_names(const ExchangeMesh& mesh) {
  std::vector<std::string> names = mesh.names().regions;
  names.insert(names.end(), mesh.line_names().begin(), mesh.line_names().end());
  names = solver_names(names); // regions and labels together, so that a name means one thing
  const auto middle = names.begin() + std::ssize(mesh.names().regions);
  return {{names.begin(), middle}, {middle, names.end()}};
}

std::string header(const ExchangeMesh& mesh, const SetNames& sets) {
  std::string text = "*HEADING\ntrime_mpi mesh\n";
  for (std::size_t k = 0; k < sets.regions.size(); ++k)
    if (mesh.triangles_of_region(k) > 0)
      text += fmt::format("** region {}: {}: ELSET {}\n", k + 1, in_comment(mesh.names().regions[k]), sets.regions[k]);
  for (std::size_t k = 0; k < sets.labels.size(); ++k)
    if (mesh.lines_of(k) > 0)
      text += fmt::format("** label {}: {}: SURFACE and NSET {}\n", k + 1, in_comment(mesh.line_names()[k]),
                          sets.labels[k]);
  return text + "*NODE\n";
}

void add_elements(const ExchangeMesh& mesh, const SetNames& sets, std::vector<io::TextRows>& rows) {
  const auto by_region = std::make_shared<const RowsByNumber>(std::ssize(mesh.mesh().triangles), sets.regions.size(),
                                                              [&](std::int64_t row) { return mesh.region(row); });
  for (std::size_t k = 0; k < sets.regions.size(); ++k) {
    if (mesh.triangles_of_region(k) == 0)
      continue;
    rows.push_back(mesh.once(fmt::format("*ELEMENT, TYPE=CPS3, ELSET={}\n", sets.regions[k])));
    rows.push_back(rows_of_number(by_region, k + 1, [&part = mesh.mesh()](std::int64_t row, std::string& to) {
      const std::array<GlobalId, 3> corners = part.triangle_ids(static_cast<std::size_t>(row));
      append_entries(to, part.triangle_slab.first + row + 1, corners[0] + 1, corners[1] + 1, corners[2] + 1);
    }));
  }
}

void add_surfaces(const ExchangeMesh& mesh, const SetNames& sets, std::vector<io::TextRows>& rows) {
  const auto sides = std::make_shared<const std::vector<EdgeSide>>(
      left_sides(mesh, [&](std::int64_t row) { return mesh.mesh().triangle_slab.first + row + 1; }));
  const auto by_label = std::make_shared<const RowsByNumber>(mesh.rank_lines(), sets.labels.size(),
                                                             [&](std::int64_t row) { return mesh.line_label(row); });
  for (std::size_t k = 0; k < sets.labels.size(); ++k) {
    if (mesh.lines_of(k) == 0)
      continue;
    rows.push_back(mesh.once(fmt::format("*SURFACE, TYPE=ELEMENT, NAME={}\n", sets.labels[k])));
    rows.push_back(rows_of_number(by_label, k + 1, [sides](std::int64_t row, std::string& to) {
      const EdgeSide& at = (*sides)[static_cast<std::size_t>(row)];
      io::append_number(to, at.element);
      to += ", S";
      io::append_number(to, at.side);
      to += '\n';
    }));
  }
}

void add_point_sets(const ExchangeMesh& mesh, const SetNames& sets, std::vector<io::TextRows>& rows) {
  const auto points = std::make_shared<const std::vector<LabelledPoint>>(labelled_points(mesh));
  const auto by_label =
      std::make_shared<const RowsByNumber>(std::ssize(*points), sets.labels.size(), [&](std::int64_t row) {
        return (*points)[static_cast<std::size_t>(row)].label;
      });
  for (std::size_t k = 0; k < sets.labels.size(); ++k) {
    if (mesh.lines_of(k) == 0)
      continue;
    rows.push_back(mesh.once(fmt::format("*NSET, NSET={}\n", sets.labels[k])));
    rows.push_back(rows_of_number(by_label, k + 1, [points](std::int64_t row, std::string& to) {
      io::append_number(to, (*points)[static_cast<std::size_t>(row)].point + 1);
      to += ",\n";
    }));
  }
}

} // namespace

std::vector<FilePlan> plan_abaqus(const ExchangeMesh& mesh, const std::string& path) {
  const SetNames sets = set_names(mesh);
  std::vector<io::TextRows> rows{mesh.once(header(mesh, sets)),
                                 mesh.point_rows([](std::int64_t, GlobalId id, geometry::Vec2 p, std::string& to) {
                                   io::append_number(to, id + 1);
                                   for (const double coordinate : {p.x, p.y}) {
                                     to += ", ";
                                     append_coordinate(to, coordinate);
                                   }
                                   to += '\n';
                                 })};
  add_elements(mesh, sets, rows);
  add_surfaces(mesh, sets, rows);
  add_point_sets(mesh, sets, rows);
  return {{path, rows}};
}

} // namespace trime::formats
