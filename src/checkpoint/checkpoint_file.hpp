// SPDX-License-Identifier: BSD-3-Clause
// Writes and reads checkpoints: files with the state of a run, from which the run can be continued on any number of
// ranks.
#pragma once

#include "meshing/checkpoints.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/io/mesh_file.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace trime::checkpoint {

/// Identifies the run to which a checkpoint belongs.
struct Origin {
  std::string program; ///< name, version and commit of the program, because other versions may make different meshes
  std::string config;  ///< the config with all defaults, as a complete ini file
};

/// The facts about a checkpoint that are not part of the run's state.
struct Title {
  Origin origin;
  std::int64_t number = 0; ///< number of the checkpoint in its run; counting continues after restarts
};

/// A checkpoint after reading.
struct Found {
  Title title;
  meshing::SavedRun run;
};

/// @brief Writes a checkpoint under a temporary name, and then renames it to `path`; an older file at `path` stays
/// until then. A point takes 61 bytes, or 40 if the size is uniform and the update rule stores no momentum. Collective.
/// @param files keeps the name of the temporary file for signal handlers; may be null
/// @param activity activity of the owned tiles, see SavedTiles
/// @throws FileError on all ranks together
void write_checkpoint(const std::string& path, io::RunFiles* files, const Title& title, const meshing::RunState& state,
                      const sites::SiteState& sites, std::span<const std::uint64_t> activity);

/// @brief Reads everything except the sites, and compares it with the hash in the file. The sites are checked when they
/// are loaded later. Collective.
/// @throws FileError on all ranks together if the file is missing, is not a checkpoint, has the format of another
/// version, or is damaged
Found read_checkpoint(const std::string& path, const comm::Communicator& comm);

/// @brief Returns the number of a checkpoint, or -1 if the file is not a checkpoint. Called by one rank alone.
std::int64_t checkpoint_number(const std::string& path);

} // namespace trime::checkpoint
