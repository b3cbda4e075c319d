// SPDX-License-Identifier: BSD-3-Clause
// All files of one run: a mesh file per output step, the final one, and the text files if they are wanted. Besides, the
// collections that ParaView plays as a time series.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/io/mesh_file.hpp"
#include "trime/io/metadata.hpp"
#include "trime/io/text_mesh.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"

#include <string>
#include <vector>

namespace trime::io {

/// Which files besides those of the final mesh.
struct SeriesOptions {
  MeshFileOptions file;
  bool steps = false;          ///< there will be meshes before the final one
  bool text = false;           ///< the files of TriMe++ in the folder `file.path("")`
  geometry::Vec2 period{0, 0}; ///< as TextPlace::period
};

/// What is written at one step. References must live as long as the call.
struct SeriesMesh {
  int retriangulation = 0; ///< counts from 1, the time of the series
  const mesh::DistributedMesh& mesh;
  const mesh::QualitySummary& quality;
  const Metadata& metadata;
};

class MeshSeries {
public:
  /// @pre `comm` outlives this object
  MeshSeries(SeriesOptions options, const comm::Communicator& comm) : options_(std::move(options)), comm_(comm) {}

  /// @brief Makes the directories and sees that all files can be written, also those of steps, whose numbers are not
  /// known yet. To be called before work starts that would be lost.
  /// @return warnings, also of a disk that seems too small for `expected_points`; on rank 0 only
  /// @throws FileError on all ranks if not, or if a file of these names exists and may not be overwritten
  /// @note Collective.
  std::vector<std::string> check(double expected_points);

  /// @brief The same without making anything: goes by permissions alone. For those who only want to know.
  /// @throws FileError on all ranks @note Collective.
  std::vector<std::string> look(double expected_points) const;

  /// @brief The run goes on from a checkpoint: the steps that it had written until then belong to it, and stay.
  /// @param retriangulation the last one before the checkpoint
  /// @return warnings about files of steps that cannot be read, the same on all ranks
  /// @note Collective. To be called before anything is written.
  std::vector<std::string> go_on_after(int retriangulation);

  /// @brief Writes NAME_step_000012.h5 (12: the retriangulation) with its views, and the collections anew.
  /// @throws FileError on all ranks together
  /// @note Collective.
  void write_step(const SeriesMesh& mesh);

  /// As write_step(), under the plain name. The last mesh of the run. @return the files of the run, those of the final
  /// mesh first, on rank 0 only
  WrittenFiles write_final(const SeriesMesh& mesh);

private:
  /// One mesh that lies in the directory now.
  struct Member {
    std::string name; ///< stem of its files
    TextQuality quality;
  };

  WrittenFiles write(const SeriesMesh& mesh, const std::string& name, const std::string& label);
  void remove_stale(const std::vector<std::string>& written) const;
  std::vector<std::string> write_collections() const;

  SeriesOptions options_;
  const comm::Communicator& comm_;
  std::vector<Member> members_;
  bool is_cleared_ = false;              ///< files of an older run are gone
  std::vector<std::string> collections_; ///< files that speak of all members
};

} // namespace trime::io
