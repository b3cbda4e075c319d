// SPDX-License-Identifier: BSD-3-Clause
#include "joined_mesh.hpp"

#include "topology.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace trime_check {
namespace {

class Joiner {
public:
  Joiner(const Mesh& mesh, std::int64_t parts) : mesh_(mesh), parts_(parts), lowest_(lowest_copies(mesh)) {
    std::int64_t count = 0;
    for (std::size_t i = 0; i < lowest_.size(); ++i)
      number_.push_back(lowest_[i] == static_cast<std::int64_t>(i) ? count++ : -1);
  }

  Mesh run() {
    Mesh joined;
    joined.periods = mesh_.periods;
    add_points(joined);
    for (const Triangle& t : mesh_.triangles)
      joined.triangles.push_back({id(t[0]), id(t[1]), id(t[2])});
    joined.alpha = mesh_.alpha;
    joined.beta = mesh_.beta;
    joined.region = mesh_.region;
    add_facets(joined);
    add_curves(joined);
    for (const Facet& edge : mesh_.interfaces)
      joined.interfaces.push_back(renamed(edge));
    joined.interface_regions = mesh_.interface_regions;
    joined.interface_pairs = mesh_.interface_pairs;
    joined.interface_labels = mesh_.interface_labels;
    joined.interface_curves = mesh_.interface_curves;
    add_split_interfaces(joined);
    for (const Facet& facet : joined.facets)
      for (const std::int64_t end : facet)
        joined.boundary[static_cast<std::size_t>(end)] = 1;
    return joined;
  }

private:
  std::int64_t id(std::int64_t point) const {
    return number_[static_cast<std::size_t>(lowest_[static_cast<std::size_t>(point)])];
  }
  Facet renamed(const Facet& edge) const { return {id(edge[0]), id(edge[1])}; }
  bool is_side(std::size_t facet) const { return mesh_.facet_parts[facet] >= parts_; }

  void add_points(Mesh& joined) const {
    for (std::size_t i = 0; i < mesh_.points.size(); ++i)
      if (number_[i] >= 0) {
        joined.points.push_back(mesh_.points[i]);
        joined.size.push_back(mesh_.size[i]);
        joined.fixed.push_back(mesh_.fixed[i]);
        joined.boundary.push_back(0);
      }
  }

  void add_facets(Mesh& joined) const {
    for (std::size_t k = 0; k < mesh_.facets.size(); ++k)
      if (!is_side(k)) {
        joined.facets.push_back(renamed(mesh_.facets[k]));
        joined.facet_tags.push_back(mesh_.facet_tags[k]);
        joined.facet_parts.push_back(mesh_.facet_parts[k]);
        joined.facet_labels.push_back(mesh_.facet_labels[k]);
        joined.asked_sizes.push_back(mesh_.asked_sizes[k]);
        if (!mesh_.facet_markers.empty())
          joined.facet_markers.push_back(mesh_.facet_markers[k]);
      }
  }

  void add_curves(Mesh& joined) const {
    for (const Facet& edge : mesh_.curve_edges)
      joined.curve_edges.push_back(renamed(edge));
    joined.curve_numbers = mesh_.curve_numbers;
    joined.curve_labels = mesh_.curve_labels;
    std::set<Facet> listed;
    for (std::size_t k = 0; k < mesh_.facets.size(); ++k)
      if (const Facet edge = renamed(mesh_.facets[k]); is_side(k) && listed.insert(ascending(edge)).second) {
        joined.curve_edges.push_back(edge);
        joined.curve_numbers.push_back(mesh_.facet_parts[k] - parts_);
        joined.curve_labels.push_back(mesh_.facet_labels[k]);
      }
  }

  /// Sides of split curves whose triangles have different regions.
  void add_split_interfaces(Mesh& joined) const {
    std::map<Facet, std::int64_t> curve_of;
    for (std::size_t k = 0; k < joined.curve_edges.size(); ++k)
      curve_of.emplace(ascending(joined.curve_edges[k]), joined.curve_numbers[k]);
    std::set<Facet> listed;
    for (const Facet& edge : joined.interfaces)
      listed.insert(ascending(edge));
    const std::vector<Side> sides = sides_of(joined);
    for (std::size_t k = 0; k + 1 < sides.size(); ++k) {
      const Side &one = sides[k], &other = sides[k + 1];
      const std::int64_t left = joined.region[one.triangle], right = joined.region[other.triangle];
      const auto curve = curve_of.find({one.low, one.high});
      if (!one.is_same_edge(other) || left == right || curve == curve_of.end() ||
          !listed.insert({one.low, one.high}).second)
        continue;
      joined.interfaces.push_back(left < right ? one.directed() : other.directed());
      joined.interface_regions.push_back({std::min(left, right), std::max(left, right)});
      joined.interface_pairs.push_back(0); // nothing that uses a joined mesh looks at the numbers of pairs and labels
      joined.interface_labels.push_back(0);
      joined.interface_curves.push_back(curve->second);
    }
  }

  const Mesh& mesh_;
  const std::int64_t parts_;
  const std::vector<std::int64_t> lowest_;
  std::vector<std::int64_t> number_; // of the lowest copies in the joined mesh; -1 for the others
};

} // namespace

std::vector<std::int64_t> lowest_copies(const Mesh& mesh) {
  Components copies(mesh.points.size());
  for (const Facet& pair : mesh.split_pairs) { // the lower point becomes the root
    const std::int64_t a = copies.root(pair[0]), b = copies.root(pair[1]);
    copies.join(std::max(a, b), std::min(a, b));
  }
  std::vector<std::int64_t> lowest(mesh.points.size());
  for (std::size_t i = 0; i < lowest.size(); ++i)
    lowest[i] = copies.root(static_cast<std::int64_t>(i));
  return lowest;
}

Mesh joined_mesh(const StoredFile& file, const Mesh& mesh) {
  return Joiner(mesh, std::ssize(file.names("/trime_mpi/tags/part_name"))).run();
}

} // namespace trime_check
