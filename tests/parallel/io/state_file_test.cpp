// SPDX-License-Identifier: BSD-3-Clause
// What a state file says comes back as it was written: names, types and values, ordered by name.
#include "io/state_file.hpp"

#include "support/temporary_directory.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace trime::io {
namespace {

constexpr int many = 100; // attributes of one group, as the longest groups of the program have them

std::string name_of(int k) {
  return fmt::format("name_{:03}", k);
}

/// Of each type in turn.
Attribute attribute_number(int k) {
  if (k % 4 == 0)
    return {name_of(k), std::int64_t{-k}};
  if (k % 4 == 1)
    return {name_of(k), UINT64_MAX - static_cast<std::uint64_t>(k)};
  if (k % 4 == 2)
    return {name_of(k), k / 3.0};
  return {name_of(k), fmt::format("word {}", k)};
}

/// Written from the last name to the first.
Metadata backwards() {
  Metadata metadata;
  MetadataGroup group{"numbers", {}, {}};
  for (int k = many - 1; k >= 0; --k) {
    metadata.attributes.push_back(attribute_number(k));
    group.attributes.push_back(attribute_number(k));
    group.columns.push_back({name_of(k), std::vector<std::int64_t>{k, -k}});
  }
  metadata.texts = {{"b", "a text"}, {"a", "another one"}};
  metadata.groups = {{"words", {}, {{"word", std::vector<std::string>{"x", "yy"}}}}, group};
  return metadata;
}

void expect_attributes(const std::vector<Attribute>& found) {
  ASSERT_EQ(found.size(), std::size_t{many});
  for (int k = 0; k < many; ++k) {
    EXPECT_EQ(found[static_cast<std::size_t>(k)].name, name_of(k));
    EXPECT_EQ(found[static_cast<std::size_t>(k)].value, attribute_number(k).value) << name_of(k);
  }
}

TEST(StateFile, ComesBackOrderedByName) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  const std::string path = directory.path() + "/state.h5";
  write_state_file(path, nullptr, backwards(), {}, comm);
  const Metadata found = read_state_metadata(path, {"numbers"}, comm);
  expect_attributes(found.attributes);
  ASSERT_EQ(found.texts.size(), 2U);
  EXPECT_EQ(found.texts[0].name + found.texts[1].name, "ab");
  EXPECT_EQ(found.texts[1].text, "a text");
  ASSERT_EQ(found.groups.size(), 2U);
  EXPECT_EQ(found.groups[1].name, "words");
  EXPECT_TRUE(found.groups[1].columns.empty()); // was not asked for
  const MetadataGroup& numbers = found.groups[0];
  EXPECT_EQ(numbers.name, "numbers");
  expect_attributes(numbers.attributes);
  ASSERT_EQ(numbers.columns.size(), std::size_t{many});
  for (int k = 0; k < many; ++k) {
    const Column& column = numbers.columns[static_cast<std::size_t>(k)];
    EXPECT_EQ(column.name, name_of(k));
    EXPECT_EQ(std::get<std::vector<std::int64_t>>(column.values), (std::vector<std::int64_t>{k, -k}));
  }
}

TEST(StateFile, OtherFilesAreRefused) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  EXPECT_THROW(read_state_metadata(directory.path() + "/none.h5", {}, comm), FileError);
}

} // namespace
} // namespace trime::io
