// SPDX-License-Identifier: BSD-3-Clause
// Writes and reads checkpoints: files with the state of a run, from which any number of ranks can continue.
#pragma once

#include "meshing/checkpoints.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/io/mesh_file.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace trime::checkpoint {

/// The run that a checkpoint belongs to.
struct Origin {
  std::string program; ///< name, version and commit, because others may make different meshes
  std::string config;  ///< the resolved config: a complete ini file
};

/// Facts about a checkpoint in addition to its state.
struct Title {
  Origin origin;
  std::int64_t number = 0; ///< counts the checkpoints of a run, over all its restarts
};

/// A checkpoint that was read.
struct Found {
  Title title;
  meshing::SavedRun run;
};

/// @brief Writes a checkpoint under a temporary name, and then renames it to `path`; an older file at `path` stays
/// until then. A point takes 61 bytes, or 40 if the size is uniform and the rule has no leads. Collective.
/// @param files keeps track of the temporary file; may be null @param activity see SavedTiles, of the owned tiles
/// @throws FileError on all ranks together
void write_checkpoint(const std::string& path, io::RunFiles* files, const Title& title, const meshing::RunState& state,
                      const sites::SiteState& sites, std::span<const std::uint64_t> activity);

/// @brief Reads everything except the sites, and checks it against the hash in the file. The sites are checked when
/// they are loaded. Collective.
/// @throws FileError on all ranks together if the file is missing, is not a checkpoint, has another format, or is
/// damaged
Found read_checkpoint(const std::string& path, const comm::Communicator& comm);

/// @brief Returns the number of a checkpoint, or -1 if the file is not a checkpoint. Called by one rank alone.
std::int64_t checkpoint_number(const std::string& path);

} // namespace trime::checkpoint
