// SPDX-License-Identifier: BSD-3-Clause
// An HDF5 file that all ranks write together. Each rank writes a contiguous range of rows (slab) of each large array,
// in slices. Before, rank 0 alone writes what is small. After each step the ranks agree on errors, so that all of them
// throw together and no rank is left waiting.
#pragma once

#include "io/file_start.hpp"
#include "io/hdf5_handle.hpp"
#include "io/slice_buffer.hpp"
#include "io/write_back.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/types.hpp"
#include "trime/io/metadata.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace trime::io {

/// An array of `slab.total` rows over all ranks. Rows are made on demand, slice by slice, so no second copy of an array
/// is needed. Several threads make a slice while another slice is written or read.
struct SlabArray {
  std::string path;
  hid_t type = -1;             ///< native type of one value, in memory and in the file
  std::size_t value_bytes = 0; ///< size of one value
  hsize_t columns = 0;         ///< number of columns; 0 for a one-dimensional array
  mesh::Slab slab;
  std::int64_t rows = 0; ///< number of rows on this rank
  /// Writes rows [first, first + count) of this rank to `out`; must write the same bytes at each call.
  std::function<void(std::int64_t first, std::int64_t count, std::byte* out)> fill;

  std::size_t row_bytes() const { return value_bytes * (columns == 0 ? 1 : static_cast<std::size_t>(columns)); }
};

/// All member functions are collective and throw FileError on all ranks together. Error messages name the file by
/// `path`.
class SlabFile {
public:
  /// @brief Creates or empties the file. On one rank it uses the POSIX driver of HDF5, on several ranks MPI-IO.
  /// @param bytes the final size of the file, which is reserved on the file system before anything is written, if
  /// possible. Otherwise the disk might become full during a collective write: Open MPI reports that to some of the
  /// ranks only, and the other ranks wait without end
  /// @param start what rank 0 puts into the file before the other ranks open it; may be empty
  SlabFile(const comm::Communicator& comm, std::string path, std::int64_t bytes = 0,
           const std::function<void(const FileStart&)>& start = {});

  void group(const std::string& path);
  void hard_link(const std::string& existing, const std::string& path);
  /// Writes an attribute of `object`, which is the path of a group or dataset. A text longer than longest_attribute is
  /// shortened.
  void attribute(const std::string& object, const Attribute& attribute);
  /// Gives another value of the same type and size to an attribute that the group has.
  void change_attribute(const std::string& group, const Attribute& attribute);
  /// Writes an array. Keeps the dataset open, and a copy of the array's description, for verify().
  void slab(SlabArray array);
  /// Writes more rows of an array that slab() has made, with the same number of rows over all ranks.
  void more_rows(SlabArray array);
  /// Flushes the file, reads every slab back, and compares each byte with the data of its rank. Must be called once,
  /// after all slabs.
  void verify();
  void close();

private:
  // A collective call of HDF5 has three steps, so that no rank leaves while others wait in the call. First the ranks
  // prepare everything that may throw, and agree on errors. Then all ranks make the call. Then they agree on its
  // result.
  template <class Work>
  void agreed(const Work& work) const;
  template <class Work>
  void agreed_after(const Work& collective) const;
  void agree_on(hid_t code, const std::string& action) const;

  void make_room(hid_t dataset, const SlabArray& array);
  struct Written {
    SlabArray array;
    Hdf5Dataset dataset;
  };
  bool is_written_alone(const SlabArray& array) const;
  void write_slices(hid_t dataset, const SlabArray& array);
  void verify_rows(const Written& written, std::int64_t begin, std::int64_t end);
  template <class Work>
  void compare_beside(const Work& work, const SlabArray& array, std::int64_t first, std::int64_t count,
                      const std::byte* read);
  std::string action(const std::string& verb, const std::string& what) const;

  const comm::Communicator& comm_;
  std::string path_;
  WriteBack write_back_; // its destructor must run after the file is closed
  Hdf5File file_;
  std::vector<Written> written_;
  SliceBuffer slice_, other_slice_;              // the slice that is written or was read, and the next slice
  std::vector<UnsetVector<std::byte>> expected_; // for each thread, the bytes that should have been read
};

} // namespace trime::io
