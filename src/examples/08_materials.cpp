// SPDX-License-Identifier: BSD-3-Clause
// Two materials with one interface: heat flows through a plate of iron with a copper end. The temperature has a kink at
// the interface, which linear elements show exactly, since edges follow it.   mpirun -n 2 08_materials [POINTS]
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

constexpr double kink = 0.6;                            // where copper begins
constexpr std::array<double, 3> conductivity{0, 1, 20}; // by number of the region: iron is the rest, copper comes next
constexpr double flow = 1 / (kink / conductivity[1] + (1 - kink) / conductivity[2]);

double exact(Vec2 p) {
  return p.x < kink ? flow * p.x / conductivity[1] : 1 - flow * (1 - p.x) / conductivity[2];
}

/// The matrix of linear elements times u, at points that are not held. Brings the ghosts of u up to date. Collective.
Field product(const trime::LocalMesh& mesh, const std::vector<char>& is_held, Field& u, Field* diagonal = nullptr) {
  mesh.update_ghosts(u);
  Field result(u.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const auto& [a, b, c] = mesh.triangles()[t];
    const Vec2 p = mesh.points()[at(a)], q = mesh.points()[at(b)], r = mesh.points()[at(c)];
    const std::array<Vec2, 3> side{r - q, p - r, q - p};
    const double k = conductivity[at(mesh.region(static_cast<LocalIndex>(t)))], scale = k / (2 * cross(q - p, r - p));
    const Vec2 slope = u[at(a)] * side[0] + u[at(b)] * side[1] + u[at(c)] * side[2];
    const std::array<LocalIndex, 3> corner{a, b, c};
    for (std::size_t i = 0; i < 3; ++i) {
      result[at(corner[i])] += is_held[at(corner[i])] ? 0 : scale * dot(side[i], slope);
      if (diagonal != nullptr)
        (*diagonal)[at(corner[i])] += scale * dot(side[i], side[i]);
    }
  }
  return result;
}

/// Conjugate gradients. Collective.
Field solve(const trime::LocalMesh& mesh, int most_steps) {
  const std::size_t n = mesh.points().size();
  std::vector<char> is_held(n, 0);
  Field u(n, 0), diagonal(n, 0);
  for (std::size_t i = 0; i < n; ++i)
    if (const double x = mesh.points()[i].x; x == 0 || x == 1) {
      is_held[i] = 1;
      u[i] = x;
    }
  const auto sum_of_products = [&](const Field& a, const Field& b) {
    double own = 0;
    for (std::size_t i = 0; i < at(mesh.owned_points()); ++i)
      own += a[i] * b[i];
    return mesh.sum(own);
  };
  Field residual = product(mesh, is_held, u, &diagonal), step(n, 0), scaled(n, 0);
  double before = 1, first = 0;
  for (int steps = 0; steps < most_steps; ++steps) {
    for (std::size_t i = 0; i < n; ++i)
      scaled[i] = -residual[i] / diagonal[i];
    const double now = -sum_of_products(residual, scaled);
    first = steps == 0 ? now : first;
    if (now <= 1e-26 * first)
      break;
    for (std::size_t i = 0; i < n; ++i)
      step[i] = scaled[i] + now / before * step[i];
    before = now;
    const Field image = product(mesh, is_held, step);
    const double length = now / sum_of_products(step, image);
    for (std::size_t i = 0; i < n; ++i) {
      u[i] += length * step[i];
      residual[i] += length * image[i];
    }
  }
  mesh.update_ghosts(u);
  return u;
}

int main(int argc, char** argv) {
  trime::Environment mpi(argc, argv);
  try {
    const auto plate = trime::rectangle("plate", {0, 0}, {1, 0.5});
    const trime::Region copper{"copper", trime::rectangle("end", {kink, 0}, {1, 0.5}), 0.5}; // with half the size
    const trime::Mesh whole = trime::make_mesh(
        MPI_COMM_WORLD, plate, {.points = argc > 1 ? std::atoll(argv[1]) : 2000, .regions = {copper}, .rest = "iron"});
    const trime::LocalMesh mesh = whole.local(); // with all triangles around owned points
    const Field u = solve(mesh, 5000);
    double worst = 0, length = 0;
    for (std::size_t i = 0; i < at(mesh.owned_points()); ++i)
      worst = std::fmax(worst, std::fabs(u[i] - exact(mesh.points()[i])));
    for (const trime::InnerEdge& edge : mesh.interfaces("iron|copper"))
      length +=
          edge.owned ? trime::geometry::length(mesh.points()[at(edge.second)] - mesh.points()[at(edge.first)]) : 0;
    length = mesh.sum(length);
    worst = mesh.communicator().max(worst);
    if (mesh.communicator().is_root())
      std::printf("%lld points; an interface of length %.12g; error %.1e\n", static_cast<long long>(whole.points()),
                  length, worst);
    return worst < 1e-9 && whole.certified() ? 0 : 1;
  } catch (const trime::Error& error) { // all ranks throw the same one
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 0)
      std::fprintf(stderr, "error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
