// SPDX-License-Identifier: BSD-3-Clause
// The metadata of a mesh file: named values, texts and tables about how the mesh was made. This module knows nothing of
// their meaning.
#pragma once

#include "trime/comm/communicator.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace trime::io {

/// A named scalar. Texts longer than longest_attribute are shortened in the file.
struct Attribute {
  std::string name;
  std::variant<std::int64_t, std::uint64_t, double, std::string> value;
};

/// The largest number of bytes of a text attribute in the file; the limit of HDF5 is 64 KiB. Use Text for long texts.
inline constexpr std::size_t longest_attribute = 32768;

/// @brief Returns the text, or as much of its start as leaves room for "..." in `longest` bytes, without cutting a
/// UTF-8 character in two. @pre longest >= 3
std::string shortened(const std::string& text, std::size_t longest);

/// A named list of values; one dataset in the file.
struct Column {
  std::string name;
  std::variant<std::vector<std::int32_t>, std::vector<std::int64_t>, std::vector<double>, std::vector<std::string>>
      values;
};

/// A long text, stored as a scalar dataset.
struct Text {
  std::string name, text;
};

/// A named table or group of values.
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

/// @brief Returns the metadata of rank 0 on every rank. Clocks and host names differ, but all ranks must pass the same
/// values to HDF5.
/// @note Collective.
Metadata broadcast(const Metadata& metadata, const comm::Communicator& comm);

/// Returns the value or column with this name. @throws FileError if no value has this name and type
template <class T>
const T& attribute_of(const Metadata& metadata, const std::string& name);
template <class T>
const std::vector<T>& column_of(const Metadata& metadata, const std::string& group, const std::string& name);
/// Returns the group with this name, or null.
const MetadataGroup* find_group(const Metadata& metadata, const std::string& name);

} // namespace trime::io
