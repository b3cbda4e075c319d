// SPDX-License-Identifier: BSD-3-Clause
// Measures a finished mesh by the rules of solvers: how often each rule is broken, and where it is worst.
#pragma once

#include "acceptance/solver_rules.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trime::acceptance {

/// Holds what judge() found for one rule.
struct Verdict {
  SolverRule rule;
  std::int64_t measured = 0; ///< triangles, points or pairs that were measured
  std::int64_t broken = 0;   ///< number of them that break the rule
  std::int64_t ears = 0;     ///< number of these that are triangles with two boundary edges
  double worst = 0;          ///< the worst value; the limit if nothing was measured; infinite, with the sign of the
                             ///< worse side, if one is not a number, as of a triangle without an area
  geometry::Vec2 place;      ///< place of the first item with the worst value; NaN if has_place() is false

  bool holds() const { return broken == 0; }
  bool has_place() const {
    return measured > 0 && rule.measure != Measure::components && rule.measure != Measure::looped_open_boundary;
  }
};

/// Facts about the whole boundary that the arrays of a mesh do not say.
struct BoundaryFacts {
  geometry::Periods periods;
  std::int64_t components = 1;
  std::int64_t outer_loops = 1, open_outer_loops = 0; ///< loops around components; those that are open all along
  std::vector<bool> open_parts; ///< for each part of the boundary, as in DistributedMesh::facet_parts
};

/// @brief Measures the mesh by all rules of the solvers. The result has the same bits on any number of ranks.
/// @param solvers a solver that is named twice counts once
/// @note Collective. Cost: O(n) for n points on a rank, with the exchanges of make_local_mesh(), the ghosts'
/// values once, and three small reductions. Memory: 56 bytes for each point, and a LocalMesh. If it does not suffice on
/// one rank, all ranks throw.
std::vector<Verdict> judge(const mesh::DistributedMesh& mesh, std::span<const Solver> solvers,
                           const BoundaryFacts& boundary, const comm::Communicator& comm);

/// The centres of two cells of D-Flow FM, and the side between them.
struct FlowLink {
  std::optional<double> cosine; ///< |cos| of the angle between the link and the side; none if the link is shorter than
                                ///< 1e-6 of the side, since rounding then decides its direction
  double length = 0;            ///< distance of the centres, over the mean root of the two areas
};
/// @brief Returns the link across the side ab between the triangles abc and bad. The centre of a cell is its
/// circumcentre; if that lies outside of the triangle, it is the place where the line to it from the centre of mass
/// leaves the triangle, as in D-Flow FM (technical reference, "Circumcentres").
FlowLink flow_link(const std::array<geometry::Vec2, 2>& side, geometry::Vec2 c, geometry::Vec2 d);

/// Returns one line about a broken rule: how often, the worst value and its place, and what to do.
/// @param splits_ears whether the mesh was made with split_ears
std::string text_of(const Verdict& verdict, bool splits_ears);

} // namespace trime::acceptance
