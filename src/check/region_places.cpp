// SPDX-License-Identifier: BSD-3-Clause
#include "region_places.hpp"

#include "inside.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

namespace trime_check {
namespace {

// [longer side of the container] Curves are computed in doubles, and what lies in them.
constexpr double on_curve = 1e-9, box_slack = 1e-12;
// [h] A triangle whose centroid is farther from all curves has no part beyond them.
constexpr double beside_curve = 1;
// [size of the mesh] The size asked for is not stored inside. Unless it is uniform, it may be larger by as much.
constexpr double lowered = 2;
// [steps of the lattice] Points of a config come to the nearest lattice point.
constexpr double on_lattice = 4;
// [degrees] Corners are kept if curves turn by more, unless the config says otherwise.
constexpr double default_angle = 30;
// Number of triangles that are tested at most.
constexpr std::size_t most_places = 1'000'000;

/// The regions of a config: the first one that contains a place has it, and the rest has number 1.
class RegionList {
public:
  /// @throws Failure (exit 2) if an expression names a part that does not exist
  /// @param stored names in the mesh file, which has a region for each value of an attribute
  RegionList(const ConfigText& config, const Shape& shape, const std::vector<std::string>& stored) : shape_(shape) {
    names.push_back(config.value("shape", "rest"));
    if (names[0].empty() || names[0] == "geometry")
      names[0] = config.value("shape", "geometry");
    for (const std::string& name : config.regions()) {
      const std::string section = "region." + name, geometry = config.value(section, "geometry");
      if (!config.value(section, "file").empty()) {
        reason = fmt::format("the polygons of region {} come from a file", name);
        const std::string file = config.value(section, "file");
        const bool has_values =
            !config.value(section, "attribute").empty() || file.ends_with(".poly") || file.ends_with(".asc");
        add_stored(name, has_values, stored);
        continue;
      }
      names.push_back(name);
      regions_.emplace_back(geometry.empty() || geometry == "NAME" ? name : geometry, shape.numbers);
    }
    for (std::size_t k = 0; k < shape.parts.size(); ++k)
      for (std::size_t region = 0; region < regions_.size(); ++region)
        if (regions_[region].uses(k)) {
          regions_of_part_[k].push_back(region);
          if (!shape.parts[k].curve)
            reason = fmt::format("part {}: {}", shape.parts[k].name, shape.parts[k].reason);
        }
  }

  /// Returns the number of the region at a place, from 1.
  std::int64_t at(Point p) { return within(parts_around(p)); }

  /// Returns whether the region at a place on the curve of a part changes with the side of this curve. @pre no other
  /// curve passes there
  bool changes_at(std::size_t part, Point p) {
    std::vector<std::size_t> around = parts_around(p);
    std::erase(around, part);
    const std::int64_t without = within(around);
    around.push_back(part);
    return within(around) != without;
  }

  /// Returns whether the curve of another part that the shape or a region uses, or a periodic image of this curve,
  /// passes within `limit`.
  bool meets_another(std::size_t part, Point p, double limit) const {
    for (const Point image : shape_.images(p)) {
      const bool is_itself = std::fabs(image.x - p.x) <= limit && std::fabs(image.y - p.y) <= limit;
      for (const std::size_t other : shape_.finder->near(image, limit))
        if ((other != part || !is_itself) && (uses(other) || shape_.region->uses(other)) &&
            shape_.parts[other].curve->distance(image) <= limit)
          return true;
    }
    return false;
  }

  bool uses(std::size_t part) const { return regions_of_part_.contains(part); }

  /// Returns the distance from the nearest curve that a region uses if it is at most `limit`, otherwise a larger
  /// number.
  double distance(Point p, double limit) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Point image : shape_.images(p))
      for (const std::size_t part : shape_.finder->near(image, limit))
        if (uses(part))
          least = std::min(least, shape_.parts[part].curve->distance(image) - shape_.parts[part].bend);
    return least;
  }

  std::vector<std::string> names; ///< of the regions 1, 2, ...
  std::string reason;             ///< why regions cannot be compared; empty: they can

private:
  /// Adds the name of a region of a file, or the names NAME.VALUE that follow in the mesh file. Features without a
  /// value have the name NAME.
  void add_stored(const std::string& name, bool has_values, const std::vector<std::string>& stored) {
    if (!has_values)
      names.push_back(name);
    const auto belongs = [&](const std::string& other) { return other == name || other.starts_with(name + "."); };
    while (has_values && names.size() < stored.size() && belongs(stored[names.size()]))
      names.push_back(stored[names.size()]);
  }

  std::vector<std::size_t> parts_around(Point p) const {
    std::vector<std::size_t> around;
    for (const Point image : shape_.images(p))
      for (const std::size_t part : shape_.finder->near(image, box_slack * shape_.side()))
        if (uses(part) && shape_.parts[part].curve->contains(image))
          around.push_back(part);
    return around;
  }

  /// The first region that contains a place within these parts. Those that use none of them do not contain it.
  std::int64_t within(const std::vector<std::size_t>& around) {
    std::set<std::size_t> candidates;
    for (const std::size_t part : around)
      candidates.insert(regions_of_part_[part].begin(), regions_of_part_[part].end());
    for (const std::size_t region : candidates) {
      for (const std::size_t part : around)
        regions_[region].set(part, true);
      const bool inside = regions_[region].contains();
      for (const std::size_t part : around)
        regions_[region].set(part, false);
      if (inside)
        return static_cast<std::int64_t>(region) + 2;
    }
    return 1;
  }

  const Shape& shape_;
  std::vector<Region> regions_;
  std::unordered_map<std::size_t, std::vector<std::size_t>> regions_of_part_;
};

class RegionPlaces {
public:
  RegionPlaces(const GivenRegions& given, Report& report)
      : file_(given.file), mesh_(given.mesh), config_(given.config), shape_(given.shape), report_(report),
        list_(given.config, given.shape, given.file.names("/trime_mpi/tags/region_name")),
        refined_(std::exp2(file_.number("/trime_mpi", "refinements").value_or(0))) {
    const std::optional<double> within = config_.number("meshing", "simplify_within");
    strict_ = config_.is_true("meshing", "keep_features") || (within && *within == 0);
    simplified_ = strict_ ? 0 : given.simplified;
    if (config_.value("sizing", "type") == "uniform" && config_.value("sizing", "size_at").empty() &&
        !has_region_sizes(config_))
      uniform_ = std::ranges::max(mesh_.size);
  }

  void run() {
    check_names();
    check_rest();
    if (!list_.reason.empty()) {
      report_.skip("region_places", list_.reason);
      report_.skip("interface_places", list_.reason);
      report_.skip("region_corners", list_.reason);
      return;
    }
    check_triangles();
    check_interfaces();
    check_corners();
  }

private:
  void check_names() {
    const std::vector<std::string> found = file_.names("/trime_mpi/tags/region_name");
    const auto text = [](const std::vector<std::string>& names) {
      constexpr std::size_t most = 5;
      std::string joined;
      for (std::size_t k = 0; k < std::min(names.size(), most); ++k)
        joined += (k > 0 ? ", " : "") + names[k];
      return names.size() > most ? fmt::format("{}, and {} more", joined, names.size() - most) : joined;
    };
    report_.add("region_list", found == list_.names, text(list_.names), text(found),
                "names of the regions: the rest, then the sections of the config in their order");
  }

  void check_rest() {
    if (config_.value("shape", "cover") != "all")
      return;
    Tally rest;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      if (mesh_.region[t] == 1)
        rest.note([&] { return place_of(mesh_, t); });
    report_.none("region_rest", rest, "triangles in no region of the config, which says `cover = all`");
  }

  /// Returns the size asked for at a point, or that of the mesh, which may be lower.
  double size_at(std::int64_t id) const {
    return refined_ * (uniform_ > 0 ? uniform_ : mesh_.size[static_cast<std::size_t>(id)]);
  }

  void check_triangles() {
    Tally wrong;
    std::int64_t tested = 0;
    const std::size_t step = mesh_.triangles.size() / most_places + 1;
    const double in_h = std::max(beside_curve, 2 * simplified_);
    for (std::size_t t = 0; t < mesh_.triangles.size(); t += step) {
      const auto [a, b, c] = mesh_.corners(mesh_.triangles[t]);
      const auto [i, j, k] = mesh_.triangles[t];
      const Point centroid{(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3};
      const double limit = in_h * std::max({size_at(i), size_at(j), size_at(k)});
      if (list_.distance(centroid, limit) <= limit)
        continue;
      ++tested;
      if (const std::int64_t expected = list_.at(centroid); expected != mesh_.region[t])
        wrong.note(
            [&] { return fmt::format("{}: expected {}, found {}", place_of(mesh_, t), expected, mesh_.region[t]); });
    }
    if (tested == 0)
      report_.skip("region_places", "all triangles are near the curve of a part");
    else
      report_.none("region_places", wrong,
                   fmt::format("triangles that are not in the first region of the config that contains their centroid; "
                               "{} were tested",
                               tested));
  }

  void check_interfaces() {
    Tally off;
    std::set<std::int64_t> ends;
    for (const Facet& edge : mesh_.interfaces)
      ends.insert(edge.begin(), edge.end());
    double largest = 0;
    for (const std::int64_t id : ends) {
      const double limit = on_curve * shape_.side() + (uniform_ > 0 ? 1 : lowered) * simplified_ * size_at(id);
      const double away = std::max(0.0, list_.distance(mesh_.at(id), limit));
      if (away > limit)
        off.note([&] { return fmt::format("point {} at {}", id, place_of(mesh_.at(id))); });
      else
        largest = std::max(largest, away);
    }
    report_.none("interface_places", off,
                 fmt::format("points of interfaces that do not lie on the curve of a part{}; {} were tested, and the "
                             "largest distance of the others is {:.3g}",
                             strict_ ? "" : ", which may have been simplified", ends.size(), largest));
  }

  /// Corners of interfaces, away from other curves.
  void check_corners() {
    if (const auto unknown =
            std::ranges::find_if(shape_.parts, [&](const Part& part) { return !part.curve && shape_.is_used(part); });
        unknown != shape_.parts.end()) {
      report_.skip("region_corners", fmt::format("part {}: {}", unknown->name, unknown->reason));
      return;
    }
    const double angle = config_.number("meshing", "corner_angle").value_or(default_angle);
    const double limit = on_lattice * shape_.step;
    std::vector<Point> fixed;
    for (std::size_t i = 0; i < mesh_.points.size(); ++i)
      if (mesh_.fixed[i] == 1)
        fixed.push_back(mesh_.points[i]);
    const PointFinder vertices(fixed, mesh_.periods);
    std::int64_t expected = 0;
    Tally missing;
    for (std::size_t k = 0; k < shape_.parts.size(); ++k) {
      if (!list_.uses(k))
        continue;
      for (const Point corner : shape_.parts[k].curve->corners(angle))
        if (!shape_.parts[k].is_crossing(corner) && !list_.meets_another(k, corner, limit) && shape_.contains(corner) &&
            list_.changes_at(k, corner)) {
          ++expected;
          if (vertices.nearest(corner).distance > 2 * limit)
            missing.note([&] { return place_of(corner); });
        }
    }
    const std::int64_t found = expected - missing.count;
    if (strict_ || missing.count == 0)
      report_.equal("region_corners", expected, found, "corners of interfaces in the config that are vertices",
                    missing.count == 0 ? "" : "first that is not a vertex: " + missing.place);
    else
      report_.skip("region_corners",
                   fmt::format("{} of {} corners of interfaces in the config are vertices; others may "
                               "have been simplified",
                               found, expected));
  }

  const StoredFile& file_;
  const Mesh& mesh_;
  const ConfigText& config_;
  const Shape& shape_;
  Report& report_;
  RegionList list_;
  double refined_;
  bool strict_ = false;   // nothing was simplified
  double simplified_ = 0; // [h asked for]
  double uniform_ = 0;    // the size asked for if it is the same everywhere, otherwise 0
};

} // namespace

void check_region_places(const GivenRegions& given, Report& report) {
  if (!given.config.regions().empty() || given.file.names("/trime_mpi/tags/region_name").size() > 1)
    RegionPlaces(given, report).run();
}

} // namespace trime_check
