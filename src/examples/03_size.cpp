// SPDX-License-Identifier: BSD-3-Clause
// Triangles of different sizes: by a function, and small where the shape has small features.
//   mpirun -n 2 03_size [POINTS [DIRECTORY]]
#include <trime/trime.hpp>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

void report(const char* what, const trime::Mesh& mesh) {
  if (mesh.communicator().is_root())
    std::printf("%s: %lld points, median alpha %.4f, edge length over wanted length %.3f +- %.3f\n", what,
                static_cast<long long>(mesh.points()), mesh.quality().alpha.median, mesh.quality().size_mean,
                mesh.quality().size_std);
}

} // namespace

int main(int argc, char** argv) {
  trime::Environment mpi(argc, argv);
  try {
    const trime::GlobalId points = argc > 1 ? std::atoll(argv[1]) : 5000;
    const std::string directory = argc > 2 ? argv[2] : "out";
    auto plate = trime::rectangle("plate", {0, 0}, {2, 1}) - trime::circle("hole", {1, .5}, .02);

    // Only ratios count: the field is scaled so that the number of points comes out.
    auto graded =
        trime::make_mesh(MPI_COMM_WORLD, plate, [](trime::Vec2 p) { return 1 + 3 * p.x; }, {.points = points});
    graded.write(directory + "/graded.h5", {.overwrite = true});
    report("graded", graded);

    auto automatic = trime::make_mesh(MPI_COMM_WORLD, plate, trime::sizes::automatic(0.1), {.points = points});
    automatic.write(directory + "/automatic.h5", {.overwrite = true});
    report("automatic", automatic);
    return graded.certified() && automatic.certified() ? 0 : 5;
  } catch (const trime::Error& error) { // all ranks throw the same one
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 0)
      std::fprintf(stderr, "error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
