// SPDX-License-Identifier: BSD-3-Clause
// Finite volumes on the Voronoi cells: heat flows through a square of two materials, 0 on its left side and 1 on its
// right. The flux between two cells needs their sites only, and it is exact for temperatures that are linear in each
// material.   mpirun -n 3 09_finite_volumes [POINTS]
#include <trime/trime.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

using trime::at;
using trime::LocalIndex;
using trime::Vec2;
using Field = std::vector<double>; // a value for each local point

constexpr std::array<double, 3> conductivity{0, 10, 1}; // by number of the region: the rest is hard, soft comes next
constexpr double flow = 1 / (0.5 / conductivity[1] + 0.5 / conductivity[2]);

double exact(Vec2 p) {
  return p.x < 0.5 ? flow * p.x / conductivity[2] : 1 - flow * (1 - p.x) / conductivity[1];
}

/// The equations of all cells: what flows through each face per difference of temperatures.
struct System {
  const trime::LocalCells& cells;
  std::vector<double> face_flow; // by face
  std::vector<char> is_held;     // by local point
};

System assemble(const trime::LocalCells& cells) {
  const trime::dual::LocalCells& arrays = cells.arrays();
  System system{cells, {}, std::vector<char>(cells.mesh().points().size(), 0)};
  for (std::size_t f = 0; f < arrays.faces.size(); ++f) {
    const auto [first, second] = arrays.face_lengths[f]; // one for each material that the face lies in
    const auto [here, there] = arrays.face_regions[f];   // 0, with conductivity 0, if there is one material only
    system.face_flow.push_back((conductivity[at(here)] * first + conductivity[at(there)] * second) /
                               length(arrays.face_arms[f]));
  }
  for (std::size_t i = 0; i < cells.mesh().points().size(); ++i)
    system.is_held[i] = cells.mesh().points()[i].x == 0 || cells.mesh().points()[i].x == 1;
  return system;
}

/// Computes the flow out of each owned cell whose value is not given. Brings the ghosts of u up to date. Collective.
Field outflow(const System& system, Field& u) {
  const trime::dual::LocalCells& cells = system.cells.arrays();
  system.cells.mesh().update_ghosts(u);
  Field result(u.size(), 0);
  for (std::size_t i = 0; i < at(cells.cells); ++i)
    for (auto k = static_cast<std::size_t>(cells.neighbour_first[i]);
         !system.is_held[i] && k < static_cast<std::size_t>(cells.neighbour_first[i + 1]); ++k)
      result[i] += system.face_flow[at(cells.neighbour_faces[k])] * (u[i] - u[at(cells.neighbours[k])]);
  return result;
}

/// Conjugate gradients. The matrix is symmetric, since both cells of a face use the same number. Collective.
Field solve(const System& system, int most_steps) {
  const trime::LocalMesh& mesh = system.cells.mesh();
  Field u(mesh.points().size(), 0);
  for (std::size_t i = 0; i < u.size(); ++i)
    u[i] = system.is_held[i] ? mesh.points()[i].x : 0;
  const auto product = [&](const Field& a, const Field& b) {
    double own = 0;
    for (std::size_t i = 0; i < at(mesh.owned_points()); ++i)
      own += a[i] * b[i];
    return mesh.sum(own);
  };
  Field residual = outflow(system, u), step(u.size(), 0);
  double before = 1, first = 0;
  for (int steps = 0; steps < most_steps; ++steps) {
    const double now = product(residual, residual);
    first = steps == 0 ? now : first;
    if (now <= 1e-28 * first)
      break;
    for (std::size_t i = 0; i < u.size(); ++i)
      step[i] = now / before * step[i] - residual[i];
    before = now;
    const Field image = outflow(system, step);
    const double stride = now / product(step, image);
    for (std::size_t i = 0; i < u.size(); ++i) {
      u[i] += stride * step[i];
      residual[i] += stride * image[i];
    }
  }
  return u;
}

int main(int argc, char** argv) {
  trime::Environment mpi(argc, argv);
  try {
    const auto square = trime::rectangle("square", {0, 0}, {1, 1});
    const trime::Region soft{"soft", trime::rectangle("left", {0, 0}, {0.5, 1})};
    const trime::Mesh whole = trime::make_mesh(
        MPI_COMM_WORLD, square, {.points = argc > 1 ? std::atoll(argv[1]) : 2000, .regions = {soft}, .rest = "hard"});
    const trime::LocalCells cells = whole.cells();
    const System system = assemble(cells);
    const Field u = solve(system, 5000);
    double worst = 0, area = 0, least = 1;
    for (std::size_t i = 0; i < at(cells.arrays().cells); ++i) {
      worst = std::fmax(worst, std::fabs(u[i] - exact(cells.mesh().points()[i])));
      area += cells.arrays().areas[i];
    }
    for (const double k : system.face_flow)
      least = std::fmin(least, k);
    const trime::comm::Communicator& comm = whole.communicator();
    area = cells.mesh().sum(area);
    worst = comm.max(worst);
    least = -comm.max(-least);
    if (comm.is_root())
      std::printf("%lld cells with the area %.12g; smallest coefficient %.1e; error %.1e\n",
                  static_cast<long long>(whole.points()), area, least, worst);
    return worst < 1e-10 && least > -1e-12 && whole.certified() ? 0 : 1;
  } catch (const trime::Error& error) { // all ranks throw the same one
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 0)
      std::fprintf(stderr, "error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
