// SPDX-License-Identifier: BSD-3-Clause
#include "io/netcdf_grid.hpp"

#include "trime/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace trime::io {
namespace {

// [steps] How far coordinates may be from even spacing: coordinates in single precision are rounded.
constexpr double uneven = 0.02;
constexpr hsize_t longest_axis = hsize_t{1} << 24;
constexpr std::size_t chunk_cache = std::size_t{1} << 26; // [bytes] a band of chunks of a large raster

Hdf5File open_netcdf(const std::string& path) {
  silence_hdf5();
  const Hdf5Properties access(H5Pcreate(H5P_FILE_ACCESS), "make properties of HDF5");
  checked(H5Pset_file_locking(access, true, true), "set the locks of HDF5");
  return Hdf5File(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), "open " + path);
}

Hdf5Dataset open_values(hid_t file, const std::string& name, const std::string& action) {
  const Hdf5Properties access(H5Pcreate(H5P_DATASET_ACCESS), "make properties of HDF5");
  checked(H5Pset_chunk_cache(access, 12'421, chunk_cache, 1.0), action);
  return Hdf5Dataset(H5Dopen2(file, name.c_str(), access), action);
}

std::vector<hsize_t> shape_of_dataset(hid_t dataset) {
  const Hdf5Space space(H5Dget_space(dataset), "read a dataset");
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

bool is_number(hid_t dataset) {
  const Hdf5Type type(H5Dget_type(dataset), "read a dataset");
  const H5T_class_t kind = H5Tget_class(type);
  return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

/// Appends the name of a link. No exception may pass through HDF5.
herr_t keep_link(hid_t, const char* name, const H5L_info_t*, void* names) {
  try {
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
    return 0;
  } catch (const std::bad_alloc&) {
    return -1;
  }
}

/// Returns the datasets of the root group with numbers in two or more dimensions of the file.
std::vector<std::string> grids_of(hid_t file, const std::string& path) {
  const std::string action = "list the variables of " + path;
  std::vector<std::string> names;
  checked(H5Literate(file, H5_INDEX_NAME, H5_ITER_INC, nullptr, keep_link, &names), action);
  std::erase_if(names, [&](const std::string& name) {
    H5O_info_t object;
    if (H5Oget_info_by_name2(file, name.c_str(), &object, H5O_INFO_BASIC, H5P_DEFAULT) < 0 ||
        object.type != H5O_TYPE_DATASET)
      return true;
    const Hdf5Dataset dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), action);
    return shape_of_dataset(dataset).size() < 2 || !is_number(dataset);
  });
  return names;
}

/// Returns the numbers of an attribute; nothing if there is no such attribute, or it has no numbers.
std::vector<double> numbers_of(hid_t object, const char* name, const std::string& action) {
  if (H5Aexists(object, name) <= 0)
    return {};
  const Hdf5Attribute attribute(H5Aopen(object, name, H5P_DEFAULT), action);
  const Hdf5Type type(H5Aget_type(attribute), action);
  const Hdf5Space space(H5Aget_space(attribute), action);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if ((H5Tget_class(type) != H5T_INTEGER && H5Tget_class(type) != H5T_FLOAT) || count < 1 || count > 1000)
    return {};
  std::vector<double> numbers(static_cast<std::size_t>(count));
  checked(H5Aread(attribute, H5T_NATIVE_DOUBLE, numbers.data()), action);
  return numbers;
}

/// Returns the dataset with the coordinates of a dimension: the first dimension scale that is attached to it.
Hdf5Dataset scale_of(hid_t dataset, std::size_t dimension, std::size_t dimensions, const std::string& action) {
  if (H5Aexists(dataset, "DIMENSION_LIST") <= 0)
    return {};
  const Hdf5Attribute attribute(H5Aopen(dataset, "DIMENSION_LIST", H5P_DEFAULT), action);
  const Hdf5Space space(H5Aget_space(attribute), action);
  const Hdf5Type type(H5Aget_type(attribute), action);
  if (H5Tget_class(type) != H5T_VLEN || H5Sget_simple_extent_npoints(space) != static_cast<hssize_t>(dimensions))
    return {};
  const Hdf5Type list(H5Tvlen_create(H5T_STD_REF_OBJ), action);
  std::vector<hvl_t> scales(dimensions);
  checked(H5Aread(attribute, list, scales.data()), action);
  Hdf5Dataset found;
  if (scales[dimension].len > 0)
    found = Hdf5Dataset(H5Rdereference2(dataset, H5P_DEFAULT, H5R_OBJECT, scales[dimension].p));
  H5Dvlen_reclaim(list, space, H5P_DEFAULT, scales.data());
  return found;
}

/// @throws GeometryError if the coordinates are not evenly spaced
GridAxis axis_of(const std::vector<double>& at, const std::string& what) {
  const auto count = static_cast<std::int64_t>(at.size());
  const double step = count > 1 ? (at.back() - at.front()) / static_cast<double>(count - 1) : 1;
  if (!std::isfinite(step) || step == 0)
    throw GeometryError(fmt::format("{}: expected ascending or descending coordinates, found {:.9g} to {:.9g}", what,
                                    at.front(), at.back()));
  for (std::size_t k = 0; k < at.size(); ++k)
    if (const double even = at.front() + static_cast<double>(k) * step;
        !(std::fabs(at[k] - even) <= uneven * std::fabs(step)))
      throw GeometryError(fmt::format("{}: expected evenly spaced coordinates, found {:.9g} at number {} in place of "
                                      "{:.9g}; interpolate the data to an even grid, for example with cdo remapbil",
                                      what, at[k], k + 1, even));
  return {at.front(), step, count};
}

/// Returns the number that the NetCDF library stores in integer cells that no program has written, if the variable has
/// no `_FillValue` (NC_FILL_SHORT and so on, NetCDF user's guide, "Fill values"). Those of floating-point numbers are
/// above 1e30.
double default_fill(std::size_t bytes, bool is_unsigned) {
  const double range = std::ldexp(1.0, 8 * static_cast<int>(bytes)); // number of values
  if (is_unsigned)
    return bytes == 8 ? range - 2 : range - 1;
  return bytes == 8 ? 2 - range / 2 : 1 - range / 2;
}

} // namespace

std::string NetcdfGrid::what() const {
  return fmt::format("the variable '{}' of {}", name_, path_);
}

NetcdfGrid::NetcdfGrid(const std::string& path, const std::string& variable) : path_(path), file_(open_netcdf(path)) {
  choose(variable);
  shape_ = shape_of_dataset(values_);
  if (shape_.size() < 2 || std::any_of(shape_.begin(), shape_.end() - 2, [](hsize_t n) { return n != 1; }))
    throw GeometryError(fmt::format("{}: expected the dimensions (latitude, longitude) or (y, x), found {} of lengths "
                                    "[{}]; cut out one time or level, for example with ncks -d time,0",
                                    what(), shape_.size(), fmt::join(shape_, ", ")));
  y_ = axis(2);
  x_ = axis(1);
  read_attributes();
}

void NetcdfGrid::choose(const std::string& variable) {
  const std::vector<std::string> known = grids_of(file_, path_);
  if (variable.empty() ? known.size() != 1 : std::find(known.begin(), known.end(), variable) == known.end())
    throw ConfigError(fmt::format("{}: {}; this file has {}", path_,
                                  variable.empty()
                                      ? "expected 'variable = NAME', unless the file has one variable with "
                                        "two dimensions"
                                      : fmt::format("'variable = {}': no variable with two dimensions and "
                                                    "numbers has this name",
                                                    variable),
                                  known.empty() ? "no such variable" : fmt::format("{}", fmt::join(known, ", "))));
  name_ = variable.empty() ? known.front() : variable;
  values_ = open_values(file_, name_, "open " + what());
}

GridAxis NetcdfGrid::axis(int dimension) const {
  const std::size_t number = shape_.size() - static_cast<std::size_t>(dimension);
  const std::string action = "read the coordinates of " + what();
  const Hdf5Dataset scale = scale_of(values_, number, shape_.size(), action);
  if (scale < 0)
    throw GeometryError(fmt::format("{}: dimension {} has no coordinates: expected a dimension scale with them, as "
                                    "NetCDF-4 files have for latitude and longitude",
                                    what(), number + 1));
  std::string name(256, '\0');
  name.resize(static_cast<std::size_t>(std::clamp<ssize_t>(H5Iget_name(scale, name.data(), name.size()), 0, 255)));
  name.erase(0, name.rfind('/') + 1);
  if (dimension == 2 && (name == "x" || name.starts_with("lon")))
    throw GeometryError(fmt::format("{}: expected the order (latitude, longitude) or (y, x) of its dimensions, found "
                                    "'{}' first; change it, for example with ncpdq -a {}",
                                    what(), name, dimension == 2 ? "lat,lon" : ""));
  if (shape_[number] < 1 || shape_[number] > longest_axis || shape_of_dataset(scale) != std::vector{shape_[number]})
    throw GeometryError(fmt::format("{}: expected {} coordinates in '{}'", what(), shape_[number], name));
  std::vector<double> at(shape_[number]);
  checked(H5Dread(scale, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, at.data()), action);
  return axis_of(at, fmt::format("the coordinates '{}' of {}", name, path_));
}

void NetcdfGrid::read_attributes() {
  const std::string action = "read the attributes of " + what();
  const std::vector<double> scale = numbers_of(values_, "scale_factor", action);
  const std::vector<double> offset = numbers_of(values_, "add_offset", action);
  scale_ = scale.empty() ? 1 : scale[0];
  offset_ = offset.empty() ? 0 : offset[0];
  for (const char* name : {"_FillValue", "missing_value"})
    for (const double value : numbers_of(values_, name, action))
      missing_.push_back(value);
  const Hdf5Type type(H5Dget_type(values_), action);
  const std::size_t bytes = H5Tget_size(type);
  if (missing_.empty() && H5Tget_class(type) == H5T_INTEGER && bytes >= 2)
    missing_.push_back(default_fill(bytes, H5Tget_sign(type) == H5T_SGN_NONE));
  fits_single_ = scale_ == 1 && offset_ == 0 && bytes <= (H5Tget_class(type) == H5T_FLOAT ? 4U : 2U);
}

void NetcdfGrid::read(std::int64_t first_row, std::int64_t rows, std::int64_t first_column, std::int64_t columns,
                      double* out) const {
  const std::string action = "read " + what();
  const std::size_t n = shape_.size();
  std::vector<hsize_t> start(n, 0), block(n, 1);
  start[n - 2] = static_cast<hsize_t>(first_row);
  start[n - 1] = static_cast<hsize_t>(first_column);
  block[n - 2] = static_cast<hsize_t>(rows);
  block[n - 1] = static_cast<hsize_t>(columns);
  const Hdf5Space space(H5Dget_space(values_), action);
  const Hdf5Space memory(H5Screate_simple(static_cast<int>(n), block.data(), nullptr), action);
  checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr), action);
  checked(H5Dread(values_, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, out), action);
  std::for_each(out, out + rows * columns, [&](double& value) {
    const bool is_missing = std::find(missing_.begin(), missing_.end(), value) != missing_.end();
    value = is_missing ? std::numeric_limits<double>::quiet_NaN() : value * scale_ + offset_;
  });
}

} // namespace trime::io
