// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/density_integral.hpp"

#include "placing/work_share.hpp"

#include "trime/core/sum.hpp"

#include <array>
#include <cmath>

namespace trime::fitting {
using sites::Stage;

DensityTotals integrate_density(const comm::Communicator& comm, const mesh::TileRange& tiles,
                                const placing::DensitySampler& sampler) {
  const double unit = std::fmax(tiles.grid.container().width(), tiles.grid.container().height());
  const placing::DensityParts parts{tiles, sampler};
  std::vector<std::int64_t> sites(static_cast<std::size_t>(parts.count()), 0);
  std::vector<FixedSum> sizes(sites.size());
  placing::agreed_loop(comm, parts.count(), [&](std::ptrdiff_t part) {
    const std::size_t at = static_cast<std::size_t>(part);
    parts.for_each_cell(part, [&](const placing::DensitySampler::Cell& cell) {
      sites[at] += cell.weight;
      sizes[at].add(static_cast<double>(cell.weight) / placing::DensitySampler::weight_unit * (cell.size / unit));
    });
  });
  std::int64_t all_sites = 0;
  FixedSum all_sizes;
  for (std::size_t t = 0; t < sites.size(); ++t) {
    all_sites += sites[t];
    all_sizes.add(sizes[t]);
  }
  const auto halves = all_sizes.split();
  std::array<std::int64_t, 3> packed{all_sites, halves.low, halves.high};
  comm.sum(packed);
  DensityTotals totals;
  totals.sites = static_cast<double>(packed[0]) / placing::DensitySampler::weight_unit;
  totals.mean_size = packed[0] > 0 ? FixedSum::join({packed[1], packed[2]}).value() * unit / totals.sites : 0;
  return totals;
}

DensityTotals wanted_inside(const LayoutContext& context, const Stage& stage, double coarsening, double most_in_part) {
  const auto time = context.timers.scope("start");
  const mesh::TileRange tiles = placing::own_share(stage);
  return integrate_density(
      context.comm, tiles,
      placing::DensitySampler(tiles.grid, *stage.guard, *stage.size, context.lattice, coarsening, most_in_part));
}

} // namespace trime::fitting
