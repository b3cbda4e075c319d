// SPDX-License-Identifier: BSD-3-Clause
// Slabs of many ranks in one file: where their rows lie, and what becomes of errors of a single rank.
#include "io/slab_file.hpp"

#include "support/hdf5_reading.hpp"
#include "support/mesh_slabs.hpp"
#include "support/temporary_directory.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <string>

namespace trime::io {
namespace {

using test::expect_values;
using test::read;

/// Of one byte, other ones in each slice and each piece of it.
std::uint8_t row_value(std::int64_t row) {
  return static_cast<std::uint8_t>(row ^ (row >> 8) ^ (row >> 12) ^ (row >> 16));
}
SlabArray counting(const std::string& path, const mesh::Slab& slab, std::int64_t rows) {
  SlabArray array;
  array.path = path;
  array.type = H5T_NATIVE_UINT8;
  array.value_bytes = 1;
  array.slab = slab;
  array.rows = rows;
  array.fill = [first_here = slab.first](std::int64_t first, std::int64_t count, std::byte* out) {
    for (std::int64_t k = 0; k < count; ++k)
      out[k] = static_cast<std::byte>(row_value(first_here + first + k));
  };
  return array;
}

/// Several slices, so that one can fail after another was written.
constexpr std::int64_t many_rows = 700000, few_rows = 60000;

/// So many rows on every rank: each writes its own.
SlabArray counting_on_all(const comm::Communicator& comm, const std::string& path) {
  return counting(path, {many_rows * comm.rank(), many_rows * comm.size()}, many_rows);
}

/// All of few rows on the last rank: written together.
SlabArray counting_on_last(const comm::Communicator& comm, const std::string& path) {
  const std::int64_t total = few_rows * comm.size();
  const bool is_last = comm.rank() == comm.size() - 1;
  return counting(path, {is_last ? 0 : total, total}, is_last ? total : 0);
}

TEST(SlabFile, RowsLieWhereTheyShould) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  {
    SlabFile file(comm, directory.path() + "/a.h5");
    file.slab(counting_on_all(comm, "/all"));
    file.slab(counting_on_last(comm, "/last"));
    std::int64_t rows = 0;
    const mesh::Slab uneven = test::share(comm, many_rows * comm.size(), 5, rows);
    file.slab(counting("/uneven", uneven, rows));
    file.verify();
    file.close();
  }
  comm.barrier();
  const Hdf5File file(H5Fopen((directory.path() + "/a.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open");
  for (const auto& [path, total] :
       {std::pair{"/all", many_rows}, std::pair{"/last", few_rows}, std::pair{"/uneven", many_rows}})
    expect_values(read<std::uint8_t>(file, path, H5T_NATIVE_UINT8, {static_cast<hsize_t>(total * comm.size())}),
                  total * comm.size(), row_value);
  comm.barrier();
}

TEST(SlabFile, ARankThatCannotMakeItsRowsStopsAllRanks) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  SlabFile file(comm, directory.path() + "/a.h5");
  for (const auto& make : {counting_on_all, counting_on_last})
    for (const std::int64_t failing_third : {0, 1, 2}) {
      const std::string path = (make == counting_on_all ? "/all" : "/last") + std::to_string(failing_third);
      SlabArray array = make(comm, path);
      if (comm.rank() == comm.size() - 1)
        array.fill = [failing_row = failing_third * array.rows / 3](std::int64_t first, std::int64_t count,
                                                                    std::byte*) {
          if (first + count > failing_row)
            throw std::bad_alloc();
        };
      try {
        file.slab(std::move(array));
        ADD_FAILURE() << "no error";
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::out_of_memory) << error.what();
      }
    }
  file.slab(counting_on_all(comm, "/all")); // the file itself is as good as before
  file.slab(counting_on_last(comm, "/last"));
  file.verify();
  file.close();
}

TEST(SlabFile, RowsThatAreReadBackOtherwiseAreToldByAllRanks) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  for (const auto& make : {counting_on_all, counting_on_last}) {
    SlabFile file(comm, directory.path() + "/a.h5");
    SlabArray array = make(comm, "/a");
    bool written = false;
    if (comm.rank() == comm.size() - 1)
      array.fill = [right = array.fill, &written, wrong_row = array.rows / 2](std::int64_t first, std::int64_t count,
                                                                              std::byte* out) {
        right(first, count, out);
        if (written && first <= wrong_row && wrong_row < first + count)
          out[wrong_row - first] ^= std::byte{1};
      };
    file.slab(std::move(array));
    written = true;
    EXPECT_THROW(file.verify(), FileError);
  }
}

/// Rows at the ends of slabs that are lost after they have been read back, to a rank that shares their page.
TEST(SlabFile, TheEndsOfSlabsAreReadOnceMore) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  for (const std::int64_t wrong_row : {std::int64_t{0}, many_rows - 1, many_rows / 2}) {
    SlabFile file(comm, directory.path() + "/a.h5");
    SlabArray array = counting_on_all(comm, "/a");
    std::atomic<int> visits = 0; // to be written, to be compared, to be compared again
    if (comm.rank() == comm.size() - 1)
      array.fill = [right = array.fill, &visits, wrong_row](std::int64_t first, std::int64_t count, std::byte* out) {
        right(first, count, out);
        if (first <= wrong_row && wrong_row < first + count && ++visits > 2)
          out[wrong_row - first] ^= std::byte{1};
      };
    file.slab(std::move(array));
    if (comm.size() > 1 && wrong_row != many_rows / 2)
      EXPECT_THROW(file.verify(), FileError) << wrong_row;
    else
      EXPECT_NO_THROW(file.verify()) << wrong_row;
  }
}

TEST(SlabFile, AFailureAtTheStartStopsAllRanks) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  const auto start = [](const FileStart&) { throw FileError("rank 0 cannot begin"); };
  EXPECT_THROW(SlabFile(comm, directory.path() + "/a.h5", 0, start), FileError);
}

TEST(SlabFile, VirtualArraysShowOthersInAnotherShape) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  const std::int64_t total = many_rows * comm.size();
  const auto rows = static_cast<hsize_t>(total);
  {
    SlabFile file(comm, directory.path() + "/a.h5", 0, [rows](const FileStart& start) {
      start.show({"/one_row", H5T_NATIVE_UINT8, {2 * rows, 0}, "/pairs", {rows, 2}});
      start.show({"/wide", H5T_NATIVE_DOUBLE, {rows, 3}, "/pairs", {rows, 2}});
    });
    SlabArray pairs = counting("/pairs", {many_rows * comm.rank(), total}, many_rows);
    pairs.columns = 2;
    pairs.fill = [first_here = pairs.slab.first](std::int64_t first, std::int64_t count, std::byte* out) {
      for (std::int64_t k = 0; k < 2 * count; ++k)
        out[k] = static_cast<std::byte>(row_value(2 * (first_here + first) + k));
    };
    file.slab(std::move(pairs));
    file.verify();
    file.close();
  }
  comm.barrier();
  const Hdf5File file(H5Fopen((directory.path() + "/a.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open");
  expect_values(read<std::uint8_t>(file, "/one_row", H5T_NATIVE_UINT8, {2 * rows}, H5D_VIRTUAL), 2 * total, row_value);
  expect_values(read<double>(file, "/wide", H5T_NATIVE_DOUBLE, {rows, 3}, H5D_VIRTUAL), 3 * total,
                [](std::int64_t i) { return i % 3 == 2 ? 0 : row_value(2 * (i / 3) + i % 3); });
  for (const char* shown : {"/one_row", "/wide"})
    EXPECT_EQ(test::stored_bytes(file, shown), 0) << shown;
  comm.barrier();
}

TEST(SlabFile, NamesThatAreTakenAreRefusedOnAllRanks) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  const auto start = [](const FileStart& begun) {
    begun.group("/g");
    begun.attribute("/g", {"a", std::int64_t{1}});
    begun.text("/g/t", "text");
    EXPECT_THROW(begun.group("/g"), FileError);
    EXPECT_THROW(begun.attribute("/g", {"a", std::int64_t{1}}), FileError);
    EXPECT_THROW(begun.text("/g/t", "text"), FileError);
    EXPECT_THROW(begun.column("/g", {"t", std::vector<double>{1}}), FileError);
    EXPECT_THROW(begun.show({"/g/t", H5T_NATIVE_INT32, {3, 0}, "/s", {3, 0}}), FileError);
  };
  SlabFile file(comm, directory.path() + "/a.h5", 0, start);
  EXPECT_THROW(file.group("/g"), FileError);
  EXPECT_THROW(file.attribute("/g", {"a", std::int64_t{1}}), FileError);
  EXPECT_THROW(file.slab(counting("/g/t", {comm.rank(), comm.size()}, 1)), FileError);
  EXPECT_THROW(file.hard_link("/nothing", "/h"), FileError);
  file.verify();
  file.close();
}

} // namespace
} // namespace trime::io
