// SPDX-License-Identifier: BSD-3-Clause
// The metadata of a mesh file: named values, texts and tables that say how the mesh was made. The module io stores them
// without using them.
#pragma once

#include "trime/comm/communicator.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace trime::io {

/// A named single value. A text longer than longest_attribute is shortened in the file.
struct Attribute {
  std::string name;
  std::variant<std::int64_t, std::uint64_t, double, std::string> value;
};

/// The largest number of bytes of a text attribute. The limit of HDF5 is 64 KiB; longer texts are stored as Text.
inline constexpr std::size_t longest_attribute = 32768;

/// @brief Returns the text if it has at most `longest` bytes; otherwise its beginning with "..." appended, in `longest`
/// bytes at most. Never cuts a UTF-8 character in two.
/// @pre longest >= 3
std::string shortened(const std::string& text, std::size_t longest);

/// A named list of values, stored as one dataset.
struct Column {
  std::string name;
  std::variant<std::vector<std::int32_t>, std::vector<std::int64_t>, std::vector<double>, std::vector<std::string>>
      values;
};

/// A long text, stored as a scalar dataset.
struct Text {
  std::string name, text;
};

/// A named group of values and columns; columns of equal length form a table.
struct MetadataGroup {
  std::string name;
  std::vector<Attribute> attributes;
  std::vector<Column> columns;
};

/// The content of the group /trime_mpi.
struct Metadata {
  std::vector<Attribute> attributes;
  std::vector<Text> texts;
  std::vector<MetadataGroup> groups;
};

/// @brief Returns the metadata of rank 0 on every rank. Ranks have different clocks and host names, but all ranks must
/// pass the same values to HDF5.
/// @note Collective.
Metadata broadcast(const Metadata& metadata, const comm::Communicator& comm);

/// Returns the value with this name.
/// @throws FileError if there is no value with this name and type
template <class T>
const T& attribute_of(const Metadata& metadata, const std::string& name);
/// Returns the column with this name in a group.
/// @throws FileError if there is no column with this name and type
template <class T>
const std::vector<T>& column_of(const Metadata& metadata, const std::string& group, const std::string& name);

/// Returns the names of the curves inside the shape; none if the file has no group with them.
std::vector<std::string> curve_names(const Metadata& metadata);
/// Returns the names of the pairs of regions that share an interface; none if the file has no group with them.
std::vector<std::string> interface_names(const Metadata& metadata);
/// Returns whether the mesh has more than one region.
bool has_regions(const Metadata& metadata);
/// Returns the group with this name, or null.
const MetadataGroup* find_group(const Metadata& metadata, const std::string& name);

} // namespace trime::io
