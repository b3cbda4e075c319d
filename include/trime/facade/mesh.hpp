// SPDX-License-Identifier: BSD-3-Clause
// The function make_mesh, which makes a mesh from a shape on all ranks of a communicator, and the classes Mesh and
// LocalMesh, with which a program uses the mesh.
#pragma once

#include "trime/boundary/features.hpp"
#include "trime/comm/from_mpi.hpp"
#include "trime/core/types.hpp"
#include "trime/dual/local_cells.hpp"
#include "trime/facade/shape.hpp"
#include "trime/facade/size.hpp"
#include "trime/formats/exchange.hpp"
#include "trime/handover/local_mesh.hpp"
#include "trime/mesh/quality.hpp"
#include "trime/record/verdict.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trime {

/// An edge of the mesh on the boundary of the shape; the interior lies on the left of first -> second.
struct Facet {
  LocalIndex first, second; ///< local indices of the two end points
  LocalIndex triangle;      ///< the local triangle to which the edge belongs
  std::int32_t loop;        ///< tag of the boundary loop on which the edge lies
  bool owned;               ///< whether this rank owns the edge; exactly one rank owns each edge
};

/// An edge of the mesh inside the shape: on a curve, or between two regions.
struct InnerEdge {
  LocalIndex first, second; ///< local indices of the two end points
  LocalIndex left, right;   ///< local triangles on both sides of first -> second; -1: not on this rank
  bool owned;               ///< whether this rank owns the edge; exactly one rank owns each edge
};

/// The names of a mesh; the same on all ranks.
struct MeshNames {
  std::vector<std::string> facets;       ///< parts of the boundary, in the order of mesh::DistributedMesh::facet_parts
  std::vector<std::string> regions{};    ///< names of the regions 1, 2, ...
  std::vector<std::string> curves{};     ///< curves inside
  std::vector<std::string> interfaces{}; ///< pairs of regions that touch, such as `rock|soil`
  /// Curves that are split. The edges on both sides of them are boundary edges with the name of the curve.
  std::vector<std::string> split_curves{};
};

/// @brief The part of a mesh on one rank: handover::LocalMesh together with the names of the mesh and the
/// communicator. Move-only; may outlive the Mesh from which it was made. Local points are numbered from 0: first the
/// owned points, then the ghosts, both by ascending global id.
class LocalMesh {
public:
  LocalMesh(handover::LocalMesh arrays, MeshNames names, std::shared_ptr<const comm::Communicator> communicator)
      : arrays_(std::move(arrays)), names_(std::move(names)), communicator_(std::move(communicator)) {}

  /// All arrays of the local mesh: ghosts and their owners, ids of triangles, neighbouring ranks, tags.
  const handover::LocalMesh& arrays() const { return arrays_; }
  const std::vector<geometry::Vec2>& points() const { return arrays_.points; } ///< [owned + ghosts]
  /// Counter-clockwise triples of local point indices: first the triangles of this rank, then those of other ranks.
  const std::vector<std::array<LocalIndex, 3>>& triangles() const { return arrays_.triangles; }
  LocalIndex owned_points() const { return arrays_.owned_points; }
  LocalIndex owned_triangles() const { return arrays_.owned_triangles; }
  GlobalId global_id(LocalIndex point) const { return arrays_.global_id(point); }

  const MeshNames& names() const { return names_; }
  const std::vector<std::string>& facet_names() const { return names_.facets; }
  /// @brief Returns the boundary edges with this name, including edges of ghost triangles. Cost: O(facets on this
  /// rank). Not collective.
  /// @throws ConfigError for an unknown name; the message lists the known names
  std::vector<Facet> facets(const std::string& name) const;
  /// @brief Return the edges on the curve, or between the two regions, with this name, in the direction of the curve,
  /// or with the region that is named first on the left. Edges of ghost triangles are included. Not collective.
  /// @throws ConfigError for an unknown name; the message lists the known names
  std::vector<InnerEdge> curve_edges(const std::string& name) const;
  std::vector<InnerEdge> interfaces(const std::string& name) const;
  /// @brief Returns the pairs of points on the two sides of a split curve with this name, by their global ids. This
  /// rank owns at least one point of each. The boundary edges on both sides are facets() of the same name. Not
  /// collective.
  /// @throws ConfigError for an unknown name; the message lists the known names
  std::vector<std::array<GlobalId, 2>> split_pairs(const std::string& name) const;
  /// Returns the number of the region of a local triangle, from 1.
  std::int32_t region(LocalIndex triangle) const { return arrays_.regions.empty() ? 1 : arrays_.regions[at(triangle)]; }

  /// @brief Sets the values of each ghost to those at its owner.
  /// @param values [local points x components]
  /// @note Collective over the ranks of the mesh.
  void update_ghosts(std::span<double> values, int components = 1) const;
  /// @brief Adds the values of ghosts to the values at their owners.
  /// @param values [local points x components]
  /// @note Collective over the ranks of the mesh.
  void add_to_owners(std::span<double> values, int components = 1) const;
  /// Returns the sum of a value over all ranks.
  /// @note Collective.
  double sum(double value) const;

  const comm::Communicator& communicator() const { return *communicator_; }

private:
  handover::LocalMesh arrays_;
  MeshNames names_;
  std::shared_ptr<const comm::Communicator> communicator_; ///< shared with the Mesh, which may be destroyed earlier
};

/// @brief The Voronoi cells of the points of one rank, for finite volumes: dual::LocalCells together with the part of
/// the mesh to which their numbers refer. Move-only; may outlive the Mesh from which it was made.
class LocalCells {
public:
  LocalCells(LocalMesh mesh, dual::LocalCells arrays) : mesh_(std::move(mesh)), arrays_(std::move(arrays)) {}

  /// The points, ghosts, triangles and boundary edges; cell i is that of its local point i.
  const LocalMesh& mesh() const { return mesh_; }
  /// All arrays of the cells: polygons, areas, centroids, faces and their lengths, neighbours, chords.
  const dual::LocalCells& arrays() const { return arrays_; }

private:
  LocalMesh mesh_;
  dual::LocalCells arrays_;
};

class Log;
class Mesh;
namespace meshing {
struct MeshResult;
}

using sweep::Method;

/// The options of make_mesh. The defaults are the same as in the program `trime_mpi`.
struct MeshOptions {
  /// Number of points. Exactly one of points and edge_length must be set, unless `absolute_sizes` is set: then
  /// edge_length must be empty, and points is a limit, above which the mesh is refused.
  std::optional<GlobalId> points{};
  std::optional<double>
      edge_length{}; ///< target edge length; if the size varies, it is scaled so that its mean is this length
  /// If true, the size gives lengths, and is not multiplied by a factor. A uniform size then needs `max_size`.
  bool absolute_sizes = false;
  Method method = Method::hybrid;
  std::optional<double> min_size{}, max_size{}; ///< absolute bounds on the edge length
  /// Largest growth of the edge length per unit of distance. Default: 0.3 for functions and fields, the gradation of
  /// the automatic size, and 0.2 around narrow places; infinity: a function is used as it is.
  std::optional<double> gradation{};
  /// The rectangle on whose lattice all coordinates lie; it must contain the shape. Default: the unit square if the
  /// shape fits into it, otherwise a box around the shape.
  std::optional<Box> container{};
  bool periodic_x = false, periodic_y = false; ///< joins opposite sides of the container; needs `container`
  std::vector<Vec2> fixed_points{};            ///< points that become vertices of the mesh, and are never moved
  /// The regions of the shape. The first one that contains a place has it; what lies in none of them is region 1, the
  /// rest, and the regions of this list are 2, 3, ...
  std::vector<Region> regions{};
  std::string rest{};                  ///< name of the rest; empty: the text of the shape
  bool regions_cover_all = false;      ///< if true, a rest with an area is a GeometryError
  std::vector<Curve> curves{};         ///< curves inside the shape; not split in a periodic container
  boundary::FeatureOptions features{}; ///< which corners, islands and lakes the mesh keeps
  int max_sweeps = 500;
  /// Divides triangles with two boundary edges, in corners of 60 degrees or more. Some models need it, see `accept`.
  bool split_ears = false;
  /// Models whose rules the mesh is measured by: "adcirc", "schism", "telemac", "fvcom", "delft3d", "mpas". See
  /// Mesh::verdicts and configs/formats.md. A rule that makes the model refuse the mesh is a check of the mesh.
  std::vector<std::string> accept{};
  /// Names of those parts of the boundary that are open, in `accept` and in the files of coastal models: the name of a
  /// part, or the text before or behind its dot. An empty list: no part is open. Not set: parts whose name has the word
  /// "open", "ocean" or "sea".
  std::optional<std::vector<std::string>> open_boundary{};
  double worst_alpha =
      5; ///< a triangle with a larger alpha, R/(2r), fails a check, unless it lies at a corner below 60 degrees
  std::uint64_t seed = 1;
  /// An old mesh of any shape, size and number of points, with the same periods, on as many ranks. Its points in the
  /// new shape are the start of the new mesh, thinned and refilled where the wanted size differs: fewer sweeps than for
  /// a new mesh if shape and size differ little. For a file, see read_mesh. Must exist until make_mesh has returned.
  const Mesh* start = nullptr;
  Log* log = nullptr; ///< receives all messages; null: warnings go to the standard error of rank 0
};

using record::SizeShare;
using record::Verdict;

/// The options of Mesh::write.
struct WriteOptions {
  bool overwrite = false; ///< replaces files of the same name; if false, an existing file is a FileError
  bool vtkhdf = true;     ///< also writes NAME.vtkhdf for ParaView; used for `.h5` files only
  bool xdmf = true;       ///< also writes NAME.xdmf for ParaView and other programs; used for `.h5` files only
  bool voronoi = false;   ///< adds the Voronoi cells as the group /Cells; used for `.h5` files only
  /// Cells in files of MPAS, MODFLOW 6, PFLOTRAN and TOUGH2.
  formats::CellKind cells = formats::CellKind::voronoi;
};

/// @brief A mesh distributed over all ranks of a communicator, with the names of its boundary. Move-only. May be
/// destroyed after MPI_Finalize, but not used then.
class Mesh {
public:
  GlobalId points() const;    ///< number of points on all ranks
  GlobalId triangles() const; ///< number of triangles on all ranks
  /// Returns true if the sweeps converged or stopped improving the mesh, and every check of the mesh passed.
  bool certified() const;
  const mesh::Checks& checks() const;
  const mesh::QualitySummary& quality() const;
  /// @brief Returns how well the mesh obeys each rule of the models in MeshOptions::accept, or in the config of the
  /// file that was read. Same on all ranks. Not collective.
  std::vector<Verdict> verdicts() const;
  /// @brief Returns how many points each of several sizes decides; empty if there was one size. Same on all ranks. Not
  /// collective.
  std::vector<SizeShare> size_shares() const;
  /// Returns the hash of points and triangles, which is the same for any number of ranks and threads.
  std::uint64_t hash() const;
  /// Returns how often the points were moved; 0 for a mesh that was read from a file.
  int sweeps() const;

  /// Returns the periods of the container; 0 in a direction in which it is not periodic.
  geometry::Vec2 periods() const;
  /// Returns the names of the boundary, the regions, the curves and the interfaces.
  MeshNames names() const;
  /// Returns the names of the parts of the boundary, in the order of mesh::DistributedMesh::facet_parts. The function
  /// facets() accepts these names and those of split curves.
  const std::vector<std::string>& facet_names() const;
  /// @brief Returns the boundary edges with this name on this rank, as pairs of global point ids; the interior lies on
  /// the left of first -> second. Cost: O(facets on this rank). Not collective.
  /// @throws ConfigError for an unknown name; the message lists the known names. All ranks know the same names, so all
  /// ranks that ask for the same name throw
  std::vector<std::array<GlobalId, 2>> facets(const std::string& name) const;

  /// @brief Returns the part of the mesh on this rank for a solver: points, triangles, ghosts, owners, and the exchange
  /// of values. See handover::make_local_mesh for cost and memory. The result does not need this Mesh afterwards.
  /// @note Collective.
  LocalMesh local(handover::Overlap overlap = handover::Overlap::triangles) const;

  /// @brief Returns the Voronoi cells of the points that this rank owns, with the faces between them and the cells of
  /// other ranks. See dual::make_local_cells for cost and memory. The result does not need this Mesh afterwards.
  /// @throws FileError on all ranks if a point has no cell, which can only be in a damaged file
  /// @note Collective.
  LocalCells cells() const;

  /// @brief Writes the mesh. With the ending `.h5` this is the file that `trime_mpi` writes for the same shape and
  /// options; with `.msh`, `.vtu`, `.mesh` and other endings it is a file for another program, see
  /// formats::all_formats. Missing directories are made. A file appears complete or not at all.
  /// @throws ConfigError for an unknown ending, or a format that does not have such cells; FileError if the file exists
  /// or cannot be written; on all ranks
  /// @note Collective.
  void write(const std::string& path, const WriteOptions& options = {}) const;

  /// The result with all details: arrays, history, loops and features. For a mesh that was read from a file, only mesh,
  /// quality and checks are set.
  const meshing::MeshResult& result() const;
  /// The communicator of the mesh: a duplicate of the one that the caller gave.
  const comm::Communicator& communicator() const;

  struct Implementation; ///< private to the library
  explicit Mesh(std::unique_ptr<Implementation> implementation);
  Mesh(Mesh&&) noexcept;
  Mesh& operator=(Mesh&&) noexcept;
  ~Mesh();

private:
  std::unique_ptr<const Implementation> implementation_;
};

/// @brief Meshes a shape on all ranks of `comm`, which is duplicated. MPI must be running, started by an Environment or
/// by the program itself.
/// @throws ConfigError for options that no mesh can satisfy, and for an unusable communicator; GeometryError for a
/// shape or a size that cannot be meshed; FileError for a contour that cannot be read. All ranks throw together
/// @note Collective over `comm`, which may contain only some of the program's ranks, see MPI_Comm_split.
Mesh make_mesh(MPI_Comm comm, const Shape& shape, const MeshOptions& options);
/// Does the same for triangles whose size is given by `size`, up to a factor.
Mesh make_mesh(MPI_Comm comm, const Shape& shape, const Size& size, const MeshOptions& options);

/// @brief Reads a mesh that Mesh::write or the program `trime_mpi` wrote, with any number of ranks. Memory: that of the
/// mesh.
/// @throws FileError on all ranks if there is no such file, or if it holds no mesh or is damaged
/// @note Collective over `comm`.
Mesh read_mesh(MPI_Comm comm, const std::string& path);

} // namespace trime
