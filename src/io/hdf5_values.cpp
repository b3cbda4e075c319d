// SPDX-License-Identifier: BSD-3-Clause
#include "io/hdf5_values.hpp"

#include <algorithm>
#include <type_traits>
#include <vector>

namespace trime::io {
namespace {

Hdf5Type text_type(std::size_t length, H5T_cset_t characters) {
  Hdf5Type type(H5Tcopy(H5T_C_S1), "make an HDF5 type");
  checked(H5Tset_size(type, std::max<std::size_t>(1, length)), "make an HDF5 type"); // HDF5 has no empty strings
  checked(H5Tset_strpad(type, H5T_STR_NULLPAD), "make an HDF5 type");
  checked(H5Tset_cset(type, characters), "make an HDF5 type");
  return type;
}

Hdf5Space scalar_space() {
  return Hdf5Space(H5Screate(H5S_SCALAR), "make an HDF5 space");
}

template <class T>
hid_t native_type();
template <>
hid_t native_type<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
hid_t native_type<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
hid_t native_type<std::uint64_t>() {
  return H5T_NATIVE_UINT64;
}
template <>
hid_t native_type<double>() {
  return H5T_NATIVE_DOUBLE;
}

template <class T>
SmallValues plain_values(Hdf5Space space, const T* values, std::size_t count) {
  Hdf5Type type(H5Tcopy(native_type<T>()), "make an HDF5 type");
  return {std::move(type), std::move(space), std::string(reinterpret_cast<const char*>(values), count * sizeof(T))};
}

SmallValues text_column(const std::vector<std::string>& texts) {
  std::size_t longest = 1;
  for (const std::string& text : texts)
    longest = std::max(longest, text.size());
  std::string packed;
  for (const std::string& text : texts)
    packed += text + std::string(longest - text.size(), '\0');
  return {text_type(longest, H5T_CSET_UTF8), array_space(texts.size(), 0), packed};
}

} // namespace

Hdf5Properties group_properties() {
  Hdf5Properties properties(H5Pcreate(H5P_GROUP_CREATE), "make HDF5 properties");
  checked(H5Pset_obj_track_times(properties, false), "set HDF5 properties");
  return properties;
}

Hdf5Properties dataset_properties() {
  Hdf5Properties properties(H5Pcreate(H5P_DATASET_CREATE), "make HDF5 properties");
  checked(H5Pset_obj_track_times(properties, false), "set HDF5 properties");
  checked(H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER), "set HDF5 properties");
  checked(H5Pset_alloc_time(properties, H5D_ALLOC_TIME_EARLY), "set HDF5 properties");
  return properties;
}

Hdf5Space array_space(hsize_t rows, hsize_t columns) {
  const hsize_t extent[2] = {rows, columns};
  return Hdf5Space(H5Screate_simple(columns == 0 ? 1 : 2, extent, nullptr), "make an HDF5 space");
}

SmallValues text_value(const std::string& text, H5T_cset_t characters) {
  return {text_type(text.size(), characters), scalar_space(), text};
}

SmallValues attribute_value(const Attribute& attribute) {
  return std::visit(
      [](const auto& value) {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>)
          return text_value(shortened(value, longest_attribute), H5T_CSET_UTF8);
        else
          return plain_values(scalar_space(), &value, 1);
      },
      attribute.value);
}

SmallValues list_value(std::span<const std::int64_t> values) {
  return plain_values(array_space(values.size(), 0), values.data(), values.size());
}

SmallValues column_values(const Column& column) {
  return std::visit(
      [](const auto& values) {
        if constexpr (std::is_same_v<std::decay_t<decltype(values)>, std::vector<std::string>>)
          return text_column(values);
        else
          return plain_values(array_space(values.size(), 0), values.data(), values.size());
      },
      column.values);
}

} // namespace trime::io
