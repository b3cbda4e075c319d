// SPDX-License-Identifier: BSD-3-Clause
// Reads the part of a raster that a shape needs, checks that it covers the shape, and gives it to all ranks.
#pragma once

#include "fields/field.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace trime::fields {

/// Says what happens at a place for which the file has no value: an error, the nearest value, or a number of the user.
enum class Fill { refuse, nearest, value };

/// Names the file that is read, and says what happens where it has no value.
struct FieldRequest {
  std::string path, variable, hint; ///< see open_raster
  Fill fill = Fill::refuse;
  double fill_value = 0;
  bool outside_is_nearest = false; ///< places outside of the raster get the nearest value; otherwise they are an error
  double smooth = 0;               ///< length over which gradients are smoothed; 0: they are not. Values by Fill::value
                                   ///< count like those of the file, values by Fill::nearest do not
  double per_degree = 0;           ///< this length in a degree of latitude, if the file has degrees; otherwise 0
  double period = 0;               ///< period of x in the file: 360 if it is a longitude, otherwise 0
};

/// Converts a place of the mesh to the coordinates of the file. Thread-safe.
using ToFile = std::function<geometry::Vec2(geometry::Vec2)>;

/// A field with a hash of its values and places.
struct ReadField {
  std::unique_ptr<const Field> field;
  std::uint64_t hash = 0;
  geometry::Vec2 cell; ///< sides of a cell in the unit of `smooth`, along rows in the mean; (0, 0) without `smooth`
};

/// Largest number of values that a field may have, because each rank holds all of them.
inline constexpr double most_values = 4e8;

/// [cells] Largest half width of the weights of a smooth copy, along rows in the mean of all rows. Each of its values
/// then costs 4000 products in the mean; a length in another unit, such as metres for kilometres, would cost hours.
inline constexpr double most_smooth_cells = 1000;

/// @brief Returns the box of the raster's cells in the coordinates of the file. Only rank 0 reads. Collective.
/// @throws FileError, GeometryError, ConfigError on all ranks
geometry::Box raster_box(const FieldRequest& request, const comm::Communicator& comm);

/// @brief Reads the values in and around the box of the shape on rank 0, band by band, and broadcasts them in pieces.
/// Collective. Cost on each rank: 4 or 8 bytes for each value of the cut, and a bit more where values were filled;
/// twice that with a smooth copy, which each rank makes by all its threads, see smoothed().
/// @throws FileError, GeometryError, ConfigError on all ranks: for a damaged file, a shape that the raster does not
/// cover, a needed place without data, more than most_values values, and more than most_smooth_cells cells
ReadField read_field(const FieldRequest& request, const geometry::Boundary& boundary, const ToFile& to_file,
                     const comm::Communicator& comm);

} // namespace trime::fields
