// SPDX-License-Identifier: BSD-3-Clause
// Makes the metadata of the HDF5 group /trime_mpi, in which a mesh file describes the run that made it.
#pragma once

#include "app/command_line.hpp"
#include "app/machine.hpp"
#include "app/map_projection.hpp"
#include "app/old_mesh.hpp"
#include "app/options.hpp"
#include "app/run_report.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/io/mesh_file.hpp"
#include "trime/meshing/mesher.hpp"
#include "trime/record/describe.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace trime::app {

/// Returns the attributes with the versions of the program and its libraries, the command, the time and the host.
std::vector<io::Attribute> program_attributes(const CommandLine& line);

/// The sources of the metadata: command line, options, machine, shape. Only the values of rank 0 are written.
/// @pre all references outlive this object
struct Provenance {
  const CommandLine& line;
  const RunOptions& options;
  const std::string& config_text;
  const Placement& placement;
  const geometry::Boundary& boundary;
  const std::vector<NormalizedPart>& normalized;
  const MapSystem& map;
  const std::optional<OldMesh>& old; ///< where the sites started
  bool is_root; ///< whether this is rank 0; other ranks do not call PROJ, because their metadata is not written
  record::Origin origin; ///< names and markers of the mesh; its ring_lines come from UserPlaces::ring_lines
};

/// Returns all metadata of the group /trime_mpi for the final mesh. Not collective.
io::Metadata describe_run(const Provenance& provenance, const meshing::MeshResult& result, const SizeSummary& size,
                          const Measurements& measured);
/// Returns the metadata for a mesh in the middle of a run.
io::Metadata describe_step(const Provenance& provenance, const meshing::Snapshot& snapshot);

} // namespace trime::app
