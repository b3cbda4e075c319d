// SPDX-License-Identifier: BSD-3-Clause
// Writes all files of one run: a mesh file for each output step, the final mesh in all wanted formats, and the
// collections that ParaView shows as a time series.
#pragma once

#include "formats/text_mesh.hpp"
#include "io/extra_arrays.hpp"
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

/// Which files a run writes.
struct SeriesOptions {
  io::MeshFileOptions file; ///< options of the HDF5 file; its views vtkhdf and xdmf are chosen by `formats`
  /// In vtkhdf, xdmf and text, the meshes of all output steps are written; in other formats only the final mesh. The
  /// files of text are in the folder `file.path("")`, files of other formats next to NAME.h5.
  std::vector<Format> formats{Format::vtkhdf, Format::xdmf};
  bool steps = false; ///< whether the run also writes meshes before the final one
  Names names{};      ///< names of boundaries and regions, for all formats except vtkhdf and xdmf

  bool wants(Format format) const { return std::find(formats.begin(), formats.end(), format) != formats.end(); }
  /// Returns the paths at which files in formats of other programs are written, replaced or removed.
  std::vector<std::string> export_paths() const;
};

/// The mesh of one output step. The references must be valid during the call.
struct SeriesMesh {
  int retriangulation = 0; ///< number of the triangulation, from 1; used as the time in the series
  const mesh::DistributedMesh& mesh;
  const mesh::QualitySummary& quality;
  const io::Metadata& metadata;
};

/// Writes the mesh files of a run, one after the other.
class MeshSeries {
public:
  /// @pre `comm` outlives this object
  MeshSeries(SeriesOptions options, const comm::Communicator& comm);

  /// @brief Creates the directories and checks that all files can be written, even those of output steps whose numbers
  /// are not known yet. Call this before long computations whose result would otherwise be lost.
  /// @return warnings, for example about a disk that seems too small for `expected_points`; on rank 0 only
  /// @throws FileError on all ranks if a file cannot be written, or if it exists and may not be overwritten
  /// @note Collective.
  std::vector<std::string> check(double expected_points);

  /// @brief Makes the same checks as check(), but creates no directory and no file: it only looks at permissions.
  /// @throws FileError on all ranks @note Collective.
  std::vector<std::string> look(double expected_points) const;

  /// @brief Continues after a restart from a checkpoint: the files of steps that the run had written before the
  /// checkpoint are kept and belong to the series.
  /// @param retriangulation number of the last step before the checkpoint
  /// @return warnings about files of steps that cannot be read, the same on all ranks
  /// @note Collective. Must be called before any file is written.
  std::vector<std::string> go_on_after(int retriangulation);

  /// @brief Writes the mesh of a step as NAME_step_000012.h5 (where 12 is the number of the triangulation) with its
  /// views, and updates the collections.
  /// @throws FileError on all ranks together
  /// @note Collective.
  void write_step(const SeriesMesh& mesh);

  /// Writes the final mesh of the run as NAME.h5 with its views, and in the formats of other programs.
  /// @return the files of the run, with those of the final mesh first; on rank 0 only
  io::WrittenFiles write_final(const SeriesMesh& mesh);
  /// Returns the checks of the Voronoi cells that write_final has written, and a line about them; both are empty if no
  /// format has cells. The paths and the warning are left out.
  const Exported& cells() const { return cells_; }
  /// Returns what a user should know of the files that write_final has written.
  const std::vector<std::string>& warnings() const { return warnings_; }

private:
  /// A mesh of the series whose files are in the directory.
  struct Member {
    std::string name; ///< file name without ending
    TextQuality quality;
  };

  std::vector<io::ExtraGroup> extra_groups(const mesh::DistributedMesh& mesh) const;
  io::WrittenFiles write(const SeriesMesh& mesh, const std::string& name, const std::string& label);
  void remove_stale(const std::vector<std::string>& written) const;
  std::vector<std::string> write_collections() const;

  SeriesOptions options_;
  const comm::Communicator& comm_;
  std::vector<Member> members_;
  Exported cells_;
  std::vector<std::string> warnings_;    ///< what write_final has learnt from the formats
  bool is_cleared_ = false;              ///< whether files of an older run have been removed
  std::vector<std::string> collections_; ///< files that list all meshes of the series
};

} // namespace trime::formats
