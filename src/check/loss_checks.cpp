// SPDX-License-Identifier: BSD-3-Clause
// Checks the table that says which regions have lost an area to which others.
#include "checks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace trime_check {
namespace {

// [area of the mesh] Areas in tables are sums in double precision.
constexpr double area_tolerance = 1e-12;
// [area of the region] The table leaves out sums below 1e-9 of a region, for each neighbour and reason.
constexpr double loss_tolerance = 1e-7;

/// Collects what the triangles of a region and the tables of the file say.
struct Balance {
  double area = 0;        // of its triangles
  bool is_on_rim = false; // some of its edges are facets
  double lost = 0;        // less what it has gained
};

using Balances = std::map<std::int64_t, Balance>;

Balances balances_of(const Mesh& mesh) {
  std::set<Facet> rim;
  for (const Facet& facet : mesh.facets)
    rim.insert(ascending(facet));
  Balances balances;
  for (std::size_t t = 0; t < std::min(mesh.triangles.size(), mesh.region.size()); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    const auto [a, b, c] = mesh.corners(triangle);
    const Point u = b - a, v = c - a;
    Balance& own = balances[mesh.region[t]];
    own.area += 0.5 * (u.x * v.y - u.y * v.x);
    for (std::size_t k = 0; k < 3; ++k)
      own.is_on_rim |= rim.contains(ascending({triangle[k], triangle[(k + 1) % 3]}));
  }
  return balances;
}

/// Adds up the rows. Returns those that are wrong.
Tally read_losses(const StoredFile& file, Balances& balances) {
  const std::string table = "/trime_mpi/region_losses/";
  const std::vector<double> losers = file.column(table + "loser"), winners = file.column(table + "winner"),
                            areas = file.column(table + "area"), largest = file.column(table + "largest_area");
  const std::vector<double> ids = file.column("/trime_mpi/regions/region_id");
  const std::set<double> known(ids.begin(), ids.end());
  Tally wrong;
  for (std::size_t k = 0; k < areas.size(); ++k) {
    const bool is_whole = k < std::min({losers.size(), winners.size(), largest.size()});
    if (!is_whole || losers[k] == winners[k] || !known.contains(losers[k]) || !known.contains(winners[k]) ||
        !(largest[k] > 0 && largest[k] <= areas[k])) {
      wrong.note([&] { return fmt::format("row {}", k); });
      continue;
    }
    balances[static_cast<std::int64_t>(losers[k])].lost += areas[k];
    balances[static_cast<std::int64_t>(winners[k])].lost -= areas[k];
  }
  return wrong;
}

} // namespace

void check_losses(const StoredFile& file, const Mesh& mesh, Report& report) {
  if (!file.has("/trime_mpi/region_losses") || !file.has("/trime_mpi/regions"))
    return;
  Balances balances = balances_of(mesh);
  report.none("region_loss_rows", read_losses(file, balances),
              "rows of /trime_mpi/region_losses without two different regions, or with a largest area above the sum");
  const std::vector<double> ids = file.column("/trime_mpi/regions/region_id"),
                            given = file.column("/trime_mpi/regions/given_area");
  double found = 0, expected = 0;
  for (const auto& of_region : balances)
    found += of_region.second.area;
  for (const double area : given)
    expected += area;
  const bool is_rim_same = std::fabs(found - expected) <= area_tolerance * found;
  Tally wrong;
  for (std::size_t k = 0; k < std::min(ids.size(), given.size()); ++k) {
    const Balance& own = balances[static_cast<std::int64_t>(ids[k])];
    const double sum = own.area + own.lost;
    if ((is_rim_same || !own.is_on_rim) &&
        !(std::fabs(sum - given[k]) <= loss_tolerance * given[k] + area_tolerance * found))
      wrong.note(
          [&] { return fmt::format("region {}: {:.12g} with its losses, {:.12g} given", ids[k], sum, given[k]); });
  }
  report.none("region_losses", wrong,
              "regions whose area with all losses and gains is not the area that was given; regions at the boundary "
              "are compared only if the boundary has lost no area");
}

} // namespace trime_check
