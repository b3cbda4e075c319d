// SPDX-License-Identifier: BSD-3-Clause
// Writes all files of one run: a mesh file per output step, the final mesh in all formats that are wanted, and the
// collections that ParaView plays as a time series.
#pragma once

#include "formats/text_mesh.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/formats/exchange.hpp"
#include "trime/io/mesh_file.hpp"
#include "trime/io/metadata.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace trime::formats {

/// Says which files a run writes.
struct SeriesOptions {
  io::MeshFileOptions file; ///< MeshSeries chooses its views by the formats
  /// In vtkhdf, xdmf and text all meshes are written, in others only the final one. The files of text are in the folder
  /// `file.path("")`, the others next to NAME.h5.
  std::vector<Format> formats{Format::vtkhdf, Format::xdmf};
  bool steps = false; ///< the run writes meshes before the final one
  Names names{};      ///< for all formats except vtkhdf and xdmf

  bool wants(Format format) const { return std::find(formats.begin(), formats.end(), format) != formats.end(); }
  /// Paths of the files in formats of other programs.
  std::vector<std::string> export_paths() const;
};

/// The mesh of one step. The references must be valid during the call.
struct SeriesMesh {
  int retriangulation = 0; ///< counts from 1; it is the time in the series
  const mesh::DistributedMesh& mesh;
  const mesh::QualitySummary& quality;
  const io::Metadata& metadata;
};

/// Writes the mesh files of a run, one after the other.
class MeshSeries {
public:
  /// @pre `comm` outlives this object
  MeshSeries(SeriesOptions options, const comm::Communicator& comm);

  /// @brief Creates the directories and checks that all files can be written, also those of steps, whose numbers are
  /// not known yet. Call it before long work whose result would be lost.
  /// @return warnings, also about a disk that seems too small for `expected_points`; on rank 0 only
  /// @throws FileError on all ranks if a file cannot be written, or exists and may not be overwritten
  /// @note Collective.
  std::vector<std::string> check(double expected_points);

  /// @brief Does the same as check(), but creates nothing and looks only at permissions.
  /// @throws FileError on all ranks @note Collective.
  std::vector<std::string> look(double expected_points) const;

  /// @brief Continues from a checkpoint: the steps that the run had written until then belong to it, and stay.
  /// @param retriangulation number of the last step before the checkpoint
  /// @return warnings about files of steps that cannot be read, the same on all ranks
  /// @note Collective. Call it before anything is written.
  std::vector<std::string> go_on_after(int retriangulation);

  /// @brief Writes NAME_step_000012.h5 (12: the retriangulation) with its views, and updates the collections.
  /// @throws FileError on all ranks together
  /// @note Collective.
  void write_step(const SeriesMesh& mesh);

  /// Writes the last mesh of the run as write_step() does, under the plain name, and in the formats of other programs.
  /// @return the files of the run, those of the final mesh first, on rank 0 only
  io::WrittenFiles write_final(const SeriesMesh& mesh);

private:
  /// A mesh that is in the directory now.
  struct Member {
    std::string name; ///< stem of its files
    TextQuality quality;
  };

  io::WrittenFiles write(const SeriesMesh& mesh, const std::string& name, const std::string& label);
  void remove_stale(const std::vector<std::string>& written) const;
  std::vector<std::string> write_collections() const;

  SeriesOptions options_;
  const comm::Communicator& comm_;
  std::vector<Member> members_;
  bool is_cleared_ = false;              ///< files of an older run have been removed
  std::vector<std::string> collections_; ///< files that list all members
};

} // namespace trime::formats
