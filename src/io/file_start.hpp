// SPDX-License-Identifier: BSD-3-Clause
// Lets rank 0 alone write the beginning of an HDF5 file before the other ranks open it: groups, everything that is
// small, and arrays that show others. So none of it needs a collective call. Nothing in this file communicates.
#pragma once

#include "io/hdf5_handle.hpp"
#include "trime/io/metadata.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace trime::io {

struct SmallValues;

/// The shape of an array in an HDF5 file.
struct ArrayShape {
  hsize_t rows = 0;
  hsize_t columns = 0; ///< 0 for a one-dimensional array
};

/// @brief An array that shows the values of another array of the same file in another shape, and takes no room; a
/// virtual dataset of HDF5. The source has the same number of values, which are shown in its order, or the same rows
/// and fewer columns, which are shown as the first ones. The values of other columns are 0. HDF5 1.10.8 cannot
/// read such an array if the file was opened by MPI-IO; other versions were not tried.
struct VirtualArray {
  std::string path;
  hid_t type = -1; ///< native type of one value
  ArrayShape shape;
  std::string source; ///< path of the other array, which may be made later
  ArrayShape source_shape;
};

/// A new file that is opened by the plain driver of HDF5. All member functions throw FileError if HDF5 fails.
class FileStart {
public:
  /// @param path name of the file for messages
  FileStart(hid_t file, std::string path) : file_(file), path_(std::move(path)) {}

  void group(const std::string& path) const;
  /// Writes an attribute of `object`, which is the path of a group. A text longer than longest_attribute is shortened.
  void attribute(const std::string& object, const Attribute& attribute) const;
  void attribute(const std::string& object, const std::string& name, std::span<const std::int64_t> values) const;
  /// Writes an ASCII text without terminator, in exactly its length, as readers of VTKHDF require.
  void ascii_attribute(const std::string& object, const std::string& name, const std::string& text) const;
  void column(const std::string& group, const Column& column) const;
  void text(const std::string& path, const std::string& text) const;
  /// Makes the group `root`, and puts all metadata into it.
  void metadata(const std::string& root, const Metadata& metadata) const;
  void show(const VirtualArray& array) const;

private:
  void write_attribute(const std::string& object, const std::string& name, const SmallValues& values) const;
  void write_dataset(const std::string& path, const SmallValues& values) const;
  std::string action(const std::string& verb, const std::string& what) const;

  hid_t file_;
  std::string path_;
};

} // namespace trime::io
