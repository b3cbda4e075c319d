// SPDX-License-Identifier: BSD-3-Clause
#include "app/size_builder.hpp"

#include "sizing/boundary_distance.hpp"
#include "sizing/distance_size.hpp"
#include "sizing/region_size.hpp"
#include "trime/core/error.hpp"
#include "trime/sizing/automatic_size.hpp"
#include "trime/sizing/size_field.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trime::app {
namespace {

BuiltSize automatic_size(const RunOptions& options, const geometry::Domain& domain, const comm::Communicator& comm) {
  const geometry::Boundary& boundary = domain.boundary();
  sizing::AutomaticSizeOptions automatic;
  automatic.gradation = options.sizing.gradation;
  automatic.feature_floor = options.mesh.absolute_sizes
                                ? options.mesh.min_size.value_or(0)
                                : sizing::feature_floor(options.mesh.points, options.mesh.edge_length, boundary.area);
  automatic.container = domain.frame().container();
  automatic.period_x = boundary.periods.x;
  automatic.period_y = boundary.periods.y;
  BuiltSize size;
  size.field = sizing::make_automatic_size(comm, boundary, automatic);
  size.description = size.field->is_uniform() ? "uniform: the automatic size with gradation 0"
                                              : fmt::format("automatic, gradation {:.6g}, features of {:.3g} and more",
                                                            automatic.gradation, automatic.feature_floor);
  return size;
}

/// A formula of a periodic container must have its periods: compares both ends of some lines across it.
void check_periods(const DistanceFormula& formula, const geometry::Frame& frame) {
  constexpr int lines = 64;
  constexpr double same = 1e-6; // relative
  const geometry::Box& box = frame.container();
  const geometry::Periods& period = frame.periods();
  const auto compare = [&](geometry::Vec2 p, geometry::Vec2 shift) {
    const geometry::Vec2 q = p + shift;
    const double at_p = formula.evaluate(p.x, p.y), at_q = formula.evaluate(q.x, q.y);
    if (!(std::fabs(at_p - at_q) <= same * std::fabs(at_p)))
      throw ConfigError(fmt::format("{}: expected the same size on both sides of the periodic "
                                    "container, found {:.6g} at {} and {:.6g} at {} for '{}'; use "
                                    "a formula with the period of the container",
                                    formula.where(), at_p, Place(p, 6), at_q, Place(q, 6), formula.text()));
  };
  for (int k = 0; k < lines; ++k) {
    const double share = (k + 0.5) / lines;
    if (period.x > 0)
      compare({box.min.x, box.min.y + share * box.height()}, {period.x, 0});
    if (period.y > 0)
      compare({box.min.x + share * box.width(), box.min.y}, {0, period.y});
  }
}

/// Makes the size of a formula, which `size` owns.
std::unique_ptr<const sizing::SizeField> formula_size(const FormulaText& text, const geometry::Domain& domain,
                                                      const std::vector<BuiltField>& fields, BuiltSize& size) {
  const geometry::Box box =
      domain.frame().periods().any() ? domain.frame().container() : domain.boundary().bounding_box();
  size.formulas.push_back(std::make_unique<const DistanceFormula>(build_formula(text, domain, fields)));
  const DistanceFormula& formula = *size.formulas.back();
  auto field = std::make_unique<const sizing::DistanceSize>(formula, box);
  check_periods(formula, domain.frame());
  return field;
}

BuiltSize expression_size(const RunOptions& options, const geometry::Domain& domain,
                          const std::vector<BuiltField>& fields) {
  BuiltSize size;
  size.field = formula_size(options.sizing.expression, domain, fields, size);
  size.description = "expression " + options.sizing.expression.text;
  return size;
}

/// The smallest one of the size so far and of the sections [size.NAME]. A uniform size does not count: `max_size`
/// bounds all of them.
void lower_by_sections(const RunOptions& options, const geometry::Domain& domain, const std::vector<BuiltField>& fields,
                       BuiltSize& size) {
  const std::vector<NamedFormula>& more = options.sizing.more;
  if (more.empty())
    return;
  std::vector<const sizing::SizeField*> smallest;
  if (options.sizing.type != "uniform") {
    size.names.push_back("sizing");
    size.bases.push_back(std::move(size.field));
    smallest.push_back(size.bases.back().get());
  }
  size.description = smallest.empty() ? "" : size.description + ", ";
  for (const NamedFormula& one : more) {
    size.names.push_back("size." + one.name);
    size.bases.push_back(formula_size(one.formula, domain, fields, size));
    smallest.push_back(size.bases.back().get());
    size.description += fmt::format("{}{} = {}", &one == &more.front() ? "" : ", ", one.name, one.formula.text);
  }
  size.description = "the smallest of " + size.description;
  auto minimum = std::make_unique<const sizing::MinimumSize>(std::move(smallest));
  size.minimum = minimum.get();
  size.field = std::move(minimum);
}

/// Sizes in another unit than the coordinates, such as degrees in a plane of metres, may ask for an absurd number of
/// points, and counting these would take hours.
/// @throws ConfigError on all ranks if even the largest size asks for too many points
void check_largest_size(const RunOptions& options, const geometry::Domain& domain) {
  if (!options.mesh.absolute_sizes || !options.mesh.max_size)
    return;
  const double largest = *options.mesh.max_size, area = domain.boundary().area;
  const double least_points = area / (0.5 * std::sqrt(3.0) * largest * largest);
  if (!(least_points <= most_points))
    throw ConfigError(fmt::format(
        "'max_size = {:g}' in [sizing] asks for {} points in a shape of area {:.3g}; at most "
        "{:.0e} are possible. Sizes have the unit of the coordinates{}; use larger sizes",
        largest, std::isfinite(least_points) ? fmt::format("{:.2g} or more", least_points) : "far too many", area,
        most_points, options.projection.empty() ? "" : ", which are projected into a plane, usually metres"));
}

/// Returns what a user can do if size_at has a name that no part of the boundary has.
std::string advice_on_names(const RunOptions& options) {
  std::string advice = "; write a list as 'coast 200, open sea 2000'";
  for (const PartOptions& part : options.parts)
    if (part.type == "contour" && part.attribute.empty())
      return advice +
             fmt::format("; 'attribute = FIELD' in [shape.{}] names the boundary after a field of a map", part.name);
  return advice;
}

/// @throws ConfigError on all ranks if size_at has a name that no part of the boundary and no curve has
void check_names(const RunOptions& options, const geometry::Domain& domain) {
  const std::vector<std::string> names = sizing::curve_names(domain);
  try {
    for (const sizing::NamedSize& named : options.sizing.size_at)
      sizing::parts_named(named.name, names);
  } catch (const ConfigError& error) {
    throw ConfigError(fmt::format("{}: {}{}", options.sizing.size_at_place, error.what(), advice_on_names(options)));
  }
}

/// Lowers the size on the parts of the boundary that the key size_at names. All ranks get the same size, or the same
/// error.
void lower_at_boundary(const RunOptions& options, const geometry::Domain& domain, BuiltSize& size) {
  const SizingOptions& sizing = options.sizing;
  const double gradation = options.mesh.gradation.value();
  size.bases.push_back(std::move(size.field));
  check_names(options, domain);
  try {
    size.field = std::make_unique<const sizing::BoundarySize>(*size.bases.back(), sizing::named_curves(domain),
                                                              sizing.size_at, gradation, sizing::images_of(domain));
  } catch (const ConfigError& error) {
    throw ConfigError(fmt::format("{}: {}", sizing.size_at_place, error.what()));
  }
  for (const sizing::NamedSize& named : sizing.size_at)
    size.description += fmt::format(", {:.6g} at {}", named.size, named.name);
  size.lowered_by += size.lowered_by.empty() ? "size_at" : " and size_at";
  size.description += fmt::format(" with gradation {:.6g}", gradation);
}

/// Bounds the size in regions.
void lower_in_regions(const RunOptions& options, const geometry::Domain& domain,
                      std::vector<sizing::RegionBound> bounds, BuiltSize& size) {
  const std::vector<std::string>& names = domain.regions().names;
  for (const sizing::RegionBound& bound : bounds)
    size.description += fmt::format(", {:.6g} in {}", bound.size, names[static_cast<std::size_t>(bound.region)]);
  for (const RegionOptions& region : options.regions) {
    if (!region.size)
      continue;
    for (std::size_t k = 1; k < names.size(); ++k)
      if (names[k] == region.name || (!region.file.empty() && names[k].starts_with(region.name + ".")))
        bounds.push_back({static_cast<int>(k), *region.size});
    size.description += fmt::format(", {:.6g} in {}", *region.size, region.name);
  }
  if (bounds.empty())
    return;
  size.lowered_by = "regions";
  size.bases.push_back(std::move(size.field));
  size.field = std::make_unique<const sizing::RegionSize>(*size.bases.back(), domain, std::move(bounds));
}

} // namespace

DistanceFormula build_formula(const FormulaText& formula, const geometry::Domain& domain,
                              const std::vector<BuiltField>& fields) {
  return DistanceFormula(formula.text, formula.place, sizing::distances_in(domain), functions_of(fields));
}

BuiltSize build_size(const RunOptions& options, const geometry::Domain& domain, const comm::Communicator& comm,
                     std::vector<sizing::RegionBound> bounds, const std::vector<BuiltField>& fields) {
  check_largest_size(options, domain);
  BuiltSize size;
  if (options.sizing.type == "automatic") {
    size = automatic_size(options, domain, comm);
  } else if (options.sizing.type == "expression") {
    size = expression_size(options, domain, fields); // the same on all ranks, errors too
  } else {
    size.field = std::make_unique<const sizing::UniformSize>(
        options.mesh.absolute_sizes ? options.mesh.max_size.value_or(1) : 1.0);
    size.description = "uniform";
  }
  lower_by_sections(options, domain, fields, size); // the same on all ranks, errors too
  lower_in_regions(options, domain, std::move(bounds), size);
  if (!options.sizing.size_at.empty())
    lower_at_boundary(options, domain, size);
  if (options.mesh.absolute_sizes)
    size.description += ", absolute";
  if (options.sizing.uses_data)
    size.description += fmt::format(", {:.3g} MB of data", static_cast<double>(bytes_of(fields)) / 1e6);
  if (options.mesh.min_size)
    size.description += fmt::format(", at least {:.6g}", *options.mesh.min_size);
  if (options.mesh.max_size)
    size.description += fmt::format(", at most {:.6g}", *options.mesh.max_size);
  return size;
}

} // namespace trime::app
