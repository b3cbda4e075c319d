// SPDX-License-Identifier: BSD-3-Clause
// The mesher: makes a certified mesh from a domain or shape and a size field, on all ranks, or estimates what it would
// do to the boundary.
#pragma once

#include "trime/boundary/features.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/log.hpp"
#include "trime/core/timer.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/meshing/options.hpp"
#include "trime/shape/region_shape.hpp"
#include "trime/sizing/size_field.hpp"

#include <functional>
#include <memory>

namespace trime::meshing {

/// What MeshResult::features will be, and the resolution at which nothing would be simplified.
struct Outlook {
  boundary::FeatureReport
      features;           ///< as a run would report when it begins its last stage; an estimate above 1e5 points
  bool keeps_all = false; ///< nothing is simplified or dropped
  /// A number of points that keeps everything; a lower bound if not `is_tried`. 0 without advice.
  double keeping_points = 0;
  bool is_tried = false;          ///< the boundary was laid out for that number, and nothing was simplified
  double keeping_edge_length = 0; ///< a tried edge length that keeps everything, if the size is uniform; otherwise 0
};

/// Says whether an outlook looks for a number of points that keeps everything.
enum class Advice { no, yes };

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
  Outlook outlook(Advice advice = Advice::yes) const;

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// @brief Makes a mesh of a domain. `domain` and `size` must give the same bits on every rank.
/// @throws ConfigError, GeometryError on all ranks together, see Mesher::run
/// @note Collective.
MeshResult make_mesh(const comm::Communicator& comm, const geometry::Domain& domain, const sizing::SizeField& size,
                     const MeshOptions& options, Log& log);

/// Makes a mesh of the domain of a shape. Collective.
MeshResult make_mesh(const comm::Communicator& comm, const shape::RegionShape& shape, const sizing::SizeField& size,
                     const MeshOptions& options, Log& log);

/// @brief Makes the domain where a function is negative, by tracing it in the container of `frame`.
/// @throws GeometryError on all ranks together, see shape::traced_part; if the shape throws on any rank, an Error with
/// its message on all ranks
/// @note Collective.
geometry::Domain traced_domain(const comm::Communicator& comm, const tracing::Shape& shape,
                               const geometry::Frame& frame);

/// Returns true if the stop rule was met and every check passed.
bool is_complete(const MeshResult& result);

} // namespace trime::meshing
