// SPDX-License-Identifier: BSD-3-Clause
// From a shape to a mesh on all ranks of a communicator, and what a program does with it.
#pragma once

#include "trime/boundary/features.hpp"
#include "trime/comm/from_mpi.hpp"
#include "trime/core/types.hpp"
#include "trime/facade/shape.hpp"
#include "trime/facade/size.hpp"
#include "trime/handover/local_mesh.hpp"
#include "trime/mesh/quality.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trime {

/// An edge of the boundary; the interior lies on the left of first -> second.
struct Facet {
  LocalIndex first, second; ///< local points
  LocalIndex triangle;      ///< the local triangle that it belongs to
  std::int32_t loop;        ///< tag of its loop
  bool owned;               ///< by this rank; each edge of the mesh is owned by exactly one
};

/// @brief handover::LocalMesh with names and communicator. Move-only; may outlive its Mesh. Local points are the owned
/// ones from 0, then the ghosts, by ascending global id in both.
class LocalMesh {
public:
  LocalMesh(handover::LocalMesh arrays, std::vector<std::string> names,
            std::shared_ptr<const comm::Communicator> communicator)
      : arrays_(std::move(arrays)), names_(std::move(names)), communicator_(std::move(communicator)) {}

  /// All arrays: ghosts and their owners, triangle ids, neighbours, tags.
  const handover::LocalMesh& arrays() const { return arrays_; }
  const std::vector<geometry::Vec2>& points() const { return arrays_.points; } ///< [owned + ghosts]
  /// Counter-clockwise triples of local points: the owned triangles, then those of other ranks.
  const std::vector<std::array<LocalIndex, 3>>& triangles() const { return arrays_.triangles; }
  LocalIndex owned_points() const { return arrays_.owned_points; }
  LocalIndex owned_triangles() const { return arrays_.owned_triangles; }
  GlobalId global_id(LocalIndex point) const { return arrays_.global_id(point); }

  const std::vector<std::string>& facet_names() const { return names_; }
  /// @brief The boundary edges of this name, those of ghost triangles too. O(facets here). Not collective.
  /// @throws ConfigError for an unknown name, with the known ones, as Mesh::facets
  std::vector<Facet> facets(const std::string& name) const;

  /// @brief Gives each ghost the values of its owner. @param values [local points x components]
  /// @note Collective over the ranks of the mesh.
  void update_ghosts(std::span<double> values, int components = 1) const;
  /// @brief Adds the values of ghosts to those of their owners. @param values [local points x components]
  /// @note Collective over the ranks of the mesh.
  void add_to_owners(std::span<double> values, int components = 1) const;
  /// The sum of a value over all ranks. @note Collective.
  double sum(double value) const;

  const comm::Communicator& communicator() const { return *communicator_; }

private:
  handover::LocalMesh arrays_;
  std::vector<std::string> names_;
  std::shared_ptr<const comm::Communicator> communicator_; ///< shared with the mesh, which may die before
};

class Log;
namespace meshing {
struct MeshResult;
}

using sweep::Method;

/// Holds the requests of a caller of make_mesh. The defaults are those of the program `trime_mpi`.
struct MeshOptions {
  std::optional<GlobalId> points{};    ///< exactly one of points and edge_length is set
  std::optional<double> edge_length{}; ///< target edge length; a size that varies is scaled so that its mean is this
  Method method = Method::hybrid;
  std::optional<double> min_size{}, max_size{}; ///< absolute bounds on the edge length
  /// The rectangle on whose lattice all coordinates lie; it must contain the shape. Default: the unit square if the
  /// shape fits into it, else a box around the shape.
  std::optional<Box> container{};
  bool periodic_x = false, periodic_y = false; ///< these sides of the container are one; needs `container`
  std::vector<Vec2> fixed_points{};            ///< become vertices, and are never moved
  boundary::FeatureOptions features{};         ///< which corners, islands and lakes the mesh keeps
  int max_sweeps = 500;
  double worst_alpha = 5; ///< a worse triangle away from corners below 60 degrees fails a check of the mesh
  std::uint64_t seed = 1;
  Log* log = nullptr; ///< gets all messages; null: warnings go to the standard error of rank 0
};

/// How Mesh::write writes.
struct WriteOptions {
  bool overwrite = false; ///< replaces files of the same name; else they are a FileError
  bool vtkhdf = true;     ///< NAME.vtkhdf for ParaView; `.h5` only
  bool xdmf = true;       ///< NAME.xdmf for ParaView and others; `.h5` only
};

/// @brief A mesh that lies on all ranks of a communicator, with the names of its boundary. Move-only. May be destroyed
/// after MPI_Finalize, but not used.
class Mesh {
public:
  GlobalId points() const;    ///< on all ranks
  GlobalId triangles() const; ///< on all ranks
  /// The stop rule was met, and every check passed: the mesh is right.
  bool certified() const;
  const mesh::Checks& checks() const;
  const mesh::QualitySummary& quality() const;
  /// The hash of points and triangles is the same for any number of ranks and threads.
  std::uint64_t hash() const;

  /// The names that facets() knows, by mesh::DistributedMesh::facet_parts.
  const std::vector<std::string>& facet_names() const;
  /// @brief The boundary edges of this name that this rank holds, as global ids of points; the interior lies on the
  /// left of first -> second. O(facets here). Not collective.
  /// @throws ConfigError for an unknown name, with the known ones. All ranks know the same names, so all that ask for
  /// the same name throw
  std::vector<std::array<GlobalId, 2>> facets(const std::string& name) const;

  /// @brief The part of this rank for a solver: points, triangles, ghosts, owners, halo. See handover::make_local_mesh
  /// for cost and memory. It does not need the mesh afterwards.
  /// @note Collective.
  LocalMesh local(handover::Overlap overlap = handover::Overlap::triangles) const;

  /// @brief Writes the file that `trime_mpi` writes for the same shape and options (`.h5`), or one for another program:
  /// `.msh`, `.vtu`, `.mesh`, ..., see formats::all_formats. Directories are made if they are missing. The file appears
  /// whole or not at all.
  /// @throws ConfigError for another ending, FileError if a file exists or cannot be written; on all ranks
  /// @note Collective.
  void write(const std::string& path, const WriteOptions& options = {}) const;

  /// The result of the lower level: arrays, history, loops and features. Of a mesh that was read from a file, only
  /// mesh, quality and checks are set.
  const meshing::MeshResult& result() const;
  /// The ranks of the mesh: a duplicate of the communicator that the caller gave.
  const comm::Communicator& communicator() const;

  struct Implementation; ///< private to the library
  explicit Mesh(std::unique_ptr<Implementation> implementation);
  Mesh(Mesh&&) noexcept;
  Mesh& operator=(Mesh&&) noexcept;
  ~Mesh();

private:
  std::unique_ptr<const Implementation> implementation_;
};

/// @brief Meshes a shape on all ranks of `comm`, which is duplicated. MPI must be running: by an Environment, or by the
/// program itself.
/// @throws ConfigError for options that no mesh can meet, and for a communicator that cannot be used; GeometryError for
/// a shape or a size that cannot be meshed; FileError for a contour that cannot be read. Always on all ranks together
/// @note Collective over `comm`. Any part of the ranks of a program may call it, see MPI_Comm_split.
Mesh make_mesh(MPI_Comm comm, const Shape& shape, const MeshOptions& options);
/// Does the same with your own size.
Mesh make_mesh(MPI_Comm comm, const Shape& shape, const Size& size, const MeshOptions& options);

/// @brief A mesh that Mesh::write or the program `trime_mpi` wrote, on any number of ranks. Memory: the mesh.
/// @throws FileError on all ranks if there is no such file, it holds no mesh, or it is damaged
/// @note Collective over `comm`.
Mesh read_mesh(MPI_Comm comm, const std::string& path);

} // namespace trime
