// SPDX-License-Identifier: BSD-3-Clause
// The mesher: makes a certified mesh from the boundary of a shape and a size field, on all ranks.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/log.hpp"
#include "trime/core/timer.hpp"
#include "trime/geometry/domain.hpp"
#include "trime/meshing/options.hpp"
#include "trime/meshing/outlook.hpp"
#include "trime/sizing/size_field.hpp"

#include <functional>
#include <memory>

namespace trime::meshing {

/// The mesh in the middle of a run; valid during the call of the observer.
struct Snapshot {
  int retriangulation; ///< counted from 1
  double seconds;      ///< time since the start of the run
  const mesh::DistributedMesh& mesh;
  const mesh::QualitySummary& quality;
  const std::vector<polygon::LoopSummary>& loops; ///< see MeshResult
};
/// Called on all ranks together; may communicate.
using SnapshotObserver = std::function<void(const Snapshot&)>;

class Checkpoints;
struct SavedRun;

/// Makes one mesh. Use make_mesh unless you need snapshots, checkpoints or an outlook.
class Mesher {
public:
  /// @brief Keeps references: all arguments must outlive the object. `domain` and `size` must have the same bits on
  /// every rank.
  Mesher(const comm::Communicator& comm, const geometry::Domain& domain, const sizing::SizeField& size,
         const MeshOptions& options, Log& log, TimerTable& timers);
  Mesher(const comm::Communicator&, const geometry::Domain&&, const sizing::SizeField&, const MeshOptions&, Log&,
         TimerTable&) = delete;
  Mesher(const comm::Communicator&, const geometry::Domain&, const sizing::SizeField&&, const MeshOptions&, Log&,
         TimerTable&) = delete;
  ~Mesher();

  /// @brief Sets the observer, which is called with the triangulations that MeshOptions::snapshot_interval asks for.
  /// There is at most one observer. Call it before run.
  void on_snapshot(SnapshotObserver observer);

  /// Sets the object that keeps checkpoints of the run; it must outlive this object. Call it before run.
  void keep_checkpoints(Checkpoints& checkpoints);
  /// @brief Continues a run from a checkpoint, to the mesh that the run would have made. Call it before run.
  /// @param saved state of a run with the same boundary, size and options, on any number of ranks; must outlive this
  /// object
  void go_on_from(const SavedRun& saved);

  /// @brief Makes the mesh. @note Collective.
  /// @throws GeometryError on all ranks together if the shape cannot be meshed at this resolution
  /// @throws ConfigError on all ranks together for options that no mesh can meet
  /// @throws FileError on all ranks together if the checkpoint does not fit this run
  MeshResult run();

  /// @brief Estimates what run() will do to the boundary, without making a mesh. Takes as long as the start of a mesh
  /// of 10^5 points, and at most 12 simplifications of the boundary. @note Collective.
  /// @throws as run
  Outlook outlook() const;

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace trime::meshing
