// SPDX-License-Identifier: BSD-3-Clause
// The mesher: makes a certified mesh from a domain or shape and a size field, on
// all ranks. The mesher can also estimate, without making a mesh, how it would simplify the boundary.
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

/// An estimate of how a run would simplify the boundary (MeshResult::features), and of the resolution at which it would
/// simplify nothing.
struct Outlook {
  double points = 0; ///< about as many as the mesh will have
  boundary::FeatureReport
      features;           ///< as a run would report it at the start of its last stage; an estimate above 1e5 points
  bool keeps_all = false; ///< true if nothing would be simplified or dropped
  /// Number of points with which nothing is simplified; only a lower bound if `is_tried` is false; 0: no advice.
  double keeping_points = 0;
  bool is_tried = false;     ///< whether the boundary was placed for keeping_points points, and nothing was simplified
  double keeping_factor = 0; ///< factor on absolute sizes with which nothing is simplified; 0: no advice
  double tried_factor = 0;   ///< the smallest factor on absolute sizes that was tried, if none keeps everything; or 0
  double keeping_edge_length = 0; ///< a tried edge length that keeps everything, if the size is uniform; otherwise 0
};

/// Says whether an outlook looks for a number of points that keeps everything.
enum class Advice { no, yes };

/// The mesh in the middle of a run. Valid only during the call of the observer.
struct Snapshot {
  int retriangulation; ///< number of triangulations since the start, counted from 1
  double seconds;      ///< time since the start of the run
  const mesh::DistributedMesh& mesh;
  const mesh::QualitySummary& quality;
  const std::vector<polygon::LoopSummary>& loops; ///< the loops of the boundary, see MeshResult::loops
};
/// A function that receives snapshots of the mesh. The function is called on all ranks together, and may communicate.
using SnapshotObserver = std::function<void(const Snapshot&)>;

class Checkpoints;
struct SavedRun;
using start::OldPoints;

/// Makes one mesh. Use the function make_mesh unless you need snapshots, checkpoints or an estimate (outlook).
class Mesher {
public:
  /// @brief Keeps references to all arguments, which must outlive this object. `domain` and `size` must have the same
  /// bits on every rank.
  Mesher(const comm::Communicator& comm, const geometry::Domain& domain, const sizing::SizeField& size,
         const MeshOptions& options, Log& log, TimerTable& timers);
  Mesher(const comm::Communicator&, const geometry::Domain&&, const sizing::SizeField&, const MeshOptions&, Log&,
         TimerTable&) = delete;
  Mesher(const comm::Communicator&, const geometry::Domain&, const sizing::SizeField&&, const MeshOptions&, Log&,
         TimerTable&) = delete;
  ~Mesher();

  /// @brief Sets the observer that receives the snapshots that MeshOptions::snapshot_interval asks for. There is at
  /// most one observer. Must be called before run.
  void on_snapshot(SnapshotObserver observer);

  /// Sets the object that writes the checkpoints of the run; it must outlive this object. Must be called before run.
  void keep_checkpoints(Checkpoints& checkpoints);
  /// @brief Continues a run from a checkpoint; run() then makes the same mesh as the interrupted run would have made.
  /// Must be called before run.
  /// @param saved state of a run with the same boundary, size and options, on any number of ranks; must outlive this
  /// object
  void go_on_from(const SavedRun& saved);

  /// @brief Starts from the points of an old mesh of any shape, size and number of points. Those that lie in the new
  /// shape are thinned and refilled where the wanted size differs; the boundary is laid out again. Costs fewer sweeps
  /// than a new mesh if shape and size differ little. Must be called before run.
  /// @param old the points that this rank holds; the array must outlive this object
  /// @throws ConfigError on all ranks if the periods of the old mesh are not those of the domain
  void start_from(OldPoints old);

  /// @brief Makes the mesh. @note Collective.
  /// @throws GeometryError on all ranks together if the shape cannot be meshed at the wanted resolution
  /// @throws ConfigError on all ranks together for options that no mesh can satisfy
  /// @throws FileError on all ranks together if the checkpoint does not belong to this run
  MeshResult run();

  /// @brief Estimates how run() will simplify the boundary, without making a mesh. Takes as long as the first steps of
  /// a mesh of 10^5 points, plus at most 12 simplifications of the boundary.
  /// @throws the errors of run()
  /// @note Collective.
  Outlook outlook(Advice advice = Advice::yes) const;

  /// Returns about as many points as the mesh will have. Cost: small, except for absolute sizes: then that of an
  /// integral over the shape.
  /// @throws GeometryError on all ranks together if a size is not positive and finite
  /// @note Collective.
  double expected_points() const;

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// @brief Makes a mesh of a domain. `domain` and `size` must have the same bits on every rank.
/// @throws ConfigError, GeometryError on all ranks together under the conditions of Mesher::run
/// @note Collective.
MeshResult make_mesh(const comm::Communicator& comm, const geometry::Domain& domain, const sizing::SizeField& size,
                     const MeshOptions& options, Log& log);

/// Makes a mesh of the domain of a shape. Collective.
MeshResult make_mesh(const comm::Communicator& comm, const shape::RegionShape& shape, const sizing::SizeField& size,
                     const MeshOptions& options, Log& log);

/// @brief Makes the domain where a function is negative. The zero set of the function is traced in the container of
/// `frame`.
/// @throws GeometryError on all ranks together under the conditions of shape::traced_part; if the function throws on
/// any rank, an Error with its message on all ranks
/// @note Collective.
geometry::Domain traced_domain(const comm::Communicator& comm, const tracing::Shape& shape,
                               const geometry::Frame& frame);

/// Returns true if the sweeps converged or stopped improving the mesh, and every check passed.
bool is_complete(const MeshResult& result);

} // namespace trime::meshing
