// SPDX-License-Identifier: BSD-3-Clause
#include "trime/facade/mesh.hpp"
#include "bindings.hpp"
#include "mesh_options.hpp"
#include "python_size.hpp"
#include "trime/comm/from_mpi.hpp"

#include <fmt/format.h>

#include <pybind11/stl.h>

#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace trime::python {
namespace {

MPI_Comm communicator_of(const py::object& comm) {
  if (!py::hasattr(comm, "py2f"))
    throw py::type_error(fmt::format("comm: expected a communicator of mpi4py, such as MPI.COMM_WORLD, found an object "
                                     "of type {}",
                                     std::string(py::str(py::type::of(comm).attr("__name__")))));
  return MPI_Comm_f2c(comm.attr("py2f")().cast<MPI_Fint>());
}

/// Makes the exception of the package for an error of the library.
py::object exception_of(const Error& error) {
  const py::object make = py::module_::import("trime_mpi.errors").attr("error_of");
  return make(static_cast<int>(error.code()), std::vector<std::string>{error.what()});
}

[[noreturn]] void raise(const Error& error, const py::object& cause) {
  const py::object exception = exception_of(error);
  if (!cause.is_none())
    exception.attr("__cause__") = cause;
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception.ptr())), exception.ptr());
  throw py::error_already_set();
}

/// The exception of the function that has failed on this rank, or None.
py::object failure_of(const GivenSize& given) {
  for (const std::shared_ptr<const PythonSize>& function : given.functions)
    if (py::object failure = function->failure(); !failure.is_none())
      return failure;
  return py::none();
}

/// The arguments of a call of make_mesh, after they were taken from Python.
struct Arguments {
  Shape shape;
  GivenSize size;
  MeshOptions options;
};

/// @brief Takes the arguments of a call in Python. Collective. @throws on a rank with a wrong argument, the exception
/// that says so; on the other ranks, a ConfigError that names this rank
Arguments agreed_arguments(MPI_Comm comm, const py::object& shape, const py::object& size, const py::dict& keywords) {
  std::optional<Arguments> given;
  std::exception_ptr failure;
  try {
    given.emplace(Arguments{shape.cast<Shape>(), size_of(size), options_of(keywords)});
  } catch (...) {
    failure = std::current_exception();
  }
  std::int64_t failed = 0;
  {
    const py::gil_scoped_release others_may_run;
    const comm::Communicator ranks = comm::duplicate_of(comm);
    failed = ranks.max(failure ? std::int64_t{ranks.rank()} : -1);
  }
  if (failure)
    std::rethrow_exception(failure);
  if (failed >= 0)
    throw ConfigError(
        fmt::format("rank {} was given a shape, a size or an option that is wrong, see its exception; all "
                    "ranks must be given the same",
                    failed));
  return std::move(*given);
}

std::unique_ptr<Mesh> make(const py::object& comm, const py::object& shape, const py::object& size,
                           const py::dict& keywords) {
  const MPI_Comm handle = communicator_of(comm);
  const Arguments given = agreed_arguments(handle, shape, size, keywords);
  std::optional<Error> error;
  try {
    const py::gil_scoped_release others_may_run;
    return std::make_unique<Mesh>(make_mesh(handle, given.shape, given.size.size, given.options));
  } catch (const Error& failed) {
    error = failed;
  }
  raise(*error, failure_of(given.size));
}

/// Lets errors of the library become exceptions of the package.
void translate_errors() {
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer)
        std::rethrow_exception(pointer);
    } catch (const Error& error) {
      const py::object exception = exception_of(error);
      PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception.ptr())), exception.ptr());
    }
  });
}

py::list checks_of(const Mesh& mesh) {
  py::list checks;
  for (const mesh::Check& check : mesh.checks())
    checks.append(py::make_tuple(check.name, check.passed, check.expected, check.found, check.meaning));
  return checks;
}

py::list verdicts_of(const Mesh& mesh) {
  py::list verdicts;
  for (const Verdict& v : mesh.verdicts()) {
    const py::object place = v.place ? py::object(py::make_tuple(v.place->x, v.place->y)) : py::none();
    verdicts.append(
        py::make_tuple(v.solver, v.rule, v.is_least, v.limit, v.worst, v.broken, v.measured, v.refuses, place));
  }
  return verdicts;
}

py::dict size_shares_of(const Mesh& mesh) {
  py::dict shares;
  for (const SizeShare& share : mesh.size_shares())
    shares[py::str(share.name)] = share.points;
  return shares;
}

py::dict quality_of(const Mesh& mesh) {
  const mesh::QualitySummary& quality = mesh.quality();
  py::dict values;
  for (const auto& [name, ratio] : {std::pair{"alpha", quality.alpha}, std::pair{"beta", quality.beta}}) {
    const std::string start = std::string(name) + "_";
    values[py::str(start + "median")] = ratio.median;
    values[py::str(start + "mean")] = ratio.mean;
    values[py::str(start + "max")] = ratio.max;
    values[py::str(start + "half_mean")] = ratio.half_mean;
    values[py::str(start + "std")] = ratio.std;
  }
  values["min_angle_degrees"] = quality.min_angle_degrees;
  values["shortest_edge"] = quality.shortest_edge;
  values["bad_triangles"] = quality.bad_triangles;
  values["obtuse_triangles"] = quality.obtuse_triangles;
  values["size_mean"] = quality.size_mean;
  values["size_std"] = quality.size_std;
  return values;
}

void write(const Mesh& mesh, const std::string& path, bool overwrite, bool vtkhdf, bool xdmf, bool voronoi,
           const std::string& cells) {
  const py::gil_scoped_release others_may_run;
  mesh.write(path, {overwrite, vtkhdf, xdmf, voronoi, formats::cell_kind_of_word(cells)});
}

std::unique_ptr<LocalMesh> local_of(const Mesh& mesh) {
  const py::gil_scoped_release others_may_run;
  return std::make_unique<LocalMesh>(mesh.local());
}
std::unique_ptr<LocalCells> cells_of(const Mesh& mesh) {
  const py::gil_scoped_release others_may_run;
  return std::make_unique<LocalCells>(mesh.cells());
}

py::dict names_of(const Mesh& mesh) {
  const MeshNames names = mesh.names();
  py::dict values;
  values["facets"] = names.facets;
  values["regions"] = names.regions;
  values["curves"] = names.curves;
  values["interfaces"] = names.interfaces;
  values["split_curves"] = names.split_curves;
  return values;
}

} // namespace

void bind_mesh(py::module_& module) {
  translate_errors();
  py::class_<Region>(module, "Region")
      .def(py::init<std::string, Shape, std::optional<double>>(), py::arg("name"), py::arg("shape"),
           py::arg("size") = py::none());
  py::class_<Curve>(module, "Curve")
      .def(py::init([](std::string name, const std::vector<Places>& lines, bool clip, bool split) {
             Curve curve{std::move(name), {}, clip, split};
             for (const Places& line : lines)
               curve.lines.push_back(places_of(line, "a line of a curve"));
             return curve;
           }),
           py::arg("name"), py::arg("lines"), py::arg("clip") = false, py::arg("split") = false);
  py::class_<Mesh>(module, "Mesh")
      .def_property_readonly("points", &Mesh::points)
      .def_property_readonly("triangles", &Mesh::triangles)
      .def_property_readonly("certified", &Mesh::certified)
      .def_property_readonly("hash", [](const Mesh& mesh) { return fmt::format("{:016x}", mesh.hash()); })
      .def_property_readonly("periods",
                             [](const Mesh& mesh) { return py::make_tuple(mesh.periods().x, mesh.periods().y); })
      .def_property_readonly("checks", checks_of)
      .def_property_readonly("quality", quality_of)
      .def_property_readonly("verdicts", verdicts_of)
      .def_property_readonly("size_shares", size_shares_of)
      .def_property_readonly("sweeps", &Mesh::sweeps)
      .def_property_readonly("names", names_of)
      .def("write", write)
      .def("local", local_of)
      .def("cells", cells_of);
  module.def("make_mesh", make);
  module.def("read_mesh", [](const py::object& comm, const std::string& path) {
    const MPI_Comm handle = communicator_of(comm);
    const py::gil_scoped_release others_may_run;
    return std::make_unique<Mesh>(read_mesh(handle, path));
  });
  module.def("mpi_library", [] { return comm::library_version(); });
}

} // namespace trime::python
