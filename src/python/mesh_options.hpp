// SPDX-License-Identifier: BSD-3-Clause
// Reads the options of a mesh from the keywords of a call in Python.
#pragma once

#include "trime/facade/mesh.hpp"
#include "trime/facade/size.hpp"

#include <pybind11/pybind11.h>

#include <memory>

namespace trime::python {

class PythonSize;

/// @throws pybind11::type_error for an unknown keyword, which lists the known ones, or a value of another type
MeshOptions options_of(const pybind11::dict& keywords);

/// A size as Python gives it.
struct GivenSize {
  Size size;
  std::shared_ptr<const PythonSize> function; ///< null for a size that does not call Python
};

/// @param size None, a formula as text, a function of an (n, 2) array, or the gradation of the automatic size in a
/// tuple
/// @throws pybind11::type_error for anything else
GivenSize size_of(const pybind11::object& size);

} // namespace trime::python
