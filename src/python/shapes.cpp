// SPDX-License-Identifier: BSD-3-Clause
#include "bindings.hpp"

#include "trime/facade/shape.hpp"

#include <fmt/format.h>

#include <pybind11/operators.h>
#include <pybind11/stl.h>

#include <string>
#include <utility>

namespace py = pybind11;

namespace trime::python {

std::vector<Vec2> places_of(const Places& array, const char* what) {
  if (array.ndim() != 2 || array.shape(1) != 2) {
    std::string shape;
    for (py::ssize_t k = 0; k < array.ndim(); ++k)
      shape += fmt::format("{}{}", k == 0 ? "" : ", ", array.shape(k));
    throw py::value_error(
        fmt::format("{}: expected an array with the shape (n, 2), found one with the shape ({})", what, shape));
  }
  std::vector<Vec2> places;
  places.reserve(static_cast<std::size_t>(array.shape(0)));
  const auto values = array.unchecked<2>();
  for (py::ssize_t k = 0; k < array.shape(0); ++k)
    places.push_back({values(k, 0), values(k, 1)});
  return places;
}

void bind_shapes(py::module_& module) {
  using Pair = std::pair<double, double>;
  py::class_<Shape>(module, "Shape")
      .def(py::self + py::self)
      .def(py::self - py::self)
      .def(py::self & py::self)
      .def_property_readonly("text", &Shape::text)
      .def("__repr__", [](const Shape& shape) { return fmt::format("<Shape {}>", shape.text()); });
  module.def("rectangle", [](const std::string& name, Pair lower, Pair upper) {
    return rectangle(name, {lower.first, lower.second}, {upper.first, upper.second});
  });
  module.def("circle", [](const std::string& name, Pair center, double radius) {
    return circle(name, {center.first, center.second}, radius);
  });
  module.def("rings", [](const std::string& name, const std::vector<Places>& arrays) {
    std::vector<std::vector<Vec2>> all;
    for (const Places& array : arrays)
      all.push_back(places_of(array, fmt::format("a ring of '{}'", name).c_str()));
    return rings(name, all);
  });
  module.def("contour", [](const std::string& name, const std::string& path) { return contour(name, path); });
  module.def("domain", [] { return domain(); });
}

} // namespace trime::python
