// SPDX-License-Identifier: BSD-3-Clause
#include "checks.hpp"
#include "joined_mesh.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <set>

namespace trime_check {
namespace {

/// All that looks at the pairs of points on curves that are split, and at the boundary edges on both sides.
class SplitChecks {
public:
  SplitChecks(const StoredFile& file, const Mesh& mesh, Report& report)
      : mesh_(mesh), report_(report), parts_(std::ssize(file.names("/trime_mpi/tags/part_name"))),
        is_split_(file.column("/trime_mpi/curves/split")), lowest_(lowest_copies(mesh)) {
    for (std::size_t k = 0; k < mesh.facets.size(); ++k)
      if (mesh.facet_parts[k] >= parts_)
        sides_.emplace(mesh.facets[k], mesh.facet_parts[k] - parts_);
    for (const Facet& pair : mesh.split_pairs)
      in_pair_.insert(pair.begin(), pair.end());
  }

  void run() {
    check_places();
    check_numbers();
    check_sides();
    check_order();
  }

private:
  static bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  }
  std::string row(std::size_t k) const {
    const Facet& pair = mesh_.split_pairs[k];
    return fmt::format("row {}, points {} and {} at {}", k, pair[0], pair[1], place_of(mesh_.at(pair[0])));
  }

  void check_places() {
    Tally apart, fields;
    for (std::size_t k = 0; k < mesh_.split_pairs.size(); ++k) {
      const auto [left, right] = mesh_.split_pairs[k];
      const auto a = static_cast<std::size_t>(left), b = static_cast<std::size_t>(right);
      const Point p = mesh_.points[a], q = mesh_.points[b];
      if (left == right || !same_bits(p.x, q.x) || !same_bits(p.y, q.y))
        apart.note([&] { return row(k); });
      if (mesh_.size[a] != mesh_.size[b] || mesh_.fixed[a] != mesh_.fixed[b])
        fields.note([&] { return row(k); });
    }
    report_.none("split_points", apart,
                 fmt::format("pairs (of {}) that are not two points with equal bits of their coordinates",
                             mesh_.split_pairs.size()));
    report_.none("split_fields", fields, "pairs whose points differ in `size` or `fixed`");
  }

  bool is_split(std::int64_t curve) const {
    return curve >= 0 && curve < std::ssize(is_split_) && is_split_[static_cast<std::size_t>(curve)] == 1;
  }

  void check_numbers() {
    Tally curves, paths;
    for (std::size_t k = 0; k < mesh_.split_pairs.size(); ++k) {
      if (!is_split(mesh_.split_curves[k]))
        curves.note([&] { return row(k); });
      const std::int64_t path = mesh_.split_paths[k], before = k == 0 ? -1 : mesh_.split_paths[k - 1];
      const bool goes_on = k > 0 && path == before && mesh_.split_curves[k] == mesh_.split_curves[k - 1];
      const bool begins = path == before + 1 && (k == 0 || mesh_.split_curves[k] >= mesh_.split_curves[k - 1]);
      if (!goes_on && !begins)
        paths.note([&] { return row(k); });
    }
    for (const auto& [side, curve] : sides_)
      if (!is_split(curve))
        curves.note([&, edge = side] { return place_of(mesh_, edge); });
    report_.none("split_curves", curves, "pairs and boundary edges of curves that are not split in /trime_mpi/curves");
    report_.none("split_paths", paths, "pairs whose path does not follow the one before, or has several curves");
  }

  Facet joined(const Facet& edge) const {
    return {lowest_[static_cast<std::size_t>(edge[0])], lowest_[static_cast<std::size_t>(edge[1])]};
  }

  /// Each side has one other side in the opposite direction, with the same curve.
  void check_sides() {
    std::map<Facet, std::int64_t> count; // of sides of the joined mesh
    for (const auto& [side, curve] : sides_)
      ++count[joined(side)];
    Tally alone;
    for (const auto& [side, curve] : sides_) {
      const Facet edge = joined(side);
      const auto other = count.find({edge[1], edge[0]});
      if (count[edge] != 1 || other == count.end() || other->second != 1)
        alone.note([&, found = side] { return place_of(mesh_, found); });
    }
    report_.none(
        "split_sides", alone,
        fmt::format("boundary edges on curves (of {}) without one edge of opposite direction on the other side",
                    sides_.size()));
  }

  /// Takes a side with this curve off the list of those that no pairs have named. Returns whether it is there.
  bool take(const Facet& side, std::int64_t curve) {
    const auto found = sides_.find(side);
    if (found == sides_.end() || found->second != curve)
      return false;
    unnamed_.erase(side);
    return true;
  }
  bool take_both(const Facet& from, const Facet& to, std::int64_t curve) {
    const bool left = take({from[0], to[0]}, curve), right = take({to[1], from[1]}, curve);
    return left && right;
  }
  /// Ends of the curve that are one point, by the sides that lead from them and to them.
  void take_ends(const std::map<std::int64_t, std::int64_t>& from, const std::map<std::int64_t, std::int64_t>& to,
                 std::size_t first, std::size_t last) {
    const std::int64_t curve = mesh_.split_curves[first];
    const auto single = [&](const std::map<std::int64_t, std::int64_t>& map, std::int64_t point) -> std::int64_t {
      const auto found = map.find(point);
      return found == map.end() || in_pair_.contains(found->second) ? -1 : found->second;
    };
    if (const std::int64_t end = single(to, mesh_.split_pairs[first][0]); end >= 0)
      take_both({end, end}, mesh_.split_pairs[first], curve);
    if (const std::int64_t end = single(from, mesh_.split_pairs[last][0]); end >= 0)
      take_both(mesh_.split_pairs[last], {end, end}, curve);
  }

  /// Follows the pairs: sides lead from each to the next on the left, and back on the right.
  void check_order() {
    std::map<std::int64_t, std::int64_t> from, to; // other ends of the sides that begin and end at a point
    for (const auto& [side, curve] : sides_) {
      unnamed_.insert(side);
      from.emplace(side[0], side[1]);
      to.emplace(side[1], side[0]);
    }
    Tally jumps;
    const std::vector<Facet>& pairs = mesh_.split_pairs;
    for (std::size_t first = 0, end = 0; first < pairs.size(); first = end) {
      for (end = first + 1; end < pairs.size() && mesh_.split_paths[end] == mesh_.split_paths[first]; ++end)
        if (!take_both(pairs[end - 1], pairs[end], mesh_.split_curves[first]))
          jumps.note([&] { return row(end); });
      take_both(pairs[end - 1], pairs[first], mesh_.split_curves[first]); // of a ring
      take_ends(from, to, first, end - 1);
    }
    Tally unnamed;
    for (const Facet& side : unnamed_)
      unnamed.note([&] { return place_of(mesh_, side); });
    report_.none("split_order", jumps,
                 "pairs to which no edges lead from the pair before, forwards on the left and backwards on the right");
    report_.none("split_listed", unnamed, "boundary edges on curves that lie between no pairs in the list");
  }

  const Mesh& mesh_;
  Report& report_;
  const std::int64_t parts_;
  const std::vector<double> is_split_; // by curve
  const std::vector<std::int64_t> lowest_;
  std::map<Facet, std::int64_t> sides_; // curve of each boundary edge on a split curve
  std::set<std::int64_t> in_pair_;      // points
  std::set<Facet> unnamed_;             // sides
};

} // namespace

void check_splits(const StoredFile& file, const Mesh& mesh, Report& report) {
  SplitChecks(file, mesh, report).run();
}

} // namespace trime_check
