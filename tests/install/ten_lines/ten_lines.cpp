// SPDX-License-Identifier: BSD-3-Clause
// The ten lines of the first page.
// clang-format off
#include <trime/trime.hpp>
int main(int argc, char** argv) {
  trime::Environment mpi(argc, argv);
  auto plate = trime::rectangle("plate", {0, 0}, {2, 1}) - trime::circle("hole", {1, .5}, .2);
  auto mesh = trime::make_mesh(MPI_COMM_WORLD, plate, {.points = 5000});
  if (!mesh.certified()) return 5;
  mesh.write("plate.h5");
  auto local = mesh.local();
  for (auto facet : local.facets("hole")) { /* boundary condition */ }
}
