// SPDX-License-Identifier: BSD-3-Clause
// Your own solver on the ranks that made the mesh: plain arrays, no file. Poisson's equation by linear elements and
// conjugate gradients.   mpirun -n 2 04_solver [POINTS]
#include "plate.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <vector>

using plate::Vec2;
using trime::at;
using trime::LocalIndex;
using trime::LocalMesh;
using Field = std::vector<double>; // a value for each local point

class Poisson {
public:
  explicit Poisson(const LocalMesh& mesh)
      : mesh_(mesh), free_(mesh.points().size(), 1), diagonal_(mesh.points().size()), load_(diagonal_) {
    for (const auto& triangle : mesh_.triangles()) { // owned points have all of their triangles: nothing to sum up
      const auto [side, area] = element(triangle);
      for (std::size_t i = 0; i < 3; ++i)
        diagonal_[at(triangle[i])] += dot(side[i], side[i]) / (4 * area);
      for (std::size_t i = 0; i < 3; ++i) { // three middles of edges
        const LocalIndex a = triangle[i], b = triangle[(i + 1) % 3];
        const double half = area / 6 * plate::source(0.5 * (mesh_.points()[at(a)] + mesh_.points()[at(b)]));
        load_[at(a)] += half;
        load_[at(b)] += half;
      }
    }
    for (const trime::Facet& facet : mesh_.facets("hole")) {
      const Vec2 along = mesh_.points()[at(facet.second)] - mesh_.points()[at(facet.first)];
      for (const LocalIndex point : {facet.first, facet.second}) // the outer normal, as long as the edge
        load_[at(point)] += 0.5 * dot(plate::gradient(mesh_.points()[at(point)]), Vec2{along.y, -along.x});
    }
    for (const trime::Facet& facet : mesh_.facets("plate"))
      free_[at(facet.first)] = free_[at(facet.second)] = 0;
  }

  /// Preconditioned by the diagonal. @return the number of steps
  int solve(Field& u, double tolerance, int most_steps) const {
    u.assign(load_.size(), 0);
    for (std::size_t i = 0; i < u.size(); ++i)
      u[i] = free_[i] ? 0 : plate::solution(mesh_.points()[i]);
    Field residual = load_, step(u.size()), image = product(u), scaled(u.size());
    double before = 0, first = 0;
    for (int steps = 0; steps < most_steps; ++steps) {
      for (std::size_t i = 0; i < u.size(); ++i) {
        residual[i] = free_[i] ? residual[i] - image[i] : 0;
        scaled[i] = residual[i] / diagonal_[i];
      }
      const double now = dot_product(residual, scaled);
      first = steps == 0 ? now : first;
      if (now <= tolerance * tolerance * first)
        return steps;
      for (std::size_t i = 0; i < u.size(); ++i)
        step[i] = scaled[i] + (steps == 0 ? 0 : now / before * step[i]);
      before = now;
      image = product(step);
      const double length = now / dot_product(step, image);
      for (std::size_t i = 0; i < u.size(); ++i) {
        u[i] += length * step[i];
        image[i] *= length;
      }
    }
    return most_steps;
  }

  /// Square root of the integral of (u - solution)^2.
  double error(Field u) const {
    mesh_.update_ghosts(u);
    double square = 0;
    for (LocalIndex t = 0; t < mesh_.owned_triangles(); ++t) {
      const auto& triangle = mesh_.triangles()[at(t)];
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t a = at(triangle[i]), b = at(triangle[(i + 1) % 3]);
        const double away = (u[a] + u[b]) / 2 - plate::solution(0.5 * (mesh_.points()[a] + mesh_.points()[b]));
        square += element(triangle).area / 3 * away * away;
      }
    }
    return std::sqrt(mesh_.sum(square));
  }

private:
  struct Element {
    std::array<Vec2, 3> side; // opposite of each vertex
    double area;
  };
  Element element(const std::array<LocalIndex, 3>& triangle) const {
    const Vec2 a = mesh_.points()[at(triangle[0])], b = mesh_.points()[at(triangle[1])],
               c = mesh_.points()[at(triangle[2])];
    return {{c - b, a - c, b - a}, 0.5 * cross(b - a, c - a)};
  }

  /// Matrix times u at the free owned points. Brings the ghosts of u up to date.
  Field product(Field& u) const {
    mesh_.update_ghosts(u);
    Field result(u.size(), 0);
    for (const auto& triangle : mesh_.triangles()) {
      const auto [side, area] = element(triangle);
      Vec2 slope{};
      for (std::size_t j = 0; j < 3; ++j)
        slope = slope + u[at(triangle[j])] * side[j];
      for (std::size_t i = 0; i < 3; ++i)
        result[at(triangle[i])] += dot(side[i], slope) / (4 * area);
    }
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] *= free_[i];
    return result;
  }

  /// Over the points of all ranks: each counts where it is owned.
  double dot_product(const Field& a, const Field& b) const {
    double own = 0;
    for (std::size_t i = 0; i < at(mesh_.owned_points()); ++i)
      own += a[i] * b[i];
    return mesh_.sum(own);
  }

  const LocalMesh& mesh_;
  std::vector<char> free_; // 0 where u is given
  Field diagonal_, load_;
};

int main(int argc, char** argv) {
  trime::Environment mpi(argc, argv);
  try {
    const LocalMesh mesh =
        plate::mesh(MPI_COMM_WORLD, argc > 1 ? std::atoll(argv[1]) : 5000, trime::handover::Overlap::triangles);
    const Poisson poisson(mesh);
    const trime::handover::LocalMesh& arrays = mesh.arrays();
    Field u;
    const int most = 100 + 20 * static_cast<int>(std::sqrt(static_cast<double>(arrays.total_points)));
    const int steps = poisson.solve(u, 1e-10, most);
    const double error = poisson.error(u);
    if (mesh.communicator().is_root())
      std::printf("%lld points, %lld triangles; %d steps; error %.6e\n", static_cast<long long>(arrays.total_points),
                  static_cast<long long>(arrays.total_triangles), steps, error);
    return steps < most ? 0 : 1;
  } catch (const trime::Error& error) { // all ranks throw the same one
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 0)
      std::fprintf(stderr, "error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
