// SPDX-License-Identifier: BSD-3-Clause
#include "bindings.hpp"
#include "shown.hpp"
#include "trime/facade/mesh.hpp"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace py = pybind11;

namespace trime::python {
namespace {

template <class Array>
auto array_of(Array handover::LocalMesh::*member) {
  return [member](const py::object& self) { return shown(self.cast<const LocalMesh&>().arrays().*member, self); };
}
template <class Number>
auto number_of(Number handover::LocalMesh::*member) {
  return [member](const LocalMesh& mesh) { return mesh.arrays().*member; };
}

py::array global_ids(const LocalMesh& mesh) {
  py::array_t<GlobalId> ids(std::ssize(mesh.points()));
  GlobalId* id = ids.mutable_data();
  for (LocalIndex point = 0; point < static_cast<LocalIndex>(mesh.points().size()); ++point)
    *id++ = mesh.global_id(point);
  return ids;
}

/// The memory of an array of Python with a row for each local point.
struct Rows {
  std::span<double> values;
  int components;
};

/// @throws pybind11::value_error on this rank alone for an array of another kind
Rows rows_of(const py::array& array, const LocalMesh& mesh) {
  const auto points = std::ssize(mesh.points());
  const bool fits = py::isinstance<py::array_t<double>>(array) && (array.ndim() == 1 || array.ndim() == 2) &&
                    array.shape(0) == points && (array.flags() & py::array::c_style) != 0 && array.writeable();
  if (!fits)
    throw py::value_error(fmt::format("expected a writeable array of doubles in the order of C with {} rows, one for "
                                      "each point of this rank, found {}",
                                      points,
                                      std::string(py::str("{} of the type {} with the shape {}")
                                                      .format(array.writeable() ? "an array" : "a read-only array",
                                                              array.dtype(), array.attr("shape")))));
  const py::ssize_t components = array.ndim() == 2 ? array.shape(1) : 1;
  auto* data = static_cast<double*>(const_cast<void*>(array.data()));
  return {{data, static_cast<std::size_t>(points * components)}, static_cast<int>(components)};
}

void update_ghosts(const LocalMesh& mesh, const py::array& array) {
  const Rows rows = rows_of(array, mesh);
  const py::gil_scoped_release others_may_run;
  mesh.update_ghosts(rows.values, rows.components);
}

void add_to_owners(const LocalMesh& mesh, const py::array& array) {
  const Rows rows = rows_of(array, mesh);
  const py::gil_scoped_release others_may_run;
  mesh.add_to_owners(rows.values, rows.components);
}

} // namespace

void bind_local_mesh(py::module_& module) {
  using Arrays = handover::LocalMesh;
  py::class_<LocalMesh> local(module, "LocalMesh");
  const auto number = [&](const char* name, auto member) { local.def_property_readonly(name, number_of(member)); };
  const auto array = [&](const char* name, auto member) { local.def_property_readonly(name, array_of(member)); };
  number("first_point", &Arrays::first_point);
  number("total_points", &Arrays::total_points);
  number("total_triangles", &Arrays::total_triangles);
  number("owned_points", &Arrays::owned_points);
  number("owned_triangles", &Arrays::owned_triangles);
  number("owned_facets", &Arrays::owned_facets);
  number("owned_curve_edges", &Arrays::owned_curve_edges);
  number("owned_interfaces", &Arrays::owned_interfaces);
  array("points", &Arrays::points);
  array("boundary", &Arrays::boundary);
  array("ghost_ids", &Arrays::ghost_ids);
  array("ghost_owners", &Arrays::ghost_owners);
  array("triangles", &Arrays::triangles);
  array("triangle_ids", &Arrays::triangle_ids);
  array("regions", &Arrays::regions);
  array("facets", &Arrays::facets);
  array("facet_triangles", &Arrays::facet_triangles);
  array("facet_tags", &Arrays::facet_tags);
  array("facet_parts", &Arrays::facet_parts);
  array("curve_edges", &Arrays::curve_edges);
  array("curve_triangles", &Arrays::curve_triangles);
  array("curve_numbers", &Arrays::curve_numbers);
  array("interfaces", &Arrays::interfaces);
  array("interface_triangles", &Arrays::interface_triangles);
  array("interface_regions", &Arrays::interface_regions);
  array("interface_pairs", &Arrays::interface_pairs);
  array("interface_curves", &Arrays::interface_curves);
  array("split_pairs", &Arrays::split_pairs);
  array("split_curves", &Arrays::split_curves);
  local.def("global_ids", global_ids);
  local.def("update_ghosts", update_ghosts);
  local.def("add_to_owners", add_to_owners);
}

} // namespace trime::python

PYBIND11_MODULE(_parallel, module) {
  module.doc() = "Meshes in place; the package trime_mpi.parallel is the way to use it.";
  trime::python::bind_shapes(module);
  trime::python::bind_mesh(module);
  trime::python::bind_local_mesh(module);
  trime::python::bind_local_cells(module);
}
