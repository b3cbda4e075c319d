// SPDX-License-Identifier: BSD-3-Clause
// Main of the parallel tests: rank 0 prints as usual, the other ranks print their failures only, and the exit code is
// the largest of all ranks. Tests run in declared order on every rank: they hold collectives.
#include "trime/comm/communicator.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

namespace {

/// Prints what failed on a rank that prints nothing else.
class FailurePrinter : public ::testing::EmptyTestEventListener {
public:
  explicit FailurePrinter(int rank) : rank_(rank) {}

  void OnTestStart(const ::testing::TestInfo& test) override { test_ = &test; }
  void OnTestEnd(const ::testing::TestInfo&) override { test_ = nullptr; }
  void OnTestPartResult(const ::testing::TestPartResult& result) override {
    if (!result.failed())
      return;
    const ::testing::TestInfo* test = test_; // asking GoogleTest for it from here would wait for itself for ever
    std::fprintf(stderr, "[rank %d] %s.%s: %s:%d: %s\n", rank_, test ? test->test_suite_name() : "", //
                 test ? test->name() : "", result.file_name() ? result.file_name() : "?", result.line_number(),
                 result.message());
    std::fflush(stderr);
  }

private:
  int rank_;
  const ::testing::TestInfo* test_ = nullptr;
};

void prepare_rank(const trime::comm::Communicator& comm) {
  ::testing::FLAGS_gtest_shuffle = false;
  // An exception that leaves a test on one rank would let the others wait for ever: terminate, mpirun ends the rest.
  ::testing::FLAGS_gtest_catch_exceptions = comm.size() == 1;
  if (comm.is_root())
    return;
  ::testing::FLAGS_gtest_output = "";
  ::testing::TestEventListeners& listeners = ::testing::UnitTest::GetInstance()->listeners();
  delete listeners.Release(listeners.default_result_printer());
  listeners.Append(new FailurePrinter(comm.rank())); // owned by GoogleTest
}

/// Are there as many ranks as ctest asked for? The mpiexec of another MPI starts programs that believe to be alone.
bool is_complete(const trime::comm::Communicator& comm) {
  const char* asked = std::getenv("TRIME_TEST_RANKS");
  if (asked == nullptr || std::atoi(asked) == comm.size())
    return true;
  std::fprintf(stderr, "Expected %s ranks, found %d. Does this mpiexec belong to the MPI of this program?\n", asked,
               comm.size());
  return false;
}

} // namespace

int main(int argc, char** argv) {
  trime::comm::Environment environment(argc, argv);
  ::testing::InitGoogleTest(&argc, argv);
  const trime::comm::Communicator comm = trime::comm::Communicator::world();
  if (!is_complete(comm))
    return 1;
  prepare_rank(comm);
  const int here = RUN_ALL_TESTS();
  const auto anywhere = static_cast<int>(comm.max(std::int64_t{here}));
  if (comm.is_root() && here == 0 && anywhere != 0)
    std::fprintf(stderr, "Tests failed on another rank than 0, see above.\n");
  return anywhere;
}
