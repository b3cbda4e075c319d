// SPDX-License-Identifier: BSD-3-Clause
// A checkpoint as a file: the state of a run, that any other number of ranks can go on from.
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
  std::string program; ///< name, version and commit: others may make other meshes
  std::string config;  ///< as resolved, a complete ini
};

/// Facts about a checkpoint in addition to its state.
struct Title {
  Origin origin;
  std::int64_t number = 0; ///< counts the checkpoints of a run, over all its restarts
};

/// A checkpoint that was read back.
struct Found {
  Title title;
  meshing::SavedRun run;
};

/// @brief Writes a checkpoint under a temporary name and then under `path`, which stays as it was until then.
/// 61 bytes a point, 21 less where the size is uniform and no rule has leads. Collective.
/// @param files notes the temporary file; may be null @param activity of the owned tiles
/// @throws FileError on all ranks together
void write_checkpoint(const std::string& path, io::RunFiles* files, const Title& title, const meshing::RunState& state,
                      const sites::SiteState& sites, std::span<const std::uint64_t> activity);

/// @brief Reads what all ranks must know, and checks it against the hash that was written with it. The sites are
/// checked when they are fetched. Collective.
/// @throws FileError on all ranks together if the file is missing, no checkpoint, of another format, or damaged
Found read_checkpoint(const std::string& path, const comm::Communicator& comm);

/// @brief Returns the number of a checkpoint, or -1 if the file is not a checkpoint. Called by one rank alone.
std::int64_t checkpoint_number(const std::string& path);

} // namespace trime::checkpoint
