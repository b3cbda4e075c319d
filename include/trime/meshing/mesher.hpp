// SPDX-License-Identifier: BSD-3-Clause
// The mesher: from the boundary of a shape and a size field to a certified mesh, over all ranks.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/log.hpp"
#include "trime/core/timer.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/meshing/options.hpp"
#include "trime/meshing/outlook.hpp"
#include "trime/sizing/size_field.hpp"

#include <functional>
#include <memory>

namespace trime::meshing {

/// The mesh in the middle of a run; valid during the call of the observer.
struct Snapshot {
  int retriangulation; ///< counted from 1
  double seconds;      ///< since the start of the run
  const mesh::DistributedMesh& mesh;
  const mesh::QualitySummary& quality;
  const std::vector<polygon::LoopSummary>& loops; ///< see MeshResult
};
/// Called on all ranks together; may communicate.
using SnapshotObserver = std::function<void(const Snapshot&)>;

class Checkpoints;
struct SavedRun;

class Mesher {
public:
  /// @brief Keeps references: all arguments must outlive the object. `boundary` and `size` are replicated: the same
  /// bits on every rank.
  Mesher(const comm::Communicator& comm, const geometry::Boundary& boundary, const sizing::SizeField& size,
         const MeshOptions& options, Log& log, TimerTable& timers);
  ~Mesher();

  /// @brief Sets what is called with the triangulations that MeshOptions::snapshot_interval asks for; at most one
  /// observer. Call it before run.
  void on_snapshot(SnapshotObserver observer);

  /// Sets who keeps checkpoints of the run; outlives this object. Call it before run.
  void keep_checkpoints(Checkpoints& checkpoints);
  /// @brief The run goes on from a checkpoint, to the mesh that it would have made. Call it before run.
  /// @param saved outlives this object; of a run with the same boundary, size and options, on any ranks
  void go_on_from(const SavedRun& saved);

  /// @brief Makes the mesh. @note Collective.
  /// @throws GeometryError on all ranks together if the shape cannot be meshed at this resolution
  /// @throws ConfigError on all ranks together for options that no mesh can meet
  /// @throws FileError on all ranks together if the checkpoint does not fit this run
  MeshResult run();

  /// @brief What run() will do to the boundary, about; no mesh is made. Takes as long as a mesh of 10^5 points needs
  /// for its start, and 12 simplifications of the boundary at most. @note Collective.
  /// @throws as run
  Outlook outlook() const;

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace trime::meshing
