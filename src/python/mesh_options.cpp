// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_options.hpp"

#include "bindings.hpp"
#include "python_size.hpp"

#include <fmt/format.h>

#include <pybind11/stl.h>

#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace trime::python {
namespace {

using Setter = std::function<void(MeshOptions&, py::handle)>;
using Pair = std::pair<double, double>;

template <class T, class Member>
Setter setter(Member MeshOptions::*member) {
  return [member](MeshOptions& options, py::handle value) { options.*member = value.cast<T>(); };
}

template <class T, class Member>
Setter feature(Member boundary::FeatureOptions::*member) {
  return [member](MeshOptions& options, py::handle value) { options.features.*member = value.cast<T>(); };
}

Method method_of(const std::string& name) {
  const std::map<std::string, Method> known{
      {"distmesh", Method::distmesh}, {"cvd", Method::cvd}, {"hybrid", Method::hybrid}};
  const auto found = known.find(name);
  if (found == known.end())
    throw py::value_error(fmt::format("method: expected 'hybrid', 'distmesh' or 'cvd', found '{}'", name));
  return found->second;
}

/// A list of texts, or a single one.
std::vector<std::string> words_of(py::handle value) {
  if (py::isinstance<py::str>(value))
    return {value.cast<std::string>()};
  return value.cast<std::vector<std::string>>();
}

void set_container(MeshOptions& options, py::handle value) {
  const auto [lower, upper] = value.cast<std::pair<Pair, Pair>>();
  options.container = Box{{lower.first, lower.second}, {upper.first, upper.second}};
}

std::map<std::string, Setter> setters() {
  return {
      {"points", setter<GlobalId>(&MeshOptions::points)},
      {"edge_length", setter<double>(&MeshOptions::edge_length)},
      {"absolute_sizes", setter<bool>(&MeshOptions::absolute_sizes)},
      {"min_size", setter<double>(&MeshOptions::min_size)},
      {"max_size", setter<double>(&MeshOptions::max_size)},
      {"gradation", setter<double>(&MeshOptions::gradation)},
      {"method", [](MeshOptions& options, py::handle value) { options.method = method_of(value.cast<std::string>()); }},
      {"container", set_container},
      {"periodic_x", setter<bool>(&MeshOptions::periodic_x)},
      {"periodic_y", setter<bool>(&MeshOptions::periodic_y)},
      {"fixed_points",
       [](MeshOptions& options, py::handle value) {
         options.fixed_points = places_of(value.cast<Places>(), "fixed_points");
       }},
      {"regions", setter<std::vector<Region>>(&MeshOptions::regions)},
      {"rest", setter<std::string>(&MeshOptions::rest)},
      {"regions_cover_all", setter<bool>(&MeshOptions::regions_cover_all)},
      {"curves", setter<std::vector<Curve>>(&MeshOptions::curves)},
      {"corner_angle", feature<double>(&boundary::FeatureOptions::corner_angle)},
      {"keep_all", feature<bool>(&boundary::FeatureOptions::keep_all)},
      {"refine_narrow", feature<bool>(&boundary::FeatureOptions::refine_narrow)},
      {"max_loss", feature<double>(&boundary::FeatureOptions::max_loss)},
      {"max_sweeps", setter<int>(&MeshOptions::max_sweeps)},
      {"split_ears", setter<bool>(&MeshOptions::split_ears)},
      {"accept", [](MeshOptions& options, py::handle value) { options.accept = words_of(value); }},
      {"open_boundary", [](MeshOptions& options, py::handle value) { options.open_boundary = words_of(value); }},
      {"worst_alpha", setter<double>(&MeshOptions::worst_alpha)},
      {"start", [](MeshOptions& options, py::handle value) { options.start = value.cast<const Mesh*>(); }},
      {"seed", setter<std::uint64_t>(&MeshOptions::seed)},
  };
}

std::string type_of(py::handle value) {
  return py::str(py::type::of(value).attr("__name__"));
}

GivenSize smallest_of(const py::dict& sizes) {
  std::vector<NamedSize> named;
  GivenSize given{sizes::uniform(), {}};
  for (const auto& [name, value] : sizes) {
    if (!py::isinstance<py::str>(name))
      throw py::type_error(
          fmt::format("size: expected a dict of sizes by name, found a name of type {}", type_of(name)));
    GivenSize one = size_of(py::reinterpret_borrow<py::object>(value));
    named.push_back({name.cast<std::string>(), std::move(one.size)});
    given.functions.insert(given.functions.end(), one.functions.begin(), one.functions.end());
  }
  if (named.empty())
    throw py::type_error("size: expected at least one size in the dict, found none");
  given.size = sizes::smallest(std::move(named));
  return given;
}

} // namespace

MeshOptions options_of(const py::dict& keywords) {
  const std::map<std::string, Setter> known = setters();
  MeshOptions options;
  for (const auto& [key, value] : keywords) {
    const auto name = key.cast<std::string>();
    const auto found = known.find(name);
    if (found == known.end()) {
      std::string names;
      for (const auto& [one, set] : known)
        names += (names.empty() ? "" : ", ") + one;
      throw py::type_error(fmt::format("mesh() has no option '{}'; known: {}", name, names));
    }
    if (value.is_none())
      continue;
    try {
      found->second(options, value);
    } catch (const py::cast_error&) {
      throw py::type_error(fmt::format("the option '{}' cannot be an object of type {}: {}", name, type_of(value),
                                       std::string(py::str(py::repr(value)))));
    }
  }
  return options;
}

GivenSize size_of(const py::object& size) {
  if (size.is_none())
    return {sizes::uniform(), {}};
  if (py::isinstance<py::str>(size))
    return {sizes::formula(size.cast<std::string>()), {}};
  if (py::isinstance<py::tuple>(size))
    return {sizes::automatic(std::get<0>(size.cast<std::tuple<double>>())), {}};
  if (py::isinstance<py::dict>(size))
    return smallest_of(size.cast<py::dict>());
  if (py::isinstance<py::function>(size) || PyCallable_Check(size.ptr()) != 0) {
    const auto function = std::make_shared<const PythonSize>(size);
    return {Size(std::shared_ptr<const sizing::SizeField>(function)), {function}};
  }
  throw py::type_error(
      fmt::format("size: expected None, a formula such as '1 + 3*x', a function of an array of places, "
                  "automatic(), or a dict of such sizes by name, found an object of type {}",
                  type_of(size)));
}

} // namespace trime::python
