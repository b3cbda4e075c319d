// SPDX-License-Identifier: BSD-3-Clause
#include "io/hdf5_input.hpp"

#include "core/read_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <optional>

namespace trime::io {
namespace {

/// HDF5 would wait without end for the writer of a pipe, and says little about a file that does not exist.
void check_is_a_file(const std::string& path) {
  if (const std::string kind = irregular_kind(path); !kind.empty())
    throw FileError(fmt::format("cannot read {}: expected a file of trime_mpi, found {}; check the path", path, kind));
  if (access(path.c_str(), R_OK) != 0)
    throw FileError(fmt::format("cannot open {}: {}; check the path and the permissions", path, std::strerror(errno)));
}

/// The views of a mesh file are text, about which HDF5 would say only that they have no signature.
void check_is_no_view(const std::string& path) {
  for (const char* ending : {".xdmf", ".xmf"})
    if (path.ends_with(ending))
      throw FileError(fmt::format("cannot read {}: it only describes a mesh file to other programs; open {}.h5, which "
                                  "has the mesh",
                                  path, path.substr(0, path.rfind('.'))));
}

/// Opened for reading; file systems without locks do not matter.
Hdf5File open_file(const std::string& path) {
  check_is_a_file(path);
  check_is_no_view(path);
  silence_hdf5();
  if (H5Fis_hdf5(path.c_str()) == 0)
    throw FileError(fmt::format("cannot read {}: expected a mesh file NAME.h5 that trime_mpi has written, found a file "
                                "that is not HDF5",
                                path));
  const Hdf5Properties access(H5Pcreate(H5P_FILE_ACCESS), "make properties of HDF5");
  checked(H5Pset_file_locking(access, true, true), "set the locks of HDF5");
  return Hdf5File(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), "open " + path);
}

std::vector<hsize_t> shape_of(hid_t space) {
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

/// HDF5 itself has an end at 64 KiB.
constexpr std::size_t most_attribute_bytes = std::size_t{1} << 16;

std::string without_padding(const std::string& text) {
  return text.substr(0, text.find('\0'));
}

/// Values of a type that metadata have, read by `fetch`(memory type, to); nothing for other types.
template <class Fetch>
std::optional<Column> small_values(const std::string& name, hid_t type, std::size_t count, const Fetch& fetch) {
  const auto numbers = [&]<class T>(hid_t memory, T) -> Column {
    std::vector<T> values(count);
    fetch(memory, values.data());
    return {name, std::move(values)};
  };
  const std::size_t bytes = H5Tget_size(type);
  switch (H5Tget_class(type)) {
  case H5T_INTEGER:
    return bytes == sizeof(std::int32_t) ? numbers(H5T_NATIVE_INT32, std::int32_t{})
                                         : numbers(H5T_NATIVE_INT64, std::int64_t{});
  case H5T_FLOAT:
    return numbers(H5T_NATIVE_DOUBLE, double{});
  case H5T_STRING: {
    if (H5Tis_variable_str(type) > 0)
      return {};
    std::string all(count * bytes, '\0');
    fetch(type, all.data());
    std::vector<std::string> words;
    for (std::size_t k = 0; k < count; ++k)
      words.push_back(without_padding(all.substr(k * bytes, bytes)));
    return Column{name, std::move(words)};
  }
  default:
    return {};
  }
}

/// For H5Literate and H5Aiterate2. No exception may pass through HDF5.
template <class Info>
herr_t keep_name(hid_t, const char* name, const Info*, void* names) {
  try {
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
    return 0;
  } catch (const std::bad_alloc&) {
    return -1;
  }
}

/// In one pass: HDF5 makes a sorted list of all attributes for each that is opened by its number. HDF5 1.10 closes
/// attributes of that list which it never opened if one in the middle cannot be decoded. Asked for a name that none has
/// it decodes all of an object header, where ours are, and fails as it should.
std::vector<std::string> attribute_names(hid_t object, const std::string& action) {
  checked(H5Aexists(object, "?"), action);
  std::vector<std::string> names;
  checked(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, keep_name<H5A_info_t>, &names), action);
  return names;
}

} // namespace

Hdf5Input::Hdf5Input(const std::string& path) : path_(path), file_(open_file(path)) {}

bool Hdf5Input::has(const std::string& object) const {
  for (std::size_t end = object.find('/', 1);; end = object.find('/', end + 1)) {
    if (H5Lexists(file_, object.substr(0, end).c_str(), H5P_DEFAULT) <= 0)
      return false;
    if (end == std::string::npos)
      return true;
  }
}

std::vector<Attribute> Hdf5Input::attributes(const std::string& group) const {
  const std::string action = "read the attributes of " + group + " in " + path_;
  const Hdf5Group opened(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), action);
  std::vector<Attribute> found;
  for (const std::string& name : attribute_names(opened, action)) {
    const Hdf5Attribute attribute(H5Aopen(opened, name.c_str(), H5P_DEFAULT), action);
    const Hdf5Type type(H5Aget_type(attribute), action);
    const Hdf5Space space(H5Aget_space(attribute), action);
    if (H5Sget_simple_extent_npoints(space) != 1)
      continue;
    if (const std::size_t bytes = H5Tget_size(type); bytes > most_attribute_bytes)
      throw FileError(fmt::format("the attribute {} of {} in {} claims to have {} bytes, expected {} at most: the file "
                                  "is damaged",
                                  name, group, path_, bytes, most_attribute_bytes));
    const auto values =
        small_values(name, type, 1, [&](hid_t memory, void* to) { checked(H5Aread(attribute, memory, to), action); });
    if (!values)
      continue;
    const bool is_unsigned = H5Tget_class(type) == H5T_INTEGER && H5Tget_sign(type) == H5T_SGN_NONE;
    std::visit(
        [&]<class T>(const std::vector<T>& value) {
          if constexpr (std::is_integral_v<T>) {
            if (is_unsigned) {
              std::uint64_t number = 0;
              checked(H5Aread(attribute, H5T_NATIVE_UINT64, &number), action);
              found.push_back({name, number});
            } else
              found.push_back({name, static_cast<std::int64_t>(value[0])});
          } else
            found.push_back({name, value[0]});
        },
        values->values);
  }
  return found;
}

std::vector<Column> Hdf5Input::columns(const std::string& group) const {
  std::vector<Column> found;
  const Hdf5Group opened = open_group(group);
  for (const std::string& name : members(opened, group, H5O_TYPE_DATASET)) {
    const std::string path = group + "/" + name;
    const Hdf5Dataset dataset(H5Dopen2(opened, name.c_str(), H5P_DEFAULT), "open " + path + " in " + path_);
    const Hdf5Type type(H5Dget_type(dataset), "read " + path);
    const Hdf5Space space(H5Dget_space(dataset), "read " + path);
    if (H5Sget_simple_extent_ndims(space) != 1)
      continue;
    check_claim(dataset, type, space, path);
    auto values = small_values(
        name, type, static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)), [&](hid_t memory, void* to) {
          checked(H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, to), "read " + path + " in " + path_);
        });
    if (values)
      found.push_back(std::move(*values));
  }
  return found;
}

std::vector<Text> Hdf5Input::texts(const std::string& group) const {
  std::vector<Text> found;
  const Hdf5Group opened = open_group(group);
  for (const std::string& name : members(opened, group, H5O_TYPE_DATASET)) {
    const std::string path = group + "/" + name;
    const Hdf5Dataset dataset(H5Dopen2(opened, name.c_str(), H5P_DEFAULT), "open " + path + " in " + path_);
    const Hdf5Type type(H5Dget_type(dataset), "read " + path);
    const Hdf5Space space(H5Dget_space(dataset), "read " + path);
    if (H5Sget_simple_extent_ndims(space) != 0 || H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
      continue;
    check_claim(dataset, type, space, path);
    std::string text(H5Tget_size(type), '\0');
    checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), "read " + path + " in " + path_);
    found.push_back({name, without_padding(text)});
  }
  return found;
}

std::vector<std::string> Hdf5Input::groups(const std::string& group) const {
  return members(open_group(group), group, H5O_TYPE_GROUP);
}

std::int64_t Hdf5Input::rows(const std::string& dataset) const {
  const Hdf5Dataset opened = open_dataset(dataset);
  const Hdf5Type type(H5Dget_type(opened), "read " + dataset);
  const Hdf5Space space(H5Dget_space(opened), "read " + dataset);
  check_claim(opened, type, space, dataset);
  const std::vector<hsize_t> shape = shape_of(space);
  if (std::find(shape.begin(), shape.end(), 0) != shape.end()) // rows without columns do not count
    return 0;
  return shape.empty() ? 1 : static_cast<std::int64_t>(shape[0]);
}

void Hdf5Input::read(const std::string& dataset, hid_t type, hsize_t columns, std::int64_t first, std::int64_t count,
                     void* out) const {
  const Hdf5Dataset opened = open_dataset(dataset);
  const Hdf5Space space(H5Dget_space(opened), "read " + dataset);
  const std::vector<hsize_t> shape = shape_of(space);
  const auto begin = static_cast<hsize_t>(first), rows = static_cast<hsize_t>(count);
  if (shape.size() != (columns == 0 ? 1U : 2U) || (columns > 0 && shape[1] != columns) || shape[0] < begin + rows)
    throw FileError(fmt::format("{}: {} has another shape than a mesh file of trime_mpi: expected at least {} rows of "
                                "{}, found [{}]",
                                path_, dataset, begin + rows, columns == 0 ? 1 : columns, fmt::join(shape, ", ")));
  if (count == 0)
    return;
  const hsize_t start[2] = {begin, 0}, block[2] = {rows, columns};
  const Hdf5Space memory(H5Screate_simple(columns == 0 ? 1 : 2, block, nullptr), "read " + dataset);
  checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, block, nullptr), "read " + dataset);
  checked(H5Dread(opened, type, memory, space, H5P_DEFAULT, out), "read " + dataset + " in " + path_);
}

Hdf5Dataset Hdf5Input::open_dataset(const std::string& dataset) const {
  if (!has(dataset))
    throw FileError(fmt::format("{} has no {}: expected a mesh file of trime_mpi", path_, dataset));
  return Hdf5Dataset(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), "open " + dataset + " in " + path_);
}

Hdf5Group Hdf5Input::open_group(const std::string& group) const {
  return Hdf5Group(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), "list " + group + " in " + path_);
}

void Hdf5Input::check_claim(hid_t dataset, hid_t type, hid_t space, const std::string& name) const {
  constexpr double most_packed = 1032; // bytes that deflate makes one of, at most
  const std::string action = "read " + name + " in " + path_;
  auto bytes = static_cast<double>(H5Tget_size(type));
  for (const hsize_t extent : shape_of(space)) // HDF5's own product may overflow
    bytes *= static_cast<double>(extent);
  hsize_t of_file = 0;
  checked(H5Fget_filesize(file_, &of_file), action);
  // HDF5 believes the size that a contiguous array claims, however short the file is.
  const auto stored = static_cast<double>(std::min(H5Dget_storage_size(dataset), of_file));
  if (bytes > most_packed * stored)
    throw FileError(
        fmt::format("{} in {} claims to have {:.3g} bytes, and the file holds {:.3g} of them: it is damaged "
                    "or cut off",
                    name, path_, bytes, stored));
}

std::vector<std::string> Hdf5Input::members(hid_t group, const std::string& name, H5O_type_t kind) const {
  const std::string action = "list " + name + " in " + path_;
  std::vector<std::string> names;
  checked(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, keep_name<H5L_info_t>, &names), action);
  std::erase_if(names, [&](const std::string& member) {
    H5O_info_t object;
    checked(H5Oget_info_by_name2(group, member.c_str(), &object, H5O_INFO_BASIC, H5P_DEFAULT), action);
    return object.type != kind;
  });
  return names;
}

} // namespace trime::io
