// SPDX-License-Identifier: BSD-3-Clause
#include "shape.hpp"

#include "contour_files.hpp"
#include "outline.hpp"
#include "plane.hpp"
#include "report.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <iterator>
#include <limits>

namespace trime_check {
namespace {

// Constants from the documentation of the config (configs/shapes.md).
constexpr double normalized_share = 0.8; // [shorter side of the container] longer side of a normalised contour
constexpr double bend = 1e-6;       // [longer side of all contours] edges of maps are divided until they follow so far
constexpr double closed_gap = 0.01; // [edge length] gaps between united polygons that are narrower are closed
constexpr double margin = 0.05;     // [longer side of the shape] around it, where the container is automatic
constexpr Box unit_square{{0, 0}, {1, 1}};
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double box_slack = 1e-12; // [longer side of the container] rounding of what lies in a curve

namespace index = boost::geometry::index;
using PlaceBox = boost::geometry::model::box<boost::geometry::model::d2::point_xy<double>>;

/// Centres the box of the rings in the container.
class Normalisation {
public:
  Normalisation(const Box& rings, const Box& container)
      : from_{(rings.min.x + rings.max.x) / 2, (rings.min.y + rings.max.y) / 2},
        to_{(container.min.x + container.max.x) / 2, (container.min.y + container.max.y) / 2},
        scale_(normalized_share * std::fmin(container.max.x - container.min.x, container.max.y - container.min.y) /
               std::fmax(rings.max.x - rings.min.x, rings.max.y - rings.min.y)) {}
  Point apply(Point p) const { return {to_.x + scale_ * (p.x - from_.x), to_.y + scale_ * (p.y - from_.y)}; }
  std::vector<Ring> apply(std::vector<Ring> rings) const {
    for (Ring& ring : rings)
      for (Point& p : ring)
        p = apply(p);
    return rings;
  }

private:
  Point from_, to_;
  double scale_;
};

/// One part of the config, before the container is known.
struct Source {
  std::string name, type, reason;
  std::vector<Ring> rings; // of all but circles
  Point center;
  double radius = 0;
  bool normalised = false, has_names = false, bent = false, united = false;
  std::string crs; // of a contour, as in its file
  std::vector<Point> crossings = {};

  Box box() const {
    return type == "circle" ? Box{{center.x - radius, center.y - radius}, {center.x + radius, center.y + radius}}
                            : box_of(rings);
  }
};

bool is_projected(const ConfigText& config) {
  return config.has("shape", "projection");
}

/// Reads the rings of a contour, unites or repairs them, and projects them if the config says so.
void read_rings_of(const ConfigText& config, const std::string& path, const std::string& plane, Source& part) {
  const std::string section = "shape." + part.name;
  const bool repaired = config.is_true(section, "repair");
  part.united = config.value(section, "overlap") == "union";
  ContourRings found = read_contour(path, repaired ? OpenLines::leave_out : OpenLines::refuse);
  part.rings = std::move(found.rings);
  part.reason = std::move(found.reason);
  part.crs = std::move(found.crs);
  if (!part.reason.empty())
    return;
  const DateLine date_line = is_projected(config) ? unroll(part.rings, part.crs) : DateLine::free;
  if (date_line == DateLine::closed) {
    part.reason = fmt::format("{}: trime_check joins polygons at the date line only if another meridian is free", path);
    return;
  }
  if (part.united || repaired || date_line == DateLine::unrolled) {
    const std::vector<Ring> given = std::move(part.rings);
    part.rings = outline(given, part.united ? found.polygon : std::vector<int>(given.size(), 0));
    part.crossings = new_vertices(part.rings, given);
  }
  if (!is_projected(config))
    return;
  if (std::optional<std::vector<Point>> places = project(part.crossings, part.crs, plane))
    part.crossings = std::move(*places);
  ProjectedRings projected = project(part.rings, part.crs, plane);
  part.rings = std::move(projected.rings);
  part.bent = projected.bent;
  if (!projected.reason.empty())
    part.reason = fmt::format("{}: {}", path, projected.reason);
}

Source read_part(const ConfigText& config, const std::string& name, const std::string& plane) {
  const std::string section = "shape." + name;
  Source part{name, config.value(section, "type"),        "",    {},    {},
              0,    config.is_true(section, "normalize"), false, false, false,
              ""};
  const auto number = [&](const char* key) {
    if (const std::optional<double> value = config.number(section, key))
      return *value;
    throw Failure(ExitCode::usage, fmt::format("the config must have a number for the key '{}' in [{}]", key, section));
  };
  if (part.type == "rectangle")
    part.rings = rectangle({{number("x_min"), number("y_min")}, {number("x_max"), number("y_max")}});
  else if (part.type == "triangle")
    part.rings = {{config.point(section, "p0"), config.point(section, "p1"), config.point(section, "p2")}};
  else if (part.type == "circle") {
    part.center = config.point(section, "center");
    part.radius = number("radius");
  } else if (part.type == "contour") {
    const std::string path = config.path(section, "file");
    part.has_names = !path.ends_with(".xy");
    read_rings_of(config, path, plane, part);
  } else
    part.reason = fmt::format("trime_check cannot compute the curve of a part of type '{}'", part.type);
  return part;
}

Box joined(const Box& a, const Box& b) {
  return {{std::min(a.min.x, b.min.x), std::min(a.min.y, b.min.y)},
          {std::max(a.max.x, b.max.x), std::max(a.max.y, b.max.y)}};
}

Box common(const Box& a, const Box& b) {
  return {{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y)},
          {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y)}};
}

/// A box of a region from those of its parts.
Box region_box(const Region& region, const std::vector<Box>& parts) {
  const std::vector<Region::Node>& nodes = region.nodes();
  std::vector<Box> boxes(nodes.size());
  std::vector<char> begun(nodes.size(), 0);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (nodes[k].kind == Region::Kind::part)
      boxes[k] = parts[nodes[k].part];
    const std::size_t parent = nodes[k].parent;
    if (parent == Region::none)
      continue;
    if (!begun[parent])
      boxes[parent] = boxes[k];
    else if (nodes[parent].kind == Region::Kind::unite)
      boxes[parent] = joined(boxes[parent], boxes[k]);
    else if (nodes[parent].kind == Region::Kind::intersect)
      boxes[parent] = common(boxes[parent], boxes[k]);
    begun[parent] = 1;
  }
  return boxes.back();
}

/// Returns the unit square if the shape fits into it, or does not say how large it is. Returns nothing if a contour
/// that is not read would decide.
std::optional<Box> container_of(const ConfigText& config, const std::vector<Source>& parts, const Region& region) {
  Box box = unit_square;
  bool is_given = config.is_true("domain", "periodic_x") || config.is_true("domain", "periodic_y");
  for (const auto& [key, side] : {std::pair{"x_min", &box.min.x}, std::pair{"x_max", &box.max.x},
                                  std::pair{"y_min", &box.min.y}, std::pair{"y_max", &box.max.y}})
    if (const std::optional<double> given = config.number("domain", key)) {
      *side = *given;
      is_given = true;
    }
  if (is_given)
    return box;
  for (const Source& part : parts)
    if (part.type == "contour" && !part.normalised && !part.reason.empty())
      return std::nullopt;
  std::vector<Box> boxes;
  for (const Source& part : parts)
    boxes.push_back(part.normalised || !part.reason.empty() ? unit_square : part.box());
  boxes.push_back(unit_square); // `domain`
  const Box found = region_box(region, boxes);
  const double side = margin * std::fmax(found.max.x - found.min.x, found.max.y - found.min.y);
  const bool fits = found.min.x >= 0 && found.min.y >= 0 && found.max.x <= 1 && found.max.y <= 1;
  return fits || !(side > 0) ? unit_square
                             : Box{{found.min.x - side, found.min.y - side}, {found.max.x + side, found.max.y + side}};
}

/// The smallest power of two that is 2^-44 of the longer side and 2^-51 of the largest coordinate, at least.
double lattice_step(const Shape& shape) {
  const Box& box = shape.container;
  const double extent =
      std::max({std::fabs(box.min.x), std::fabs(box.min.y), std::fabs(box.max.x), std::fabs(box.max.y)});
  int exponent = 0;
  std::frexp(std::max(shape.side() * 0x1p-44, extent * 0x1p-51), &exponent);
  return std::ldexp(1.0, exponent);
}

} // namespace

struct PartFinder::Tree {
  index::rtree<std::pair<PlaceBox, std::size_t>, index::rstar<16>> boxes;
};

PartFinder::PartFinder(const std::vector<Part>& parts) : tree_(std::make_unique<Tree>()) {
  std::vector<std::pair<PlaceBox, std::size_t>> boxes;
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (parts[k].curve) {
      const Box box = parts[k].curve->box();
      boxes.emplace_back(PlaceBox({box.min.x, box.min.y}, {box.max.x, box.max.y}), k);
    }
  tree_->boxes = decltype(tree_->boxes)(boxes);
}

PartFinder::~PartFinder() = default;

std::vector<std::size_t> PartFinder::near(Point p, double reach) const {
  std::vector<std::size_t> found;
  const PlaceBox around({p.x - reach, p.y - reach}, {p.x + reach, p.y + reach});
  for (auto at = tree_->boxes.qbegin(index::intersects(around)); at != tree_->boxes.qend(); ++at)
    found.push_back(at->second);
  return found;
}

const Part* Shape::part(const std::string& name) const {
  const auto found = numbers.find(name);
  return found == numbers.end() ? nullptr : &parts[found->second];
}

std::vector<Point> Shape::images(Point p) const {
  const auto into = [](double x, double low, double period) {
    return period > 0 ? x - period * std::floor((x - low) / period) : x;
  };
  const Point inside{into(p.x, container.min.x, periods.x), into(p.y, container.min.y, periods.y)};
  std::vector<Point> images;
  for (const int i : {0, -1, 1, 2}) // 2: the upper sides belong to what lies one period on
    for (const int j : {0, -1, 1, 2})
      if ((i == 0 || periods.x > 0) && (j == 0 || periods.y > 0))
        images.push_back({inside.x + i * periods.x, inside.y + j * periods.y});
  return images;
}

double Shape::distance(const Part& part, Point p) const {
  double least = infinity;
  for (const Point image : images(p))
    least = std::min(least, part.curve->distance(image));
  return least;
}

double Shape::distance_from_any(Point p, double limit) const {
  double least = infinity;
  for (const Point image : images(p))
    for (const std::size_t number : finder->near(image, limit))
      if (region->uses(number))
        least = std::min(least, parts[number].curve->distance(image));
  return least;
}

bool Shape::meets_another(const Part& part, Point p, double limit) const {
  for (const Point image : images(p)) {
    const bool is_own = std::fabs(image.x - p.x) <= limit && std::fabs(image.y - p.y) <= limit;
    for (const std::size_t number : finder->near(image, limit))
      if ((&parts[number] != &part || !is_own) && region->uses(number) && parts[number].curve->distance(image) <= limit)
        return true;
  }
  return false;
}

bool Shape::matters(const Part& part, Point p) const {
  const auto own = static_cast<std::size_t>(&part - parts.data());
  std::vector<std::size_t> around;
  for (const Point image : images(p)) {
    const bool is_own =
        std::fabs(image.x - p.x) <= box_slack * side() && std::fabs(image.y - p.y) <= box_slack * side();
    for (const std::size_t number : finder->near(image, box_slack * side()))
      if ((number != own || !is_own) && parts[number].curve->contains(image))
        around.push_back(number);
  }
  if (std::ranges::find(around, own) != around.end()) // within an image of itself
    return false;
  for (const std::size_t number : around)
    region->set(number, true);
  const bool without = region->contains();
  region->set(own, true);
  const bool with = region->contains();
  region->set(own, false);
  for (const std::size_t number : around)
    region->set(number, false);
  return with != without;
}

bool Shape::contains(Point p) const {
  std::vector<std::size_t> around;
  for (const Point image : images(p))
    for (const std::size_t number : finder->near(image, box_slack * side()))
      if (region->uses(number) && parts[number].curve->contains(image))
        around.push_back(number);
  for (const std::size_t number : around)
    region->set(number, true);
  const bool inside = region->contains();
  for (const std::size_t number : around)
    region->set(number, false);
  return inside;
}

const Part* Shape::part_of_label(const std::string& label) const {
  if (const Part* exact = part(label))
    return exact;
  const Part* whole = part(label.substr(0, label.find('.')));
  return whole && (!whole->curve || whole->has_names) ? whole : nullptr;
}

namespace {

/// Sets container, lattice and periods. @param mesh its box is the container if that is not known
void set_container(Shape& shape, const ConfigText& config, const std::vector<Source>& sources,
                   const std::vector<Point>& mesh) {
  const std::optional<Box> container = container_of(config, sources, *shape.region);
  shape.container = container ? *container : box_of({mesh});
  if (!container)
    shape.container_reason = "it depends on a contour that trime_check cannot read";
  shape.step = lattice_step(shape);
  const auto period = [&](const char* key, double side) {
    return config.is_true("domain", key) ? std::round(side / shape.step) * shape.step : 0;
  };
  shape.periods = {period("periodic_x", shape.container.max.x - shape.container.min.x),
                   period("periodic_y", shape.container.max.y - shape.container.min.y)};
}

/// The fixed points as their file has them, or projected.
/// @param from reference system of the file
void read_fixed_points(Shape& shape, const ConfigText& config, const std::string& from, const std::string& plane) {
  const std::string points = config.path("meshing", "fixed_points");
  if (points.empty())
    return;
  const std::optional<std::string> text = read_text(points);
  if (!text)
    shape.fixed_points_reason = fmt::format("{} cannot be read", points);
  if (text)
    for (const Ring& ring : read_rings(*text + "\n"))
      shape.fixed_points.insert(shape.fixed_points.end(), ring.begin(), ring.end());
  if (!is_projected(config))
    return;
  if (std::optional<std::vector<Point>> projected = project(shape.fixed_points, from, plane))
    shape.fixed_points = std::move(*projected);
  else
    shape.fixed_points_reason = fmt::format("{}: a point has no place in the plane of the mesh", points);
}

/// Reference system of the first contour.
std::string crs_of(const std::vector<Source>& sources) {
  const auto contour = std::ranges::find(sources, "contour", &Source::type);
  return contour == sources.end() ? std::string() : contour->crs;
}

/// @pre the parts begin with those of the sources
void set_bends(Shape& shape, const std::vector<Source>& sources) {
  std::vector<Ring> all;
  for (const Source& source : sources)
    if (source.type == "contour")
      all.insert(all.end(), source.rings.begin(), source.rings.end());
  const Box box = box_of(all);
  for (std::size_t k = 0; k < sources.size(); ++k)
    if (sources[k].bent)
      shape.parts[k].bend = bend * std::max(box.max.x - box.min.x, box.max.y - box.min.y);
}

/// Appends the part of a source, and normalises the fixed points if they go with it.
void add_part(Shape& shape, const Source& source, bool has_fixed_points) {
  Part part{source.name, nullptr, source.reason, 0, source.crossings, source.has_names};
  std::vector<Ring> rings = source.rings;
  if (source.normalised && source.reason.empty()) {
    const Normalisation fit(source.box(), shape.container);
    rings = fit.apply(rings);
    if (has_fixed_points)
      for (Point& p : shape.fixed_points)
        p = fit.apply(p);
  } else if (has_fixed_points)
    shape.fixed_points_reason =
        source.reason.empty() ? "the part that fixed_points_normalize_with names is not normalised" : source.reason;
  if (source.type == "circle")
    part.curve = make_circle(source.center, source.radius);
  else if (source.reason.empty())
    part.curve = make_polygon(std::move(rings));
  shape.parts.push_back(std::move(part));
}

/// Removes from united polygons the gaps that the mesher closes. Those of up to twice this width are not judged,
/// because only the program knows the edge length that it has used.
void close_gaps(const ConfigText& config, const std::vector<Point>& mesh, std::vector<Source>& sources) {
  const Box box = box_of({mesh});
  const double h = std::sqrt(2 / std::sqrt(3.0) * (box.max.x - box.min.x) * (box.max.y - box.min.y) /
                             static_cast<double>(std::max<std::size_t>(mesh.size(), 1)));
  for (Source& source : sources)
    if (source.united && !config.is_true("meshing", "keep_features"))
      drop_narrow_holes(source.rings, 2 * closed_gap * h);
}

} // namespace

Shape make_shape(const ConfigText& config, const std::vector<Point>& mesh, const std::string& plane) {
  Shape shape;
  std::string region = config.value("shape", "geometry");
  if (region.empty())
    region = config.value("shape", "region"); // the name of the key in configs of earlier versions
  if (region.empty())
    throw Failure(ExitCode::usage, "the config has no 'geometry' in [shape]");
  std::vector<Source> sources;
  for (const std::string& name : config.parts()) {
    shape.numbers.emplace(name, sources.size());
    sources.push_back(read_part(config, name, plane));
  }
  close_gaps(config, mesh, sources);
  shape.numbers.emplace("domain", sources.size());
  shape.region = std::make_unique<Region>(region, shape.numbers);
  set_container(shape, config, sources, mesh);
  read_fixed_points(shape, config, crs_of(sources), plane);
  const std::string companion = config.value("meshing", "fixed_points_normalize_with");
  for (const Source& source : sources)
    add_part(shape, source, source.name == companion);
  set_bends(shape, sources);
  shape.parts.push_back({"domain", make_container(shape.container, shape.periods), "", 0, {}, false});
  shape.finder = std::make_unique<PartFinder>(shape.parts);
  return shape;
}

} // namespace trime_check
