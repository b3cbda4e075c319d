// SPDX-License-Identifier: BSD-3-Clause
// Makes a shape, or only its boundary, from the sections [shape.NAME] of a config, on every rank. Only rank 0 reads
// files.
#pragma once

#include "app/map_projection.hpp"
#include "app/options.hpp"
#include "app/user_places.hpp"
#include "sizing/region_size.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/contours/contour.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/shape/region_shape.hpp"

#include <optional>
#include <vector>

namespace trime::app {

/// Returns the bytes of a file on every rank; only rank 0 reads the file.
/// @throws FileError on all ranks
/// @note Collective.
std::string read_shared(const std::string& path, const comm::Communicator& comm);

/// Says which part of the result the caller needs: only the boundary, as a run does, or the whole shape with its parts,
/// which takes as much memory again.
enum class ShapeUse { boundary, queries };

/// The shape, and further data from its files.
struct ShapeInput {
  const geometry::Domain& domain() const { return shape ? shape->domain() : *alone; }
  const geometry::Boundary& boundary() const { return domain().boundary(); }
  void set_fixed_points(std::vector<geometry::FixedPoint> points) {
    shape ? shape->set_fixed_points(std::move(points)) : alone->set_fixed_points(std::move(points));
  }

  std::optional<shape::RegionShape> shape;    ///< the whole shape; set for ShapeUse::queries only
  std::optional<geometry::Domain> alone;      ///< the domain; set if `shape` is not
  contours::Normalization fixed_points_place; ///< the normalisation to be applied to fixed points: that of the contour
                                              ///< with which they are normalised
  std::vector<NormalizedPart> normalized;     ///< the parts that were normalised, in the order of the parts
  MapSystem map;                              ///< reference system of the coordinates of the container
  std::vector<sizing::RegionBound> bounds;    ///< largest sizes in regions, as files give them
};

/// @brief Makes the shape. Reads each file once, and writes warnings to the log.
/// @param places receives the contours on rank 0
/// @throws GeometryError, ConfigError, FileError on all ranks together
/// @note Collective.
ShapeInput read_shape(const RunOptions& options, ShapeUse use, const comm::Communicator& comm, Log& log,
                      UserPlaces& places);

/// @brief Returns the fixed points with labels `file:line`, normalised or projected in the same way as the contours.
/// The list is empty if the options name no file.
/// @throws GeometryError, ConfigError, FileError on all ranks together
/// @note Collective.
std::vector<geometry::FixedPoint> read_fixed_points(const RunOptions& options, const ShapeInput& input,
                                                    const comm::Communicator& comm);

/// @brief Returns the options of the mesher. The place of the key meshing.components is normalised and projected in the
/// same way as the contours.
/// @throws ConfigError on all ranks together if the place cannot be projected
/// @note Collective.
meshing::MeshOptions placed_options(const RunOptions& options, const ShapeInput& input, const comm::Communicator& comm);

} // namespace trime::app
