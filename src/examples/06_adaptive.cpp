// SPDX-License-Identifier: BSD-3-Clause
// The size of the next mesh from a solution on the last one: three meshes, each finer where the function is steep.
//   mpirun -n 2 06_adaptive [POINTS]
#include <trime/trime.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

using trime::at;
using trime::Vec2;

/// Stands for the solution of a solver: a front along a circle.
double solution(Vec2 p) {
  return std::tanh(40 * (std::hypot(p.x - 0.5, p.y - 0.5) - 0.3));
}

/// Sizes on a grid over the unit square, the same on every rank.
class Grid {
public:
  Grid() : values_(n * n, coarse) {}

  void lower(Vec2 p, double size) {
    double& value = values_[index(cell(p.x), cell(p.y))];
    value = std::min(value, size);
  }
  /// No size grows faster than 0.3 per length.
  void grade() {
    for (std::size_t round = 0; round < n; ++round)
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          for (const auto& [k, l] : {std::array{i + 1, j}, std::array{i, j + 1}})
            if (k < n && l < n) {
              double &a = values_[index(i, j)], &b = values_[index(k, l)];
              a = std::min(a, b + 0.3 / n);
              b = std::min(b, a + 0.3 / n);
            }
  }
  double operator()(Vec2 p) const { // bilinear
    const double x = std::clamp(p.x * n - 0.5, 0.0, n - 1.0), y = std::clamp(p.y * n - 0.5, 0.0, n - 1.0);
    const std::size_t i = std::min(static_cast<std::size_t>(x), n - 2),
                      j = std::min(static_cast<std::size_t>(y), n - 2);
    const double s = x - static_cast<double>(i), t = y - static_cast<double>(j);
    return (1 - s) * ((1 - t) * values_[index(i, j)] + t * values_[index(i, j + 1)]) +
           s * ((1 - t) * values_[index(i + 1, j)] + t * values_[index(i + 1, j + 1)]);
  }

private:
  static constexpr std::size_t n = 64; // cells along each side
  static constexpr double coarse = 0.1;
  static std::size_t cell(double x) { return std::min(static_cast<std::size_t>(std::max(x, 0.0) * n), n - 1); }
  static std::size_t index(std::size_t i, std::size_t j) { return i * n + j; }
  std::vector<double> values_;
};

/// Where the solution changes by more than 0.2 within a triangle, the next one is to be as much smaller. Collective.
Grid sizes_after(const trime::Mesh& mesh, double& largest_change) {
  struct Wish {
    Vec2 place;
    double size, change;
  };
  auto local = mesh.local();
  std::vector<Wish> wishes;
  for (trime::LocalIndex t = 0; t < local.owned_triangles(); ++t) {
    const auto& [a, b, c] = local.triangles()[at(t)];
    const Vec2 p = local.points()[at(a)], q = local.points()[at(b)], r = local.points()[at(c)];
    const auto [least, most] = std::minmax({solution(p), solution(q), solution(r)});
    const double length = std::sqrt(std::abs(cross(q - p, r - p)));
    wishes.push_back({1.0 / 3 * (p + q + r), length * 0.2 / std::max(most - least, 0.02), most - least});
  }
  const auto all = trime::comm::from_bytes<Wish>( // every rank needs the sizes of all
      mesh.communicator().all_gather(trime::comm::to_bytes(std::span<const Wish>(wishes))));
  Grid grid;
  largest_change = 0;
  for (const Wish& wish : all) {
    grid.lower(wish.place, wish.size);
    largest_change = std::max(largest_change, wish.change);
  }
  grid.grade();
  return grid;
}

int main(int argc, char** argv) {
  trime::Environment mpi(argc, argv);
  try {
    const trime::GlobalId points = argc > 1 ? std::atoll(argv[1]) : 4000;
    auto square = trime::rectangle("square", {0, 0}, {1, 1});
    auto mesh = trime::make_mesh(MPI_COMM_WORLD, square, {.points = points});
    for (int round = 0; round < 3; ++round) {
      double largest_change = 0;
      const Grid grid = sizes_after(mesh, largest_change);
      if (mesh.communicator().is_root())
        std::printf("mesh %d: %lld points; the solution changes by %.3f within a triangle at most\n", round + 1,
                    static_cast<long long>(mesh.points()), largest_change);
      if (round < 2)
        mesh = trime::make_mesh(MPI_COMM_WORLD, square, grid, {.points = points});
    }
    return mesh.certified() ? 0 : 5;
  } catch (const trime::Error& error) { // all ranks throw the same one
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 0)
      std::fprintf(stderr, "error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
