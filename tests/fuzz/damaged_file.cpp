// SPDX-License-Identifier: BSD-3-Clause
#include "damaged_file.hpp"

#include "app/program.hpp"
#include "app/signal_requests.hpp"
#include "app/user_places.hpp"
#include "core/read_file.hpp"
#include "io/hdf5_handle.hpp"
#include "meshing/checkpoints.hpp"
#include "trime/io/mesh_file.hpp"

#include <fuzzer/FuzzedDataProvider.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>

namespace trime::fuzz {
namespace {

using namespace trime::io;

constexpr const char* config = "[shape]\ngeometry = difference(plate, hole)\n"
                               "[shape.plate]\ntype = rectangle\nx_min = 0.1\nx_max = 0.9\ny_min = 0.1\ny_max = 0.9\n"
                               "[shape.hole]\ntype = circle\ncenter = 0.5 0.5\nradius = 0.2\n"
                               "[meshing]\npoints = 60\n[parallel]\nsetup_threads = 1\nmesh_threads = 1\n"
                               "[checkpoint]\ninterval = 1000\n[log]\nlevel = silent\n";

void write_file(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Runs the program in this process, in a directory of its own.
void run(const std::string& directory, const comm::Communicator& comm, bool stops) {
  const std::string path = directory + "/case.ini", place = "output.directory=" + directory;
  write_file(path, config);
  const std::array<const char*, 3> arguments{"trime_mpi", path.c_str(), place.c_str()};
  app::SignalRequests signals;
  if (stops)
    signals.ask_to_stop();
  app::UserPlaces places;
  try {
    app::run_program(static_cast<int>(arguments.size()), arguments.data(), comm, {nullptr, signals, places});
  } catch (const meshing::StoppedAtCheckpoint&) {
    TRIME_ASSERT(stops, "stopped without being asked");
  }
}

/// A type by number: those of the program's files, and others.
Hdf5Type some_type(FuzzedDataProvider& input) {
  const std::array<hid_t, 9> plain{H5T_NATIVE_INT32,   H5T_NATIVE_INT64, H5T_NATIVE_UINT64,
                                   H5T_NATIVE_DOUBLE,  H5T_NATIVE_FLOAT, H5T_NATIVE_UINT8,
                                   H5T_NATIVE_LDOUBLE, H5T_NATIVE_SHORT, H5T_STD_REF_OBJ};
  const auto choice = input.ConsumeIntegralInRange<std::size_t>(0, plain.size() + 1);
  if (choice < plain.size())
    return Hdf5Type(H5Tcopy(plain[choice]));
  Hdf5Type text(H5Tcopy(H5T_C_S1));
  constexpr std::array<std::size_t, 5> lengths{1, 7, 300, 1 << 20, std::size_t{3} << 30};
  H5Tset_size(text, choice == plain.size() ? H5T_VARIABLE : input.PickValueInArray(lengths));
  return text;
}

/// A scalar, or up to three dimensions, some of them huge.
Hdf5Space some_space(FuzzedDataProvider& input) {
  constexpr std::array<hsize_t, 10> extents{
      0, 1, 2, 3, 60, 97, 1000, hsize_t{1} << 31, hsize_t{1} << 40, hsize_t{1} << 61};
  const int rank = input.ConsumeIntegralInRange(0, 3);
  std::array<hsize_t, 3> extent{};
  for (int k = 0; k < rank; ++k)
    extent[static_cast<std::size_t>(k)] = input.PickValueInArray(extents);
  return Hdf5Space(rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(rank, extent.data(), nullptr));
}

/// Contiguous, or in packed chunks; space in the file only when something is written.
Hdf5Properties some_layout(FuzzedDataProvider& input, hid_t space) {
  Hdf5Properties layout(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_alloc_time(layout, H5D_ALLOC_TIME_LATE);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (const bool is_packed = input.ConsumeBool(); is_packed && rank > 0) {
    const std::array<hsize_t, 3> chunk{8, 8, 8};
    H5Pset_chunk(layout, rank, chunk.data());
    H5Pset_deflate(layout, 1);
  }
  return layout;
}

void replace_dataset(FuzzedDataProvider& input, hid_t file, const std::string& path) {
  H5Ldelete(file, path.c_str(), H5P_DEFAULT);
  const Hdf5Type type = some_type(input);
  const Hdf5Space space = some_space(input);
  const Hdf5Properties layout = some_layout(input, space);
  const Hdf5Dataset made(H5Dcreate2(file, path.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT));
}

/// One value of a dataset of numbers.
void overwrite_value(FuzzedDataProvider& input, hid_t file, const std::string& path) {
  const Hdf5Dataset dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT));
  if (dataset < 0)
    return;
  if (const Hdf5Properties layout(H5Dget_create_plist(dataset)); H5Pget_layout(layout) == H5D_CHUNKED)
    return; // HDF5 writes all chunks at once, petabytes of them if need be, and not always without a crash
  const Hdf5Space space(H5Dget_space(dataset)), one(H5Screate(H5S_SCALAR));
  std::array<hsize_t, 3> place{}, extent{};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 1 || rank > 3 || H5Sget_simple_extent_dims(space, extent.data(), nullptr) < 0)
    return;
  constexpr double most_values = 1 << 16; // a file with one value at its far end is longer than any that is read
  double values = 1;
  for (std::size_t k = 0; k < static_cast<std::size_t>(rank); ++k)
    values *= static_cast<double>(extent[k]);
  if (values > most_values)
    return;
  for (std::size_t k = 0; k < static_cast<std::size_t>(rank); ++k)
    place[k] = extent[k] == 0 ? 0 : input.ConsumeIntegral<std::uint16_t>() % extent[k];
  if (H5Sselect_elements(space, H5S_SELECT_SET, 1, place.data()) < 0)
    return;
  if (input.ConsumeBool()) {
    const auto value = input.ConsumeIntegral<std::int64_t>();
    H5Dwrite(dataset, H5T_NATIVE_INT64, one, space, H5P_DEFAULT, &value);
  } else {
    const auto value = input.ConsumeFloatingPoint<double>();
    H5Dwrite(dataset, H5T_NATIVE_DOUBLE, one, space, H5P_DEFAULT, &value);
  }
}

/// The attribute number k of a group gets another type and value, or goes.
void replace_attribute(FuzzedDataProvider& input, hid_t file, const std::string& group) {
  const hsize_t number = input.ConsumeIntegral<std::uint8_t>();
  const Hdf5Attribute old(
      H5Aopen_by_idx(file, group.c_str(), H5_INDEX_NAME, H5_ITER_INC, number, H5P_DEFAULT, H5P_DEFAULT));
  if (old < 0)
    return;
  std::string name(static_cast<std::size_t>(H5Aget_name(old, 0, nullptr)), '\0');
  H5Aget_name(old, name.size() + 1, name.data());
  H5Adelete_by_name(file, group.c_str(), name.c_str(), H5P_DEFAULT);
  if (input.ConsumeBool())
    return;
  const Hdf5Space space = some_space(input);
  const auto value = input.ConsumeIntegral<std::int64_t>();
  const Hdf5Type type(H5Tcopy(input.ConsumeBool() ? H5T_NATIVE_INT64 : H5T_NATIVE_DOUBLE));
  const Hdf5Attribute made(
      H5Acreate_by_name(file, group.c_str(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  if (made >= 0 && H5Sget_simple_extent_npoints(space) == 1)
    H5Awrite(made, type, &value);
}

herr_t keep_path(hid_t, const char* name, const H5O_info_t* info, void* lists) {
  auto* const found = static_cast<std::array<std::vector<std::string>*, 2>*>(lists);
  if (std::string_view(name) != ".")
    (*found)[info->type == H5O_TYPE_DATASET ? 0 : 1]->push_back(name);
  return 0;
}

} // namespace

void start_mpi() {
  static int argument_count = 0;
  static char** arguments = nullptr;
  setenv("OMPI_MCA_opal_signal", "", 1); // the text of a stack is libFuzzer's affair
  static const comm::Environment environment(argument_count, arguments);
}

DamagedFile::DamagedFile(bool is_checkpoint)
    : comm_((start_mpi(), comm::Communicator::self())), path_(directory_.path() + "/damaged.h5") {
  constexpr int all = -1; // the table of each open file is kept for the next one, or pages would be cleared for it
  H5set_free_list_limits(all, all, all, all, all, all);
  run(directory_.path(), comm_, is_checkpoint);
  std::string made;
  for (const auto& entry : std::filesystem::directory_iterator(directory_.path()))
    if (const std::string name = entry.path().string(); name.ends_with(".h5"))
      made = name;
  bytes_ = read_file(made);
  std::filesystem::remove(made);
  list_objects();
}

void DamagedFile::list_objects() {
  write_file(path_, bytes_);
  const Hdf5File file(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open " + path_);
  std::array<std::vector<std::string>*, 2> lists{&datasets_, &groups_};
  checked(H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, keep_path, &lists, H5O_INFO_BASIC), "list " + path_);
  TRIME_ASSERT(datasets_.size() > 5 && groups_.size() > 2, "{} datasets", datasets_.size());
}

const std::string& DamagedFile::damage(const std::uint8_t* data, std::size_t size) {
  constexpr int most_changes = 8;
  FuzzedDataProvider input(data, size);
  std::string bytes = bytes_;
  write_file(path_, bytes);
  silence_hdf5();
  const int changes = input.ConsumeIntegralInRange(0, most_changes);
  if (const Hdf5File file(changes == 0 ? -1 : H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)); file >= 0)
    for (int k = 0; k < changes; ++k) {
      const auto kind = input.ConsumeIntegralInRange(0, 4);
      const std::string &dataset = datasets_[input.ConsumeIntegral<std::uint8_t>() % datasets_.size()],
                        &group = groups_[input.ConsumeIntegral<std::uint8_t>() % groups_.size()];
      if (kind == 0)
        H5Ldelete(file, (input.ConsumeBool() ? dataset : group).c_str(), H5P_DEFAULT);
      else if (kind == 1)
        replace_dataset(input, file, dataset);
      else if (kind == 2)
        overwrite_value(input, file, dataset);
      else if (kind == 3)
        replace_attribute(input, file, group);
      else {
        const std::string& other = datasets_[input.ConsumeIntegral<std::uint8_t>() % datasets_.size()];
        H5Ldelete(file, dataset.c_str(), H5P_DEFAULT);
        H5Lmove(file, other.c_str(), file, dataset.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      }
    }
  if (input.ConsumeBool()) { // cut off
    const std::string changed = read_file(path_);
    write_file(path_, changed.substr(0, input.ConsumeIntegral<std::uint32_t>() % (changed.size() + 1)));
  }
  return path_;
}

DamagedFile& good_file() {
  static DamagedFile file(damages_checkpoints);
  return file;
}

} // namespace trime::fuzz

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  trime::fuzz::good_file();
  return 0;
}
