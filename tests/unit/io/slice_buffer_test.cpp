// SPDX-License-Identifier: BSD-3-Clause
#include "io/slice_buffer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace trime::io {
namespace {

constexpr std::uint64_t page = 4096, line = 64;

TEST(SliceBuffer, LiesHalfAPageOffFromItsPlaceInTheFile) {
  SliceBuffer buffer;
  for (const std::size_t bytes : {1U, 100U, 5000U, 70000U})
    for (const std::uint64_t place : {0U, 1U, 63U, 64U, 2048U, 4095U, 4096U, 123457U}) {
      buffer.resize(bytes, place);
      const auto address = reinterpret_cast<std::uintptr_t>(buffer.data());
      EXPECT_EQ(address % line, 0U);
      const std::uint64_t off = (address - place) % page; // modulo 2^64, which pages divide
      EXPECT_LE(off, page / 2) << place;
      EXPECT_GT(off, page / 2 - line) << place;
      std::fill(buffer.data(), buffer.data() + bytes, std::byte{7}); // all of it may be written
    }
}

TEST(SliceBuffer, SwapsWithAnother) {
  SliceBuffer a, b;
  a.resize(10, 5);
  b.resize(20, 3000);
  *a.data() = std::byte{1};
  *b.data() = std::byte{2};
  const std::byte* of_a = a.data();
  swap(a, b);
  EXPECT_EQ(*a.data(), std::byte{2});
  EXPECT_EQ(*b.data(), std::byte{1});
  EXPECT_EQ(b.data(), of_a);
}

} // namespace
} // namespace trime::io
