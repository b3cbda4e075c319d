// SPDX-License-Identifier: BSD-3-Clause
#include "io/slab_file.hpp"

#include "io/temporary_file.hpp"
#include "trime/comm/agree.hpp"
#include "trime/comm/native.hpp"

#include <algorithm>
#include <cstring>

namespace trime::io {
namespace {

/// Rows of one collective write: a few MB, far below the 2^31 bytes of an MPI count.
constexpr std::int64_t slice_rows = std::int64_t{1} << 18;

/// Objects without times of their own, so that equal meshes make equal objects.
Hdf5Properties dataset_properties() {
  Hdf5Properties properties(H5Pcreate(H5P_DATASET_CREATE), "make HDF5 properties");
  checked(H5Pset_obj_track_times(properties, false), "set HDF5 properties");
  checked(H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER), "set HDF5 properties");
  checked(H5Pset_alloc_time(properties, H5D_ALLOC_TIME_EARLY), "set HDF5 properties");
  return properties;
}

Hdf5Properties file_access(const comm::Communicator& comm) {
  constexpr hsize_t large = hsize_t{16} << 20, alignment = hsize_t{1} << 20;
  Hdf5Properties properties(H5Pcreate(H5P_FILE_ACCESS), "make HDF5 properties");
  checked(H5Pset_alignment(properties, large, alignment), "set HDF5 properties"); // stripes of parallel file systems
  if (comm.size() > 1) {
    checked(H5Pset_fapl_mpio(properties, comm::native_handle(comm), MPI_INFO_NULL), "set HDF5 properties");
    // Reading metadata collectively is broken in HDF5 1.10.5 to 1.10.8; writing it so is right.
    checked(H5Pset_coll_metadata_write(properties, true), "set HDF5 properties");
  }
  return properties;
}

Hdf5Properties transfer(const comm::Communicator& comm, bool collective) {
  Hdf5Properties properties(H5Pcreate(H5P_DATASET_XFER), "make HDF5 properties");
  if (comm.size() > 1)
    checked(H5Pset_dxpl_mpio(properties, collective ? H5FD_MPIO_COLLECTIVE : H5FD_MPIO_INDEPENDENT),
            "set HDF5 properties");
  return properties;
}

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

Hdf5Space array_space(hsize_t rows, hsize_t columns) {
  const hsize_t extent[2] = {rows, columns};
  return Hdf5Space(H5Screate_simple(columns == 0 ? 1 : 2, extent, nullptr), "make an HDF5 space");
}

/// Selects rows [first, first + count) of a space, or nothing.
void select_rows(hid_t space, hsize_t first, hsize_t count, hsize_t columns) {
  const hsize_t start[2] = {first, 0}, extent[2] = {count, columns};
  checked(count == 0 ? H5Sselect_none(space)
                     : H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, extent, nullptr),
          "select rows of an HDF5 array");
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

void write_attribute(hid_t file, const std::string& object, const std::string& name, hid_t type, hid_t space,
                     const void* data) {
  const Hdf5Attribute attribute(
      H5Acreate_by_name(file, object.c_str(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      "make the attribute " + name);
  checked(H5Awrite(attribute, type, data), "write the attribute " + name);
}

} // namespace

SlabFile::SlabFile(const comm::Communicator& comm, std::string path) : comm_(comm), path_(std::move(path)) {
  comm::run_agreed(comm_, [&] {
    silence_hdf5();
    const Hdf5Properties access = file_access(comm_);
    Hdf5Properties creation(H5Pcreate(H5P_FILE_CREATE), "make HDF5 properties");
    checked(H5Pset_obj_track_times(creation, false), "set HDF5 properties");
    file_ = Hdf5File(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, creation, access), "create " + path_);
  });
}

std::string SlabFile::action(const std::string& verb, const std::string& what) const {
  return fmt::format("{} {} in {}", verb, what, path_);
}

void SlabFile::reserve(std::int64_t bytes) {
  comm::run_agreed(comm_, [&] {
    if (comm_.is_root())
      reserve_space(path_, bytes);
  });
}

void SlabFile::group(const std::string& path) {
  comm::run_agreed(comm_, [&] {
    Hdf5Properties creation(H5Pcreate(H5P_GROUP_CREATE), "make HDF5 properties");
    checked(H5Pset_obj_track_times(creation, false), "set HDF5 properties");
    Hdf5Group made(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), action("make", path));
  });
}

void SlabFile::hard_link(const std::string& existing, const std::string& path) {
  comm::run_agreed(comm_, [&] {
    checked(H5Lcreate_hard(file_, existing.c_str(), file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT),
            action("link", path));
  });
}

void SlabFile::attribute(const std::string& object, const Attribute& attribute) {
  comm::run_agreed(comm_, [&] {
    const Hdf5Space space = scalar_space();
    std::visit(
        [&](const auto& value) {
          using T = std::decay_t<decltype(value)>;
          if constexpr (std::is_same_v<T, std::string>) {
            const Hdf5Type type = text_type(value.size(), H5T_CSET_UTF8);
            write_attribute(file_, object, attribute.name, type, space, value.c_str());
          } else {
            write_attribute(file_, object, attribute.name, native_type<T>(), space, &value);
          }
        },
        attribute.value);
  });
}

void SlabFile::attribute(const std::string& object, const std::string& name, std::span<const std::int64_t> values) {
  comm::run_agreed(comm_, [&] {
    const Hdf5Space space = array_space(values.size(), 0);
    write_attribute(file_, object, name, H5T_NATIVE_INT64, space, values.data());
  });
}

void SlabFile::ascii_attribute(const std::string& object, const std::string& name, const std::string& text) {
  comm::run_agreed(comm_, [&] {
    const Hdf5Type type = text_type(text.size(), H5T_CSET_ASCII);
    const Hdf5Space space = scalar_space();
    write_attribute(file_, object, name, type, space, text.c_str());
  });
}

/// Rank 0 writes the data alone: they are few, and no other rank needs to hold them.
void SlabFile::small_dataset(const std::string& path, hid_t type, hid_t space, const void* data) {
  comm::run_agreed(comm_, [&] {
    const Hdf5Properties creation = dataset_properties();
    const Hdf5Dataset dataset(H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                              action("make", path));
    if (comm_.is_root() && H5Sget_simple_extent_npoints(space) > 0) {
      const Hdf5Properties alone = transfer(comm_, false);
      checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, alone, data), action("write", path));
    }
  });
}

void SlabFile::column(const std::string& group, const Column& column) {
  const std::string path = group + "/" + column.name;
  std::visit(
      [&](const auto& values) {
        using T = typename std::decay_t<decltype(values)>::value_type;
        const Hdf5Space space = array_space(values.size(), 0);
        if constexpr (std::is_same_v<T, std::string>) {
          std::size_t longest = 1;
          for (const std::string& value : values)
            longest = std::max(longest, value.size());
          std::string packed;
          for (const std::string& value : values)
            packed += value + std::string(longest - value.size(), '\0');
          const Hdf5Type type = text_type(longest, H5T_CSET_UTF8);
          small_dataset(path, type, space, packed.data());
        } else {
          small_dataset(path, native_type<T>(), space, values.data());
        }
      },
      column.values);
}

void SlabFile::text(const std::string& path, const std::string& text) {
  const Hdf5Type type = text_type(text.size(), H5T_CSET_UTF8);
  const Hdf5Space space = scalar_space();
  small_dataset(path, type, space, text.c_str());
}

void SlabFile::slab(SlabArray array) {
  TRIME_ASSERT(array.slab.first >= 0 && array.slab.first + array.rows <= array.slab.total, "{}: rows {} to {} of {}",
               array.path, array.slab.first, array.slab.first + array.rows, array.slab.total);
  Hdf5Dataset dataset;
  comm::run_agreed(comm_, [&] {
    const Hdf5Properties creation = dataset_properties();
    const Hdf5Space space = array_space(static_cast<hsize_t>(array.slab.total), array.columns);
    dataset = Hdf5Dataset(H5Dcreate2(file_, array.path.c_str(), array.type, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                          action("make", array.path));
  });
  write_slices(dataset, array);
  arrays_.push_back(std::move(array));
}

void SlabFile::write_slices(hid_t dataset, const SlabArray& array) {
  const std::int64_t longest = comm_.max(array.rows);
  std::vector<std::byte> buffer(static_cast<std::size_t>(std::min(array.rows, slice_rows)) * array.row_bytes());
  for (std::int64_t first = 0; first < longest; first += slice_rows) {
    const std::int64_t count = std::clamp<std::int64_t>(array.rows - first, 0, slice_rows);
    comm::run_agreed(comm_, [&] { // every rank takes part in every slice, with nothing if it has no rows left
      if (count > 0)
        array.fill(first, count, buffer.data());
      const Hdf5Space in_file = array_space(static_cast<hsize_t>(array.slab.total), array.columns);
      select_rows(in_file, static_cast<hsize_t>(array.slab.first + first), static_cast<hsize_t>(count), array.columns);
      const Hdf5Space in_memory = array_space(static_cast<hsize_t>(std::max<std::int64_t>(count, 1)), array.columns);
      select_rows(in_memory, 0, static_cast<hsize_t>(count), array.columns);
      const Hdf5Properties together = transfer(comm_, true);
      std::byte nothing{};
      checked(H5Dwrite(dataset, array.type, in_memory, in_file, together, count > 0 ? buffer.data() : &nothing),
              action("write", array.path));
    });
  }
}

void SlabFile::verify() {
  comm::run_agreed(comm_, [&] { checked(H5Fflush(file_, H5F_SCOPE_GLOBAL), "write " + path_ + " to disk"); });
  comm_.barrier();
  comm::run_agreed(comm_, [&] {
    for (const SlabArray& array : arrays_)
      verify_slices(array);
  });
}

/// Not collective on purpose: another path through MPI-IO than the one that wrote.
void SlabFile::verify_slices(const SlabArray& array) {
  if (array.rows == 0)
    return;
  const Hdf5Dataset dataset(H5Dopen2(file_, array.path.c_str(), H5P_DEFAULT), action("open", array.path));
  const Hdf5Properties alone = transfer(comm_, false);
  const std::size_t bytes = static_cast<std::size_t>(std::min(array.rows, slice_rows)) * array.row_bytes();
  std::vector<std::byte> held(bytes), read(bytes);
  for (std::int64_t first = 0; first < array.rows; first += slice_rows) {
    const std::int64_t count = std::min(array.rows - first, slice_rows);
    array.fill(first, count, held.data());
    const Hdf5Space in_file = array_space(static_cast<hsize_t>(array.slab.total), array.columns);
    select_rows(in_file, static_cast<hsize_t>(array.slab.first + first), static_cast<hsize_t>(count), array.columns);
    const Hdf5Space in_memory = array_space(static_cast<hsize_t>(count), array.columns);
    checked(H5Dread(dataset, array.type, in_memory, in_file, alone, read.data()), action("read back", array.path));
    if (std::memcmp(held.data(), read.data(), static_cast<std::size_t>(count) * array.row_bytes()) != 0)
      throw FileError(fmt::format("{}: rows {} to {} of {} were not written as they should be; the file system or the "
                                  "MPI-IO layer is at fault (try another directory, or OMPI_MCA_io=romio321)",
                                  path_, array.slab.first + first, array.slab.first + first + count, array.path));
  }
}

void SlabFile::close() {
  comm::run_agreed(comm_, [&] { file_.close("close " + path_); });
}

} // namespace trime::io
