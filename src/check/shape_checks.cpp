// SPDX-License-Identifier: BSD-3-Clause
#include "checks.hpp"
#include "cover.hpp"
#include "region_places.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

namespace trime_check {
namespace {

// [longer side of the container] Curves are computed in doubles.
constexpr double on_curve = 1e-9;
// [steps of the lattice] Points of a config come to the nearest lattice point, some after they were normalised.
constexpr double on_lattice = 4;
// [h asked for] Rounding of sizes, where the boundary was simplified.
constexpr double slack = 1.01;
// [h asked for] The boundary strays so far from its facets, at most: what the certificate says of chords.
constexpr double chord = 0.75;

/// Finds places to within a few steps of the lattice: sorted in columns of that width.
class PlaceSet {
public:
  PlaceSet(const std::vector<Point>& places, const Shape& shape) : shape_(shape), reach_(on_lattice * shape.step) {
    for (const Point p : places)
      points_.push_back({column(p.x), p});
    std::ranges::sort(points_, {}, [](const Entry& entry) { return std::pair(entry.column, entry.place.y); });
  }

  bool has(Point p) const {
    return std::ranges::any_of(shape_.images(p), [&](Point image) { return has_at(image); });
  }

private:
  struct Entry {
    double column; // a whole number
    Point place;
  };

  double column(double x) const { return std::floor(x / (2 * reach_)); }

  bool has_at(Point p) const {
    for (const double c : {column(p.x - reach_), column(p.x + reach_)})
      for (auto at = std::ranges::lower_bound(points_, std::pair(c, p.y - reach_), {},
                                              [](const Entry& e) { return std::pair(e.column, e.place.y); });
           at != points_.end() && at->column == c && at->place.y <= p.y + reach_; ++at)
        if (std::fabs(at->place.x - p.x) <= reach_)
          return true;
    return false;
  }

  const Shape& shape_;
  double reach_;
  std::vector<Entry> points_;
};

std::vector<Point> fixed_vertices(const Mesh& mesh) {
  std::vector<Point> fixed;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    if (mesh.fixed[i] == 1)
      fixed.push_back(mesh.points[i]);
  return fixed;
}

class ShapeChecks {
public:
  ShapeChecks(const StoredFile& file, const Mesh& mesh, const ConfigText& config, Report& report)
      : file_(file), mesh_(mesh), config_(config), report_(report),
        shape_(make_shape(config, mesh.points, file.text_attribute("/trime_mpi", "crs").value_or(""))),
        fixed_(fixed_vertices(mesh), shape_) {}

  void run() {
    check_container();
    check_fixed_points();
    check_corners();
    check_vertices();
    check_region();
    check_region_places({file_, mesh_, config_, shape_, simplified_within()}, report_);
  }

private:
  void check_container() {
    Tally outside, off;
    const Box& box = shape_.container;
    bool any_changed = false;
    changed_tags(any_changed);
    const double largest = mesh_.asked_sizes.empty() ? 0 : std::ranges::max(mesh_.asked_sizes);
    const double reach = shape_.step + (any_changed ? simplified_within() * largest : 0);
    for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
      const Point p = mesh_.points[i];
      const auto place = [&] { return fmt::format("point {} at {}", i, place_of(p)); };
      if (!(p.x >= box.min.x - reach && p.x <= box.max.x + reach && p.y >= box.min.y - reach &&
            p.y <= box.max.y + reach))
        outside.note(place);
      if (p.x != std::round(p.x / shape_.step) * shape_.step || p.y != std::round(p.y / shape_.step) * shape_.step)
        off.note(place);
    }
    const bool same = mesh_.periods.x == shape_.periods.x && mesh_.periods.y == shape_.periods.y;
    const auto text = [](Periods p) { return fmt::format("({:.12g}, {:.12g})", p.x, p.y); };
    report_.add("periods", same, text(shape_.periods), text(mesh_.periods), "periods of the container, 0 for none");
    if (!shape_.container_reason.empty()) {
      report_.skip("container", shape_.container_reason);
      report_.skip("lattice", "the step of the coordinate lattice depends on the container, which is not known");
      return;
    }
    report_.none("container", outside,
                 fmt::format("points outside of the container from {} to {}", place_of(box.min), place_of(box.max)));
    report_.none("lattice", off,
                 fmt::format("points whose coordinates are not multiples of {:.6g}, the step of the coordinate lattice",
                             shape_.step));
  }

  void check_fixed_points() {
    if (!shape_.fixed_points_reason.empty()) {
      report_.skip("fixed_points", shape_.fixed_points_reason);
      report_.skip("fixed_inside", shape_.fixed_points_reason);
      return;
    }
    Tally missing, foreign;
    for (const Point p : shape_.fixed_points)
      if (!fixed_.has(p))
        missing.note([&] { return place_of(p); });
    const PlaceSet given(shape_.fixed_points, shape_);
    std::vector<char> has_curve(mesh_.points.size(), 0);
    for (const std::vector<Facet>* edges : {&mesh_.curve_edges, &mesh_.interfaces})
      for (const Facet& edge : *edges)
        for (const std::int64_t end : edge)
          has_curve[static_cast<std::size_t>(end)] = 1;
    for (std::size_t i = 0; i < mesh_.points.size(); ++i)
      if (mesh_.fixed[i] == 1 && mesh_.boundary[i] == 0 && has_curve[i] == 0 && !given.has(mesh_.points[i]))
        foreign.note([&] { return fmt::format("point {} at {}", i, place_of(mesh_.points[i])); });
    report_.none("fixed_points", missing,
                 fmt::format("fixed points (among {} in the config) that are not vertices of the mesh",
                             shape_.fixed_points.size()));
    report_.none(
        "fixed_inside", foreign,
        "inner points that are marked as fixed, but neither fixed points of the config nor on a curve or interface");
  }

  /// Why corners or curves cannot be judged; empty: they can.
  std::string unknown_part() const {
    for (std::size_t k = 0; k < shape_.parts.size(); ++k)
      if (const Part& part = shape_.parts[k]; !part.curve && shape_.region->uses(k))
        return fmt::format("part {}: {}", part.name, part.reason);
    return "";
  }

  /// Returns the loops of the shape that were not cut, dropped or smoothed: their curve is the one of the config.
  std::set<std::int64_t> changed_tags(bool& any) const {
    std::set<std::int64_t> tags;
    const std::vector<std::string> states = file_.names("/trime_mpi/rings/state");
    const std::vector<std::string> lists = file_.names("/trime_mpi/rings/tags");
    any = states.empty() && !loops_of_file().empty();
    if (any) // a step of a run, which does not say what became of the loops
      for (const double tag : loops_of_file())
        tags.insert(static_cast<std::int64_t>(tag));
    for (std::size_t k = 0; k < std::min(states.size(), lists.size()); ++k) {
      if (states[k] == "kept")
        continue;
      any = true;
      for (const char* at = lists[k].c_str(); *at != '\0';) {
        char* end = nullptr;
        const long tag = std::strtol(at, &end, 10);
        if (end == at)
          break;
        tags.insert(tag);
        at = end;
      }
    }
    return tags;
  }
  std::vector<double> loops_of_file() const { return file_.column("/trime_mpi/tags/edge_id"); }

  /// [h asked for] How far a boundary that was simplified may stray.
  double simplified_within() const {
    return config_.number("meshing", "simplify_within").value_or(0.5) *
           file_.number("/trime_mpi", "coarseness").value_or(1) * slack;
  }

  /// Corners below the resolution that the mesh passes over.
  std::int64_t left_out() const {
    return static_cast<std::int64_t>(file_.number("/trime_mpi", "corners_left_out").value_or(0));
  }

  /// Vertices that `refine` has left off the curve, at most.
  std::int64_t off_curve_by_refining() const {
    double count = 0;
    for (const char* name : {"middles_near_curve", "middles_straight", "middles_refused"})
      count += file_.number("/trime_mpi", name).value_or(0);
    return static_cast<std::int64_t>(count);
  }
  /// [h asked for] How far the curve is from the edges of the mesh that was refined.
  double chord_of_refined() const { return chord * std::exp2(file_.number("/trime_mpi", "refinements").value_or(0)); }

  void check_corners() {
    if (const std::string reason = unknown_part(); !reason.empty()) {
      report_.skip("corners", reason);
      return;
    }
    bool any_changed = false;
    changed_tags(any_changed);
    const double angle = config_.number("meshing", "corner_angle").value_or(30);
    std::int64_t expected = 0;
    Tally missing;
    for (const Part& part : shape_.parts) {
      if (!part.curve) // the region does not use it
        continue;
      for (const Point corner : part.curve->corners(angle))
        if (!part.is_crossing(corner) && !shape_.meets_another(part, corner, on_lattice * shape_.step) &&
            shape_.matters(part, corner)) {
          ++expected;
          if (!fixed_.has(corner))
            missing.note([&] { return place_of(corner); });
        }
    }
    const std::int64_t left_out = this->left_out();
    const std::string found = std::to_string(expected - missing.count);
    if (any_changed)
      report_.skip(
          "corners",
          fmt::format("{} of {} corners of the config are vertices, but the boundary was simplified", found, expected));
    else
      report_.add("corners", missing.count <= left_out,
                  left_out > 0 ? fmt::format("{} to {}", expected - left_out, expected) : std::to_string(expected),
                  found, fmt::format("corners of the config that are vertices; {} may be left out", left_out),
                  missing.count == 0 ? "" : "first that is not a vertex: " + missing.place);
  }

  /// Numbers of facets that may have an end off the curve of their part.
  struct Allowance {
    std::int64_t across = 0;  ///< because they pass over places where parts meet
    std::int64_t refined = 0; ///< because `refine` has left a vertex off the curve
  };

  /// Notes the ends of a facet off its part. @param allowance null if the loop was simplified
  void check_facet(std::size_t k, const Part& part, double limit, Allowance* allowance, Tally& off) const {
    const bool strays =
        std::ranges::any_of(mesh_.facets[k], [&](std::int64_t id) { return distance_of(part, mesh_.at(id)) > limit; });
    Tally found;
    check_ends(k, part, limit, !allowance || (strays && allowance->across > 0), found);
    if (allowance && found.count > 0 && allowance->refined > 0) {
      --allowance->refined;
      found = {};
      check_ends(k, part, limit + chord_of_refined() * mesh_.asked_sizes[k], false, found);
    } else if (allowance && strays)
      --allowance->across;
    off.add(found);
  }

  void check_vertices() {
    std::vector<const Part*> named;
    for (const std::string& name : file_.names("/trime_mpi/tags/part_name"))
      named.push_back(shape_.part_of_label(name));
    bool any_changed = false;
    const std::set<std::int64_t> changed = changed_tags(any_changed);
    const double within = simplified_within();
    const std::string reason = unknown_part();
    Tally off, foreign;
    Allowance allowance{left_out(), 2 * off_curve_by_refining()};
    std::int64_t judged = 0;
    for (std::size_t k = 0; k < mesh_.facets.size(); ++k) {
      const auto number = static_cast<std::size_t>(mesh_.facet_parts[k]);
      const Part* part = number < named.size() ? named[number] : nullptr;
      if (!part || !shape_.is_used(*part)) {
        foreign.note([&] { return fmt::format("facet {}: {}", k, place_of(mesh_, mesh_.facets[k])); });
        continue;
      }
      const bool strict = !changed.contains(mesh_.facet_tags[k]);
      if (strict ? !part->curve : !reason.empty())
        continue;
      ++judged;
      const double limit = on_curve * shape_.side() + part->bend + (strict ? 0 : within * mesh_.asked_sizes[k]);
      check_facet(k, *part, limit, strict ? &allowance : nullptr, off);
    }
    report_.none("facet_parts", foreign, "facets of parts that the region of the config does not use");
    if (judged == 0 && !mesh_.facets.empty())
      report_.skip("on_curve", reason.empty() ? "no facet follows a curve that trime_check can compute" : reason);
    else
      report_.none("on_curve", off,
                   fmt::format("ends of facets that do not lie on the curve of their part; {} of {} facets were tested",
                               judged, mesh_.facets.size()));
  }

  /// Distance from the curve of a part; 0 if the part has none.
  double distance_of(const Part& part, Point p) const { return part.curve ? shape_.distance(part, p) : 0; }

  /// Notes the ends of facet k that lie farther than `limit` from its part; with `may_cross` another part will do.
  void check_ends(std::size_t k, const Part& part, double limit, bool may_cross, Tally& off) const {
    for (const std::int64_t id : mesh_.facets[k]) {
      double away = distance_of(part, mesh_.at(id));
      if (may_cross && away > limit) // what was joined, or lies beyond a corner left out, may lie at another part
        away = std::min(away, shape_.distance_from_any(mesh_.at(id), limit));
      if (away > limit)
        off.note([&] {
          return fmt::format("point {} at {}: {:.3g} from {}, limit {:.3g}", id, place_of(mesh_.at(id)), away,
                             part.name, limit);
        });
    }
  }

  Changes changes() const {
    bool any_changed = false;
    changed_tags(any_changed);
    const std::vector<std::string> states = file_.names("/trime_mpi/rings/state");
    const std::vector<double> x = file_.column("/trime_mpi/rings/x"), y = file_.column("/trime_mpi/rings/y"),
                              length = file_.column("/trime_mpi/rings/length");
    Changes changes{!(any_changed && states.empty()), {}, chord + (any_changed ? simplified_within() : 0)};
    for (std::size_t k = 0; k < std::min({states.size(), x.size(), y.size(), length.size()}); ++k)
      if (states[k] != "kept")
        changes.loops.push_back({{x[k], y[k]}, length[k]});
    return changes;
  }

  void check_region() {
    if (const std::string reason = unknown_part(); !reason.empty())
      report_.skip("region_cover", "whether the mesh covers the shape and nothing else: " + reason);
    else
      check_cover(shape_, mesh_, changes(), report_);
  }

  const StoredFile& file_;
  const Mesh& mesh_;
  const ConfigText& config_;
  Report& report_;
  Shape shape_;
  PlaceSet fixed_; // vertices
};

} // namespace

void check_shape(const StoredFile& file, const Mesh& mesh, const std::string& config, Report& report) {
  std::string text = file.text("/trime_mpi/config_resolved"), folder;
  if (!config.empty()) {
    const std::optional<std::string> given = read_text(config);
    if (!given || std::filesystem::is_directory(config))
      throw Failure(ExitCode::file, fmt::format("{}: the config cannot be read", config));
    text = *given;
    folder = std::filesystem::absolute(config).parent_path().string();
  } else if (text.empty()) {
    report.skip("shape", "the file contains no config; name a config file as the second argument");
    return;
  }
  ShapeChecks(file, mesh, ConfigText(text, folder), report).run();
}

} // namespace trime_check
