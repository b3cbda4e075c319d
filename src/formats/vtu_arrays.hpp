// SPDX-License-Identifier: BSD-3-Clause
// Helpers for files of VTK's XML unstructured grid, whose arrays are appended as raw binary with 64-bit sizes.
#pragma once

#include "formats/exchange_mesh.hpp"

#include <string>
#include <vector>

namespace trime::formats {

/// The arrays of a file, in the order in which their descriptions and their bytes stand.
class VtuArrays {
public:
  explicit VtuArrays(const ExchangeMesh& mesh) : mesh_(mesh) {}

  /// Returns the description of the next array.
  std::string describe(const char* type, const char* name, int components) const;
  /// Adds the bytes of an array: their number, then those of each set of rows.
  void add(GlobalId bytes, const std::vector<io::TextRows>& rows);
  const std::vector<io::TextRows>& rows() const { return rows_; }

private:
  const ExchangeMesh& mesh_;
  std::vector<io::TextRows> rows_;
  GlobalId offset_ = 0;
};

/// Returns one number for each name, called after it: readers other than VTK have no arrays of texts.
std::string vtu_numbers_by_name(const char* what, const std::vector<std::string>& names);

/// Returns the text up to the arrays of points and cells. @param fields the field data, without the element around them
std::string vtu_head(const std::string& fields, GlobalId points, GlobalId cells);
/// Returns the plan of a file. @param text vtu_head(), then the elements Points, Cells, PointData and CellData
FilePlan vtu_file(const ExchangeMesh& mesh, const std::string& path, const std::string& text, const VtuArrays& data);

} // namespace trime::formats
