// SPDX-License-Identifier: BSD-3-Clause
#include "trime/dual/local_cells.hpp"
#include "bindings.hpp"
#include "shown.hpp"
#include "trime/facade/mesh.hpp"

namespace py = pybind11;

namespace trime::python {
namespace {

template <class Array>
auto array_of(Array dual::LocalCells::*member) {
  return [member](const py::object& self) { return shown(self.cast<const LocalCells&>().arrays().*member, self); };
}

} // namespace

void bind_local_cells(py::module_& module) {
  using Arrays = dual::LocalCells;
  py::class_<LocalCells> bound(module, "LocalCells");
  const auto array = [&](const char* name, auto member) { bound.def_property_readonly(name, array_of(member)); };
  bound.def_property_readonly("owned_cells", [](const LocalCells& cells) { return cells.arrays().cells; });
  bound.def_property_readonly("owned_faces", [](const LocalCells& cells) { return cells.arrays().owned_faces; });
  array("areas", &Arrays::areas);
  array("centroids", &Arrays::centroids);
  array("vertices", &Arrays::vertices);
  array("corner_first", &Arrays::corner_first);
  array("corners", &Arrays::corners);
  array("part_first", &Arrays::part_first);
  array("part_regions", &Arrays::part_regions);
  array("part_areas", &Arrays::part_areas);
  array("part_centroids", &Arrays::part_centroids);
  array("part_corner_first", &Arrays::part_corner_first);
  array("part_corners", &Arrays::part_corners);
  array("faces", &Arrays::faces);
  array("face_arms", &Arrays::face_arms);
  array("face_lengths", &Arrays::face_lengths);
  array("face_regions", &Arrays::face_regions);
  array("face_vertices", &Arrays::face_vertices);
  array("neighbour_first", &Arrays::neighbour_first);
  array("neighbours", &Arrays::neighbours);
  array("neighbour_faces", &Arrays::neighbour_faces);
  array("chord_cells", &Arrays::chord_cells);
  array("chord_facets", &Arrays::chord_facets);
  array("chord_normals", &Arrays::chord_normals);
}

} // namespace trime::python
