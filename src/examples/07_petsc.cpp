// SPDX-License-Identifier: BSD-3-Clause
// Poisson's equation by PETSc on the ranks that made the mesh; no file lies between. The cells of the ranks become a
// DMPlex, the parts of the boundary its labels, by name; linear elements, conjugate gradients with algebraic multigrid.
//   mpirun -n 2 07_petsc [POINTS [options of PETSc, such as -ksp_monitor -pc_type hypre]]
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

/// One unknown at each vertex; those of the label `given` are not unknowns. Collective.
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

constexpr std::size_t position(PetscInt i) {
  return static_cast<std::size_t>(i);
}

/// This rank's part of the DMPlex as arrays, indexed by the number of a vertex or cell from the first one.
struct Cells {
  std::vector<Vec2> places;                      // of the vertices
  std::vector<std::array<PetscInt, 3>> corners;  // of the cells
  std::vector<PetscInt> unknowns, local_offsets; // of the vertices: global number, negative where it is given; in a
                                                 // local vector
  PetscInt first_vertex = 0;
};

/// The corners of a cell or an edge.
PetscErrorCode find_corners(DM dm, PetscInt item, PetscInt first_vertex, std::array<PetscInt, 3>* corners) {
  PetscFunctionBeginUser;
  PetscInt count = 0, *closure = nullptr; // items and orientations in turn; the vertices come last
  PetscCall(DMPlexGetTransitiveClosure(dm, item, PETSC_TRUE, &count, &closure));
  const PetscInt of_item = count == 7 ? 3 : 2; // a triangle with edges and vertices, or an edge with its ends
  for (PetscInt k = 0; k < of_item; ++k)
    (*corners)[static_cast<std::size_t>(k)] = closure[2 * (count - of_item + k)] - first_vertex;
  PetscCall(DMPlexRestoreTransitiveClosure(dm, item, PETSC_TRUE, &count, &closure));
  PetscFunctionReturn(0);
}

/// @pre number_unknowns. Collective.
PetscErrorCode find_cells(DM dm, Cells* cells) {
  PetscFunctionBeginUser;
  PetscInt first_cell = 0, last_cell = 0, last_vertex = 0;
  PetscSection local = nullptr, global = nullptr, of_coordinates = nullptr;
  Vec coordinates = nullptr;
  const PetscScalar* values = nullptr;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &first_cell, &last_cell));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &cells->first_vertex, &last_vertex));
  PetscCall(DMGetLocalSection(dm, &local));
  PetscCall(DMGetGlobalSection(dm, &global));
  PetscCall(DMGetCoordinateSection(dm, &of_coordinates));
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(VecGetArrayRead(coordinates, &values));
  for (PetscInt vertex = cells->first_vertex; vertex < last_vertex; ++vertex) {
    PetscInt offset = 0, given = 0, unknown = 0;
    PetscCall(PetscSectionGetOffset(of_coordinates, vertex, &offset));
    cells->places.push_back({values[offset], values[offset + 1]});
    PetscCall(PetscSectionGetOffset(local, vertex, &offset));
    cells->local_offsets.push_back(offset);
    PetscCall(PetscSectionGetConstraintDof(local, vertex, &given));
    PetscCall(PetscSectionGetOffset(global, vertex, &unknown)); // -1 - number where another rank owns it
    cells->unknowns.push_back(given > 0 ? -1 : unknown < 0 ? -1 - unknown : unknown);
  }
  PetscCall(VecRestoreArrayRead(coordinates, &values));
  cells->corners.resize(position(last_cell - first_cell));
  for (PetscInt cell = first_cell; cell < last_cell; ++cell)
    PetscCall(find_corners(dm, cell, cells->first_vertex, &cells->corners[position(cell - first_cell)]));
  PetscFunctionReturn(0);
}

/// Puts the solution where it is given.
PetscErrorCode set_given(const Cells& cells, Vec local) {
  PetscFunctionBeginUser;
  PetscScalar* u = nullptr;
  PetscCall(VecGetArray(local, &u));
  for (std::size_t vertex = 0; vertex < cells.places.size(); ++vertex)
    u[cells.local_offsets[vertex]] = cells.unknowns[vertex] < 0 ? plate::solution(cells.places[vertex]) : 0;
  PetscCall(VecRestoreArray(local, &u));
  PetscFunctionReturn(0);
}

/// Matrix and right-hand side of the cells of this rank; `local` has the given values. Entries of rows or columns with
/// negative numbers are left out by PETSc. Collective.
PetscErrorCode add_cells(const Cells& cells, Vec local, Mat matrix, Vec load) {
  PetscFunctionBeginUser;
  std::vector<PetscInt> rows, columns;
  std::vector<PetscScalar> stiffness;
  const PetscScalar* known = nullptr;
  PetscScalar* right = nullptr;
  for (auto* list : {&rows, &columns})
    list->reserve(9 * cells.corners.size());
  stiffness.reserve(9 * cells.corners.size());
  PetscCall(VecGetArrayRead(local, &known));
  PetscCall(VecGetArray(load, &right));
  for (const std::array<PetscInt, 3>& corners : cells.corners) {
    const std::array<Vec2, 3> p{cells.places[position(corners[0])], cells.places[position(corners[1])],
                                cells.places[position(corners[2])]};
    const std::array<Vec2, 3> side{p[2] - p[1], p[0] - p[2], p[1] - p[0]};
    const double area = 0.5 * std::abs(cross(side[0], side[1]));
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = (i + 1) % 3, previous = (i + 2) % 3; // the source at the middles of two edges
      double sum = area / 6 * (plate::source(0.5 * (p[i] + p[next])) + plate::source(0.5 * (p[i] + p[previous])));
      for (std::size_t j = 0; j < 3; ++j) {
        rows.push_back(cells.unknowns[position(corners[i])]);
        columns.push_back(cells.unknowns[position(corners[j])]);
        stiffness.push_back(dot(side[i], side[j]) / (4 * area));
        sum -= stiffness.back() * known[cells.local_offsets[position(corners[j])]];
      }
      right[cells.local_offsets[position(corners[i])]] += sum;
    }
  }
  PetscCall(VecRestoreArrayRead(local, &known));
  PetscCall(VecRestoreArray(load, &right));
  PetscCall(MatSetPreallocationCOO(matrix, static_cast<PetscCount>(rows.size()), rows.data(), columns.data()));
  PetscCall(MatSetValuesCOO(matrix, stiffness.data(), ADD_VALUES));
  PetscFunctionReturn(0);
}

/// The slope along the outer normal, on the edges of a label.
PetscErrorCode add_flux(DM dm, const char* label, const Cells& cells, Vec load) {
  PetscFunctionBeginUser;
  PetscInt first_edge = 0, last_edge = 0, first_cell = 0, count = 0;
  IS labelled = nullptr;
  const PetscInt* items = nullptr;
  PetscScalar* right = nullptr;
  PetscCall(DMPlexGetDepthStratum(dm, 1, &first_edge, &last_edge));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &first_cell, nullptr));
  PetscCall(DMGetStratumIS(dm, label, 1, &labelled));
  if (labelled == nullptr)
    PetscFunctionReturn(0); // this rank has none
  PetscCall(ISGetLocalSize(labelled, &count));
  PetscCall(ISGetIndices(labelled, &items));
  PetscCall(VecGetArray(load, &right));
  for (PetscInt k = 0; k < count; ++k) {
    if (items[k] < first_edge || items[k] >= last_edge)
      continue; // an end of an edge
    const PetscInt* of_edge = nullptr;
    std::array<PetscInt, 3> ends{};
    PetscCall(DMPlexGetSupport(dm, items[k], &of_edge));
    PetscCall(find_corners(dm, items[k], cells.first_vertex, &ends));
    const Vec2 a = cells.places[position(ends[0])], b = cells.places[position(ends[1])], along = b - a;
    Vec2 inwards{0, 0};
    for (const PetscInt corner : cells.corners[position(of_edge[0] - first_cell)])
      inwards = inwards + 1.0 / 3 * (cells.places[position(corner)] - a);
    const double turn = cross(along, inwards) > 0 ? 1 : -1;
    const Vec2 normal = turn * Vec2{along.y, -along.x}; // as long as the edge
    right[cells.local_offsets[position(ends[0])]] += 0.5 * dot(plate::gradient(a), normal);
    right[cells.local_offsets[position(ends[1])]] += 0.5 * dot(plate::gradient(b), normal);
  }
  PetscCall(VecRestoreArray(load, &right));
  PetscCall(ISRestoreIndices(labelled, &items));
  PetscCall(ISDestroy(&labelled));
  PetscFunctionReturn(0);
}

/// Square root of the integral of (u - solution)^2. Collective.
PetscErrorCode measure_error(const Cells& cells, Vec local, PetscReal* error) {
  PetscFunctionBeginUser;
  const PetscScalar* u = nullptr;
  PetscReal own = 0;
  PetscCall(VecGetArrayRead(local, &u));
  for (const std::array<PetscInt, 3>& corners : cells.corners) {
    const auto place = [&](std::size_t k) { return cells.places[position(corners[k % 3])]; };
    const auto value = [&](std::size_t k) { return u[cells.local_offsets[position(corners[k % 3])]]; };
    const double area = 0.5 * std::abs(cross(place(1) - place(0), place(2) - place(0)));
    for (std::size_t i = 0; i < 3; ++i) {
      const double away = (value(i) + value(i + 1)) / 2 - plate::solution(0.5 * (place(i) + place(i + 1)));
      own += area / 3 * away * away;
    }
  }
  PetscCall(VecRestoreArrayRead(local, &u));
  PetscCallMPI(MPI_Allreduce(&own, error, 1, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  *error = std::sqrt(*error);
  PetscFunctionReturn(0);
}

/// Conjugate gradients with algebraic multigrid. Collective.
PetscErrorCode solve(Mat matrix, Vec right, Vec u, PetscInt* steps) {
  PetscFunctionBeginUser;
  KSP solver = nullptr;
  PC preconditioner = nullptr;
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
  PetscCall(KSPDestroy(&solver));
  PetscFunctionReturn(0);
}

/// Assembles and solves; `local` gets the solution with its given values. @param flux label of the edges where the
/// slope is given. Collective.
PetscErrorCode assemble_and_solve(DM dm, const char* flux, const Cells& cells, Vec local, PetscInt* steps) {
  PetscFunctionBeginUser;
  Mat matrix = nullptr;
  Vec load = nullptr, right = nullptr, u = nullptr;
  PetscInt own = 0;
  PetscCall(set_given(cells, local));
  PetscCall(DMCreateLocalVector(dm, &load));
  PetscCall(DMCreateGlobalVector(dm, &right));
  PetscCall(VecDuplicate(right, &u));
  PetscCall(VecSet(load, 0));
  PetscCall(VecSet(right, 0));
  PetscCall(VecGetLocalSize(right, &own));
  PetscCall(MatCreate(PETSC_COMM_WORLD, &matrix)); // DMCreateMatrix works too, but preallocates four times as long
  PetscCall(MatSetSizes(matrix, own, own, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(matrix, MATAIJ));
  PetscCall(MatSetFromOptions(matrix));
  PetscCall(add_cells(cells, local, matrix, load));
  PetscCall(add_flux(dm, flux, cells, load));
  PetscCall(DMLocalToGlobal(dm, load, ADD_VALUES, right));
  PetscCall(solve(matrix, right, u, steps));
  PetscCall(DMGlobalToLocal(dm, u, INSERT_VALUES, local)); // leaves the given values alone
  PetscCall(MatDestroy(&matrix));
  for (Vec* vector : {&load, &right, &u})
    PetscCall(VecDestroy(vector));
  PetscFunctionReturn(0);
}

PetscErrorCode run(MPI_Comm comm, GlobalId points) {
  PetscFunctionBeginUser;
  DM dm = nullptr;
  Vec local = nullptr;
  PetscInt steps = 0;
  PetscReal error = 0;
  GlobalId total_points = 0, total_triangles = 0;
  const double start = MPI_Wtime();
  double meshed = 0;
  {
    const trime::LocalMesh mesh = plate::mesh(comm, points, trime::handover::Overlap::none);
    meshed = MPI_Wtime();
    total_points = mesh.arrays().total_points;
    total_triangles = mesh.arrays().total_triangles;
    PetscCall(make_plex(mesh.arrays(), mesh.facet_names(), &dm)); // PETSc has it now
  }
  const double handed_over = MPI_Wtime();
  PetscCall(number_unknowns(dm, "plate"));
  PetscCall(DMCreateLocalVector(dm, &local));
  Cells cells;
  PetscCall(find_cells(dm, &cells));
  PetscCall(assemble_and_solve(dm, "hole", cells, local, &steps));
  PetscCall(measure_error(cells, local, &error));
  const double solved = MPI_Wtime();
  PetscCall(PetscPrintf(
      comm, "%lld points, %lld triangles; %d steps; error %.6e; seconds: mesh %.2f, DMPlex %.2f, solve %.2f\n",
      static_cast<long long>(total_points), static_cast<long long>(total_triangles), static_cast<int>(steps), error,
      meshed - start, handed_over - meshed, solved - handed_over));
  PetscCall(VecDestroy(&local));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

int main(int argc, char** argv) {
  const GlobalId points = argc > 1 ? std::atoll(argv[1]) : 5000;
  PetscCall(PetscInitialize(&argc, &argv, nullptr, nullptr)); // starts MPI: no trime::Environment is needed
  try {
    PetscCall(run(PETSC_COMM_WORLD, points));
  } catch (const trime::Error& error) { // all ranks have the same one
    PetscCall(PetscFPrintf(PETSC_COMM_WORLD, stderr, "error: %s\n", error.what()));
    return static_cast<int>(error.code());
  }
  PetscCall(PetscFinalize());
  return 0;
}
