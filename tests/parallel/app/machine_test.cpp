// SPDX-License-Identifier: BSD-3-Clause
// The warnings of too many threads: the advice is one that helps.
#include "app/machine.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace trime::app {
namespace {

/// What rank 0 is told, all ranks being placed alike.
std::string report(const Placement& placement, const comm::Communicator& comm) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* stream = open_memstream(&text, &size);
  Log log(LogLevel::warning, comm.is_root(), stream);
  report_placement(placement, comm, log);
  std::fclose(stream);
  const std::string told = text;
  std::free(text); // NOLINT: it comes from malloc
  return told;
}

Placement placement(int threads, int cores, int sharing) {
  Placement result;
  result.setup_threads = result.threads = threads;
  result.cores = cores;
  result.sharing = sharing;
  return result;
}

TEST(Machine, AdvisesFewerThreadsOnlyWhereThatHelps) {
  const comm::Communicator comm = comm::Communicator::world();
  const std::string fits = report(placement(2, 4, 2), comm), threads = report(placement(4, 4, 2), comm),
                    ranks = report(placement(1, 2, 3), comm);
  EXPECT_EQ(fits, "");
  if (!comm.is_root())
    return;
  EXPECT_NE(threads.find("set --threads 2 or start fewer ranks"), std::string::npos) << threads;
  EXPECT_NE(ranks.find("; start fewer ranks"), std::string::npos) << ranks;
  EXPECT_EQ(ranks.find("--threads"), std::string::npos) << ranks;
}

} // namespace
} // namespace trime::app
