// SPDX-License-Identifier: BSD-3-Clause
#include "python_size.hpp"

#include "trime/core/error.hpp"

#include <fmt/format.h>

#include <pybind11/numpy.h>

#include <algorithm>
#include <string>

namespace py = pybind11;

namespace trime::python {
namespace {

/// @pre the calling thread holds the lock of the interpreter
void call(const py::object& function, std::span<const geometry::Vec2> places, double* values) {
  const auto n = static_cast<py::ssize_t>(places.size());
  py::array_t<double> array({n, py::ssize_t{2}});
  double* to = array.mutable_data();
  for (const geometry::Vec2 p : places) {
    *to++ = p.x;
    *to++ = p.y;
  }
  using Result = py::array_t<double, py::array::c_style | py::array::forcecast>;
  const auto result = Result(function(array));
  if (result.ndim() != 1 || result.shape(0) != n)
    throw py::value_error(
        fmt::format("expected {0} sizes for an array with the shape ({0}, 2), found an array with the shape {1}", n,
                    std::string(py::str(result.attr("shape")))));
  std::copy_n(result.data(), n, values);
}

} // namespace

double PythonSize::size(geometry::Vec2 p) const {
  double value = 0;
  sizes({&p, 1}, {&value, 1});
  return value;
}

void PythonSize::sizes(std::span<const geometry::Vec2> places, std::span<double> values) const {
  if (places.empty())
    return;
  const std::lock_guard one_call(one_call_);
  const py::gil_scoped_acquire lock;
  if (failure_) // another thread goes on until it finds the loop at its end
    fail(places[0]);
  try {
    call(function_, places, values.data());
  } catch (const py::error_already_set& error) {
    failure_ = error;
    fail(places[0]);
  } catch (const py::builtin_exception& error) {
    error.set_error();
    failure_.emplace(); // takes over the error that is set
    fail(places[0]);
  }
}

void PythonSize::fail(geometry::Vec2 p) const {
  const std::string kind = py::str(failure_->type().attr("__name__")), text = py::str(failure_->value());
  std::string where;
  for (py::object trace = failure_->trace(); trace && !trace.is_none(); trace = trace.attr("tb_next"))
    where =
        fmt::format(" ({}, line {})", std::string(py::str(trace.attr("tb_frame").attr("f_code").attr("co_filename"))),
                    trace.attr("tb_lineno").cast<int>());
  throw GeometryError(fmt::format("the size function failed at or after {}: {}: {}{}", Place(p), kind, text, where));
}

} // namespace trime::python
