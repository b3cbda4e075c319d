// SPDX-License-Identifier: BSD-3-Clause
// Poisson's equation by PETSc on the ranks that made the mesh; no file lies between. The cells of the ranks become a
// DMPlex, the parts of the boundary its labels, by name; linear elements, conjugate gradients with algebraic multigrid.
//   mpirun -np 2 poisson_petsc [POINTS [options of PETSc, such as -ksp_monitor -pc_type hypre]]
#include "plate.hpp"

#include <petscdmplex.h>
#include <petscksp.h>
#include <petscsf.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

using plate::Vec2;
using trime::at;
using trime::GlobalId;
using trime::LocalIndex;
using trime::comm::Communicator;
using trime::handover::LocalMesh;

/// PETSc's integers may have 32 bits.
PetscInt to_petsc(GlobalId id) {
  if (id > std::numeric_limits<PetscInt>::max())
    throw trime::ConfigError("too many points for this PETSc: take one with 64 bit indices");
  return static_cast<PetscInt>(id);
}

/// The point of the DMPlex for the edge between two points of the mesh. `known`: global ids of its vertices, ascending.
PetscErrorCode find_edge(DM dm, const std::vector<PetscInt>& known, std::array<GlobalId, 2> ends, PetscInt* edge) {
  PetscFunctionBeginUser;
  PetscInt first_vertex = 0, count = 0, vertices[2];
  const PetscInt* edges = nullptr;
  PetscCall(DMPlexGetDepthStratum(dm, 0, &first_vertex, nullptr));
  for (const int k : {0, 1})
    vertices[k] =
        first_vertex + static_cast<PetscInt>(std::lower_bound(known.begin(), known.end(), ends[k]) - known.begin());
  PetscCall(DMPlexGetJoin(dm, 2, vertices, &count, &edges));
  PetscCheck(count == 1, PETSC_COMM_SELF, PETSC_ERR_PLIB, "a boundary edge is not in the DMPlex");
  *edge = edges[0];
  PetscCall(DMPlexRestoreJoin(dm, 2, vertices, &count, &edges));
  PetscFunctionReturn(0);
}

/// The mesh of all ranks, with a label for each part of the boundary that has its name. Collective.
PetscErrorCode make_plex(const LocalMesh& mesh, const std::vector<std::string>& part_names, DM* dm) {
  PetscFunctionBeginUser;
  std::vector<PetscInt> cells;
  for (LocalIndex t = 0; t < mesh.owned_triangles; ++t)
    for (const LocalIndex point : mesh.triangles[at(t)])
      cells.push_back(to_petsc(mesh.global_id(point)));
  std::vector<PetscReal> coordinates;
  for (LocalIndex i = 0; i < mesh.owned_points; ++i)
    coordinates.insert(coordinates.end(), {mesh.points[at(i)].x, mesh.points[at(i)].y});
  PetscSF owners = nullptr;
  PetscCall(DMPlexCreateFromCellListParallelPetsc(PETSC_COMM_WORLD, 2, mesh.owned_triangles, mesh.owned_points,
                                                  to_petsc(mesh.total_points), 3, PETSC_TRUE, cells.data(), 2,
                                                  coordinates.data(), &owners, nullptr, dm));
  std::sort(cells.begin(), cells.end()); // PETSc has them; the vertices of a DMPlex go by global ids
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  for (const std::string& name : part_names)
    PetscCall(DMCreateLabel(*dm, name.c_str()));
  for (LocalIndex k = 0; k < mesh.owned_facets; ++k) {
    const auto& [a, b] = mesh.facets[at(k)];
    PetscInt edge = 0;
    PetscCall(find_edge(*dm, cells, {mesh.global_id(a), mesh.global_id(b)}, &edge));
    PetscCall(DMSetLabelValue(*dm, part_names[at(mesh.facet_parts[at(k)])].c_str(), edge, 1));
  }
  for (const std::string& name : part_names) { // the ends of the edges as well, wherever they are
    DMLabel label = nullptr;
    PetscCall(DMGetLabel(*dm, name.c_str(), &label));
    PetscCall(DMPlexLabelComplete(*dm, label));
  }
  PetscCall(PetscSFDestroy(&owners));
  PetscFunctionReturn(0);
}

/// One unknown at each vertex; those of the label `given` are no unknowns. Collective.
PetscErrorCode number_unknowns(DM dm, const char* given) {
  PetscFunctionBeginUser;
  const PetscInt components = 1, of_dimension[] = {1, 0, 0}, field = 0;
  IS points = nullptr;
  PetscSection section = nullptr;
  PetscCall(DMSetNumFields(dm, 1));
  PetscCall(DMGetStratumIS(dm, given, 1, &points)); // null where a rank has none
  PetscCall(DMPlexCreateSection(dm, nullptr, &components, of_dimension, points ? 1 : 0, &field, nullptr, &points,
                                nullptr, &section));
  PetscCall(DMSetLocalSection(dm, section));
  PetscCall(PetscSectionDestroy(&section));
  PetscCall(ISDestroy(&points));
  PetscFunctionReturn(0);
}

/// Corners of a cell or an edge of the DMPlex.
PetscErrorCode corners_of(DM dm, PetscInt item, std::array<Vec2, 3>* corners) {
  PetscFunctionBeginUser;
  DM of_coordinates = nullptr;
  PetscSection section = nullptr;
  Vec coordinates = nullptr;
  PetscInt count = 6;
  std::array<PetscScalar, 6> values{};
  PetscScalar* into = values.data();
  PetscCall(DMGetCoordinateDM(dm, &of_coordinates));
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMPlexVecGetClosure(of_coordinates, section, coordinates, item, &count, &into));
  for (std::size_t k = 0; k < 3; ++k)
    (*corners)[k] = {values[2 * k], values[2 * k + 1]};
  PetscFunctionReturn(0);
}

/// Values of a local vector at the corners of an item.
PetscErrorCode values_of(DM dm, Vec local, PetscInt item, std::array<PetscScalar, 3>* values) {
  PetscFunctionBeginUser;
  PetscInt count = 3;
  PetscScalar* into = values->data();
  PetscCall(DMPlexVecGetClosure(dm, nullptr, local, item, &count, &into));
  PetscFunctionReturn(0);
}

/// Puts the solution where it is given.
PetscErrorCode set_given(DM dm, const char* given, Vec local) {
  PetscFunctionBeginUser;
  PetscInt first_vertex = 0, last_vertex = 0;
  PetscCall(DMPlexGetDepthStratum(dm, 0, &first_vertex, &last_vertex));
  for (PetscInt vertex = first_vertex; vertex < last_vertex; ++vertex) {
    PetscInt value = -1;
    PetscCall(DMGetLabelValue(dm, given, vertex, &value));
    if (value != 1)
      continue;
    std::array<Vec2, 3> place;
    PetscCall(corners_of(dm, vertex, &place));
    const PetscScalar u = plate::solution(place[0]);
    PetscCall(DMPlexVecSetClosure(dm, nullptr, local, vertex, &u, INSERT_ALL_VALUES));
  }
  PetscFunctionReturn(0);
}

/// Matrix and right-hand side of the cells of this rank; `local` has the given values.
PetscErrorCode add_cells(DM dm, Vec local, Mat matrix, Vec load) {
  PetscFunctionBeginUser;
  PetscInt first = 0, last = 0;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &first, &last));
  for (PetscInt cell = first; cell < last; ++cell) {
    std::array<Vec2, 3> p;
    std::array<PetscScalar, 3> known{}, right{};
    PetscCall(corners_of(dm, cell, &p));
    PetscCall(values_of(dm, local, cell, &known));
    const std::array<Vec2, 3> side{p[2] - p[1], p[0] - p[2], p[1] - p[0]};
    const double area = 0.5 * std::abs(cross(side[0], side[1]));
    std::array<PetscScalar, 9> stiffness{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = (i + 1) % 3, previous = (i + 2) % 3; // the source at the middles of two edges
      right[i] = area / 6 * (plate::source(0.5 * (p[i] + p[next])) + plate::source(0.5 * (p[i] + p[previous])));
      for (std::size_t j = 0; j < 3; ++j) {
        stiffness[3 * i + j] = dot(side[i], side[j]) / (4 * area);
        right[i] -= stiffness[3 * i + j] * known[j];
      }
    }
    PetscCall(DMPlexMatSetClosure(dm, nullptr, nullptr, matrix, cell, stiffness.data(), ADD_VALUES));
    PetscCall(DMPlexVecSetClosure(dm, nullptr, load, cell, right.data(), ADD_VALUES));
  }
  PetscFunctionReturn(0);
}

/// The slope along the outer normal, on the edges of a label.
PetscErrorCode add_flux(DM dm, const char* label, Vec load) {
  PetscFunctionBeginUser;
  PetscInt first = 0, last = 0;
  PetscCall(DMPlexGetDepthStratum(dm, 1, &first, &last));
  for (PetscInt edge = first; edge < last; ++edge) {
    PetscInt value = -1;
    PetscCall(DMGetLabelValue(dm, label, edge, &value));
    if (value != 1)
      continue;
    const PetscInt* cells = nullptr;
    std::array<Vec2, 3> p, of_cell;
    PetscCall(DMPlexGetSupport(dm, edge, &cells));
    PetscCall(corners_of(dm, edge, &p));
    PetscCall(corners_of(dm, cells[0], &of_cell));
    const Vec2 along = p[1] - p[0], inwards = 1.0 / 3 * (of_cell[0] + of_cell[1] + of_cell[2]) - p[0];
    const double turn = cross(along, inwards) > 0 ? 1 : -1;
    const Vec2 normal = turn * Vec2{along.y, -along.x}; // as long as the edge
    const std::array<PetscScalar, 2> right{0.5 * dot(plate::gradient(p[0]), normal),
                                           0.5 * dot(plate::gradient(p[1]), normal)};
    PetscCall(DMPlexVecSetClosure(dm, nullptr, load, edge, right.data(), ADD_VALUES));
  }
  PetscFunctionReturn(0);
}

/// Square root of the integral of (u - solution)^2. Collective.
PetscErrorCode measure_error(DM dm, Vec local, PetscReal* error) {
  PetscFunctionBeginUser;
  PetscInt first = 0, last = 0;
  PetscReal own = 0;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &first, &last));
  for (PetscInt cell = first; cell < last; ++cell) {
    std::array<Vec2, 3> p;
    std::array<PetscScalar, 3> u{};
    PetscCall(corners_of(dm, cell, &p));
    PetscCall(values_of(dm, local, cell, &u));
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = (i + 1) % 3;
      const double away = (u[i] + u[next]) / 2 - plate::solution(0.5 * (p[i] + p[next]));
      own += std::abs(cross(p[1] - p[0], p[2] - p[0])) / 6 * away * away;
    }
  }
  PetscCallMPI(MPI_Allreduce(&own, error, 1, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  *error = std::sqrt(*error);
  PetscFunctionReturn(0);
}

/// Assembles and solves; the solution comes with its given values. Collective.
PetscErrorCode solve(DM dm, const char* given, const char* flux, Vec local, PetscInt* steps) {
  PetscFunctionBeginUser;
  Mat matrix = nullptr;
  Vec load = nullptr, right = nullptr, u = nullptr;
  KSP solver = nullptr;
  PC preconditioner = nullptr;
  PetscCall(VecSet(local, 0));
  PetscCall(set_given(dm, given, local));
  PetscCall(DMCreateMatrix(dm, &matrix));
  PetscCall(DMCreateLocalVector(dm, &load));
  PetscCall(DMCreateGlobalVector(dm, &right));
  PetscCall(VecDuplicate(right, &u));
  PetscCall(VecSet(load, 0));
  PetscCall(VecSet(right, 0));
  PetscCall(add_cells(dm, local, matrix, load));
  PetscCall(add_flux(dm, flux, load));
  PetscCall(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  PetscCall(DMLocalToGlobal(dm, load, ADD_VALUES, right));
  PetscCall(KSPCreate(PETSC_COMM_WORLD, &solver));
  PetscCall(KSPSetOperators(solver, matrix, matrix));
  PetscCall(KSPSetType(solver, KSPCG));
  PetscCall(KSPGetPC(solver, &preconditioner));
  PetscCall(PCSetType(preconditioner, PCGAMG));
  PetscCall(KSPSetTolerances(solver, 1e-10, PETSC_DEFAULT, PETSC_DEFAULT, 1000));
  PetscCall(KSPSetErrorIfNotConverged(solver, PETSC_TRUE));
  PetscCall(KSPSetFromOptions(solver));
  PetscCall(KSPSolve(solver, right, u));
  PetscCall(KSPGetIterationNumber(solver, steps));
  PetscCall(DMGlobalToLocal(dm, u, INSERT_VALUES, local)); // leaves the given values alone
  PetscCall(KSPDestroy(&solver));
  PetscCall(MatDestroy(&matrix));
  for (Vec* vector : {&load, &right, &u})
    PetscCall(VecDestroy(vector));
  PetscFunctionReturn(0);
}

PetscErrorCode run(const Communicator& comm, GlobalId points) {
  PetscFunctionBeginUser;
  DM dm = nullptr;
  Vec local = nullptr;
  PetscInt steps = 0;
  PetscReal error = 0;
  const double start = MPI_Wtime();
  const trime::shape::RegionShape shape = plate::shape();
  LocalMesh mesh = plate::mesh(comm, shape, points, trime::handover::Overlap::none);
  const double meshed = MPI_Wtime();
  PetscCall(make_plex(mesh, shape.boundary().part_names, &dm));
  const GlobalId total_points = mesh.total_points, total_triangles = mesh.total_triangles;
  mesh = {}; // PETSc has it now
  const double handed_over = MPI_Wtime();
  PetscCall(number_unknowns(dm, "plate"));
  PetscCall(DMCreateLocalVector(dm, &local));
  PetscCall(solve(dm, "plate", "hole", local, &steps));
  PetscCall(measure_error(dm, local, &error));
  const double solved = MPI_Wtime();
  if (comm.is_root())
    std::printf("%lld points, %lld triangles; %d steps; error %.6e; seconds: mesh %.2f, DMPlex %.2f, solve %.2f\n",
                static_cast<long long>(total_points), static_cast<long long>(total_triangles), static_cast<int>(steps),
                error, meshed - start, handed_over - meshed, solved - handed_over);
  PetscCall(VecDestroy(&local));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

int main(int argc, char** argv) {
  const trime::comm::Environment mpi(argc, argv); // PETSc takes the MPI that it finds running
  const Communicator comm = Communicator::world();
  const GlobalId points = argc > 1 ? std::atoll(argv[1]) : 5000;
  try {
    PetscCall(PetscInitialize(&argc, &argv, nullptr, nullptr));
    PetscCall(run(comm, points));
    PetscCall(PetscFinalize());
    return 0;
  } catch (const trime::Error& error) { // all ranks have the same one
    if (comm.is_root())
      std::fprintf(stderr, "poisson_petsc: error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
