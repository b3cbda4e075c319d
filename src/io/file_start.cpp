// SPDX-License-Identifier: BSD-3-Clause
#include "io/file_start.hpp"

#include "io/hdf5_values.hpp"

#include <fmt/format.h>

namespace trime::io {
namespace {

/// The values of the source appear in the first columns. The file refers to itself, whatever its name will be.
void set_source(const Hdf5Properties& creation, const VirtualArray& array) {
  const auto& [rows, columns] = array.shape;
  const Hdf5Space shown = array_space(rows, columns),
                  source = array_space(array.source_shape.rows, array.source_shape.columns);
  if (columns > array.source_shape.columns) {
    const hsize_t start[2] = {0, 0}, extent[2] = {rows, array.source_shape.columns};
    checked(H5Sselect_hyperslab(shown, H5S_SELECT_SET, start, nullptr, extent, nullptr), "select columns");
  }
  checked(H5Pset_virtual(creation, shown, ".", array.source.c_str(), source), "set the source of " + array.path);
}

} // namespace

std::string FileStart::action(const std::string& verb, const std::string& what) const {
  return fmt::format("{} {} in {}", verb, what, path_);
}

void FileStart::group(const std::string& path) const {
  const Hdf5Properties creation = group_properties();
  const Hdf5Group made(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), action("make", path));
}

void FileStart::write_attribute(const std::string& object, const std::string& name, const SmallValues& values) const {
  const Hdf5Attribute made(H5Acreate_by_name(file_, object.c_str(), name.c_str(), values.type, values.space,
                                             H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           action("make", "the attribute " + name));
  checked(H5Awrite(made, values.type, values.bytes.data()), action("write", "the attribute " + name));
}

void FileStart::attribute(const std::string& object, const Attribute& attribute) const {
  write_attribute(object, attribute.name, attribute_value(attribute));
}

void FileStart::attribute(const std::string& object, const std::string& name,
                          std::span<const std::int64_t> values) const {
  write_attribute(object, name, list_value(values));
}

void FileStart::ascii_attribute(const std::string& object, const std::string& name, const std::string& text) const {
  write_attribute(object, name, text_value(text, H5T_CSET_ASCII));
}

void FileStart::write_dataset(const std::string& path, const SmallValues& values) const {
  const Hdf5Properties creation = dataset_properties();
  const Hdf5Dataset made(H5Dcreate2(file_, path.c_str(), values.type, values.space, H5P_DEFAULT, creation, H5P_DEFAULT),
                         action("make", path));
  if (H5Sget_simple_extent_npoints(values.space) > 0)
    checked(H5Dwrite(made, values.type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.bytes.data()), action("write", path));
}

void FileStart::column(const std::string& group, const Column& column) const {
  write_dataset(group + "/" + column.name, column_values(column));
}

void FileStart::text(const std::string& path, const std::string& text) const {
  write_dataset(path, text_value(text, H5T_CSET_UTF8));
}

void FileStart::metadata(const std::string& root, const Metadata& metadata) const {
  group(root);
  for (const Attribute& one : metadata.attributes)
    attribute(root, one);
  for (const Text& one : metadata.texts)
    text(root + "/" + one.name, one.text);
  for (const MetadataGroup& table : metadata.groups) {
    const std::string inside = root + "/" + table.name;
    group(inside);
    for (const Attribute& one : table.attributes)
      attribute(inside, one);
    for (const Column& one : table.columns)
      column(inside, one);
  }
}

void FileStart::show(const VirtualArray& array) const {
  const Hdf5Properties creation(H5Pcreate(H5P_DATASET_CREATE), "make HDF5 properties");
  checked(H5Pset_obj_track_times(creation, false), "set HDF5 properties");
  if (array.shape.rows > 0)
    set_source(creation, array);
  const Hdf5Space space = array_space(array.shape.rows, array.shape.columns);
  const Hdf5Dataset made(H5Dcreate2(file_, array.path.c_str(), array.type, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                         action("make", array.path));
}

} // namespace trime::io
