// SPDX-License-Identifier: BSD-3-Clause
#include "python_size.hpp"

#include "bindings.hpp"
#include "trime/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace py = pybind11;

namespace trime::python {
namespace {

/// Python objects do not survive a stop of the interpreter's lock between their making and their end.
/// @pre the calling thread holds the lock
void call(const py::function& function, std::span<const geometry::Vec2> places, double* values) {
  const auto n = static_cast<py::ssize_t>(places.size());
  py::array_t<double> array({n, py::ssize_t{2}});
  double* to = array.mutable_data();
  for (const geometry::Vec2 p : places) {
    *to++ = p.x;
    *to++ = p.y;
  }
  const auto result = py::array_t<double, py::array::c_style | py::array::forcecast>(function(array));
  if (result.ndim() != 1 || result.shape(0) != n) {
    std::string shape;
    for (py::ssize_t k = 0; k < result.ndim(); ++k)
      shape += fmt::format("{}{}", k == 0 ? "" : ", ", result.shape(k));
    throw py::value_error(fmt::format("the size function got an array of {} places: expected {} sizes, found an array "
                                      "with the shape ({}{})",
                                      n, n, shape, result.ndim() == 1 ? "," : ""));
  }
  std::copy_n(result.data(), n, values);
}

} // namespace

double PythonSize::size(geometry::Vec2 p) const {
  double value = 0;
  evaluate({&p, 1}, &value);
  return value;
}

void PythonSize::evaluate(std::span<const geometry::Vec2> places, double* values) const {
  const py::gil_scoped_acquire lock;
  if (failure_) // another thread will report it
    fail(*failure_, places[0]);
  try {
    call(function_, places, values);
  } catch (py::error_already_set& error) {
    failure_ = error;
    fail(error, places[0]);
  } catch (const py::builtin_exception& error) {
    error.set_error();
    failure_.emplace();
    fail(*failure_, places[0]);
  }
}

void PythonSize::fail(const py::error_already_set& error, geometry::Vec2 p) const {
  const std::string kind = py::str(error.type().attr("__name__")), text = py::str(error.value());
  std::string where;
  for (py::object trace = error.trace(); trace && !trace.is_none(); trace = trace.attr("tb_next"))
    where =
        fmt::format(" ({}, line {})", std::string(py::str(trace.attr("tb_frame").attr("f_code").attr("co_filename"))),
                    trace.attr("tb_lineno").cast<int>());
  throw GeometryError(fmt::format("the size function failed at {}: {}: {}{}", Place(p), kind, text, where));
}

} // namespace trime::python
