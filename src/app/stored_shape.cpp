// SPDX-License-Identifier: BSD-3-Clause
#include "app/stored_shape.hpp"

#include "app/config.hpp"
#include "app/field_builder.hpp"
#include "app/size_builder.hpp"
#include "app/user_places.hpp"
#include "meshing/meshed_curves.hpp"
#include "trime/core/error.hpp"
#include "trime/core/log.hpp"

#include <algorithm>
#include <cmath>

namespace trime::app {
namespace {

// Relative difference of areas that are the same except for rounding by another compiler. Any change of a contour that
// a mesh could show is larger.
constexpr double same_area = 1e-12;

/// Why the shape is not the one that was meshed; empty: it is.
std::string difference(const io::Metadata& metadata, const geometry::Boundary& boundary) {
  const auto& names = io::column_of<std::string>(metadata, "tags", "part_name");
  if (names != boundary.part_names)
    return fmt::format("its shape had {} parts, but the files that its config names now give {} parts or other names",
                       names.size(), boundary.part_names.size());
  const double area = io::attribute_of<double>(metadata, "given_area");
  if (std::fabs(area - boundary.area) > same_area * area)
    return fmt::format("the files that its config names have changed: its shape had the area {:.15g}, now the area "
                       "is {:.15g}",
                       area, boundary.area);
  if (io::attribute_of<double>(metadata, "period_x") != boundary.periods.x ||
      io::attribute_of<double>(metadata, "period_y") != boundary.periods.y)
    return "the periods of its container are not those of its config";
  return {};
}

/// Does the mesh follow a simplified boundary?
bool is_simplified(const io::Metadata& metadata) {
  if (!io::find_group(metadata, "rings"))
    return true; // a step of a run
  const auto& states = io::column_of<std::string>(metadata, "rings", "state");
  return std::ranges::any_of(states, [](const std::string& state) { return state != "kept"; });
}

/// Returns the curves of the run. Collective.
geometry::Boundary simplified_curves(const RunOptions& options, ShapeInput& input, const comm::Communicator& comm) {
  input.set_fixed_points(read_fixed_points(options, input, comm));
  const std::vector<BuiltField> fields = read_fields(options, input, comm);
  const BuiltSize size = build_size(options, input.domain(), comm, input.bounds, fields);
  return meshing::meshed_curves(comm, input.domain(), *size.field, placed_options(options, input, comm));
}

} // namespace

StoredShape stored_shape(const io::Metadata& metadata, const std::string& path, const comm::Communicator& comm) {
  StoredShape stored;
  const auto config = std::ranges::find(metadata.texts, "config_resolved", &io::Text::name);
  if (config == metadata.texts.end()) {
    stored.reason = "the file stores no config, because a program made it with the library";
    return stored;
  }
  try { // all ranks throw together
    const RunOptions options = parse_config(config->text, path + ": config", {});
    stored.vtkhdf = options.output.file.vtkhdf;
    stored.xdmf = options.output.file.xdmf;
    stored.cells = options.output.wants(formats::Format::voronoi);
    Log quiet(LogLevel::error, comm.is_root());
    UserPlaces places;
    stored.input = read_shape(options, ShapeUse::boundary, comm, quiet, places);
    stored.reason = difference(metadata, stored.input->boundary());
    if (stored.reason.empty() && is_simplified(metadata))
      stored.simplified = simplified_curves(options, *stored.input, comm);
  } catch (const Error& error) {
    stored.reason = error.what();
  }
  if (!stored.reason.empty())
    stored.input.reset();
  return stored;
}

} // namespace trime::app
