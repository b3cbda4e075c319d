// SPDX-License-Identifier: BSD-3-Clause
#include "checks.hpp"
#include "exact.hpp"
#include "topology.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <optional>
#include <set>

namespace trime_check {
namespace {

// [area of the mesh] Areas in tables are sums in double precision.
constexpr double area_tolerance = 1e-12;
// The report has a line of numbers for each of the first regions, at most as many.
constexpr std::size_t most_lines = 20;

/// An edge between two regions, by the triangles.
struct Border {
  Facet edge;                  ///< the lower region lies on its left
  std::array<Side, 2> sides{}; ///< of the lower region, of the other one
};

/// Collects what belongs to one region, by the arrays.
struct RegionParts {
  std::int64_t triangles = 0, edges = 0, points = 0, components = 0;
  Integer twice_area = 0;                            // of its triangles
  std::multimap<std::int64_t, std::int64_t> borders; // the ends of edges that have the region on their left
};

/// All that looks at regions and at the edges between them.
class RegionChecks {
public:
  RegionChecks(const StoredFile& file, const Mesh& mesh, Report& report)
      : file_(file), mesh_(mesh), report_(report), plane_(mesh) {
    const std::vector<double> ids = file.column("/trime_mpi/tags/region_id");
    const std::vector<std::string> names = file.names("/trime_mpi/tags/region_name");
    for (std::size_t k = 0; k < std::min(ids.size(), names.size()); ++k)
      names_.emplace(static_cast<std::int64_t>(ids[k]), names[k]);
    for (const std::int64_t region : mesh.region)
      regions_[region];
    for (const auto& [id, name] : names_)
      regions_[id];
  }

  void run() {
    check_names();
    check_pairs();
    read_triangles();
    check_interfaces();
    check_numbers();
    check_curves();
    check_discs();
    check_areas();
    check_table();
    describe();
  }

private:
  std::string name_of(std::int64_t region) const {
    const auto found = names_.find(region);
    return found == names_.end() ? std::to_string(region) : found->second;
  }
  std::int64_t region_of(const Side& side) const { return mesh_.region[side.triangle]; }

  void check_names() {
    Tally wrong;
    std::set<std::string> seen;
    std::int64_t expected = 0;
    for (const auto& [id, name] : names_)
      if (id != ++expected || name.empty() || !seen.insert(name).second)
        wrong.note([&, number = id] { return fmt::format("region {} '{}'", number, name_of(number)); });
    report_.none("region_names", wrong, "regions without a name, with the name of another one, or not numbered from 1");
  }

  /// The table of the pairs of regions.
  void check_pairs() {
    const std::string table = "/trime_mpi/interfaces/";
    const std::vector<double> ids = file_.column(table + "pair_id"), left = file_.column(table + "left"),
                              right = file_.column(table + "right"), labels = file_.column(table + "label");
    const std::vector<std::string> names = file_.names(table + "pair_name");
    const auto others = static_cast<double>(file_.names("/trime_mpi/tags/part_name").size() +
                                            file_.names("/trime_mpi/curves/curve_name").size());
    Tally wrong;
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const auto pair = static_cast<double>(k);
      if (k >= std::min({left.size(), right.size(), labels.size(), names.size()})) {
        wrong.note([&] { return fmt::format("row {} is incomplete", k); });
        break;
      }
      pairs_.push_back({static_cast<std::int64_t>(left[k]), static_cast<std::int64_t>(right[k])});
      const std::string name = name_of(pairs_[k][0]) + "|" + name_of(pairs_[k][1]);
      if (ids[k] != pair || labels[k] != others + pair + 1 || names[k] != name || left[k] >= right[k] ||
          !names_.contains(pairs_[k][0]) || !names_.contains(pairs_[k][1]))
        wrong.note([&] { return fmt::format("row {}: {}", k, names[k]); });
    }
    if (std::set<Facet>(pairs_.begin(), pairs_.end()).size() < pairs_.size())
      wrong.note([] { return std::string("a pair that is listed twice"); });
    report_.none("interface_pairs", wrong,
                 "rows of /trime_mpi/interfaces that are not two regions in ascending order with the name `A|B` and "
                 "the next label after parts and curves");
  }

  /// Finds the edges between regions, and what belongs to each region.
  void read_triangles() {
    const std::vector<Side> sides = sides_of(mesh_);
    Components joined(mesh_.triangles.size());
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const Side& side = sides[k];
      RegionParts& own = regions_[region_of(side)];
      ++own.edges;
      const bool is_last = k + 1 == sides.size() || !side.is_same_edge(sides[k + 1]);
      if (const bool is_first = k == 0 || !side.is_same_edge(sides[k - 1]); is_first && is_last)
        own.borders.emplace(side.directed()[0], side.directed()[1]);
      if (is_last)
        continue;
      const Side& other = sides[k + 1];
      if (region_of(side) == region_of(other)) {
        --own.edges;
        joined.join(side.triangle, other.triangle);
      } else {
        const bool lower = region_of(side) < region_of(other);
        borders_.push_back(
            {lower ? side.directed() : other.directed(), lower ? std::array{side, other} : std::array{other, side}});
      }
    }
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      RegionParts& own = regions_[mesh_.region[t]];
      const auto [a, b, c] = mesh_.corners(mesh_.triangles[t]);
      own.twice_area += plane_.twice_area(a, b, c);
      ++own.triangles;
      own.components += joined.root(static_cast<std::int64_t>(t)) == static_cast<std::int64_t>(t);
    }
    count_points();
  }

  void count_points() {
    std::vector<std::array<std::int64_t, 2>> points; // region, point
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const std::int64_t id : mesh_.triangles[t])
        points.push_back({mesh_.region[t], id});
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    for (const auto& of_region : points)
      ++regions_[of_region[0]].points;
  }

  /// The list of the file against the edges between triangles.
  void check_interfaces() {
    Tally twice, missing, foreign, turned;
    for (std::size_t k = 0; k < mesh_.interfaces.size(); ++k)
      if (!listed_.emplace(ascending(mesh_.interfaces[k]), k).second)
        twice.note([&] { return place_of(mesh_, mesh_.interfaces[k]); });
    std::set<Facet> found;
    for (const Border& border : borders_) {
      const auto row = listed_.find(ascending(border.edge));
      found.insert(ascending(border.edge));
      if (row == listed_.end())
        missing.note([&] { return place_of(mesh_, border.edge); });
      else if (mesh_.interfaces[row->second] != border.edge)
        turned.note([&] { return place_of(mesh_, border.edge); });
    }
    for (const auto& listed : listed_)
      if (!found.contains(listed.first))
        foreign.note([&] { return place_of(mesh_, listed.first); });
    report_.none("interfaces", missing,
                 fmt::format("edges between triangles of different regions that are not among the {} interface edges",
                             mesh_.interfaces.size()));
    report_.none("interface_foreign", foreign, "interface edges that are not between triangles of different regions");
    report_.none("interface_once", twice, "interface edges that are listed twice");
    report_.none("interface_sides", turned, "interface edges whose region with the lower number is not on the left");
  }

  /// The numbers of each interface edge.
  void check_numbers() {
    Tally regions, labels;
    for (const Border& border : borders_) {
      const auto row = listed_.find(ascending(border.edge));
      if (row == listed_.end())
        continue;
      const Facet expected{region_of(border.sides[0]), region_of(border.sides[1])};
      const std::int64_t pair = mesh_.interface_pairs[row->second];
      const bool is_pair = pair >= 0 && pair < std::ssize(pairs_) && pairs_[static_cast<std::size_t>(pair)] == expected;
      if (mesh_.interface_regions[row->second] != expected || !is_pair)
        regions.note([&] { return place_of(mesh_, border.edge); });
    }
    const auto others = static_cast<std::int64_t>(file_.names("/trime_mpi/tags/part_name").size() +
                                                  file_.names("/trime_mpi/curves/curve_name").size());
    for (std::size_t k = 0; k < mesh_.interfaces.size(); ++k)
      if (mesh_.interface_labels[k] != others + mesh_.interface_pairs[k] + 1)
        labels.note([&] { return place_of(mesh_, mesh_.interfaces[k]); });
    report_.none("interface_regions", regions, "interface edges with the numbers or the pair of other regions");
    report_.none("interface_labels", labels, "interface edges whose label is not that of the pair after all curves");
  }

  /// Interface edges on curves are in both lists.
  void check_curves() {
    std::map<Facet, std::int64_t> curves;
    for (std::size_t k = 0; k < mesh_.curve_edges.size(); ++k)
      curves.emplace(ascending(mesh_.curve_edges[k]), mesh_.curve_numbers[k]);
    Tally wrong;
    for (std::size_t k = 0; k < mesh_.interfaces.size(); ++k) {
      const auto curve = curves.find(ascending(mesh_.interfaces[k]));
      if (mesh_.interface_curves[k] != (curve == curves.end() ? -1 : curve->second))
        wrong.note([&] { return place_of(mesh_, mesh_.interfaces[k]); });
    }
    report_.none("interface_curves", wrong, "interface edges whose curve is not that in /Mesh/curves; -1 for none");
  }

  void check_discs() {
    Tally wide;
    for (const Border& border : borders_)
      for (const Side& side : border.sides)
        if (mesh_.cosine(mesh_.triangles[side.triangle], side.corner) < least_cosine)
          wide.note([&] { return place_of(mesh_, border.edge); });
    report_.none("interface_discs", wide, "edges between regions with an angle above 90 degrees opposite to them");
  }

  /// Returns the edge that goes on around the same side of the region: the first one clockwise from the way back.
  std::multimap<std::int64_t, std::int64_t>::iterator next_border(std::multimap<std::int64_t, std::int64_t>& borders,
                                                                  std::int64_t from, std::int64_t id) const {
    const auto [low, high] = borders.equal_range(id);
    auto best = low;
    if (low == high)
      return borders.end();
    const Point place = mesh_.at(id), back = mesh_.periods.near(mesh_.at(from), place) - place;
    double least = HUGE_VAL;
    for (auto out = low; out != high; ++out) {
      const Point along = mesh_.periods.near(mesh_.at(out->second), place) - place;
      const double angle = std::atan2(along.x * back.y - along.y * back.x, along.x * back.x + along.y * back.y);
      if (const double turn = angle > 0 ? angle : angle + 2 * std::numbers::pi; turn < least) {
        least = turn;
        best = out;
      }
    }
    return best;
  }

  /// @brief Returns twice the area inside the border of a region, or nothing if its edges do not form closed paths.
  /// Where paths meet in a point, each goes on around the same side of the region. So no two paths of a torus cross.
  std::optional<Integer> twice_area_inside(std::multimap<std::int64_t, std::int64_t> borders) const {
    Integer area = 0;
    while (!borders.empty()) {
      const auto first = borders.begin();
      const Point origin = mesh_.at(first->first);
      Point at = origin;
      for (auto edge = first;;) {
        const auto [id, to_id] = *edge;
        const Point from = mesh_.at(id), to = at + (mesh_.periods.near(mesh_.at(to_id), from) - from);
        area += plane_.twice_area(origin, at, to);
        at = to;
        const auto next = next_border(borders, id, to_id);
        if (next == borders.end() || (next == edge && edge != first))
          return std::nullopt;
        if (edge != first)
          borders.erase(edge);
        if (next == first)
          break;
        edge = next;
      }
      borders.erase(first);
      area += 2 * plane_.cross(origin - mesh_.points[0], at - origin); // of a path around a periodic container
    }
    return area;
  }

  /// The area of a region of a torus is known up to that of the whole.
  Integer in_container(const Integer& area, const RegionParts& own) const {
    if (!(mesh_.periods.x > 0 && mesh_.periods.y > 0))
      return area;
    const Integer whole = 2 * plane_.cross({mesh_.periods.x, 0}, {0, mesh_.periods.y});
    const Integer rest = ((area % whole) + whole) % whole;
    return rest == 0 && own.triangles > 0 ? whole : rest;
  }

  /// Areas inside the borders, which are the facets and the interface edges of the file.
  void check_areas() {
    for (std::size_t k = 0; k < mesh_.interfaces.size(); ++k) {
      const auto [a, b] = mesh_.interfaces[k];
      const auto [left, right] = mesh_.interface_regions[k];
      regions_[left].borders.emplace(a, b);
      regions_[right].borders.emplace(b, a);
    }
    Tally open, wrong;
    Integer sum = 0, triangles = 0;
    for (const auto& [region, own] : regions_) {
      triangles += own.twice_area;
      const std::optional<Integer> found = twice_area_inside(own.borders);
      if (!found) {
        open.note([&, id = region] { return "region " + name_of(id); });
        continue;
      }
      const Integer area = in_container(*found, own);
      sum += area;
      if (area != own.twice_area)
        wrong.note([&, id = region, twice = own.twice_area] {
          return fmt::format("region {}: {:.17g} inside of its border, {:.17g} in its triangles", name_of(id),
                             plane_.area(area), plane_.area(twice));
        });
    }
    report_.none("region_borders", open, "regions whose facets and interface edges do not form closed paths");
    report_.none("region_area", wrong,
                 "regions with another area inside of their border than in their triangles (Boost, exact integers)");
    report_.add("region_sum", sum == triangles, fmt::format("{:.17g}", plane_.area(triangles)),
                fmt::format("{:.17g}", plane_.area(sum)), "sum of the areas inside the borders of all regions (exact)");
  }

  /// The table of regions, where the file has one.
  void check_table() {
    const std::string table = "/trime_mpi/regions/";
    if (!file_.has("/trime_mpi/regions"))
      return;
    const std::vector<double> ids = file_.column(table + "region_id"), triangles = file_.column(table + "triangles"),
                              areas = file_.column(table + "area");
    const std::vector<std::string> names = file_.names(table + "region_name");
    Integer whole = 0;
    for (const auto& of_region : regions_)
      whole += of_region.second.twice_area;
    Tally wrong;
    std::set<std::int64_t> listed;
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const auto id = static_cast<std::int64_t>(ids[k]);
      const auto own = regions_.find(id);
      if (k >= std::min({triangles.size(), areas.size(), names.size()}) || own == regions_.end() ||
          !listed.insert(id).second || names[k] != name_of(id) ||
          triangles[k] != static_cast<double>(own->second.triangles) ||
          !(std::fabs(areas[k] - plane_.area(own->second.twice_area)) <= area_tolerance * plane_.area(whole)))
        wrong.note([&] { return fmt::format("row {}, region {}", k, name_of(id)); });
    }
    if (listed.size() != names_.size())
      wrong.note([&] { return fmt::format("{} of {} regions", listed.size(), names_.size()); });
    report_.none("region_table", wrong, "rows of /trime_mpi/regions with another name, number of triangles or area");
  }

  /// Returns how many chords meet at the points where three or more do.
  std::map<std::int64_t, std::int64_t> junctions() const {
    std::set<Facet> chords;
    for (const std::vector<Facet>* list : {&mesh_.facets, &mesh_.interfaces, &mesh_.curve_edges})
      for (const Facet& chord : *list)
        chords.insert(ascending(chord));
    std::map<std::int64_t, std::int64_t> degrees, junctions;
    for (const Facet& chord : chords)
      for (const std::int64_t end : chord)
        ++degrees[end];
    for (const auto& of_point : degrees)
      if (of_point.second > 2)
        ++junctions[of_point.second];
    return junctions;
  }

  void describe() {
    std::size_t lines = 0;
    for (const auto& [region, own] : regions_)
      if (++lines <= most_lines)
        report_.info("regions", fmt::format("{} {}: {} triangles in {} components, area {:.12g}, points - edges + "
                                            "triangles {}",
                                            region, name_of(region), own.triangles, own.components,
                                            plane_.area(own.twice_area), own.points - own.edges + own.triangles));
    if (lines > most_lines)
      report_.info("regions", fmt::format("and {} more", lines - most_lines));
    std::string text;
    for (const auto& [degree, count] : junctions())
      text += fmt::format("{}{} points with {} of them", text.empty() ? "" : ", ", count, degree);
    report_.info("junctions", "three or more facets, interface edges and edges on curves meet at: " +
                                  (text.empty() ? "no point" : text));
  }

  const StoredFile& file_;
  const Mesh& mesh_;
  Report& report_;
  IntegerPlane plane_;
  std::map<std::int64_t, std::string> names_;
  std::map<std::int64_t, RegionParts> regions_;
  std::vector<Facet> pairs_;            // of the table, by their numbers
  std::map<Facet, std::size_t> listed_; // interface edges of the file
  std::vector<Border> borders_;         // by the triangles
};

} // namespace

void check_regions(const StoredFile& file, const Mesh& mesh, Report& report) {
  if (file.column("/trime_mpi/tags/region_id").size() > 1 || file.has("/Mesh/interfaces"))
    RegionChecks(file, mesh, report).run();
}

} // namespace trime_check
