// SPDX-License-Identifier: BSD-3-Clause
// A plate with a hole and a notch given by a function; its boundary by name.   mpirun -n 2 02_hole [POINTS [FILE]]
#include <trime/trime.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>

/// Negative inside of a square that stands on its corner at (2, 1), 0.4 wide: a notch in the corner of the plate.
double notch(trime::Vec2 p) {
  return std::abs(p.x - 2) + std::abs(p.y - 1) - 0.2;
}

int main(int argc, char** argv) {
  trime::Environment mpi(argc, argv);
  try {
    auto plate = trime::rectangle("plate", {0, 0}, {2, 1}) - trime::circle("hole", {1, .5}, .2) -
                 trime::function("notch", notch, {{1.8, 0.8}, {2.2, 1.2}});
    auto mesh = trime::make_mesh(MPI_COMM_WORLD, plate, {.points = argc > 1 ? std::atoll(argv[1]) : 5000});
    if (!mesh.certified())
      return 5;
    mesh.write(argc > 2 ? argv[2] : "out/hole.h5", {.overwrite = true});

    auto local = mesh.local(); // this rank's points and triangles, with ghosts
    for (const std::string& name : mesh.facet_names()) {
      double length = 0;
      for (auto facet : local.facets(name))
        if (facet.owned)
          length +=
              trime::geometry::length(local.points()[trime::at(facet.second)] - local.points()[trime::at(facet.first)]);
      length = local.sum(length);
      if (mesh.communicator().is_root())
        std::printf("%s: length %.6f\n", name.c_str(), length);
    }
    return 0;
  } catch (const trime::Error& error) { // all ranks throw the same one
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 0)
      std::fprintf(stderr, "error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
