// SPDX-License-Identifier: BSD-3-Clause
#include "io/slab_file.hpp"

#include "comm/agree.hpp"
#include "comm/native.hpp"
#include "comm/running_mpi.hpp"
#include "core/thread_loop.hpp"
#include "io/hdf5_values.hpp"
#include "io/lone_failure.hpp"
#include "io/temporary_file.hpp"

#include <algorithm>
#include <cstring>
#include <functional>

namespace trime::io {
namespace {

/// Rows of one write, 2 MB at most, which stay in the caches; and of what one thread fills.
/// All slices of an array lie alike in the pages of the file.
constexpr std::int64_t slice_rows = std::int64_t{1} << 16, piece_rows = std::int64_t{1} << 12;
static_assert(slice_rows % 4096 == 0);
constexpr std::int64_t slices_of_a_request = 4; // the disk begins early

std::int64_t pieces_of(std::int64_t rows) {
  return (rows + piece_rows - 1) / piece_rows;
}

/// Rows [first, first + count) of an array, by all threads, while the calling one does `work`.
template <class Work>
void fill_beside(const Work& work, const SlabArray& array, std::int64_t first, std::int64_t count, std::byte* out) {
  thread_loop_beside(work, pieces_of(count), [&](std::ptrdiff_t piece, int) {
    const std::int64_t begin = piece * piece_rows, rows = std::min(piece_rows, count - begin);
    array.fill(first + begin, rows, out + static_cast<std::size_t>(begin) * array.row_bytes());
  });
}

/// @param alone by the plain driver
Hdf5Properties file_access(const comm::Communicator& comm, bool alone) {
  constexpr hsize_t large = hsize_t{16} << 20, alignment = hsize_t{1} << 20;
  Hdf5Properties properties(H5Pcreate(H5P_FILE_ACCESS), "make HDF5 properties");
  checked(H5Pset_alignment(properties, large, alignment), "set HDF5 properties"); // stripes of parallel file systems
  checked(H5Pset_sieve_buf_size(properties, 0), "set HDF5 properties"); // or rows would be read back from memory
  if (!alone) {
    checked(H5Pset_fapl_mpio(properties, comm::native_handle(comm), MPI_INFO_NULL), "set HDF5 properties");
    // Reading metadata collectively is broken in HDF5 1.10.5 to 1.10.8; writing it so is right. Calls that change the
    // file let rank 0 read and send what the others need, so the others read none (counted by strace).
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

/// Selects rows [first, first + count) of a space, or nothing.
void select_rows(hid_t space, hsize_t first, hsize_t count, hsize_t columns) {
  const hsize_t start[2] = {first, 0}, extent[2] = {count, columns};
  checked(count == 0 ? H5Sselect_none(space)
                     : H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, extent, nullptr),
          "select rows of an HDF5 array");
}

/// The rows of a slice in the file and in the buffer.
struct SliceSpaces {
  Hdf5Space in_file, in_memory;

  SliceSpaces() = default;
  /// @param most rows of a slice, at least 1
  SliceSpaces(const SlabArray& array, std::int64_t most)
      : in_file(array_space(static_cast<hsize_t>(array.slab.total), array.columns)),
        in_memory(array_space(static_cast<hsize_t>(most), array.columns)) {}

  /// Selects `count` rows of this rank from row `first` on.
  void select(const SlabArray& array, std::int64_t first, std::int64_t count) const {
    select_rows(in_file, static_cast<hsize_t>(array.slab.first + first), static_cast<hsize_t>(count), array.columns);
    select_rows(in_memory, 0, static_cast<hsize_t>(count), array.columns);
  }
};

} // namespace

/// Passed by reference, since a copy of the lambda might need memory before the ranks could agree that memory has run
/// out.
template <class Work>
void SlabFile::agreed(const Work& work) const {
  comm::run_agreed(comm_, std::cref(work));
}

/// Does the same for work that contains a collective call of HDF5: if it fails here, the other ranks may not return
/// from it.
template <class Work>
void SlabFile::agreed_after(const Work& collective) const {
  LoneFailure failure(path_); // ends when all ranks have come
  comm::run_agreed(comm_, [&] {
    try {
      collective();
    } catch (const Error& error) {
      if (comm_.size() > 1)
        failure.begin(error.what());
      throw;
    }
  });
}

void SlabFile::agree_on(hid_t code, const std::string& action) const {
  agreed_after([&] { checked(code, action); });
}

/// Rank 0 makes the file, reserves its room, and writes all that is small, before the others open it by MPI-IO. If all
/// ranks made it together, they would write its first bytes together, on a disk that may be full.
SlabFile::SlabFile(const comm::Communicator& comm, std::string path, std::int64_t bytes,
                   const std::function<void(const FileStart&)>& start)
    : comm_(comm), path_(std::move(path)), write_back_(path_) {
  const bool alone = comm_.size() == 1;
  if (!alone)
    comm::warn_of_wrong_writer(comm_.is_root());
  Hdf5Properties access;
  std::string opening;
  agreed([&] {
    silence_hdf5();
    access = file_access(comm_, alone);
    opening = "open " + path_;
    if (!comm_.is_root())
      return;
    const Hdf5Properties creation(H5Pcreate(H5P_FILE_CREATE), "make HDF5 properties");
    checked(H5Pset_obj_track_times(creation, false), "set HDF5 properties");
    const Hdf5Properties plain = file_access(comm_, true);
    Hdf5File made(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, creation, plain), "create " + path_);
    if (bytes > 0) // first, so that a message says how much room is missing
      reserve_space(path_, bytes);
    if (start)
      start(FileStart(made, path_));
    if (alone) {
      file_ = std::move(made);
      return;
    }
    checked(made.close(), "create " + path_);
    if (bytes > 0) // closing has given the room back
      reserve_space(path_, bytes);
  });
  if (alone)
    return;
  file_ = Hdf5File(H5Fopen(path_.c_str(), H5F_ACC_RDWR, access));
  agree_on(file_, opening);
}

std::string SlabFile::action(const std::string& verb, const std::string& what) const {
  return fmt::format("{} {} in {}", verb, what, path_);
}

void SlabFile::group(const std::string& path) {
  Hdf5Properties creation;
  std::string making;
  agreed([&] {
    creation = group_properties();
    making = action("make", path);
  });
  const Hdf5Group made(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT));
  agree_on(made, making);
}

void SlabFile::hard_link(const std::string& existing, const std::string& path) {
  std::string linking;
  agreed([&] { linking = action("link", path); });
  agree_on(H5Lcreate_hard(file_, existing.c_str(), file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT), linking);
}

void SlabFile::attribute(const std::string& object, const Attribute& attribute) {
  SmallValues values;
  std::string making, writing;
  agreed([&] {
    values = attribute_value(attribute);
    making = action("make", "the attribute " + attribute.name);
    writing = action("write", "the attribute " + attribute.name);
  });
  const Hdf5Attribute made(H5Acreate_by_name(file_, object.c_str(), attribute.name.c_str(), values.type, values.space,
                                             H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  agree_on(made, making);
  agree_on(H5Awrite(made, values.type, values.bytes.data()), writing);
}

/// The group is opened before the attribute: HDF5 1.10.8 cannot write to what H5Aopen_by_name has opened.
void SlabFile::change_attribute(const std::string& group, const Attribute& attribute) {
  SmallValues values;
  std::string changing;
  agreed([&] {
    values = attribute_value(attribute);
    changing = action("change", "the attribute " + attribute.name);
  });
  const Hdf5Group opened(H5Gopen2(file_, group.c_str(), H5P_DEFAULT));
  agree_on(opened, changing);
  const Hdf5Attribute found(H5Aopen(opened, attribute.name.c_str(), H5P_DEFAULT));
  agree_on(found, changing);
  agree_on(H5Awrite(found, values.type, values.bytes.data()), changing);
}

void SlabFile::slab(SlabArray array) {
  TRIME_ASSERT(array.slab.first >= 0 && array.slab.first + array.rows <= array.slab.total, "{}: rows {} to {} of {}",
               array.path, array.slab.first, array.slab.first + array.rows, array.slab.total);
  Hdf5Properties creation;
  Hdf5Space space;
  std::string making;
  agreed([&] {
    creation = dataset_properties();
    space = array_space(static_cast<hsize_t>(array.slab.total), array.columns);
    making = action("make", array.path);
    written_.reserve(written_.size() + 1);
  });
  Hdf5Dataset dataset(H5Dcreate2(file_, array.path.c_str(), array.type, space, H5P_DEFAULT, creation, H5P_DEFAULT));
  agree_on(dataset, making);
  write_slices(dataset, array);
  written_.push_back({std::move(array), std::move(dataset)});
}

void SlabFile::more_rows(SlabArray array) {
  std::string opening;
  agreed([&] {
    opening = action("open", array.path);
    written_.reserve(written_.size() + 1);
  });
  Hdf5Dataset dataset(H5Dopen2(file_, array.path.c_str(), H5P_DEFAULT));
  agree_on(dataset, opening);
  write_slices(dataset, array);
  written_.push_back({std::move(array), std::move(dataset)});
}

/// For the longest slice of this rank. HDF5 wants a buffer for no rows, too.
void SlabFile::make_room(hid_t dataset, const SlabArray& array) {
  const haddr_t begin = H5Dget_offset(dataset);
  const std::uint64_t before = static_cast<std::uint64_t>(array.slab.first) * array.row_bytes();
  const std::int64_t rows = std::clamp<std::int64_t>(array.rows, 1, slice_rows);
  for (SliceBuffer* buffer : {&slice_, &other_slice_})
    buffer->resize(static_cast<std::size_t>(rows) * array.row_bytes(), begin == HADDR_UNDEF ? 0 : begin + before);
}

/// Where ranks have a slice each on average, every one writes its own at its own pace. Smaller pieces are left to
/// MPI-IO, which puts those of several ranks together.
bool SlabFile::is_written_alone(const SlabArray& array) const {
  return array.slab.total / comm_.size() >= slice_rows;
}

/// A slice is written while the other threads make the next. In collective writes every rank takes part in every slice,
/// with nothing if it has no rows left.
void SlabFile::write_slices(hid_t dataset, const SlabArray& array) {
  const bool alone = is_written_alone(array);
  const std::int64_t longest = alone ? array.rows : comm_.max(array.rows);
  const auto rows_from = [&](std::int64_t first) {
    return std::clamp<std::int64_t>(array.rows - first, 0, slice_rows);
  };
  SliceSpaces spaces;
  Hdf5Properties properties;
  std::string writing;
  agreed([&] {
    make_room(dataset, array);
    spaces = SliceSpaces(array, std::max<std::int64_t>(rows_from(0), 1));
    properties = transfer(comm_, !alone);
    writing = action("write", array.path);
    fill_beside([] {}, array, 0, rows_from(0), slice_.data());
  });
  const auto write_slice = [&](std::int64_t first) { // what throws in here comes after the call of HDF5
    herr_t written = -1;
    const auto write = [&] {
      written = H5Dwrite(dataset, array.type, spaces.in_memory, spaces.in_file, properties, slice_.data());
    };
    fill_beside(write, array, first + slice_rows, rows_from(first + slice_rows), other_slice_.data());
    checked(written, writing);
    swap(slice_, other_slice_);
    if (comm_.is_root() && first / slice_rows % slices_of_a_request == slices_of_a_request - 1)
      write_back_.request();
  };
  if (alone)
    agreed([&] {
      for (std::int64_t first = 0; first < longest; first += slice_rows) {
        spaces.select(array, first, rows_from(first));
        write_slice(first);
      }
    });
  else
    for (std::int64_t first = 0; first < longest; first += slice_rows) {
      agreed([&] { spaces.select(array, first, rows_from(first)); });
      agreed_after([&] { write_slice(first); });
    }
}

/// A rank can read what it has written alone at once, while the disk works, and what others have written for it after
/// the flush. Then it also reads the ends of the slabs once more: where ranks of two nodes share a page, a file system
/// that keeps copies of it on both could have lost the rows of one.
void SlabFile::verify() {
  if (comm_.is_root())
    write_back_.request();
  std::string flushing;
  agreed([&] {
    flushing = "write " + path_ + " to disk";
    for (const Written& written : written_)
      if (is_written_alone(written.array))
        verify_rows(written, 0, written.array.rows);
  });
  agree_on(H5Fflush(file_, H5F_SCOPE_GLOBAL), flushing);
  comm_.barrier();
  agreed([&] {
    for (const Written& written : written_) {
      const std::int64_t rows = written.array.rows;
      if (!is_written_alone(written.array)) {
        verify_rows(written, 0, rows);
      } else if (comm_.size() > 1) {
        verify_rows(written, 0, std::min(piece_rows, rows));
        verify_rows(written, std::max<std::int64_t>(0, rows - piece_rows), rows);
      }
    }
  });
  written_.clear();
}

/// Rows [begin, end) of this rank; no rank waits for others. A slice is read while the other threads compare the one
/// before.
void SlabFile::verify_rows(const Written& written, std::int64_t begin, std::int64_t end) {
  if (begin == end)
    return;
  const SlabArray& array = written.array;
  const Hdf5Properties alone = transfer(comm_, false);
  const Hdf5Space in_file = array_space(static_cast<hsize_t>(array.slab.total), array.columns);
  make_room(written.dataset, array);
  std::int64_t compared = begin;
  for (std::int64_t first = begin; first < end; first += slice_rows) {
    const std::int64_t count = std::min(end - first, slice_rows);
    select_rows(in_file, static_cast<hsize_t>(array.slab.first + first), static_cast<hsize_t>(count), array.columns);
    const Hdf5Space in_memory = array_space(static_cast<hsize_t>(count), array.columns);
    herr_t status = -1;
    const auto read_slice = [&] {
      status = H5Dread(written.dataset, array.type, in_memory, in_file, alone, slice_.data());
    };
    compare_beside(read_slice, array, compared, first - compared, other_slice_.data());
    checked(status, action("read back", array.path));
    swap(slice_, other_slice_);
    compared = first;
  }
  compare_beside([] {}, array, compared, end - compared, other_slice_.data());
}

/// Does the work of fill_beside for rows that were read. @throws FileError if a value differs from what was written
template <class Work>
void SlabFile::compare_beside(const Work& work, const SlabArray& array, std::int64_t first, std::int64_t count,
                              const std::byte* read) {
  expected_.resize(static_cast<std::size_t>(thread_count()));
  thread_loop_beside(work, pieces_of(count), [&](std::ptrdiff_t piece, int thread) {
    const std::int64_t begin = piece * piece_rows, rows = std::min(piece_rows, count - begin);
    const std::size_t bytes = static_cast<std::size_t>(rows) * array.row_bytes();
    UnsetVector<std::byte>& expected = expected_[static_cast<std::size_t>(thread)];
    expected.resize(bytes);
    array.fill(first + begin, rows, expected.data());
    if (std::memcmp(expected.data(), read + static_cast<std::size_t>(begin) * array.row_bytes(), bytes) != 0)
      throw FileError(fmt::format("{}: rows {} to {} of {} were not written correctly; the file system or the MPI-IO "
                                  "layer is at fault (try another directory, or OMPI_MCA_io=romio321)",
                                  path_, array.slab.first + first + begin, array.slab.first + first + begin + rows,
                                  array.path));
  });
}

void SlabFile::close() {
  written_.clear();
  std::string closing;
  agreed([&] { closing = "close " + path_; });
  agree_on(file_.close(), closing);
}

} // namespace trime::io
