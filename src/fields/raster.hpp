// SPDX-License-Identifier: BSD-3-Clause
// A raster of numbers at the centres of its cells, such as the depth of the sea, and the reader of its files.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace trime::fields {

/// Coordinates of the centres along one axis: first + k * step for 0 <= k < count, with step > 0.
struct Axis {
  double first = 0, step = 1;
  std::int64_t count = 0;

  double at(double k) const { return first + k * step; }
  double last() const { return at(static_cast<double>(count - 1)); }
  /// Returns the index of a coordinate, with a fraction.
  double index(double coordinate) const { return (coordinate - first) / step; }
};

/// Values of a part of a raster. Rows ascend, so row 0 is the southernmost one. The values are in one of both lists:
/// in `singles` if single precision holds all of them.
struct Raster {
  Axis x, y;
  std::vector<float> singles{};
  std::vector<double> doubles{};
  /// One bit for each value that was filled because the file has no number there; empty if no value was filled.
  std::vector<std::uint8_t> filled{};

  std::size_t index(std::int64_t column, std::int64_t row) const {
    return static_cast<std::size_t>(row * x.count + column);
  }
  std::size_t size() const { return static_cast<std::size_t>(x.count * y.count); }
  double value(std::size_t k) const { return singles.empty() ? doubles[k] : static_cast<double>(singles[k]); }
  void set(std::size_t k, double value) {
    if (singles.empty())
      doubles[k] = value;
    else
      singles[k] = static_cast<float>(value);
  }
  bool is_filled(std::size_t k) const { return !filled.empty() && (filled[k / 8] >> k % 8 & 1) != 0; }
  std::size_t bytes() const { return singles.size() * sizeof(float) + doubles.size() * sizeof(double) + filled.size(); }
};

/// Columns [first_column, first_column + columns) and rows [first_row, first_row + rows) of a file; rows count from the
/// south.
struct Window {
  std::int64_t first_column = 0, columns = 0, first_row = 0, rows = 0;
};

/// An open file with a raster.
class RasterFile {
public:
  virtual ~RasterFile() = default;
  virtual const Axis& x() const = 0;
  virtual const Axis& y() const = 0;
  /// Returns whether single precision holds all values.
  virtual bool fits_single() const = 0;
  /// Reads the values of a window, row by row from the south; NaN where there is no data.
  /// @param out room for all values @throws FileError if the file is damaged
  virtual void read(const Window& window, double* out) = 0;
  /// Returns whether the first row of the file is the northernmost one.
  virtual bool begins_in_north() const = 0;
};

/// Values above this are marks for missing data that a file does not name: maxima of floating-point types.
inline constexpr double largest_value = 1e30;

/// @brief Opens an ESRI ASCII grid or a NetCDF-4 file, by its first bytes.
/// @param variable name of the variable of a NetCDF file; empty: the only one that has two dimensions
/// @param hint text that ends the message if the file cannot be opened
/// @throws FileError, GeometryError or ConfigError with what can be done for files of other formats
/// @note Serial.
std::unique_ptr<RasterFile> open_raster(const std::string& path, const std::string& variable, const std::string& hint);

} // namespace trime::fields
