// SPDX-License-Identifier: BSD-3-Clause
// What a file says about how its mesh was made: plain named values, texts and columns. This module knows nothing of
// their meaning.
#pragma once

#include "trime/comm/communicator.hpp"

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace trime::io {

/// A named scalar; texts are stored with fixed length and must stay below 64 KiB.
struct Attribute {
  std::string name;
  std::variant<std::int64_t, std::uint64_t, double, std::string> value;
};

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

} // namespace trime::io
