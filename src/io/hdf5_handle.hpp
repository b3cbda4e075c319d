// SPDX-License-Identifier: BSD-3-Clause
// HDF5 identifiers that are closed by their destructor, and the text of HDF5's error stack. Nothing in this file
// communicates, except where HDF5 itself does so for files.
#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

namespace trime::io {

/// @brief Returns the innermost error of the last failed HDF5 call in one line, with the system's message (such as "No
/// space left on device") if HDF5 has stored it. Empties HDF5's error stack.
std::string hdf5_error_text();

/// Stops HDF5 from printing its errors, because they become exceptions.
void silence_hdf5();

/// Returns `code`, an identifier or status of HDF5.
/// @throws FileError "cannot `action`: reason" if `code` is negative
hid_t checked(hid_t code, const std::string& action);

using Hdf5Close = herr_t (*)(hid_t);

/// An HDF5 identifier. Movable, but not copyable.
template <Hdf5Close close_function>
class Hdf5Handle {
public:
  Hdf5Handle() = default;
  /// Takes the result of an HDF5 function. A negative result is not closed.
  explicit Hdf5Handle(hid_t id) noexcept : id_(id) {}
  /// Takes the result of an HDF5 function.
  /// @throws FileError "cannot `action`: reason" if it is negative
  Hdf5Handle(hid_t id, const std::string& action) : id_(checked(id, action)) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Hdf5Handle() {
    if (id_ >= 0)
      close_function(id_); // a failure is ignored: it can happen here only after another error
  }

  operator hid_t() const { return id_; }
  /// Closes the identifier.
  /// @return the status of HDF5, negative on failure
  herr_t close() noexcept { return id_ < 0 ? 0 : close_function(std::exchange(id_, -1)); }

private:
  hid_t id_ = -1;
};

/// Closes a file by H5Fclose, and notes a failure for `hdf5_cannot_end`.
herr_t close_file(hid_t file) noexcept;

using Hdf5File = Hdf5Handle<close_file>;
using Hdf5Group = Hdf5Handle<H5Gclose>;
using Hdf5Dataset = Hdf5Handle<H5Dclose>;
using Hdf5Space = Hdf5Handle<H5Sclose>;
using Hdf5Type = Hdf5Handle<H5Tclose>;
using Hdf5Attribute = Hdf5Handle<H5Aclose>;
using Hdf5Properties = Hdf5Handle<H5Pclose>;

} // namespace trime::io
