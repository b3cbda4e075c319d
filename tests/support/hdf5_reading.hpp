// SPDX-License-Identifier: BSD-3-Clause
// Reads datasets of a finished HDF5 file by calls of the HDF5 library alone.
#pragma once

#include "io/hdf5_handle.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace trime::test {

/// Reads one dataset on one rank, and also checks its shape, its type in the file and its layout.
template <class T>
std::vector<T> read(hid_t file, const char* path, hid_t type, const std::vector<hsize_t>& shape,
                    H5D_layout_t layout = H5D_CONTIGUOUS) {
  const io::Hdf5Dataset dataset(H5Dopen2(file, path, H5P_DEFAULT), path);
  const io::Hdf5Space space(H5Dget_space(dataset), "space");
  std::vector<hsize_t> found(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, found.data(), nullptr);
  EXPECT_EQ(found, shape) << path;
  const io::Hdf5Type stored(H5Dget_type(dataset), "type");
  EXPECT_GT(H5Tequal(stored, type), 0) << path;
  const io::Hdf5Properties creation(H5Dget_create_plist(dataset), "properties");
  EXPECT_EQ(H5Pget_layout(creation), layout) << path;
  H5O_info_t info;
  EXPECT_GE(H5Oget_info2(dataset, &info, H5O_INFO_TIME), 0);
  EXPECT_EQ(info.mtime, 0) << path << " keeps the time of its making";
  std::vector<T> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  if (!values.empty()) {
    EXPECT_GE(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << path;
  }
  return values;
}

/// Returns the bytes that the values of a dataset take in the file.
inline std::int64_t stored_bytes(hid_t file, const char* path) {
  const io::Hdf5Dataset dataset(H5Dopen2(file, path, H5P_DEFAULT), path);
  return static_cast<std::int64_t>(H5Dget_storage_size(dataset));
}

template <class T, class F>
void expect_values(const std::vector<T>& values, std::int64_t count, const F& expected) {
  ASSERT_EQ(static_cast<std::int64_t>(values.size()), count);
  for (std::int64_t i = 0; i < count; ++i)
    ASSERT_EQ(values[static_cast<std::size_t>(i)], static_cast<T>(expected(i))) << i;
}

} // namespace trime::test
