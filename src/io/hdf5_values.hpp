// SPDX-License-Identifier: BSD-3-Clause
// Converts attributes and small datasets to types, dataspaces and properties of HDF5. Nothing in this file accesses a
// file.
#pragma once

#include "io/hdf5_handle.hpp"
#include "trime/io/metadata.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace trime::io {

/// Returns the dataspace of an array.
/// @param columns 0 for a one-dimensional array
Hdf5Space array_space(hsize_t rows, hsize_t columns);

/// Returns the properties of groups and datasets. Objects have no times of their own, so that equal meshes make equal
/// objects. A dataset gets its room at once, and HDF5 does not fill it.
Hdf5Properties group_properties();
Hdf5Properties dataset_properties();

/// The values of an attribute or of a small dataset in the form that HDF5 writes.
struct SmallValues {
  Hdf5Type type;
  Hdf5Space space;
  std::string bytes;
};

SmallValues attribute_value(const Attribute& attribute);
SmallValues text_value(const std::string& text, H5T_cset_t characters);
SmallValues list_value(std::span<const std::int64_t> values);
SmallValues column_values(const Column& column);

} // namespace trime::io
