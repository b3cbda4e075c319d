// SPDX-License-Identifier: BSD-3-Clause
// NumPy arrays that show the memory of vectors of the library, without a copy.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <vector>

namespace trime::python {

/// Returns a NumPy array that shows the memory of a vector, which `owner` keeps. It cannot be written.
template <class Value>
pybind11::array shown(const Value* data, std::vector<pybind11::ssize_t> shape, const pybind11::object& owner) {
  pybind11::array array(pybind11::dtype::of<Value>(), std::move(shape), {}, data, owner);
  array.attr("setflags")(pybind11::arg("write") = false);
  return array;
}

template <class Value>
pybind11::array shown(const std::vector<Value>& values, const pybind11::object& owner) {
  return shown(values.data(), {std::ssize(values)}, owner);
}
template <class Value, std::size_t n>
pybind11::array shown(const std::vector<std::array<Value, n>>& values, const pybind11::object& owner) {
  static_assert(sizeof(std::array<Value, n>) == n * sizeof(Value));
  return shown(values.empty() ? nullptr : values.front().data(), {std::ssize(values), pybind11::ssize_t{n}}, owner);
}
inline pybind11::array shown(const std::vector<geometry::Vec2>& values, const pybind11::object& owner) {
  static_assert(sizeof(geometry::Vec2) == 2 * sizeof(double));
  return shown(values.empty() ? nullptr : &values.front().x, {std::ssize(values), pybind11::ssize_t{2}}, owner);
}

} // namespace trime::python
