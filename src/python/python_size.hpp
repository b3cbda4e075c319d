// SPDX-License-Identifier: BSD-3-Clause
// A size that is a function of Python. Such a function is fast for many places at once, and not for single ones.
#pragma once

#include "trime/sizing/size_field.hpp"

#include <pybind11/pybind11.h>

#include <mutex>
#include <optional>
#include <span>

namespace trime::python {

/// @brief Calls a function of Python with an (n, 2) array of places, which returns n sizes. Thread-safe: one call runs
/// at a time.
/// @pre a thread that asks for sizes does not hold the lock of the interpreter
class PythonSize final : public sizing::SizeField {
public:
  explicit PythonSize(pybind11::object function) : function_(std::move(function)) {}

  /// @throws GeometryError on this rank alone, with the place, if the function throws or returns something else
  double size(geometry::Vec2 p) const override;
  void sizes(std::span<const geometry::Vec2> places, std::span<double> values) const override;
  bool prefers_blocks() const override { return true; }

  /// Returns the exception of the function, as an object of Python; none if the function has not failed on this rank.
  /// @pre the calling thread holds the lock of the interpreter
  pybind11::object failure() const {
    return failure_ ? pybind11::reinterpret_borrow<pybind11::object>(failure_->value()) : pybind11::none();
  }

private:
  [[noreturn]] void fail(geometry::Vec2 p) const;

  pybind11::object function_;
  // Mutable because a size does not change by being asked.
  mutable std::mutex one_call_; ///< NumPy gives the lock of the interpreter away while it computes
  mutable std::optional<pybind11::error_already_set> failure_; ///< the first exception; used by one call at a time
};

} // namespace trime::python
