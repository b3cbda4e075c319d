// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/zoned_lattice.hpp"

#include "fitting/lattice_fit.hpp"
#include "placing/work_share.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace trime::fitting {
namespace {

// [rounds] Largest number of layouts of the boundary, each at a size between those of the boundary and of the lattice
// before. North America needs 1, 500 discs at 40 points each 3.
constexpr int most_layouts = 6;

// [1] If the spacing differs from the uniform size by a smaller share, the boundary is not laid out again.
constexpr double same_spacing = 0.02;

// [1] If they differ by a larger share, so few sites are on the lattice that its spacing says nothing about the size.
constexpr double other_spacing = 0.3;

// [1] If a larger share of the sites inside is missing, since the lattice loses whole rows at a time, there is no
// lattice. A start from coarse to fine inserts sites if as many are missing.
constexpr double largest_shortage = 0.01;

// [1] If the zones have a larger share of the sites inside, sites are placed along the Hilbert curve everywhere, from
// coarse to fine. Measured on coasts, grains and 11 wavy interfaces: with smaller shares the mean of alpha was always
// smaller with a lattice; with 0.44 it was smaller in two of three cases.
constexpr double largest_zones = 0.4;

/// Lays out the boundary at a fitted size times a number, and with the limits that it then needs.
sites::Stage lay_scaled(const LayoutContext& context, FittedSize& fitted, double factor, double expected) {
  fitted.factor *= factor;
  for (sizing::SizeLimit& limit : fitted.limits)
    limit.size = std::fmax(context.options.least_lowered, factor * limit.size);
  sites::Stage stage = lay_stage(context, fitted, 1, expected);
  const std::vector<sizing::SizeLimit> more = further_limits(context, stage);
  if (more.empty())
    return stage;
  fitted.limits.insert(fitted.limits.end(), more.begin(), more.end());
  return lay_stage(context, fitted, 1, expected);
}

/// @brief Finds the sites of a stage. @param wanted number of sites inside
/// @return nothing if the zones have too large a share, or too few sites fit
std::optional<ZonedLattice> fit_to(const LayoutContext& context, const sites::Stage& stage, double wanted) {
  const double h = stage.asked_size().size({});
  const mesh::TileRange tiles = placing::own_share(stage);
  ZonedLattice found;
  found.zones = std::make_unique<const placing::LoweredZones>(*stage.lowered_size, h, context.narrow_gradation());
  {
    const auto time = context.timers.scope("start");
    found.along_curve = std::make_unique<const placing::HilbertStart>(context.comm, tiles, *stage.guard, *stage.size,
                                                                      context.lattice, wanted, 1, found.zones.get());
  }
  found.in_zones = static_cast<std::int64_t>(found.along_curve->wanted());
  if (!(static_cast<double>(found.in_zones) < largest_zones * wanted))
    return std::nullopt;
  const placing::LatticeStart lattice(context.given_boundary, *stage.guard, context.lattice, found.zones.get());
  found.runs = context.options.points ? fitting_runs(context, stage, lattice, h, std::llround(wanted) - found.in_zones)
                                      : lattice.runs(tiles, h);
  const double missing = wanted - static_cast<double>(found.in_zones + context.comm.sum(found.runs.count()));
  if (context.options.points && missing > largest_shortage * wanted)
    return std::nullopt;
  return found;
}

} // namespace

std::optional<ZonedLattice> fit_zoned_lattice(const LayoutContext& context, const FittedSize& fitted, StageFit& fit,
                                              double expected) {
  if (!context.relative_size.is_uniform() || !fit.stage.lowered_size || fit.stage.raised_size || fit.stage.limited_size)
    return std::nullopt;
  fit.stage = lay_again(context, std::move(fit.stage), expected);
  std::optional<sites::Stage> laid_again;
  FittedSize size = fitted;
  for (int round = 1;; ++round) {
    sites::Stage& stage = laid_again ? *laid_again : fit.stage;
    const double wanted = context.options.points && fit.shortage.empty()
                              ? expected - static_cast<double>(stage.placed_first())
                              : fit.inner;
    std::optional<ZonedLattice> found = fit_to(context, stage, wanted);
    if (!found)
      return std::nullopt;
    const double ratio = found->runs.spacing / stage.asked_size().size({});
    if (std::fabs(ratio - 1) < same_spacing) {
      found->stage = std::move(stage);
      found->fitted = std::move(size);
      return found;
    }
    if (round == most_layouts || !(std::fabs(ratio - 1) < other_spacing))
      return std::nullopt;
    laid_again = lay_scaled(context, size, std::sqrt(ratio), expected);
    if (!laid_again->lowered_size)
      return std::nullopt;
  }
}

} // namespace trime::fitting
