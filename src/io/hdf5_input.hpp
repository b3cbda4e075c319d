// SPDX-License-Identifier: BSD-3-Clause
// Reads an existing HDF5 file on one rank. Every error message names the file and the object in it.
#pragma once

#include "io/hdf5_handle.hpp"
#include "trime/core/error.hpp"
#include "trime/io/metadata.hpp"

#include <string>
#include <vector>

namespace trime::io {

class Hdf5Input {
public:
  /// Opens the file.
  /// @throws FileError if it cannot be opened
  explicit Hdf5Input(const std::string& path);

  bool has(const std::string& object) const;
  /// Return the attributes and columns of a group, and the texts and groups inside it.
  std::vector<Attribute> attributes(const std::string& group) const;
  std::vector<Column> columns(const std::string& group) const;
  std::vector<Text> texts(const std::string& group) const;
  std::vector<std::string> groups(const std::string& group) const;

  /// @brief Returns the number of rows of a dataset.
  /// @throws FileError if the file is too small for this number of rows, because the caller allocates memory for them
  std::int64_t rows(const std::string& dataset) const;
  /// @brief Reads rows [first, first + count) of a dataset into `out`, which must have room for them.
  /// @param columns number of columns that the dataset must have; 0 if it must be one-dimensional
  void read(const std::string& dataset, hid_t type, hsize_t columns, std::int64_t first, std::int64_t count,
            void* out) const;

private:
  Hdf5Dataset open_dataset(const std::string& dataset) const;
  /// Checks, before memory is allocated, that the file is as large as the dataset claims.
  /// @throws FileError if it is too small
  void check_claim(hid_t dataset, hid_t type, hid_t space, const std::string& name) const;
  Hdf5Group open_group(const std::string& group) const;
  /// Returns the names of the members of one kind in a group, in their order.
  /// @param name the name of the group, for messages
  std::vector<std::string> members(hid_t group, const std::string& name, H5O_type_t kind) const;

  std::string path_;
  Hdf5File file_;
};

} // namespace trime::io
