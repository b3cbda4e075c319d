// SPDX-License-Identifier: BSD-3-Clause
#include "facade/check_options.hpp"

#include "acceptance/solver_rules.hpp"
#include "comm/agree.hpp"
#include "core/quoted.hpp"
#include "facade/build_size.hpp"
#include "trime/core/error.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

namespace trime {
namespace {

template <class T>
std::string text_of(const std::optional<T>& value) {
  return value ? fmt::format("{}", *value) : "none";
}

std::string text_of(const std::optional<Box>& box) {
  return box ? fmt::format("({}, {}) to ({}, {})", box->min.x, box->min.y, box->max.x, box->max.y) : "none";
}

/// Describes a size as far as ranks can compare it: kind, formula and numbers, but not the values of its function.
std::string kind_of(const Size& size) {
  if (size.is_minimum())
    return fmt::format("the smallest of {} sizes", size.parts().size());
  return size.is_automatic() ? fmt::format("automatic, gradation {}", size.gradation()) : text_of(size);
}

/// Returns the facts of a size on which the ranks must agree, one on each line.
std::vector<std::string> items_of(const Size& size) {
  std::vector<std::string> items{"size " + kind_of(size)};
  for (const NamedSize& named : size.parts())
    items.push_back(fmt::format("size '{}' {}", named.name, kind_of(named.size)));
  return items;
}

/// Returns the facts on which the ranks must agree, one on each line.
std::vector<std::string> items_of(const Shape& shape, const MeshOptions& options) {
  const boundary::FeatureOptions& features = options.features;
  std::vector<std::string> items{
      "shape " + shape.text(),
      "points " + text_of(options.points),
      "edge_length " + text_of(options.edge_length),
      fmt::format("absolute_sizes {}, gradation {}", options.absolute_sizes, text_of(options.gradation)),
      fmt::format("method {}", static_cast<int>(options.method)),
      "min_size " + text_of(options.min_size),
      "max_size " + text_of(options.max_size),
      "container " + text_of(options.container),
      fmt::format("periodic_x, periodic_y {}, {}", options.periodic_x, options.periodic_y),
      fmt::format("max_sweeps {}", options.max_sweeps),
      fmt::format("split_ears {}, accept '{}'", options.split_ears, fmt::join(options.accept, " ")),
      options.open_boundary ? fmt::format("open_boundary '{}'", fmt::join(*options.open_boundary, ", "))
                            : "open_boundary none",
      fmt::format("worst_alpha {}", options.worst_alpha),
      fmt::format("seed {}", options.seed),
      options.start ? fmt::format("start mesh {:016x}", options.start->hash()) : "start none",
      fmt::format("features {} {} {} {} {} {}", features.corner_angle, features.keep_all, features.refine_narrow,
                  features.tolerance, features.within, static_cast<int>(features.narrow)),
      fmt::format("connections {}, components {} at ({}, {}), max_loss {}", static_cast<int>(features.connect),
                  static_cast<int>(features.components), features.component_place.x, features.component_place.y,
                  text_of(features.max_loss)),
      fmt::format("rest '{}', regions_cover_all {}", options.rest, options.regions_cover_all),
      fmt::format("{} regions, {} curves, {} fixed points", options.regions.size(), options.curves.size(),
                  options.fixed_points.size())};
  for (const Region& region : options.regions)
    items.push_back(fmt::format("region '{}' {} of size {}", region.name, region.shape.text(), text_of(region.size)));
  for (const Vec2 p : options.fixed_points)
    items.push_back(fmt::format("fixed point ({}, {})", p.x, p.y));
  return items;
}

void check_same(const Shape& shape, const Size& size, const MeshOptions& options, const comm::Communicator& comm) {
  std::vector<std::string> items = items_of(shape, options);
  const std::vector<std::string> size_items = items_of(size);
  items.insert(items.end(), size_items.begin(), size_items.end());
  const std::string here = fmt::format("{}", fmt::join(items, "\n"));
  const std::string of_root = comm.broadcast(here);
  comm::run_agreed(comm, [&] {
    if (here == of_root)
      return;
    std::size_t start = 0;
    for (const std::string& item : items) {
      const std::string theirs = of_root.substr(start, of_root.find('\n', start) - start);
      if (item != theirs)
        throw ConfigError(fmt::format("the ranks ask for different meshes: rank 0 has '{}', another rank has '{}'; "
                                      "expected the same shape, size and options on all ranks",
                                      theirs, item));
      start += theirs.size() + 1;
    }
  });
}

void check_positive(const std::optional<double>& value, const char* name) {
  if (value && !(*value > 0 && std::isfinite(*value)))
    throw ConfigError(fmt::format("MeshOptions::{}: expected a finite number above 0, found {}", name, *value));
}

void check_values(const MeshOptions& options) {
  if (options.absolute_sizes && options.edge_length)
    throw ConfigError("MeshOptions::edge_length: expected no edge length with absolute_sizes, because the size gives "
                      "lengths already");
  if (options.points.has_value() == options.edge_length.has_value() && !options.absolute_sizes)
    throw ConfigError(fmt::format("MeshOptions: expected one of points and edge_length, found {}; for example "
                                  "{{.points = 5000}}",
                                  options.points ? "both" : "none"));
  if (options.points && *options.points < 3)
    throw ConfigError(fmt::format("MeshOptions::points: expected at least 3, found {}", *options.points));
  check_positive(options.edge_length, "edge_length");
  check_positive(options.min_size, "min_size");
  check_positive(options.max_size, "max_size");
  for (const Region& region : options.regions)
    if (region.size && !(*region.size > 0 && std::isfinite(*region.size)))
      throw ConfigError(fmt::format("the size of the region '{}' in MeshOptions: expected a number above 0, found {}",
                                    region.name, *region.size));
  if (options.gradation && !(*options.gradation > 0))
    throw ConfigError(fmt::format("MeshOptions::gradation: expected a number above 0, found {}", *options.gradation));
  if (const std::optional<double>& loss = options.features.max_loss; loss && !(*loss >= 0 && *loss <= 1))
    throw ConfigError(fmt::format("MeshOptions::features.max_loss: expected a share from 0 to 1, found {}", *loss));
  if (options.min_size && options.max_size && *options.min_size > *options.max_size)
    throw ConfigError(fmt::format("MeshOptions: expected min_size <= max_size, found {} and {}", *options.min_size,
                                  *options.max_size));
  if ((options.periodic_x || options.periodic_y) && !options.container)
    throw ConfigError("MeshOptions: periodic_x and periodic_y need a container, whose sides are the periods");
  if (options.max_sweeps < 0)
    throw ConfigError(fmt::format("MeshOptions::max_sweeps: expected at least 0, found {}", options.max_sweeps));
  for (const Vec2 p : options.fixed_points)
    if (!std::isfinite(p.x) || !std::isfinite(p.y))
      throw ConfigError(fmt::format("MeshOptions::fixed_points: expected finite numbers, found ({}, {})", p.x, p.y));
}

bool is_uniform(const Size& size) {
  return !size.is_automatic() && !size.function() && !size.field() && size.formula().empty() && !size.is_minimum();
}

/// Absolute sizes need a length that the size itself does not give.
void check_absolute(const Size& size, const MeshOptions& options) {
  if (!options.absolute_sizes)
    return;
  if (size.is_automatic() && !options.min_size)
    throw ConfigError("MeshOptions::min_size: expected a length, because absolute_sizes is set and the size is "
                      "automatic: features of the boundary that are smaller are not resolved");
  for (const NamedSize& named : size.parts())
    if (named.size.is_automatic() && !options.min_size)
      throw ConfigError(fmt::format("MeshOptions::min_size: expected a length, because absolute_sizes is set and the "
                                    "size '{}' is automatic",
                                    named.name));
  if (is_uniform(size) && !options.max_size)
    throw ConfigError("MeshOptions::max_size: expected the length of the edges, because absolute_sizes is set and the "
                      "size is uniform");
}

/// Several sizes need names, and each of them must be able to be the smallest one somewhere.
void check_parts(const Size& size) {
  if (size.is_minimum() && size.parts().empty())
    throw ConfigError("the smallest one of several sizes: expected at least one size with a name, found none; use "
                      "sizes::uniform() for a size that is the same everywhere");
  std::set<std::string> names;
  for (const auto& [name, part] : size.parts()) {
    const bool is_plain = std::ranges::all_of(
        name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-'; });
    if (name.empty() || !is_plain)
      throw ConfigError(fmt::format("the name '{}' of a size: expected letters, digits, '_' and '-'", shown(name)));
    if (!names.insert(name).second)
      throw ConfigError(fmt::format("two sizes are called '{}': expected a name for each", name));
    if (is_uniform(part))
      throw ConfigError(fmt::format("the size '{}' is uniform: expected a size that varies, because several sizes are "
                                    "combined by their minimum; MeshOptions::max_size bounds all of them",
                                    name));
    if (part.is_minimum())
      throw ConfigError(
          fmt::format("the size '{}' is the smallest one of others: expected these in the list itself", name));
  }
}

} // namespace

std::vector<acceptance::Solver> models_of(const std::vector<std::string>& words) {
  std::vector<acceptance::Solver> models;
  for (const std::string& word : words) {
    const std::optional<acceptance::Solver> model = acceptance::solver_of_word(word);
    if (!model)
      throw ConfigError(fmt::format("MeshOptions::accept: expected names of models among {}, found '{}'",
                                    acceptance::solver_words(), shown(word)));
    models.push_back(*model);
  }
  return models;
}

void check_options(const Shape& shape, const Size& size, const MeshOptions& options, const comm::Communicator& comm) {
  check_same(shape, size, options, comm);
  check_values(options); // the same on all ranks
  check_parts(size);
  check_absolute(size, options);
  models_of(options.accept);
  if (options.start && options.start->communicator().size() != comm.size())
    throw ConfigError(fmt::format("MeshOptions::start: expected a mesh on the {} ranks of the communicator, found one "
                                  "on {}; write it to a file, and read it with this communicator",
                                  comm.size(), options.start->communicator().size()));
}

} // namespace trime
