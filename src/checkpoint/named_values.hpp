// SPDX-License-Identifier: BSD-3-Clause
// Attributes and columns of a checkpoint by name.
#pragma once

#include "trime/core/error.hpp"
#include "trime/io/metadata.hpp"

#include <string>
#include <variant>
#include <vector>

namespace trime::checkpoint {

/// Returns a column of a group. @throws FileError if no column has this name and type
template <class T>
const std::vector<T>& column(const io::Metadata& metadata, const char* group, const char* name) {
  if (const io::MetadataGroup* found = io::find_group(metadata, group))
    for (const io::Column& candidate : found->columns)
      if (candidate.name == name && std::holds_alternative<std::vector<T>>(candidate.values))
        return std::get<std::vector<T>>(candidate.values);
  throw FileError(fmt::format("the checkpoint is damaged: expected the column {}/{}, found none", group, name));
}

/// Returns an attribute. @throws FileError if no attribute has this name and type
template <class T>
const T& attribute(const io::Metadata& metadata, const char* name) {
  for (const io::Attribute& candidate : metadata.attributes)
    if (candidate.name == name && std::holds_alternative<T>(candidate.value))
      return std::get<T>(candidate.value);
  throw FileError(fmt::format("the checkpoint is damaged: expected the attribute {}, found none", name));
}

} // namespace trime::checkpoint
