// SPDX-License-Identifier: BSD-3-Clause
// The table of all output formats, and the functions that write meshes for other programs with the names of boundaries
// and regions.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/io/mesh_file.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trime::formats {

class ExchangeMesh;
struct FilePlan;

/// The output formats. vtkhdf and xdmf describe the arrays of NAME.h5 for other readers, and text has the files of
/// TriMe++. The formats gmsh, gmsh2 and sms are MSH 4.1, MSH 2.2 and .2dm; schism is hgrid.gr3, telemac is Selafin
/// with its boundary conditions, and fvcom is CASE_grd.dat with the files for depths, open boundary and latitudes. The
/// formats voronoi, mpas, disv (MODFLOW 6), uge (PFLOTRAN) and tough (TOUGH2) have the Voronoi cells of the points, not
/// the triangles. The faces of ugrid are triangles, and those of ugrid_cells the cells.
enum class Format {
  vtkhdf,
  xdmf,
  text,
  gmsh,
  gmsh2,
  medit,
  freefem,
  triangle,
  vtu,
  voronoi,
  disv,
  uge,
  sms,
  adcirc,
  schism,
  telemac,
  fvcom,
  su2,
  geojson,
  abaqus,
  exodus,
  ugrid,
  ugrid_cells,
  mpas,
  tough
};

/// The cells in files of mpas, disv, uge and tough.
enum class CellKind {
  voronoi,  ///< cells of all points; the boundary edges cut those on the boundary
  whole,    ///< cells of the points inside; for mpas
  triangles ///< the triangles, with their circumcentres as centres; for disv, uge and tough
};

/// Returns the kind of cells that a config calls so. @pre the word is one of them
CellKind cell_kind_of_word(const std::string& word);
/// Returns why a format cannot have cells of a kind; an empty text if it can, or if the kind does not concern it.
std::string cells_problem(Format format, CellKind kind);

/// One row of the table of formats. Config, --help, `trime_mpi convert` and the output of a run take all facts about a
/// format from this row.
struct FormatInfo {
  Format format;
  const char* word;            ///< word for the format in a config
  const char* ending;          ///< ending of the (first) file, with the dot; empty for text, which is a directory
  bool holds_periodic = false; ///< whether it can hold the mesh of a periodic container
  bool has_long_ids = false;   ///< whether its ids have 64 bits
  /// Plans the files of a mesh; `path` is that of the first file. Null for formats that a run writes along with
  /// NAME.h5. Collective.
  std::vector<FilePlan> (*plan)(const ExchangeMesh& mesh, const std::string& path) = nullptr;
};
std::span<const FormatInfo> all_formats();
const FormatInfo& info_of(Format format);
std::optional<Format> format_of_word(const std::string& word);
/// Returns the format whose ending the path has. Formats that belong to NAME.h5 are left out.
std::optional<Format> format_of_path(const std::string& path);
/// Returns the words of all formats that have a property, such as "vtkhdf, xdmf and text"; `last` is put before the
/// last word.
std::string words_of(bool FormatInfo::*property, const char* last);

/// The names of the numbers in a mesh. In all formats a boundary edge that follows part k of the shape has the label k
/// + 1, because 0 means inside. The labels of edges on curves inside follow those of the parts, and then come the
/// labels of interfaces between regions. An edge on a curve that is also an interface has the label of the curve. A
/// point has the lowest label of its edges. Regions keep their numbers, which begin with 1.
struct Names {
  std::vector<std::string> parts;        ///< names, indexed by DistributedMesh::facet_parts
  std::vector<std::string> regions;      ///< names of the regions 1, 2, ...
  std::vector<std::string> curves{};     ///< names, indexed by DistributedMesh::curve_numbers
  std::vector<std::string> interfaces{}; ///< names, indexed by DistributedMesh::interface_pairs
  /// Periods of the container; 0 in a direction in which it is not periodic.
  geometry::Vec2 period{0, 0};
  /// Reference system of the coordinates, as PROJ names it; empty: unknown.
  std::string crs{};
  /// Names of the parts that are open in files for coastal models, such as fort14 (see configs/formats.md). An empty
  /// list: no part is open, as with `none` in a config. No list: those whose name says it, as with `auto`.
  std::optional<std::vector<std::string>> open_boundary{};
  /// The files of fort14, gr3, fvcom and 2dm hold longitude and latitude, not the coordinates of the mesh. Needs `crs`.
  bool in_degrees = false;
  CellKind cells = CellKind::voronoi;             ///< cells in files of mpas, disv, uge and tough
  std::vector<geometry::CurveKind> curve_kinds{}; ///< kinds of the curves, see geometry::InnerCurves::kinds
};

/// Returns the paths of all files of a format if the first file is `path`. For example, Triangle has three files, and
/// PFLOTRAN one for each part of the boundary.
std::vector<std::string> paths_of(Format format, const std::string& path, const Names& names);
/// @brief Returns the paths of files that belong to another mesh if they exist at all, because this one has none: for
/// FVCOM the latitudes of a mesh with a known reference system. The model would take them for part of this mesh.
std::vector<std::string> stale_paths(Format format, const std::string& path, const Names& names);
/// Returns the paths at which write() replaces or removes a file: those of paths_of() and of stale_paths().
std::vector<std::string> touched_paths(Format format, const std::string& path, const Names& names);

/// The files of a format.
struct Exported {
  std::vector<std::string> paths;
  mesh::Checks checks{}; ///< what was checked about data beyond the mesh, such as Voronoi cells
  std::string summary{}; ///< a line about that
  std::string warning{}; ///< what a user should know of it before the files are used
};

/// @brief Writes the mesh in a format of another program. Each file appears complete or not at all; files of the same
/// name are replaced, and those of stale_paths() removed. The ranks make the text in slices, so no rank holds the whole
/// of it; for sms, adcirc, schism, telemac and fvcom, however, rank 0 gathers all boundary edges.
/// @param files list of the temporary files, which a signal handler removes; may be null
/// @throws ConfigError for a mesh that the format cannot hold (periodic container, too many points); FileError if a
/// file cannot be written; both on all ranks together
/// @note Collective.
Exported write(Format format, const std::string& path, const mesh::DistributedMesh& mesh, const Names& names,
               io::RunFiles* files, const comm::Communicator& comm);

/// @brief Creates the output directory if it is missing, and checks that the mesh file and its views can be written.
/// Call this before long computations whose result would otherwise be lost.
/// @return warnings for the user, for example about files that a killed run has left; on rank 0 only
/// @throws FileError on all ranks if the directory cannot be made or written, or a file exists and may not be
/// overwritten
/// @note Collective.
std::vector<std::string> check_output(const io::MeshFileOptions& options, const comm::Communicator& comm);

} // namespace trime::formats
