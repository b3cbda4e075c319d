// SPDX-License-Identifier: BSD-3-Clause
#include "curves.hpp"

#include "report.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/segment.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <limits>

namespace trime_check {
namespace {

// What the documentation of the config says (configs/README.md).
constexpr double normalized_share = 0.8; // [shorter side of the container] longer side of a normalised contour
constexpr double margin = 0.05;          // [longer side of the shape] around it, where the container is automatic
constexpr Box unit_square{{0, 0}, {1, 1}};
constexpr double degrees_per_radian = 57.295779513082320877;

class Circle : public Curve {
public:
  Circle(Point center, double radius) : center_(center), radius_(radius) {}
  double distance(Point p) const override { return std::fabs(std::hypot(p.x - center_.x, p.y - center_.y) - radius_); }
  bool contains(Point p) const override { return std::hypot(p.x - center_.x, p.y - center_.y) < radius_; }
  std::vector<Point> corners(double) const override { return {}; }

private:
  Point center_;
  double radius_;
};

/// Closed rings of straight sides, inside by even-odd.
class Polygon : public Curve {
public:
  explicit Polygon(std::vector<Ring> rings) : rings_(std::move(rings)) {
    std::vector<Segment> sides;
    for (const Ring& ring : rings_)
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point a = ring[k], b = ring[(k + 1) % ring.size()];
        sides.push_back({{a.x, a.y}, {b.x, b.y}});
      }
    tree_ = Tree(sides);
  }

  double distance(Point p) const override {
    const Place place(p.x, p.y);
    const auto nearest = tree_.qbegin(boost::geometry::index::nearest(place, 1));
    return nearest == tree_.qend() ? std::numeric_limits<double>::infinity()
                                   : boost::geometry::distance(place, *nearest);
  }

  bool contains(Point p) const override {
    bool inside = false;
    for (const Ring& ring : rings_)
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point a = ring[k], b = ring[(k + 1) % ring.size()];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y))
          inside = !inside;
      }
    return inside;
  }

  std::vector<Point> corners(double degrees) const override {
    std::vector<Point> found;
    for (const Ring& ring : rings_)
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point into = ring[k] - ring[(k + ring.size() - 1) % ring.size()];
        const Point out = ring[(k + 1) % ring.size()] - ring[k];
        const double turn = std::atan2(into.x * out.y - into.y * out.x, into.x * out.x + into.y * out.y);
        if (std::fabs(turn) * degrees_per_radian > degrees)
          found.push_back(ring[k]);
      }
    return found;
  }

private:
  using Place = boost::geometry::model::d2::point_xy<double>;
  using Segment = boost::geometry::model::segment<Place>;
  using Tree = boost::geometry::index::rtree<Segment, boost::geometry::index::rstar<16>>;

  std::vector<Ring> rings_;
  Tree tree_;
};

Box box_of(const std::vector<Ring>& rings) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box box{{infinity, infinity}, {-infinity, -infinity}};
  for (const Ring& ring : rings)
    for (const Point p : ring)
      box = {{std::min(box.min.x, p.x), std::min(box.min.y, p.y)},
             {std::max(box.max.x, p.x), std::max(box.max.y, p.y)}};
  return box;
}

std::vector<Ring> rectangle(const Box& box) {
  return {{box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}}};
}

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

/// What the config says of one part, before the container is known.
struct Source {
  std::string name, type, reason;
  std::vector<Ring> rings; // of all but circles
  Point center;
  double radius = 0;
  bool normalised = false;

  Box box() const {
    return type == "circle" ? Box{{center.x - radius, center.y - radius}, {center.x + radius, center.y + radius}}
                            : box_of(rings);
  }
};

Source read_part(const ConfigText& config, const std::string& name) {
  const std::string section = "shape." + name;
  Source part{name, config.value(section, "type"), "", {}, {}, 0, config.is_true(section, "normalize")};
  const auto number = [&](const char* key) {
    if (const std::optional<double> value = config.number(section, key))
      return *value;
    throw Failure(ExitCode::usage, fmt::format("the config has no number '{}' in [{}]", key, section));
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
    const std::optional<std::string> text = read_text(path);
    if (!path.ends_with(".xy") && !path.ends_with(".txt") && !path.ends_with(".dat"))
      part.reason = fmt::format("{}: only contours of 'x y' lines are read here", path);
    else if (!text)
      part.reason = fmt::format("{} cannot be read", path);
    else if (part.rings = read_rings(*text); part.rings.empty())
      part.reason = fmt::format("{} has no rings", path);
  } else
    part.reason = fmt::format("a part of type '{}' has no curve of its own", part.type);
  return part;
}

/// The unit square where the shape fits in there, or does not say how large it is. Nothing if a contour that is not
/// read would have to tell.
std::optional<Box> container_of(const ConfigText& config, const std::vector<Source>& parts, const std::string& region) {
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
  std::vector<std::pair<std::string, Box>> boxes{{"domain", unit_square}};
  for (const Source& part : parts)
    if (part.type == "contour" && !part.normalised && !part.reason.empty())
      return std::nullopt;
  for (const Source& part : parts)
    boxes.emplace_back(part.name, part.normalised || !part.reason.empty() ? unit_square : part.box());
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

const Part* Shape::part(const std::string& name) const {
  const auto found = std::ranges::find(parts, name, &Part::name);
  return found == parts.end() ? nullptr : &*found;
}

double Shape::distance(const Part& part, Point p) const {
  double least = part.curve->distance(p);
  for (const int i : {-1, 0, 1})
    for (const int j : {-1, 0, 1})
      if ((i == 0 || periods.x > 0) && (j == 0 || periods.y > 0) && (i != 0 || j != 0))
        least = std::min(least, part.curve->distance({p.x + i * periods.x, p.y + j * periods.y}));
  return least;
}

bool Shape::matters(const Part& part, Point p) const {
  std::vector<std::pair<std::string, bool>> inside;
  std::size_t own = 0;
  for (const Part& other : parts) {
    if (&other == &part)
      own = inside.size();
    inside.emplace_back(other.name, other.curve->contains(p));
  }
  inside[own].second = true;
  const bool with = evaluate_region(region, inside);
  inside[own].second = false;
  return with != evaluate_region(region, inside);
}

const Part* Shape::part_of_label(const std::string& label) const {
  if (const Part* exact = part(label))
    return exact;
  const Part* whole = part(label.substr(0, label.find('.')));
  return whole && !whole->curve ? whole : nullptr;
}

Shape make_shape(const ConfigText& config, const std::vector<Point>& mesh) {
  Shape shape;
  shape.region = config.value("shape", "region");
  if (shape.region.empty())
    throw Failure(ExitCode::usage, "the config has no 'region' in [shape]");
  std::vector<Source> sources;
  for (const std::string& name : config.parts())
    sources.push_back(read_part(config, name));
  const std::optional<Box> container = container_of(config, sources, shape.region);
  shape.container = container ? *container : box_of({mesh});
  if (!container)
    shape.container_reason = "it follows from a contour that is not read here";
  shape.step = lattice_step(shape);
  const auto period = [&](const char* key, double side) {
    return config.is_true("domain", key) ? std::round(side / shape.step) * shape.step : 0;
  };
  shape.periods = {period("periodic_x", shape.container.max.x - shape.container.min.x),
                   period("periodic_y", shape.container.max.y - shape.container.min.y)};

  const std::string companion = config.value("meshing", "fixed_points_normalize_with");
  const std::string points = config.path("meshing", "fixed_points");
  std::optional<std::string> text;
  if (!points.empty() && !(text = read_text(points)))
    shape.fixed_points_reason = fmt::format("{} cannot be read", points);
  if (text)
    for (const Ring& ring : read_rings(*text + "\n"))
      shape.fixed_points.insert(shape.fixed_points.end(), ring.begin(), ring.end());
  for (const Source& source : sources) {
    Part part{source.name, nullptr, source.reason};
    std::vector<Ring> rings = source.rings;
    if (source.normalised && source.reason.empty()) {
      const Normalisation fit(source.box(), shape.container);
      rings = fit.apply(rings);
      if (source.name == companion)
        for (Point& p : shape.fixed_points)
          p = fit.apply(p);
    } else if (source.name == companion && !companion.empty())
      shape.fixed_points_reason = source.reason.empty() ? "the part they go with is not normalised" : source.reason;
    if (source.type == "circle")
      part.curve = std::make_unique<Circle>(source.center, source.radius);
    else if (source.reason.empty())
      part.curve = std::make_unique<Polygon>(std::move(rings));
    shape.parts.push_back(std::move(part));
  }
  shape.parts.push_back({"domain", std::make_unique<Polygon>(rectangle(shape.container)), ""});
  return shape;
}

} // namespace trime_check
