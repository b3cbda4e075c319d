// SPDX-License-Identifier: BSD-3-Clause
// The ten lines in a program that has MPI running: twice, on half of the ranks, and with a mesh that dies after MPI.
#include <trime/trime.hpp>

#include <cstdio>
#include <mpi.h>

namespace {

auto plate() {
  return trime::rectangle("plate", {0, 0}, {2, 1}) - trime::circle("hole", {1, .5}, .2);
}

} // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  trime::Environment does_nothing(argc, argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm half = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, rank % 2, rank, &half);
  auto first = trime::make_mesh(MPI_COMM_WORLD, plate(), {.points = 5000});
  auto second = trime::make_mesh(half, plate(), {.points = 5000});
  MPI_Comm_free(&half);
  if (!first.certified() || first.hash() != second.hash())
    return 5;
  if (rank % 2 == 0)
    second.write("half.h5");
  first.write("whole.h5");
  MPI_Comm freed = MPI_COMM_NULL;
  MPI_Comm_dup(MPI_COMM_WORLD, &freed);
  const MPI_Comm copy = freed;
  MPI_Comm_free(&freed);
  int told = 0;
  for (const MPI_Comm bad : {freed, copy})
    try {
      trime::make_mesh(bad, plate(), {.points = 100});
    } catch (const trime::ConfigError& error) {
      ++told;
      if (rank == 0)
        std::printf("%s\n", error.what());
    }
  MPI_Finalize();
  try {
    first.local();
  } catch (const trime::ConfigError& error) {
    ++told;
    if (rank == 0)
      std::printf("%s\n", error.what());
  }
  return told == 3 ? 0 : 1;
}
