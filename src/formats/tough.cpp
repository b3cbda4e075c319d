// SPDX-License-Identifier: BSD-3-Clause
// Voronoi cells or triangles as a file MESH of TOUGH2 and TOUGH3 (TOUGH3 user's guide, blocks ELEME and CONNE): one
// layer of thickness 1. A line has columns of fixed width. That of an element has a name of five characters, the
// material, the volume and the centre. That of a connection has the names of both elements, the direction, the
// distances of both centres from the face, and the area of the face.
#include "formats/named_cells.hpp"
#include "formats/solver_names.hpp"
#include "trime/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace trime::formats {
namespace {

constexpr std::size_t number_width = 10, name_width = 5;
constexpr std::size_t most_materials = 999; // so that names of five characters can differ
constexpr std::string_view characters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789abcdefghijklmnopqrstuvwxyz";
constexpr GlobalId upper_count = 26, upper_and_digits = 36, all_characters = 62;

/// @brief Names elements by their numbers. A name begins with a letter and ends with two digits, as TOUGH asks for.
/// Small letters are used only if there are more elements than names without them.
class ElementNames {
public:
  explicit ElementNames(GlobalId count) : has_small_(count > upper_count * upper_and_digits * upper_and_digits * 100) {}

  static constexpr GlobalId most = (all_characters - 10) * all_characters * all_characters * 100;

  void append(GlobalId number, std::string& to) const {
    const GlobalId base = has_small_ ? all_characters : upper_and_digits;
    const auto character = [](GlobalId k) { return characters[static_cast<std::size_t>(k)]; };
    const GlobalId block = number / 100, first = block / (base * base);
    to += character(first < upper_count ? first : first + 10); // no digit
    to += character(block / base % base);
    to += character(block % base);
    to += static_cast<char>('0' + number % 100 / 10);
    to += static_cast<char>('0' + number % 10);
  }

private:
  bool has_small_;
};

/// Appends a number in ten columns with as many digits as fit. It has a decimal point, since Fortran would put one into
/// numbers without.
void append_fixed(double number, std::string& to) {
  auto digits = static_cast<int>(number_width) - 1;
  std::string text = fmt::format("{:#.{}g}", number, digits);
  while (text.size() > number_width && digits > 1) {
    digits = std::max(1, digits - static_cast<int>(text.size() - number_width));
    text = fmt::format("{:#.{}g}", number, digits);
  }
  to.append(number_width - std::min(number_width, text.size()), ' ');
  to += text;
}

/// Appends blanks up to a column.
void append_blanks(std::size_t count, std::string& to) {
  to.append(count, ' ');
}

void append_element(const ElementNames& names, const std::vector<std::string>& materials, const FlowCell& cell,
                    std::string& to) {
  names.append(cell.number, to);
  append_blanks(10, to); // NSEQ, NADD
  const std::string& material = materials[static_cast<std::size_t>(cell.region - 1)];
  to += material;
  append_blanks(name_width - material.size(), to);
  append_fixed(cell.area, to);
  append_blanks(20, to); // AHTX, PMX
  append_fixed(cell.centre.x, to);
  append_fixed(cell.centre.y, to);
  append_fixed(0, to);
  to += '\n';
}

/// All lines between centres are horizontal: direction 1, and the cosine of their angle with gravity is 0.
void append_connection(const ElementNames& names, const FlowFace& face, std::string& to) {
  for (const GlobalId cell : face.cells)
    names.append(cell, to);
  append_blanks(15, to); // NSEQ, NAD1, NAD2
  to += "    1";
  for (const double value : {face.distances[0], face.distances[1], face.length, 0.0})
    append_fixed(value, to);
  to += '\n';
}

void check_counts(const FlowCells& cells, const ExchangeMesh& mesh) {
  if (cells.count() > ElementNames::most) // all ranks find the same
    throw FileError(fmt::format("the format 'tough' names at most {} cells with five characters, found {} cells; use "
                                "fewer points, or the format 'uge'",
                                ElementNames::most, cells.count()));
  if (mesh.names().regions.size() > most_materials)
    throw FileError(fmt::format("the format 'tough' names at most {} materials with five characters, found {} regions; "
                                "join regions, or use the format 'uge'",
                                most_materials, mesh.names().regions.size()));
}

} // namespace

std::vector<FilePlan> plan_tough(const ExchangeMesh& mesh, const std::string& path) {
  const FlowCells cells(mesh);
  check_counts(cells, mesh);
  const ElementNames names(cells.count());
  const std::vector<std::string> materials = solver_names(mesh.names().regions, name_width);
  FilePlan plan{path,
                {mesh.once("ELEME\n"), cells.cell_rows([names, materials](const FlowCell& cell, std::string& to) {
                   append_element(names, materials, cell, to);
                 }),
                 mesh.once("\nCONNE\n"), cells.face_rows([names](const FlowFace& face, std::string& to) {
                   append_connection(names, face, to);
                 }),
                 mesh.once("\n")}};
  plan = cells.proved(std::move(plan));
  constexpr std::size_t most_listed = 20;
  for (std::size_t k = 0; k < std::min(materials.size(), most_listed); ++k)
    plan.summary +=
        fmt::format("{}{} is {}", k == 0 ? "; material " : ", ", materials[k], in_comment(mesh.names().regions[k]));
  return {plan, plan_named_cells(cells, paths_of(Format::tough, path, mesh.names())[1],
                                 [names](GlobalId number, std::string& to) { names.append(number, to); })};
}

} // namespace trime::formats
