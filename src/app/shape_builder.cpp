// SPDX-License-Identifier: BSD-3-Clause
#include "app/shape_builder.hpp"

#include "trime/comm/agree.hpp"
#include "trime/core/read_file.hpp"
#include "trime/geometry/expression_shape.hpp"

namespace trime::app {
namespace {

/// Contour text on every rank; the reader of the geometry refuses formats that it does not know.
std::string read_contour(const PartOptions& part, const comm::Communicator& comm) {
  std::string text;
  comm::run_agreed(comm, [&] {
    if (comm.is_root())
      text = geometry::read_contour_text(
          part.file, part.file_is_relative ? " (relative to the config file, not to the working directory)" : "");
  });
  return comm.broadcast(std::move(text));
}

geometry::Part build_part(const PartOptions& part, const geometry::Frame& frame, const comm::Communicator& comm) {
  if (part.type == "rectangle")
    return geometry::Part::rectangle(part.name, part.box, frame);
  if (part.type == "circle")
    return geometry::Part::circle(part.name, part.center, part.radius, frame);
  if (part.type == "triangle")
    return geometry::Part::triangle(part.name, part.corners, frame);
  if (part.type == "expression") {
    const Formula sdf(part.sdf, fmt::format("'sdf' in [shape.{}]", part.name));
    return geometry::Part::implicit(part.name, geometry::ExpressionShape(sdf), frame);
  }
  const geometry::Contour contour = geometry::parse_xy(read_contour(part, comm), part.file);
  const geometry::Normalization place =
      part.normalize ? geometry::fit_to_container(contour, frame.container()) : geometry::Normalization{};
  return geometry::Part::contour(part.name, contour, place, frame);
}

} // namespace

std::string read_shared(const std::string& path, const comm::Communicator& comm) {
  std::string text;
  comm::run_agreed(comm, [&] {
    if (comm.is_root())
      text = read_file(path);
  });
  return comm.broadcast(std::move(text));
}

/// All ranks build the same shape from the same numbers, so they throw the same errors without asking each other.
geometry::RegionShape build_shape(const RunOptions& options, const comm::Communicator& comm, Log& log) {
  const geometry::Frame frame(options.mesh.container, options.mesh.periodic_x, options.mesh.periodic_y);
  std::vector<geometry::Part> parts;
  for (const PartOptions& part : options.parts) {
    parts.push_back(build_part(part, frame, comm));
    for (const std::string& warning : parts.back().warnings())
      log.warning("{}", warning);
  }
  return geometry::RegionShape(std::move(parts), options.region, frame);
}

} // namespace trime::app
