// SPDX-License-Identifier: BSD-3-Clause
#include "facade/build_shape.hpp"

#include "comm/agree.hpp"
#include "trime/contours/contour.hpp"
#include "trime/core/error.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/shape/part.hpp"
#include "trime/shape/region_shape.hpp"
#include "trime/shape/traced_part.hpp"
#include "trime/tracing/shape.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <set>

namespace trime {
namespace {

using Node = Shape::Node;

/// A part with what was read for it.
struct UsedPart {
  const Node* node;
  contours::Contour contour{};
};

void check_name(const std::string& name) {
  const auto is_allowed = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  };
  if (name.empty() || !std::all_of(name.begin(), name.end(), is_allowed))
    throw ConfigError(fmt::format("the name '{}' of a part: expected letters, digits, '_' and '-'", name));
  if (name == shape::domain_name)
    throw ConfigError(
        fmt::format("a part is called '{}', but this name stands for the container: choose another name", name));
}

/// The parts from left to right, each once. @throws ConfigError for names
void collect(const Shape& shape, std::vector<UsedPart>& parts) {
  const Node& node = shape.node();
  for (const Shape& operand : node.operands)
    collect(operand, parts);
  if (node.operation != Node::Operation::part || std::holds_alternative<DomainForm>(node.form))
    return;
  check_name(node.name);
  const auto known =
      std::find_if(parts.begin(), parts.end(), [&](const UsedPart& part) { return part.node->name == node.name; });
  if (known == parts.end())
    parts.push_back({&node});
  else if (known->node != &node)
    throw ConfigError(fmt::format("two different parts are called '{}': expected a name for each", node.name));
}

/// Rank 0 reads the files, for all. Collective.
void read_contours(std::vector<UsedPart>& parts, const comm::Communicator& comm) {
  const auto is_file = [](const UsedPart& part) { return std::holds_alternative<FileForm>(part.node->form); };
  comm::run_agreed(comm, [&] {
    for (UsedPart& part : parts)
      if (comm.is_root() && is_file(part))
        part.contour = contours::read_contour(std::get<FileForm>(part.node->form).path);
  });
  for (UsedPart& part : parts)
    if (is_file(part)) {
      const std::string bytes = comm.broadcast(comm.is_root() ? contours::to_bytes(part.contour) : std::string());
      part.contour = contours::contour_of_bytes(bytes);
    }
}

void check_box(const Box& box, const std::string& what) {
  if (!(box.width() > 0 && box.height() > 0 && std::isfinite(box.width()) && std::isfinite(box.height())))
    throw GeometryError(fmt::format("{}: expected a width and a height above 0, found ({:.9g}, {:.9g}) to ({:.9g}, "
                                    "{:.9g})",
                                    what, box.min.x, box.min.y, box.max.x, box.max.y));
}

/// Rings become a contour, and every part has its box.
Box box_of(UsedPart& part) {
  Box box;
  if (const auto* rectangle = std::get_if<RectangleForm>(&part.node->form))
    box = rectangle->box;
  else if (const auto* circle = std::get_if<CircleForm>(&part.node->form))
    box = {circle->center - Vec2{circle->radius, circle->radius},
           circle->center + Vec2{circle->radius, circle->radius}};
  else if (const auto* function = std::get_if<FunctionForm>(&part.node->form))
    box = function->box;
  else if (const auto* rings = std::get_if<RingsForm>(&part.node->form))
    part.contour = contours::make_contour(rings->rings, fmt::format("rings of '{}'", part.node->name));
  for (const contours::ContourRing& ring : part.contour.rings)
    for (const Vec2 p : ring.points)
      box.include(p);
  check_box(box, fmt::format("the part '{}'", part.node->name));
  return box;
}

std::vector<std::string> names_of(const std::vector<UsedPart>& parts) {
  std::vector<std::string> names;
  for (const UsedPart& part : parts)
    names.push_back(part.node->name);
  return names;
}

Box container_of(const Shape& shape, const MeshOptions& options, std::vector<UsedPart>& parts) {
  std::vector<Box> boxes;
  for (UsedPart& part : parts)
    boxes.push_back(box_of(part));
  boxes.push_back(geometry::unit_square); // the domain
  const Box around = shape::Region::parse(shape.text(), names_of(parts)).box(boxes);
  return options.container ? *options.container : geometry::container_around(around);
}

/// A function of the user as the lower level asks it.
class CalledShape final : public tracing::Shape {
public:
  CalledShape(const std::function<double(Vec2)>& function, std::string name)
      : function_(function), what_("the function of the part '" + std::move(name) + "'") {}
  double signed_distance(Vec2 p) const override { return called(function_, p, what_); }

private:
  const std::function<double(Vec2)>& function_;
  std::string what_;
};

shape::Part build_part(const UsedPart& part, const geometry::Frame& frame) {
  const std::string& name = part.node->name;
  if (const auto* rectangle = std::get_if<RectangleForm>(&part.node->form))
    return shape::Part::rectangle(name, rectangle->box, frame);
  if (const auto* circle = std::get_if<CircleForm>(&part.node->form))
    return shape::Part::circle(name, circle->center, circle->radius, frame);
  if (const auto* function = std::get_if<FunctionForm>(&part.node->form))
    return shape::traced_part(name, CalledShape(function->distance, name), frame);
  return shape::Part::contour(name, part.contour, {}, frame);
}

void check_inner_name(const std::string& name, const char* what, std::set<std::string>& names) {
  if (name.empty())
    throw ConfigError(fmt::format("a {} in MeshOptions has no name", what));
  if (!names.insert(name).second)
    throw ConfigError(fmt::format("two {}s in MeshOptions are called '{}': expected a name for each", what, name));
}

/// @throws ConfigError for names, GeometryError for curves
shape::InnerParts inner_parts(const MeshOptions& options, const geometry::Frame& frame) {
  shape::InnerParts inner;
  std::set<std::string> regions{options.rest}, curves;
  for (const Region& region : options.regions) {
    check_inner_name(region.name, "region", regions);
    inner.division.regions.push_back({region.name, region.shape.text()});
  }
  inner.division.rest = options.rest;
  inner.division.cover_all = options.regions_cover_all;
  for (const Curve& curve : options.curves) {
    check_inner_name(curve.name, "curve", curves);
    std::vector<shape::CurveLine> lines;
    for (const std::vector<Vec2>& line : curve.lines) {
      const bool closed = line.size() > 2 && line.front() == line.back();
      lines.push_back({{line.begin(), line.end() - (closed ? 1 : 0)}, closed});
    }
    inner.curves.push_back(shape::Part::curve(curve.name, std::move(lines), frame));
    inner.clip.push_back(curve.clip ? 1 : 0);
    inner.kinds.push_back({curve.split});
  }
  return inner;
}

std::vector<geometry::FixedPoint> fixed_points_of(const MeshOptions& options) {
  std::vector<geometry::FixedPoint> points;
  for (std::size_t k = 0; k < options.fixed_points.size(); ++k)
    points.push_back({options.fixed_points[k], fmt::format("MeshOptions::fixed_points[{}]", k)});
  return points;
}

} // namespace

geometry::Domain build_domain(const Shape& shape, const MeshOptions& options, const comm::Communicator& comm,
                              Log& log) {
  std::vector<UsedPart> used;
  comm::run_agreed(comm, [&] {
    collect(shape, used);
    for (const Region& region : options.regions)
      collect(region.shape, used);
  });
  read_contours(used, comm);
  std::optional<geometry::Domain> domain;
  std::vector<std::string> warnings;
  comm::run_agreed(comm, [&] {
    const Box container = container_of(shape, options, used);
    check_box(container, "MeshOptions::container");
    const geometry::Frame frame(container, options.periodic_x, options.periodic_y);
    std::vector<shape::Part> parts;
    for (const UsedPart& part : used) {
      parts.push_back(build_part(part, frame));
      warnings.insert(warnings.end(), parts.back().warnings().begin(), parts.back().warnings().end());
    }
    domain = shape::domain_of(std::move(parts), shape.text(), frame, inner_parts(options, frame));
    domain->set_fixed_points(fixed_points_of(options));
  });
  for (const std::string& warning : warnings)
    log.warning("{}", warning);
  return std::move(*domain);
}

} // namespace trime
