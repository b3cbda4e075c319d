// SPDX-License-Identifier: BSD-3-Clause
#include "contours/ascii_grid.hpp"
#include "core/read_file.hpp"
#include "fields/raster.hpp"
#include "io/netcdf_grid.hpp"
#include "trime/core/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <string_view>

namespace trime::fields {
namespace {

double usable(double value) {
  return std::fabs(value) <= largest_value ? value : std::numeric_limits<double>::quiet_NaN();
}

/// An ESRI ASCII grid, all of whose values are in memory.
class AsciiRaster final : public RasterFile {
public:
  explicit AsciiRaster(contours::AsciiGrid grid)
      : grid_(std::move(grid)), x_{grid_.corner.x + grid_.cell.x / 2, grid_.cell.x, grid_.columns},
        y_{grid_.corner.y + grid_.cell.y / 2, grid_.cell.y, grid_.rows} {
    for (double& value : grid_.values) {
      value = usable(value);
      fits_single_ = fits_single_ && (std::isnan(value) || static_cast<double>(static_cast<float>(value)) == value);
    }
  }
  const Axis& x() const override { return x_; }
  const Axis& y() const override { return y_; }
  bool fits_single() const override { return fits_single_; }
  bool begins_in_north() const override { return true; }
  void read(const Window& window, double* out) override {
    for (std::int64_t row = 0; row < window.rows; ++row) {
      const int in_file = grid_.rows - 1 - static_cast<int>(window.first_row + row);
      const double* const values = &grid_.values[grid_.index(static_cast<int>(window.first_column), in_file)];
      out = std::copy(values, values + window.columns, out);
    }
  }

private:
  contours::AsciiGrid grid_;
  Axis x_, y_;
  bool fits_single_ = true;
};

/// A variable of a NetCDF-4 file, whose axes may descend.
class NetcdfRaster final : public RasterFile {
public:
  NetcdfRaster(const std::string& path, const std::string& variable)
      : grid_(path, variable), x_(ascending(grid_.x())), y_(ascending(grid_.y())) {}
  const Axis& x() const override { return x_; }
  const Axis& y() const override { return y_; }
  bool fits_single() const override { return grid_.fits_single(); }
  bool begins_in_north() const override { return grid_.y().step < 0; }
  void read(const Window& window, double* out) override {
    const bool turns_x = grid_.x().step < 0, turns_y = grid_.y().step < 0;
    const std::int64_t column = turns_x ? x_.count - window.first_column - window.columns : window.first_column;
    const std::int64_t row = turns_y ? y_.count - window.first_row - window.rows : window.first_row;
    grid_.read(row, window.rows, column, window.columns, out);
    const std::int64_t size = window.rows * window.columns;
    std::transform(out, out + size, out, usable);
    for (std::int64_t k = 0; turns_x && k < window.rows; ++k)
      std::reverse(out + k * window.columns, out + (k + 1) * window.columns);
    for (std::int64_t k = 0; turns_y && k < window.rows / 2; ++k)
      std::swap_ranges(out + k * window.columns, out + (k + 1) * window.columns,
                       out + (window.rows - 1 - k) * window.columns);
  }

private:
  static Axis ascending(const io::GridAxis& axis) {
    return axis.step > 0 ? Axis{axis.first, axis.step, axis.count}
                         : Axis{axis.first + axis.step * static_cast<double>(axis.count - 1), -axis.step, axis.count};
  }
  io::NetcdfGrid grid_;
  Axis x_, y_;
};

std::string first_bytes(const std::string& path) {
  std::array<char, 8> bytes{};
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), bytes.size());
  return {bytes.data(), static_cast<std::size_t>(file.gcount())};
}

/// Formats that other programs convert.
void refuse_other_formats(const std::string& path, std::string_view bytes) {
  if (bytes.starts_with("CDF"))
    throw GeometryError(fmt::format("{0}: expected an ESRI ASCII grid or a NetCDF-4 file, found a classic NetCDF file; "
                                    "convert it: nccopy -4 {0} OUT.nc",
                                    path));
  using std::string_view_literals::operator""sv;
  for (const std::string_view tiff : {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv})
    if (bytes.starts_with(tiff))
      throw GeometryError(fmt::format("{0}: expected an ESRI ASCII grid or a NetCDF-4 file, found a GeoTIFF; convert "
                                      "it: gdal_translate -of AAIGrid {0} OUT.asc, or for a large raster "
                                      "gdal_translate -of netCDF -co FORMAT=NC4 {0} OUT.nc",
                                      path));
}

} // namespace

std::unique_ptr<RasterFile> open_raster(const std::string& path, const std::string& variable, const std::string& hint) {
  const std::string kind = irregular_kind(path);
  const std::string bytes = kind.empty() ? first_bytes(path) : std::string();
  refuse_other_formats(path, bytes);
  if (bytes.starts_with("\x89HDF"))
    return std::make_unique<NetcdfRaster>(path, variable);
  if (!variable.empty() && !bytes.empty())
    throw ConfigError(fmt::format("{}: 'variable' names a variable of a NetCDF file, but this file is not one", path));
  return std::make_unique<AsciiRaster>(contours::read_ascii_grid(read_file(path, hint), path));
}

} // namespace trime::fields
