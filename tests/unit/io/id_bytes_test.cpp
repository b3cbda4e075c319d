// SPDX-License-Identifier: BSD-3-Clause
// The width of the numbers of points in the mesh file.
#include "io/id_bytes.hpp"

#include <gtest/gtest.h>

namespace trime::io {
namespace {

TEST(IdBytes, AreEightOnlyIfTheLastOffsetNeedsThem) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max() / 3;
  EXPECT_EQ(id_bytes(0), 4);
  EXPECT_EQ(id_bytes(most), 4);
  EXPECT_EQ(id_bytes(most + 1), 8);
}

} // namespace
} // namespace trime::io
