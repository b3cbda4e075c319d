// SPDX-License-Identifier: BSD-3-Clause
// trime_check FILE.h5 [CONFIG]: recomputes from a mesh file all that it promises, and says what does not hold.
// One process, no MPI; exact predicates of CGAL, exact integers of Boost; shares no code with trime_mpi.
#include "checks.hpp"
#include "joined_mesh.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace {

constexpr const char* help =
    R"(trime_check FILE.h5 [CONFIG]

Recomputes from a mesh file of trime_mpi all that it promises: triangles, Delaunay edges, boundary loops, area, tags,
regions, Voronoi cells, quality, hash, tables, the stored checks, and the mesh against the shape. One line a check: expected, found, first wrong place.

  FILE.h5   a mesh that trime_mpi has written
  CONFIG    the shape is that of this config; without it, of the one that is stored in the file

Exit codes: 0 all checks passed, 2 wrong command line or config, 4 no mesh file, 5 a check failed, 1 internal error.
)";

/// Curves that are split have boundary edges on both sides. The certificate and the shape know the mesh without them.
void check_all(const trime_check::StoredFile& file, const trime_check::Mesh& mesh, const std::string& config,
               trime_check::Report& report) {
  const bool is_split = !mesh.split_pairs.empty();
  const trime_check::Mesh joined = is_split ? trime_check::joined_mesh(file, mesh) : trime_check::Mesh{};
  const trime_check::Mesh& whole = is_split ? joined : mesh;
  trime_check::Counted counted = trime_check::check_surface(file, mesh, report), of_whole = counted;
  if (is_split) {
    of_whole = trime_check::check_joined_surface(file, whole, report);
    counted.corners = of_whole.corners;
    trime_check::check_splits(file, mesh, report);
  }
  trime_check::check_curves(file, whole, report);
  trime_check::check_lines(file, mesh, report);
  trime_check::check_regions(file, mesh, report);
  trime_check::check_losses(file, mesh, report);
  trime_check::check_cells(file, mesh, report);
  trime_check::check_summary(file, {mesh, counted}, {whole, of_whole}, report);
  trime_check::check_tables(file, mesh, counted, report);
  trime_check::check_shape(file, whole, config, report);
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() == 1 && (arguments[0] == "--help" || arguments[0] == "-h")) {
    fmt::print("{}", help);
    return 0;
  }
  if (arguments.size() == 1 && arguments[0] == "--version") {
    fmt::print("trime_check {}\n", TRIME_VERSION);
    return 0;
  }
  if (arguments.empty() || arguments.size() > 2 || arguments[0].starts_with('-'))
    throw trime_check::Failure(trime_check::ExitCode::usage,
                               "expected a mesh file FILE.h5 and optionally a config file; see trime_check --help");
  const trime_check::StoredFile file(arguments[0]);
  trime_check::Mesh mesh;
  trime_check::Report report;
  if (trime_check::read_mesh(file, mesh, report) && trime_check::check_arrays(file, mesh, report)) {
    check_all(file, mesh, arguments.size() > 1 ? arguments[1] : "", report);
  } else
    report.skip("geometry", "nothing can be computed from these arrays");
  fmt::print("{}: {} points, {} triangles, {} facets\n{}", arguments[0], mesh.points.size(), mesh.triangles.size(),
             mesh.facets.size(), report.text());
  return static_cast<int>(report.all_passed() ? trime_check::ExitCode::sound : trime_check::ExitCode::damaged);
}

} // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const trime_check::Failure& failure) {
    fmt::print(stderr, "trime_check: error: {}\n", failure.what());
    return static_cast<int>(failure.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "trime_check: internal error: {}\n", error.what());
    return static_cast<int>(trime_check::ExitCode::internal_error);
  }
}
