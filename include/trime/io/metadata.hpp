// SPDX-License-Identifier: BSD-3-Clause
// What a file says about how its mesh was made: plain named values, texts and columns. This module knows nothing of
// their meaning.
#pragma once

#include "trime/comm/communicator.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace trime::io {

/// A named scalar. Texts are for short words: those beyond longest_attribute are shortened in the file.
struct Attribute {
  std::string name;
  std::variant<std::int64_t, std::uint64_t, double, std::string> value;
};

/// Bytes of a text attribute in the file; HDF5 has an end at 64 KiB. What may be long belongs into a Text.
inline constexpr std::size_t longest_attribute = 32768;

/// @brief The text itself, or as much of its start as leaves room for "..." in `longest` bytes; no character of UTF-8
/// is cut in two. @pre longest >= 3
std::string shortened(const std::string& text, std::size_t longest);

/// A named list of values, one dataset.
struct Column {
  std::string name;
  std::variant<std::vector<std::int32_t>, std::vector<std::int64_t>, std::vector<double>, std::vector<std::string>>
      values;
};

/// A long text, stored as a scalar dataset.
struct Text {
  std::string name, text;
};

struct MetadataGroup {
  std::string name;
  std::vector<Attribute> attributes;
  std::vector<Column> columns;
};

/// Content of the group /trime_mpi.
struct Metadata {
  std::vector<Attribute> attributes;
  std::vector<Text> texts;
  std::vector<MetadataGroup> groups;
};

/// @brief The metadata of rank 0 on every rank (clocks and host names differ, but a file must be told the same by all).
/// @note Collective.
Metadata broadcast(const Metadata& metadata, const comm::Communicator& comm);

/// The values of metadata by name. @throws FileError if there is none of this name and type
template <class T>
const T& attribute_of(const Metadata& metadata, const std::string& name);
template <class T>
const std::vector<T>& column_of(const Metadata& metadata, const std::string& group, const std::string& name);
/// Null if there is none of this name.
const MetadataGroup* find_group(const Metadata& metadata, const std::string& name);

} // namespace trime::io
