// SPDX-License-Identifier: BSD-3-Clause
// From the sections [shape.NAME] to a shape, or its boundary, on every rank. Files are read by rank 0 only.
#pragma once

#include "app/map_projection.hpp"
#include "app/options.hpp"
#include "app/user_places.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/contours/contour.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/shape/region_shape.hpp"

#include <optional>
#include <vector>

namespace trime::app {

/// Bytes of a file on every rank; rank 0 reads. @throws FileError on all ranks. @note Collective.
std::string read_shared(const std::string& path, const comm::Communicator& comm);

/// A run asks for nothing but the boundary; the parts of a large shape take as much memory again.
enum class ShapeUse { boundary, queries };

/// The content of the shape sections of a config and their files.
struct ShapeInput {
  const geometry::Domain& domain() const { return shape ? shape->domain() : *alone; }
  const geometry::Boundary& boundary() const { return domain().boundary(); }
  void set_fixed_points(std::vector<geometry::FixedPoint> points) {
    shape ? shape->set_fixed_points(std::move(points)) : alone->set_fixed_points(std::move(points));
  }

  std::optional<shape::RegionShape> shape; ///< for queries only
  std::optional<geometry::Domain> alone;   ///< if there is no shape
  contours::Normalization
      fixed_points_place;                 ///< what fixed points undergo: that of the contour they are normalised with
  std::vector<NormalizedPart> normalized; ///< in the order of the parts
  MapSystem map;                          ///< reference system of the container
};

/// @brief Reads each file once, and writes warnings to the log.
/// @param places gets the contours, on rank 0
/// @throws GeometryError, ConfigError, FileError on all ranks together
/// @note Collective.
ShapeInput read_shape(const RunOptions& options, ShapeUse use, const comm::Communicator& comm, Log& log,
                      UserPlaces& places);

/// @brief The fixed points with labels `file:line`, normalised or projected as the contours; none if the options name
/// no file.
/// @throws GeometryError, ConfigError, FileError on all ranks together
/// @note Collective.
std::vector<geometry::FixedPoint> read_fixed_points(const RunOptions& options, const ShapeInput& input,
                                                    const comm::Communicator& comm);

/// @brief The options of the mesh, with the place of meshing.components moved and projected as the contours are.
/// @throws ConfigError on all ranks together if it cannot be projected
/// @note Collective.
meshing::MeshOptions placed_options(const RunOptions& options, const ShapeInput& input, const comm::Communicator& comm);

} // namespace trime::app
