// SPDX-License-Identifier: BSD-3-Clause
// A size that is a function of Python. The mesher asks for single places from several threads; Python answers one
// thread at a time, and NumPy is fast for many places at once.
#pragma once

#include "trime/sizing/size_field.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <mutex>
#include <optional>
#include <span>
#include <string>

namespace trime::python {

/// @brief Calls a function of Python with an (n, 2) array of places, which returns n sizes. Thread-safe: each call
/// takes the lock of the interpreter, so no thread may hold that lock while it waits for another thread that calls.
class PythonSize final : public sizing::SizeField {
public:
  explicit PythonSize(pybind11::function function) : function_(std::move(function)) {}

  /// @throws GeometryError on this rank alone, with the place, if the function throws or returns something else
  double size(geometry::Vec2 p) const override;

  /// Returns the exception of the function, as an object of Python; none if the function has not failed on this rank.
  /// @pre the calling thread holds the lock of the interpreter
  pybind11::object failure() const { return failure_ ? failure_->value() : pybind11::none(); }

private:
  void evaluate(std::span<const geometry::Vec2> places, double* values) const;
  [[noreturn]] void fail(const pybind11::error_already_set& error, geometry::Vec2 p) const;

  pybind11::function function_;
  /// The first exception; mutable because a size does not change by being asked. The interpreter's lock guards it.
  mutable std::optional<pybind11::error_already_set> failure_;
};

} // namespace trime::python
