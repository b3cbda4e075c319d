// SPDX-License-Identifier: BSD-3-Clause
// One rank's part of a mesh for a solver, with the names of its boundary.
#pragma once

#include "trime/core/types.hpp"
#include "trime/handover/local_mesh.hpp"

#include <array>
#include <cstdint>
#include <memory>
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

} // namespace trime
