// SPDX-License-Identifier: BSD-3-Clause
// The parts of the Python module trime_mpi._parallel. The package trime_mpi.parallel wraps it for users.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <vector>

namespace trime::python {

/// An array of places, or what NumPy can make one of. It has the shape (n, 2).
using Places = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// @throws pybind11::value_error, which names `what`, for another shape
std::vector<geometry::Vec2> places_of(const Places& array, const char* what);

void bind_shapes(pybind11::module_& module);
void bind_mesh(pybind11::module_& module);
void bind_local_mesh(pybind11::module_& module);
void bind_local_cells(pybind11::module_& module);

} // namespace trime::python
