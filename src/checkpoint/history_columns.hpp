// SPDX-License-Identifier: BSD-3-Clause
// Converts the contents of a checkpoint to columns and back: named values and the history of the run. Computes the hash
// of the contents.
#pragma once

#include "core/random.hpp"
#include "trime/core/error.hpp"
#include "trime/io/metadata.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <bit>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace trime::checkpoint {

/// Hashes words in their order. Each row has its own hash; the hashes of all rows are added up, so the result does not
/// depend on which rank has which row.
class ContentHash {
public:
  explicit ContentHash(std::uint64_t seed) : value_(mix_bits(seed)) {}
  void add(std::int64_t word) { value_ = mix_bits(value_ ^ static_cast<std::uint64_t>(word)); }
  void add(double number) { add(std::bit_cast<std::int64_t>(number)); }
  void add(const std::string& text) {
    for (const char c : text)
      add(std::int64_t{static_cast<unsigned char>(c)});
    add(static_cast<std::int64_t>(text.size()));
  }
  std::uint64_t value() const { return value_; }

private:
  std::uint64_t value_;
};

/// Returns a column of a group of the checkpoint.
/// @throws FileError if there is no column with this name and type
template <class T>
const std::vector<T>& column(const io::Metadata& metadata, const char* group, const char* name) {
  if (const io::MetadataGroup* found = io::find_group(metadata, group))
    for (const io::Column& candidate : found->columns)
      if (candidate.name == name && std::holds_alternative<std::vector<T>>(candidate.values))
        return std::get<std::vector<T>>(candidate.values);
  throw FileError(fmt::format("the checkpoint is damaged: expected the column {}/{}, found none", group, name));
}

/// Returns an attribute of the checkpoint.
/// @throws FileError if there is no attribute with this name and type
template <class T>
const T& attribute(const io::Metadata& metadata, const char* name) {
  for (const io::Attribute& candidate : metadata.attributes)
    if (candidate.name == name && std::holds_alternative<T>(candidate.value))
      return std::get<T>(candidate.value);
  throw FileError(fmt::format("the checkpoint is damaged: expected the attribute {}, found none", name));
}

/// Returns the history of a run as the group `history`.
io::MetadataGroup columns_of(const std::vector<sweep::SweepRecord>& history);
/// Returns the history of a run from the group `history`.
/// @throws FileError if columns are missing or have different lengths
std::vector<sweep::SweepRecord> history_of(const io::Metadata& metadata);
/// Adds all members of all records to a hash.
void add(const std::vector<sweep::SweepRecord>& history, ContentHash& hash);

} // namespace trime::checkpoint
