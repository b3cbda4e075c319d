// SPDX-License-Identifier: BSD-3-Clause
// A square, meshed by all ranks and written to a file.   mpirun -n 2 01_square [POINTS [FILE]]
#include <trime/trime.hpp>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  trime::Environment mpi(argc, argv);
  try {
    auto square = trime::rectangle("square", {0, 0}, {1, 1});
    auto mesh = trime::make_mesh(MPI_COMM_WORLD, square, {.points = argc > 1 ? std::atoll(argv[1]) : 5000});
    if (!mesh.certified())
      return 5;
    mesh.write(argc > 2 ? argv[2] : "out/square.h5", {.overwrite = true});
    if (mesh.communicator().is_root())
      std::printf("%lld points, %lld triangles; hash %016llx\n", static_cast<long long>(mesh.points()),
                  static_cast<long long>(mesh.triangles()), static_cast<unsigned long long>(mesh.hash()));
    return 0;
  } catch (const trime::Error& error) { // all ranks throw the same one
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 0)
      std::fprintf(stderr, "error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
