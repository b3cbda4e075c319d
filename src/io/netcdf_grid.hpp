// SPDX-License-Identifier: BSD-3-Clause
// Reads a raster from a NetCDF-4 file, which is an HDF5 file with names for axes and attributes for units and missing
// values (the CF conventions).
#pragma once

#include "io/hdf5_handle.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace trime::io {

/// Evenly spaced coordinates; `step` may be negative.
struct GridAxis {
  double first = 0, step = 1;
  std::int64_t count = 0;
};

/// @brief A variable with the dimensions (y, x) or (latitude, longitude), after any number of dimensions of length 1.
/// The axes are the dimension scales of the variable.
/// @note Serial.
class NetcdfGrid {
public:
  /// @param variable name of the variable; empty: the only one with two dimensions
  /// @throws FileError if the file cannot be read; ConfigError if there is no such variable; GeometryError if the
  /// variable has other dimensions, or axes that are not evenly spaced
  NetcdfGrid(const std::string& path, const std::string& variable);

  const GridAxis& x() const { return x_; }
  const GridAxis& y() const { return y_; }
  /// Returns whether single precision holds all values.
  bool fits_single() const { return fits_single_; }
  /// @brief Reads rows and columns in the order of the file, row by row, with scale_factor and add_offset applied.
  /// Values that are equal to _FillValue or missing_value become NaN.
  void read(std::int64_t first_row, std::int64_t rows, std::int64_t first_column, std::int64_t columns,
            double* out) const;

private:
  std::string what() const;
  GridAxis axis(int dimension) const;
  void choose(const std::string& variable);
  void read_attributes();

  std::string path_, name_;
  Hdf5File file_;
  Hdf5Dataset values_;
  std::vector<hsize_t> shape_;
  GridAxis x_, y_;
  double scale_ = 1, offset_ = 0;
  std::vector<double> missing_; // in the numbers of the file, before scale and offset
  bool fits_single_ = false;
};

} // namespace trime::io
