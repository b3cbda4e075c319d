// SPDX-License-Identifier: BSD-3-Clause
// The warnings of too many threads, with advice that helps, and of the launcher of another MPI.
#include "app/machine.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <optional>
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

/// mpirun -np 1 binds the rank to one core, so `--threads` alone would not end the warning.
TEST(Machine, ABoundRankIsAdvisedToLeaveItsCore) {
  const comm::Communicator comm = comm::Communicator::world();
  const std::string bound = report(placement(100000, 1, 1), comm);
  if (!comm.is_root())
    return;
  EXPECT_NE(bound.find("--bind-to none"), std::string::npos) << bound;
  EXPECT_NE(bound.find("set --threads "), std::string::npos) << bound;
}

/// Sets a variable of the environment until its end.
class Variable {
public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name))
      before_ = before;
    setenv(name, value, 1);
  }
  ~Variable() {
    if (before_)
      setenv(name_, before_->c_str(), 1);
    else
      unsetenv(name_);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST(Machine, WarnsOfTheLauncherOfAnotherMpi) {
  const comm::Communicator world = comm::Communicator::world(), alone = comm::Communicator::self();
  const Variable four("OMPI_COMM_WORLD_SIZE", "4");
  const Placement fits = placement(1, 1, 1);
  EXPECT_NE(report(fits, alone).find("4 processes were launched, but each sees only itself"), std::string::npos);
  if (world.size() > 1) {
    EXPECT_EQ(report(fits, world), "");
  }
  const Variable one("OMPI_COMM_WORLD_SIZE", "1");
  EXPECT_EQ(report(fits, alone), "");
}

} // namespace
} // namespace trime::app
