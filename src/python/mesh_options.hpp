// SPDX-License-Identifier: BSD-3-Clause
// Reads the options of a mesh from the keywords of a call in Python.
#pragma once

#include "trime/facade/mesh.hpp"
#include "trime/facade/size.hpp"

#include <pybind11/pybind11.h>

#include <memory>
#include <vector>

namespace trime::python {

class PythonSize;

/// @throws pybind11::type_error for an unknown keyword, which lists the known ones, or a value of another type
MeshOptions options_of(const pybind11::dict& keywords);

/// A size as Python gives it.
struct GivenSize {
  Size size;
  std::vector<std::shared_ptr<const PythonSize>> functions; ///< functions of Python that the size calls
};

/// @param size None, a formula as text, a function of an (n, 2) array, the gradation of the automatic size in a tuple,
/// or a dict of such sizes by name, whose smallest one counts at each place
/// @throws pybind11::type_error for anything else
GivenSize size_of(const pybind11::object& size);

} // namespace trime::python
