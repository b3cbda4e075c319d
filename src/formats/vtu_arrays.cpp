// SPDX-License-Identifier: BSD-3-Clause
#include "formats/vtu_arrays.hpp"

#include <fmt/format.h>

#include <bit>

namespace trime::formats {
namespace {

std::string in_xml(const std::string& text) {
  std::string escaped;
  for (const char c : text)
    escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return escaped;
}

} // namespace

std::string VtuArrays::describe(const char* type, const char* name, int components) const {
  const std::string columns = components > 1 ? fmt::format(" NumberOfComponents=\"{}\"", components) : "";
  return fmt::format("<DataArray type=\"{}\" Name=\"{}\"{} format=\"appended\" offset=\"{}\"/>\n", type, name, columns,
                     offset_);
}

void VtuArrays::add(GlobalId bytes, const std::vector<io::TextRows>& rows) {
  std::string size;
  append_bytes(size, static_cast<std::uint64_t>(bytes));
  rows_.push_back(mesh_.once(size));
  rows_.insert(rows_.end(), rows.begin(), rows.end());
  offset_ += static_cast<GlobalId>(size.size()) + bytes;
}

std::string vtu_numbers_by_name(const char* what, const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text +=
        fmt::format("<DataArray type=\"Int32\" Name=\"{} {}\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n",
                    what, in_xml(names[k]), k + 1);
  return text;
}

std::string vtu_head(const std::string& fields, GlobalId points, GlobalId cells) {
  return fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" "
                     "header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n{}</FieldData>\n"
                     "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                     std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian", fields, points, cells);
}

FilePlan vtu_file(const ExchangeMesh& mesh, const std::string& path, const std::string& text, const VtuArrays& data) {
  std::vector<io::TextRows> rows{mesh.once(text + "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_")};
  rows.insert(rows.end(), data.rows().begin(), data.rows().end());
  rows.push_back(mesh.once("\n</AppendedData>\n</VTKFile>\n"));
  return {path, rows};
}

} // namespace trime::formats
