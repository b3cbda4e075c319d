// SPDX-License-Identifier: BSD-3-Clause
#include "simulated_work.hpp"

#include "comm/mpi_call.hpp"
#include "trime/comm/communicator.hpp"

#include <mpi.h>
#include <simgrid/host.h>
#include <smpi/smpi.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace trime::comm {
namespace {

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The stretches of a rank.
struct RankWork {
  std::vector<double> least; // [s] of each stretch, over the runs so far
  std::size_t known = 0;     // stretches of an earlier run; 0: no earlier run
  std::size_t next = 0;      // stretch
  double start = 0;          // [s] of the present one
  int depth = 1;             // of InMpi; before it begins the rank is as good as in MPI
};

/// State of all ranks: they are contexts of one thread.
std::vector<RankWork>& all_work() {
  static std::vector<RankWork> work;
  return work;
}

int world_rank() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

RankWork& own_work() {
  std::vector<RankWork>& work = all_work();
  if (work.empty()) {
    int ranks = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    work.resize(static_cast<std::size_t>(ranks));
  }
  return work[static_cast<std::size_t>(world_rank())];
}

/// Empty: nothing is kept.
std::string file_of_rank() {
  const char* directory = std::getenv("TRIME_SIMULATED_WORK");
  return directory ? fmt::format("{}/work-{}", directory, world_rank()) : std::string();
}

void end_stretch(RankWork& work) {
  const double seconds = thread_seconds() - work.start;
  if (work.next == work.least.size())
    work.least.push_back(seconds);
  double& least = work.least[work.next++];
  least = std::min(least, seconds);
  smpi_execute_flops(least * sg_host_get_speed(sg_host_self()));
}

} // namespace

InMpi::InMpi() {
  RankWork& work = own_work();
  if (work.depth++ == 0)
    end_stretch(work);
}

InMpi::~InMpi() {
  RankWork& work = own_work();
  if (--work.depth == 0)
    work.start = thread_seconds();
}

void begin_simulated_work() {
  RankWork& work = own_work();
  if (const std::string name = file_of_rank(); !name.empty())
    if (std::FILE* file = std::fopen(name.c_str(), "rb")) {
      for (double seconds = 0; std::fread(&seconds, sizeof seconds, 1, file) == 1;)
        work.least.push_back(seconds);
      std::fclose(file);
      work.known = work.least.size();
    }
  work.depth = 0;
  work.start = thread_seconds();
}

void end_simulated_work() {
  RankWork& work = own_work();
  end_stretch(work);
  work.depth = 1;
  if (work.known > 0 && work.next != work.known) {
    fmt::print(stderr, "trime_mpi: rank {} worked in {} stretches, and in {} in an earlier run: times mean nothing\n",
               world_rank(), work.next, work.known);
    abort_job(static_cast<int>(ExitCode::internal_error));
  }
  const std::string name = file_of_rank();
  if (name.empty())
    return;
  std::FILE* file = std::fopen(name.c_str(), "wb");
  if (!file || std::fwrite(work.least.data(), sizeof(double), work.least.size(), file) != work.least.size()) {
    fmt::print(stderr, "trime_mpi: cannot write {}\n", name);
    abort_job(static_cast<int>(ExitCode::file));
  }
  std::fclose(file);
}

} // namespace trime::comm
