// SPDX-License-Identifier: BSD-3-Clause
#include "app/field_builder.hpp"

#include "comm/agree.hpp"
#include "core/angle.hpp"
#include "core/elementary.hpp"
#include "projection/projection.hpp"
#include "projection/shared_transform.hpp"
#include "trime/core/error.hpp"

#include <array>
#include <cmath>

namespace trime::app {
namespace {

using geometry::Vec2;

constexpr double metres_per_degree = 6'371'008.8 * pi / 180; // of the mean radius of the Earth

fields::FieldRequest request_of(const FieldOptions& options) {
  fields::FieldRequest request;
  request.path = options.file;
  request.variable = options.variable;
  request.hint =
      fmt::format("; 'file' in [field.{}]{}", options.name,
                  options.file_is_relative ? " (relative to the config file, not to the working directory)" : "");
  request.fill = options.fill == "error"     ? fields::Fill::refuse
                 : options.fill == "nearest" ? fields::Fill::nearest
                                             : fields::Fill::value;
  request.fill_value = options.fill_value;
  request.outside_is_nearest = options.outside_is_nearest;
  return request;
}

/// Are the coordinates of a raster longitude and latitude? Collective.
bool is_in_degrees(const FieldOptions& options, bool is_projected, const fields::FieldRequest& request,
                   const comm::Communicator& comm) {
  if (options.coordinates != "auto")
    return options.coordinates == "degrees";
  if (!is_projected)
    return false;
  const geometry::Box box = fields::raster_box(request, comm);
  return std::fabs(box.min.x) <= 361 && std::fabs(box.max.x) <= 361 && std::fabs(box.min.y) <= 91 &&
         std::fabs(box.max.y) <= 91;
}

double slope(const BuiltField& field, Vec2 place) {
  const Vec2 p = field.to_file(place), gradient = field.field->gradient(p);
  if (!field.in_metres)
    return std::sqrt(gradient.x * gradient.x + gradient.y * gradient.y);
  const fields::Axis& rows = field.field->raster().y;
  const double latitude = std::fmin(std::fmax(p.y, rows.first), rows.last()); // not at a pole, where the cosine is 0
  const double along = gradient.x / (metres_per_degree * elementary::cos(latitude * pi / 180));
  const double up = gradient.y / metres_per_degree;
  return std::sqrt(along * along + up * up);
}

/// The sides of a container as a boundary: a size may be needed everywhere in a periodic container.
geometry::Boundary sides_of(const geometry::Box& container) {
  const Vec2 low = container.min, high = container.max;
  const std::array<Vec2, 4> corners{low, {high.x, low.y}, high, {low.x, high.y}};
  geometry::Boundary sides;
  geometry::Loop& loop = sides.loops.emplace_back();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    geometry::Piece& side = loop.pieces.emplace_back();
    side.start = corners[k];
    side.end = corners[(k + 1) % corners.size()];
  }
  return sides;
}

} // namespace

std::vector<BuiltField> read_fields(const RunOptions& options, const ShapeInput& input,
                                    const comm::Communicator& comm) {
  std::vector<BuiltField> built;
  const bool is_projected = !options.projection.empty() && !input.map.crs.empty();
  const geometry::Frame& frame = input.domain().frame();
  const geometry::Boundary where = frame.periods().any() ? sides_of(frame.container()) : input.boundary();
  std::shared_ptr<const projection::DegreesOfPlane> degrees; // all fields ask it for the same places
  for (const FieldOptions& one : options.fields) {
    fields::FieldRequest request = request_of(one);
    const bool in_degrees = is_in_degrees(one, is_projected, request, comm);
    BuiltField field{one.name, nullptr, [](Vec2 p) { return p; }, in_degrees && is_projected};
    request.period = in_degrees ? 360 : 0;
    request.smooth = one.smooth;
    request.per_degree = field.in_metres ? metres_per_degree : 0;
    if (field.in_metres && !degrees)
      comm::run_agreed(comm, [&] { degrees = std::make_shared<const projection::DegreesOfPlane>(input.map.crs); });
    if (field.in_metres)
      field.to_file = [degrees](Vec2 p) { return degrees->at(p); };
    fields::ReadField read = fields::read_field(request, where, field.to_file, comm);
    field.field = std::move(read.field);
    field.hash = read.hash;
    if (one.smooth > 0 && one.smooth <= std::fmin(read.cell.x, read.cell.y))
      field.warning =
          fmt::format("'smooth = {:g}' in [field.{}] has no effect: it is a length in the unit of the mesh, "
                      "and shorter than the cells of the raster, which are {:.3g} x {:.3g}; take the length "
                      "of several cells",
                      one.smooth, one.name, read.cell.x, read.cell.y);
    built.push_back(std::move(field));
  }
  return built;
}

std::vector<FormulaField> functions_of(const std::vector<BuiltField>& fields) {
  std::vector<FormulaField> functions;
  for (const BuiltField& field : fields)
    functions.push_back({field.name,
                         [field](double x, double y) {
                           return field.field->value(field.to_file({x, y}));
                         },
                         [field](double x, double y) {
                           return slope(field, {x, y});
                         }});
  return functions;
}

std::string hashes_of(const std::vector<BuiltField>& fields) {
  std::string text = fields.empty() ? "" : "\n[hashes of data]\n";
  for (const BuiltField& field : fields)
    text += fmt::format("{} = {:016x}\n", field.name, field.hash);
  return text;
}

std::size_t bytes_of(const std::vector<BuiltField>& fields) {
  std::size_t bytes = 0;
  for (const BuiltField& field : fields)
    bytes += field.field->bytes();
  return bytes;
}

std::string description_of(const BuiltField& field) {
  const fields::Raster& raster = field.field->raster();
  return fmt::format("{} x {} values around the shape, {:.3g} MB on each rank{}", raster.x.count, raster.y.count,
                     static_cast<double>(field.field->bytes()) / 1e6,
                     raster.filled.empty() ? "" : "; some are filled with the nearest value");
}

} // namespace trime::app
