// SPDX-License-Identifier: BSD-3-Clause
// Reads a mesh file with the serial functions of HDF5.
#pragma once

#include "mesh.hpp"
#include "report.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace trime_check {

/// @brief An open mesh file. All names are paths from the root group of the file.
class StoredFile {
public:
  /// @throws Failure (exit 4) if the file does not exist, is not an HDF5 file, is truncated, or is not a mesh of
  /// trime_mpi
  explicit StoredFile(const std::string& path);
  ~StoredFile();
  StoredFile(const StoredFile&) = delete;
  StoredFile& operator=(const StoredFile&) = delete;

  /// @brief Returns the values of an array if it has this type and shape. Otherwise adds the fault to `wrong` and
  /// returns an empty array.
  /// @param type "float64", "int64" or another name of a type
  /// @param shape extents; -1 allows any extent
  template <class T>
  std::vector<T> array(const std::string& name, const std::string& type, std::vector<std::int64_t> shape,
                       Tally& wrong) const;

  bool has(const std::string& name) const;
  std::optional<double> number(const std::string& object, const std::string& attribute) const;
  /// Returns all values of an attribute; empty if it is missing or has no numbers.
  std::vector<double> numbers(const std::string& object, const std::string& attribute) const;
  std::optional<std::uint64_t> hash(const std::string& object, const std::string& attribute) const;
  std::optional<std::string> text_attribute(const std::string& object, const std::string& attribute) const;
  /// Returns the text of a dataset; empty if it is missing.
  std::string text(const std::string& name) const;
  /// Return the columns of a table; empty if the column is missing or has another type.
  std::vector<double> column(const std::string& name) const;
  std::vector<std::string> names(const std::string& name) const;

private:
  std::int64_t file_ = -1;
};

/// Reads all arrays. The check named `arrays` reports which are missing or have another type or shape. The mesh can be
/// used only if the function returns true.
bool read_mesh(const StoredFile& file, Mesh& mesh, Report& report);

} // namespace trime_check
