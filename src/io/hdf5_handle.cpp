// SPDX-License-Identifier: BSD-3-Clause
#include "io/hdf5_handle.hpp"

#include "trime/core/error.hpp"
#include "trime/io/mesh_file.hpp"

namespace trime::io {
namespace {

bool file_stays_open = false; // HDF5 has its own globals, and this is about them

herr_t keep_innermost(unsigned, const H5E_error2_t* entry, void* text) {
  if (entry->desc)
    *static_cast<std::string*>(text) = entry->desc;
  return 0;
}

} // namespace

std::string hdf5_error_text() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_innermost, &text);
  H5Eclear2(H5E_DEFAULT);
  const std::string marker = "error message = '"; // how the POSIX driver quotes strerror
  const std::size_t start = text.find(marker);
  if (start != std::string::npos) {
    const std::size_t from = start + marker.size();
    return text.substr(from, text.find('\'', from) - from);
  }
  return text.empty() ? "HDF5 gives no reason" : text;
}

herr_t close_file(hid_t file) noexcept {
  const herr_t status = H5Fclose(file);
  file_stays_open = file_stays_open || status < 0;
  return status;
}

bool hdf5_cannot_end() {
  return file_stays_open;
}

void silence_hdf5() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

hid_t checked(hid_t code, const std::string& action) {
  if (code < 0)
    throw FileError(fmt::format("cannot {}: {}", action, hdf5_error_text()));
  return code;
}

} // namespace trime::io
