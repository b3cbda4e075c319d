// SPDX-License-Identifier: BSD-3-Clause
// Main of the serial tests: no MPI at all, so that the sanitizers see only our own code.
#include <gtest/gtest.h>

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
