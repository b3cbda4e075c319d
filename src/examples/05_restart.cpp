// SPDX-License-Identifier: BSD-3-Clause
// A mesh from a file, on any number of ranks: what a solver does that goes on from an earlier run.
//   mpirun -n 2 05_restart [FILE]     makes the mesh if there is no such file, else reads it
#include <trime/trime.hpp>

#include <cstdio>
#include <filesystem>
#include <string>

namespace {

trime::Mesh mesh_of(const std::string& path) {
  if (std::filesystem::exists(path))
    return trime::read_mesh(MPI_COMM_WORLD, path);
  auto plate = trime::rectangle("plate", {0, 0}, {2, 1}) - trime::circle("hole", {1, .5}, .2);
  auto mesh = trime::make_mesh(MPI_COMM_WORLD, plate, {.points = 2000});
  mesh.write(path);
  return mesh;
}

} // namespace

int main(int argc, char** argv) {
  trime::Environment mpi(argc, argv);
  try {
    auto mesh = mesh_of(argc > 1 ? argv[1] : "out/restart.h5");
    auto local = mesh.local();
    const double facets = local.sum(static_cast<double>(mesh.facets("hole").size()));
    if (mesh.communicator().is_root())
      std::printf("%lld points, %lld triangles, %.0f edges of the hole; hash %016llx\n",
                  static_cast<long long>(mesh.points()), static_cast<long long>(mesh.triangles()), facets,
                  static_cast<unsigned long long>(mesh.hash()));
    return mesh.certified() ? 0 : 5;
  } catch (const trime::Error& error) { // all ranks throw the same one
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 0)
      std::fprintf(stderr, "error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
