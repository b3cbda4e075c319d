// SPDX-License-Identifier: BSD-3-Clause
#include "app/shape_builder.hpp"

#include "app/inside_builder.hpp"
#include "boundary/rules.hpp"
#include "comm/agree.hpp"
#include "contours/faults.hpp"
#include "contours/map_features.hpp"
#include "contours/ring_repair.hpp"
#include "core/read_file.hpp"
#include "fitting/points_of_length.hpp"
#include "trime/shape/region_shape.hpp"
#include "trime/shape/traced_part.hpp"
#include "trime/tracing/shape.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>

namespace trime::app {
namespace {

// [h] Where nothing is simplified, rings that touch are separated by this: triangles around the gap are about as small.
constexpr double kept_gap = 0.1;
// [h] Faces between regions that are narrower belong to the region next to them. Not measured.
constexpr double narrowest_face = 0.1;
// [mean h] Where the size varies, it may be so small at a face. Not measured.
constexpr double least_local_size = 0.1;
// [h] Gaps between united polygons that are narrower are closed: they come from polygons that were digitised one by
// one. Not measured.
constexpr double closed_gap = 0.01;

std::string hint_of(bool is_relative) {
  return is_relative ? " (relative to the config file, not to the working directory)" : "";
}

/// @throws ConfigError if it cannot be parsed
shape::Region region_of(const RunOptions& options) {
  std::vector<std::string> names;
  for (const PartOptions& part : options.parts)
    names.push_back(part.name);
  return shape::Region::parse(options.geometry, names);
}

/// Returns the options without the parts that nothing depends on, which may lie anywhere: the config has warned of
/// them. @throws ConfigError if the region cannot be parsed
RunOptions with_used_parts(const RunOptions& options) {
  std::vector<std::string> names;
  for (const PartOptions& part : options.parts)
    names.push_back(part.name);
  const std::vector<int> in_shape = region_of(options).parts();
  std::set<int> found(in_shape.begin(), in_shape.end());
  for (const RegionOptions& region : options.regions) {
    if (!region.file.empty())
      continue;
    const std::vector<int> in_region = shape::Region::parse(region.geometry, names).parts();
    found.insert(in_region.begin(), in_region.end());
  }
  RunOptions used = options;
  used.parts.clear();
  for (int k = 0; k < static_cast<int>(options.parts.size()); ++k) {
    const PartOptions& part = options.parts[static_cast<std::size_t>(k)];
    const auto follows = [&](const auto& inside) { return inside.normalize_with == part.name; };
    if (found.contains(k) || part.name == options.fixed_points.normalize_with ||
        std::any_of(options.curves.begin(), options.curves.end(), follows) ||
        std::any_of(options.regions.begin(), options.regions.end(), follows) || part.name == shape::domain_name)
      used.parts.push_back(part);
  }
  return used;
}

contours::Faults faults_of(const PartOptions& part) {
  return part.repair ? contours::Faults::repair : contours::Faults::collect;
}

/// Reads the lines of all curves, then the polygons of all regions that have a file.
void read_inner_files(const RunOptions& options, std::span<contours::Contour> contours) {
  for (std::size_t k = 0; k < options.curves.size(); ++k) {
    const CurveOptions& curve = options.curves[k];
    contours[k] = contours::read_curves(
        curve.file, fmt::format("; 'file' in [curve.{}]{}", curve.name, hint_of(curve.file_is_relative)),
        curve.attribute);
  }
  for (std::size_t k = 0; k < options.regions.size(); ++k)
    if (const RegionOptions& region = options.regions[k]; !region.file.empty())
      contours[options.curves.size() + k] = contours::read_regions(
          region.file, fmt::format("; 'file' in [region.{}]{}", region.name, hint_of(region.file_is_relative)),
          region.attribute);
}

/// Removes the warnings about the inside of a file which regions or curves read.
void drop_inner_warnings(const RunOptions& options, const std::string& file, contours::Contour& contour) {
  const auto reads = [&](const auto& one) { return one.file == file; };
  if (std::ranges::none_of(options.regions, reads) && std::ranges::none_of(options.curves, reads))
    return;
  std::erase_if(contour.warnings, [&](const std::string& warning) {
    return std::ranges::find(contour.inner_warnings, warning) != contour.inner_warnings.end();
  });
}

/// The rings of parts that are contours, by part, projected. Rank 0 reads. Collective.
std::vector<contours::Contour> read_contours(const RunOptions& options, const comm::Communicator& comm, Log& log,
                                             MapSystem& map) {
  std::vector<contours::Contour> contours(options.parts.size() + options.curves.size() +
                                          options.regions.size()); // in this order
  comm::run_agreed(comm, [&] {
    if (!comm.is_root())
      return;
    for (std::size_t k = 0; k < options.parts.size(); ++k)
      if (const PartOptions& part = options.parts[k]; part.type == "contour")
        contours[k] = contours::read_contour(
            part.file, fmt::format("; 'file' in [shape.{}]{}", part.name, hint_of(part.file_is_relative)),
            part.attribute, faults_of(part));
    for (std::size_t k = 0; k < options.parts.size(); ++k)
      drop_inner_warnings(options, options.parts[k].file, contours[k]);
    for (std::size_t k = 0; k < options.parts.size(); ++k)
      if (options.parts[k].dissolve && !contours[k].is_map)
        throw ConfigError(fmt::format("{}: 'overlap = union' in [shape.{}] unites the polygons of a map; expected a "
                                      ".geojson or .shp, found a file of another type",
                                      contours[k].source, options.parts[k].name));
    for (std::size_t k = 0; k < options.parts.size(); ++k)
      if (options.parts[k].repair) {
        contours::repair_rings(contours[k]);
        contours::check_reading(contours[k], contours::Faults::repair, "rings with an area");
      }
    read_inner_files(options, std::span(contours).subspan(options.parts.size()));
    map = project_contours(options, contours, log);
  });
  if (comm.size() > 1)
    for (contours::Contour& contour : contours) {
      const std::string bytes = comm.broadcast(comm.is_root() ? contours::to_bytes(contour) : std::string());
      if (!comm.is_root())
        contour = contours::contour_of_bytes(bytes);
    }
  for (std::string* text : {&map.crs, &map.well_known_text, &map.crs_of_files})
    *text = comm.broadcast(std::move(*text));
  return contours;
}

geometry::Box box_of(const PartOptions& part, const contours::Contour& contour) {
  const geometry::Vec2 radius{part.radius, part.radius};
  geometry::Box box;
  if (part.type == "rectangle")
    box = part.box;
  else if (part.type == "circle")
    box = {part.center - radius, part.center + radius};
  else if (part.type == "triangle")
    for (const geometry::Vec2 corner : part.corners)
      box.include(corner);
  for (const contours::ContourRing& ring : contour.rings)
    for (const geometry::Vec2 p : ring.points)
      box.include(p);
  return box;
}

/// The container where the options give no side.
geometry::Box automatic_container(const RunOptions& options, std::span<const contours::Contour> contours) {
  std::vector<geometry::Box> boxes;
  for (std::size_t k = 0; k < options.parts.size(); ++k) {
    const PartOptions& part = options.parts[k];
    boxes.push_back(part.type == "expression" || part.normalize ? geometry::unit_square : box_of(part, contours[k]));
  }
  boxes.push_back(geometry::unit_square); // the domain
  return geometry::container_around(region_of(options).box(boxes));
}

/// The size of the triangles before anything is known of the shape.
double estimated_size(const RunOptions& options, const geometry::Box& container) {
  return options.mesh.edge_length.value_or(fitting::estimated_size(
      container.width() * container.height(), 0, static_cast<double>(options.mesh.points.value_or(1000))));
}

/// How rings of a contour that touch are separated, and gaps between united polygons closed, at the size h of the
/// triangles.
shape::TouchOptions touch_options(const RunOptions& options, const PartOptions& part, bool outside,
                                  const geometry::Box& container) {
  const boundary::FeatureOptions& features = options.mesh.features;
  const double h = estimated_size(options, container);
  const bool keeps_all = features.keep_all || !(features.within > 0); // nothing widens a gap later
  return {.outside = outside,
          .dissolve = part.dissolve,
          .gap = keeps_all ? kept_gap * h : 0,
          .faults = faults_of(part),
          .widest_gap = features.keep_all ? 0 : closed_gap * h};
}

/// @param contour of a part that is one @param place what its vertices undergo
shape::Part build_part(const PartOptions& part, const contours::Contour& contour, const contours::Normalization& place,
                       const geometry::Frame& frame, const shape::TouchOptions& touches) {
  if (part.type == "rectangle")
    return shape::Part::rectangle(part.name, part.box, frame);
  if (part.type == "circle")
    return shape::Part::circle(part.name, part.center, part.radius, frame);
  if (part.type == "triangle")
    return shape::Part::triangle(part.name, part.corners, frame);
  if (part.type == "expression") {
    const Formula sdf(part.sdf, fmt::format("'sdf' in [shape.{}]", part.name));
    return shape::traced_part(part.name, tracing::ExpressionShape(sdf), frame);
  }
  return shape::Part::contour(part.name, contour, place, frame, touches);
}

/// Sets which faces between regions are too small for the triangles.
void set_least_faces(const RunOptions& options, const geometry::Box& container, shape::Division& division) {
  const boundary::FeatureOptions& features = options.mesh.features;
  if (features.keep_all || !(features.within > 0))
    return;
  const bool is_uniform = options.sizing.type == "uniform" && options.sizing.size_at.empty() &&
                          std::ranges::none_of(options.regions, [](const RegionOptions& region) {
                            return region.size.has_value() || region.area_limits;
                          });
  const double length = length_of(options).length;
  const double h = (length > 0 ? length : estimated_size(options, container)) * (is_uniform ? 1 : least_local_size);
  division.least_perimeter = boundary::BoundaryRules::least_perimeter * h;
  division.least_width = narrowest_face * h;
}

void tell_of(const shape::Part& part, Log& log) {
  for (const std::string& warning : part.warnings())
    log.warning("{}", warning);
  if (const shape::Polygon* polygon = part.as_polygon())
    for (const std::string& note : polygon->notes)
      log.summary("{}", note);
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

namespace {

/// Makes parts from contours, one after the other, and keeps what messages and other files need of them.
class PartsMaker {
public:
  PartsMaker(const RunOptions& options, const geometry::Frame& frame, bool keeps_places, Log& log)
      : options_(options), frame_(frame), region_(region_of(options)), keeps_places_(keeps_places), log_(log) {}

  /// @param k number of the part @param contour of the part if it is one; it is freed
  void add_part(std::size_t k, contours::Contour& contour) {
    const PartOptions& part = options_.parts[k];
    contours::Normalization place;
    if (part.normalize)
      place = contours::fit_to_container(contour, frame_.container());
    parts.push_back(
        build_part(part, contour, place, frame_,
                   touch_options(options_, part, region_.subtracts(static_cast<int>(k)), frame_.container())));
    if (part.type == "contour" && keeps_places_)
      found.add(contour, place);
    contour = {};
    places[part.name] = place;
    if (part.normalize)
      normalized.push_back({part.name, part.file, place.scale, place.to - place.scale * place.from});
    tell_of(parts.back(), log_);
  }

  /// Notes the contour of a curve or a region that is normalised with a part. Returns its place. @pre all parts were
  /// added
  contours::Normalization place_of(const std::string& part, const contours::Contour& contour) {
    const contours::Normalization place = part.empty() ? contours::Normalization{} : places.at(part);
    if (keeps_places_ && !contour.rings.empty())
      found.add(contour, place);
    return place;
  }

  std::vector<shape::Part> parts;
  std::map<std::string, contours::Normalization> places; // by name of the part
  std::vector<NormalizedPart> normalized;
  UserPlaces found;

private:
  const RunOptions& options_;
  const geometry::Frame& frame_;
  const shape::Region region_;
  const bool keeps_places_;
  Log& log_;
};

} // namespace

/// All ranks build the same shape from the same numbers, so they throw the same errors without asking each other.
ShapeInput read_shape(const RunOptions& given, ShapeUse use, const comm::Communicator& comm, Log& log,
                      UserPlaces& places) {
  const RunOptions options = with_used_parts(given);
  MapSystem map;
  std::vector<contours::Contour> contours = read_contours(options, comm, log, map);
  const geometry::Frame frame(options.container_is_automatic ? automatic_container(options, contours)
                                                             : options.container,
                              options.periodic_x, options.periodic_y);
  PartsMaker made(options, frame, comm.is_root(), log); // messages of the parts speak of their files already
  for (std::size_t k = 0; k < options.parts.size(); ++k)
    made.add_part(k, contours[k]);
  InsideBuilder inside(frame, log);
  for (std::size_t k = 0; k < options.curves.size(); ++k) {
    const contours::Contour& contour = contours[options.parts.size() + k];
    inside.add_curve(options.curves[k], contour, made.place_of(options.curves[k].normalize_with, contour));
  }
  for (std::size_t k = 0; k < options.regions.size(); ++k) {
    const contours::Contour& contour = contours[options.parts.size() + options.curves.size() + k];
    inside.add_region(options.regions[k], contour, made.place_of(options.regions[k].normalize_with, contour));
  }
  inside.parts.division.rest = options.rest;
  inside.parts.division.cover_all = options.regions_cover_all;
  if (!frame.periods().any())
    set_least_faces(options, frame.container(), inside.parts.division);
  if (!map.crs.empty())
    made.found.set_on_earth([map](geometry::Vec2 place) { return on_earth(map, place); });
  places = std::move(made.found);
  ShapeInput input{{},
                   {},
                   made.places[options.fixed_points.normalize_with],
                   std::move(made.normalized),
                   std::move(map),
                   std::move(inside.bounds)};
  if (use == ShapeUse::queries)
    input.shape.emplace(std::move(made.parts), options.geometry, frame, inside.parts);
  else
    input.alone.emplace(shape::domain_of(std::move(made.parts), options.geometry, frame, inside.parts));
  tell_of_inside(input.domain(), log);
  return input;
}

std::vector<geometry::FixedPoint> read_fixed_points(const RunOptions& options, const ShapeInput& input,
                                                    const comm::Communicator& comm) {
  const FixedPointsFile& source = options.fixed_points;
  if (source.file.empty())
    return {};
  contours::Contour read; // one list of points, on its way to all ranks
  read.source = source.file;
  read.crs = input.map.crs_of_files;
  comm::run_agreed(comm, [&] {
    if (!comm.is_root())
      return;
    contours::ContourRing& list = read.rings.emplace_back();
    for (const contours::FilePoint& point :
         contours::parse_points(read_file(source.file, hint_of(source.file_is_relative)), source.file)) {
      list.points.push_back(point.position);
      list.lines.push_back(point.line);
    }
    if (!options.projection.empty())
      project_contour(read, input.map.crs);
  });
  read = contours::contour_of_bytes(comm.broadcast(contours::to_bytes(read)));
  std::vector<geometry::FixedPoint> points;
  for (std::size_t k = 0; k < read.rings[0].points.size(); ++k)
    points.push_back({input.fixed_points_place.apply(read.rings[0].points[k]),
                      fmt::format("{}:{}", source.file, read.rings[0].lines[k])});
  return points;
}

meshing::MeshOptions placed_options(const RunOptions& options, const ShapeInput& input,
                                    const comm::Communicator& comm) {
  meshing::MeshOptions mesh = options.mesh;
  if (mesh.features.components != boundary::Components::at)
    return mesh;
  contours::Contour read; // one point, on its way to all ranks
  read.source = "'components' in [meshing]";
  read.crs = input.map.crs_of_files;
  read.rings.emplace_back().points.push_back(mesh.features.component_place);
  read.rings.back().lines.push_back(0);
  comm::run_agreed(comm, [&] {
    if (comm.is_root() && !options.projection.empty())
      project_contour(read, input.map.crs);
  });
  read = contours::contour_of_bytes(comm.broadcast(contours::to_bytes(read)));
  geometry::Vec2& place = mesh.features.component_place = read.rings[0].points[0];
  if (input.normalized.size() > 1)
    throw ConfigError(
        "components = at X Y: several contours are normalised, each by its own scale, so a place of the files "
        "is not unique; expected one such contour, or normalize = false");
  if (input.normalized.size() == 1)
    place = input.normalized[0].scale * place + input.normalized[0].shift;
  return mesh;
}

} // namespace trime::app
