// SPDX-License-Identifier: BSD-3-Clause
// Makes the metadata of a refined mesh from those of the mesh that was refined.
#pragma once

#include "app/command_line.hpp"
#include "app/machine.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/io/metadata.hpp"
#include "trime/refinement/refine.hpp"

#include <string>
#include <vector>

namespace trime::app {

/// The groups of the metadata of a mesh that those of the refined mesh are made from.
std::vector<std::string> groups_to_refine();

/// @brief Returns the metadata of the refined mesh. What describes the shape and the run stays: config, names, history,
/// rings, sharp corners. What describes triangles, edges, sizes and the program is new.
/// @param metadata of the mesh that was refined, with groups_to_refine()
/// @param seconds since the start of the program
/// @throws FileError if the metadata have no table of tags
/// @note Collective.
io::Metadata refined_metadata(const io::Metadata& metadata, const refinement::Refined& refined, const CommandLine& line,
                              double seconds, const comm::Communicator& comm);

/// Returns whether the file says that the mesh is complete.
bool says_complete(const io::Metadata& metadata);

} // namespace trime::app
