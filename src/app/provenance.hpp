// SPDX-License-Identifier: BSD-3-Clause
// Makes the metadata of the group /trime_mpi: what the mesh file says about the run that made it.
#pragma once

#include "app/command_line.hpp"
#include "app/machine.hpp"
#include "app/map_projection.hpp"
#include "app/options.hpp"
#include "app/run_report.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/io/mesh_file.hpp"
#include "trime/meshing/mesher.hpp"
#include "trime/record/describe.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace trime::app {

/// Where a mesh comes from. Only that of rank 0 counts. @pre all outlive this object
struct Provenance {
  const CommandLine& line;
  const RunOptions& options;
  const std::string& config_text;
  const Placement& placement;
  const geometry::Boundary& boundary;
  const std::vector<NormalizedPart>& normalized;
  const MapSystem& map;
  bool is_root;          ///< only rank 0 asks PROJ, since the other ranks' metadata is not written
  record::Origin origin; ///< ring_lines: UserPlaces::ring_lines
};

/// Everything that the group /trime_mpi holds. Not collective.
io::Metadata describe_run(const Provenance& provenance, const meshing::MeshResult& result, const SizeSummary& size,
                          const Measurements& measured);
/// Makes the metadata for a mesh in the middle of a run.
io::Metadata describe_step(const Provenance& provenance, const meshing::Snapshot& snapshot);

} // namespace trime::app
