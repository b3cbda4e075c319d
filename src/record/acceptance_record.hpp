// SPDX-License-Identifier: BSD-3-Clause
// Judges a mesh by the rules of the models that a config or a program names, and reports what was found.
#pragma once

#include "acceptance/judge.hpp"
#include "trime/core/log.hpp"
#include "trime/io/metadata.hpp"
#include "trime/meshing/options.hpp"
#include "trime/record/verdict.hpp"

#include <string>
#include <vector>

namespace trime::record {

/// Holds what the rules need to know in addition to the mesh.
struct AcceptanceInput {
  std::vector<acceptance::Solver> solvers;
  geometry::Periods periods;
  std::vector<bool> open_parts; ///< for each part of the boundary
};

/// @brief Measures the mesh, and adds one check for each rule whose breaking makes the model refuse the mesh: the
/// number of triangles, points or sides that break it must be 0. Collective. Cost: see acceptance::judge().
std::vector<acceptance::Verdict> judge_mesh(const AcceptanceInput& input, meshing::MeshResult& result,
                                            const comm::Communicator& comm);

/// Returns the name of the check in a mesh file for a rule whose breaking makes the model refuse the mesh.
std::string check_name(const acceptance::SolverRule& rule);

/// Prints one line for each solver, and a warning for each broken rule. @param splits_ears see acceptance::text_of
void print_verdicts(const std::vector<acceptance::Verdict>& verdicts, bool splits_ears, Log& log);

/// Returns the verdicts as a group of the mesh file, with one row for each rule.
io::MetadataGroup accept_group(const std::vector<acceptance::Verdict>& verdicts);
/// Returns the verdicts in the metadata of a file; none if it has no group with them.
/// @throws FileError on this rank alone if a column is missing
std::vector<Verdict> verdicts_of(const io::Metadata& metadata);

} // namespace trime::record
