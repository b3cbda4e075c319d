// SPDX-License-Identifier: BSD-3-Clause
#include "start/density_changes.hpp"

#include "comm/agree.hpp"
#include "comm/outbox.hpp"
#include "core/angle.hpp"
#include "core/thread_loop.hpp"
#include "sites/fan.hpp"
#include "sizing/size_blocks.hpp"
#include "start/refinement.hpp"
#include "start/rules.hpp"
#include "trime/core/sum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

namespace trime::start {
namespace {

using geometry::Vec2;
using sites::Fan;
using sites::inside_fan;
using sites::Stage;
using sites::StageView;

// [sites] Largest share of one site: more triangles than that are left to the next call.
constexpr double largest_share = 4;

// [sites] Sites are taken out or put in when the sum of the shares differs from the number of sites by more than this.
// The sum over the first sites of a tile varies by up to two where the density is right, because the triangles at the
// edge of these sites belong to other sites, too.
constexpr double tolerated = 3;

// [sites] The same where the share of a single site says that the density is wrong.
constexpr double tolerated_at_wrong_share = 0.5;

// [1] Such shares are above or below these. In a relaxed mesh nearly all of them lie between 0.8 and 1.2.
constexpr double wrong_above = 1.5, wrong_below = 0.55;

// [sites] From this share on, new sites lie in the middles of edges, and otherwise in the middles of triangles: four
// times as many sites are regular if each edge is divided.
constexpr double share_of_edges = 2.5;

// [1] The factor between the shares and the wanted number lies within this of 1. It is the error of the sum of the
// shares, if the old triangles are large compared with changes of the size.
constexpr double largest_correction = 0.1;

// [1] Nothing is finished while more than this share of the sites has a share above largest_share.
constexpr double few_starved = 1e-3;

constexpr double third = 1.0 / 3;

/// The number of sites that the triangles around a site can be shared among; a site on the boundary counts half.
double wanted_share(const mesh::BinnedPoints& points, LocalIndex i) {
  return points.boundary(i) >= 0 ? 0.5 : 1;
}

/// The share of a site: a third of the area of its triangles over the area of a site in a regular mesh.
double share_of(const StageView& view, LocalIndex i) {
  const mesh::BinnedPoints& points = view.state.points();
  const Fan fan = inside_fan(view, i);
  const Vec2 p = points.position(i);
  double twice = 0;
  for (std::size_t k = 0; k < fan.triangles; ++k)
    twice +=
        std::fabs(geometry::cross(points.position(fan.neighbour(k)) - p, points.position(fan.neighbour(k + 1)) - p));
  const double h = view.state.sizes().known(i) ? view.state.sizes()[i] : view.size.size(p);
  return std::fmin(0.5 * third * twice / (row_height * h * h), 0x1p17);
}

/// The places of new sites around a site, the most urgent one first.
std::vector<Vec2> places_around(const StageView& view, LocalIndex i, bool on_edges) {
  const mesh::BinnedPoints& points = view.state.points();
  const geometry::Periods& periods = view.polygon.periods;
  const Fan fan = inside_fan(view, i);
  const Vec2 p = points.position(i);
  std::vector<std::pair<double, Vec2>> found; // measure of the edge or triangle, its middle
  for (std::size_t k = on_edges && !fan.closed ? 1 : 0; k < fan.triangles; ++k) { // the first edge may be a chord
    const Vec2 q = points.position(fan.neighbour(k)), r = points.position(fan.neighbour(k + 1));
    if (on_edges && periods.less(p, q))
      found.push_back({geometry::length(q - p), p + 0.5 * (q - p)});
    if (!on_edges && periods.less(p, q) && periods.less(p, r))
      found.push_back({std::fabs(geometry::cross(q - p, r - p)), p + third * ((q - p) + (r - p))});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : geometry::lexicographically_less(a.second, b.second);
  });
  std::vector<Vec2> places;
  for (const auto& [measure, place] : found)
    places.push_back(periods.wrap(view.lattice.snap(place)));
  return places;
}

/// Walks along the sites of a tile, and compares their shares with their number.
class Walk {
public:
  Walk(const StageView& view, const Stage& next, std::span<const double> shares, std::vector<std::uint8_t>& gone)
      : view_(view), next_(next), points_(view.state.points()), shares_(shares), gone_(gone) {}

  /// @param correction factor on the shares
  void visit(LocalIndex i, double correction) {
    const double share = std::fmin(correction * shares_[at(i)], largest_share);
    ahead_ += share - wanted_share(points_, i);
    if (points_.boundary(i) == mesh::free_site && (smallest_ < 0 || shares_[at(i)] < shares_[at(smallest_)]))
      smallest_ = i;
    if (largest_ < 0 || shares_[at(i)] > shares_[at(largest_)])
      largest_ = i;
    const double free = wanted_share(points_, i);
    const double most = share > wrong_above * free || share < wrong_below * free ? tolerated_at_wrong_share : tolerated;
    if (ahead_ < -most && smallest_ >= 0)
      take_out();
    else if (ahead_ > most)
      put_in(share > share_of_edges ? i : largest_, share > share_of_edges, most);
    ahead_ = std::clamp(ahead_, -2 * tolerated, 2 * tolerated); // the rest is left to the next call
  }

  std::vector<Vec2> come;

private:
  void take_out() {
    gone_[at(smallest_)] = 1;
    ahead_ += 1;
    smallest_ = largest_ = -1;
  }

  void put_in(LocalIndex i, bool on_edges, double most) {
    for (const Vec2 place : places_around(view_, i, on_edges)) {
      if (ahead_ <= most)
        break;
      if (!is_clear(next_, place))
        continue;
      come.push_back(place);
      ahead_ -= 1;
      smallest_ = largest_ = -1;
    }
  }

  const StageView& view_;
  const Stage& next_;
  const mesh::BinnedPoints& points_;
  std::span<const double> shares_;
  std::vector<std::uint8_t>& gone_;
  double ahead_ = 0;                        // sum of the shares minus the number of sites
  LocalIndex smallest_ = -1, largest_ = -1; // sites with these shares since the last change
};

/// Returns the owned sites of a tile along the Hilbert curve.
std::vector<LocalIndex> along_curve(const StageView& view, mesh::SiteRange range) {
  const mesh::BinnedPoints& points = view.state.points();
  std::vector<std::pair<std::uint64_t, LocalIndex>> keys;
  for (LocalIndex i = range.begin; i < range.end; ++i)
    keys.push_back({view.state.grid().point_key(points.position(i)), i});
  std::sort(keys.begin(), keys.end()); // of equal keys the first in the order of coordinates
  std::vector<LocalIndex> sites;
  for (const auto& [key, i] : keys)
    sites.push_back(i);
  return sites;
}

/// Returns the shares of the owned sites. Collective.
std::vector<double> shares_of(const StageView& view) {
  std::vector<double> shares(at(view.state.points().owned()));
  comm::run_agreed(view.state.comm(), [&] {
    thread_loop(std::ssize(shares), 256, [&](std::ptrdiff_t i, int) {
      shares[static_cast<std::size_t>(i)] = share_of(view, static_cast<LocalIndex>(i));
    });
  });
  return shares;
}

/// Returns the factor on the shares with which their sum is the wanted number of sites. Collective.
double correction_of(const StageView& view, std::span<const double> shares, double wanted) {
  const mesh::BinnedPoints& points = view.state.points();
  FixedSum sum, placed_first; // placed_first: sites that `wanted` does not count
  for (LocalIndex i = 0; i < points.owned(); ++i) {
    sum.add(shares[at(i)]);
    if (points.boundary(i) != mesh::free_site)
      placed_first.add(wanted_share(points, i));
  }
  std::array<std::int64_t, 4> parts{sum.split().low, sum.split().high, placed_first.split().low,
                                    placed_first.split().high};
  view.state.comm().sum(parts);
  const double all = FixedSum::join({parts[0], parts[1]}).value();
  const double want = wanted + FixedSum::join({parts[2], parts[3]}).value();
  return std::clamp(want / std::fmax(all, 1), 1 - largest_correction, 1 + largest_correction);
}

} // namespace

DensityChanges changes_for_density(const StageView& view, const Stage& next, double wanted) {
  const mesh::BinnedPoints& points = view.state.points();
  const comm::Communicator& comm = view.state.comm();
  const std::vector<double> shares = shares_of(view);
  const double correction = correction_of(view, shares, wanted);
  const LocalIndex first_tile = points.first_tile(), tiles = points.last_tile() - first_tile;
  std::vector<std::uint8_t> gone(at(points.owned()));
  std::vector<std::vector<Vec2>> come(at(tiles));
  comm::run_agreed(comm, [&] {
    thread_loop(tiles, 1, [&](std::ptrdiff_t t, int) {
      Walk walk(view, next, shares, gone);
      for (const LocalIndex i : along_curve(view, points.tile_range(first_tile + static_cast<LocalIndex>(t))))
        walk.visit(i, correction);
      come[static_cast<std::size_t>(t)] = std::move(walk.come);
    });
  });
  DensityChanges made;
  std::int64_t starved = 0;
  for (LocalIndex i = 0; i < points.owned(); ++i) {
    starved += correction * shares[at(i)] > largest_share;
    if (gone[at(i)])
      made.gone.push_back(i);
  }
  for (const std::vector<Vec2>& places : come)
    for (const Vec2 place : places)
      made.come.push_back({place});
  std::array<std::int64_t, 4> counts{std::ssize(made.gone), std::ssize(made.come), starved, points.owned()};
  comm.sum(counts);
  made.removed = counts[0];
  made.inserted = counts[1];
  const auto sites = static_cast<double>(counts[3]);
  made.is_finished = static_cast<double>(counts[2]) <= few_starved * sites &&
                     static_cast<double>(made.removed + made.inserted) <= StartRules::small_change * sites;
  return made;
}

mesh::SiteList sites_after(const sites::SiteState& state, const DensityChanges& changes) {
  const mesh::BinnedPoints& points = state.points();
  mesh::SiteList sites;
  auto gone = changes.gone.begin();
  for (LocalIndex i = 0; i < points.owned(); ++i)
    if (gone != changes.gone.end() && *gone == i)
      ++gone;
    else if (points.boundary(i) == mesh::free_site)
      sites.push_back({points.position(i)});
  sites.insert(sites.end(), changes.come.begin(), changes.come.end());
  return sites;
}

void edit_for_density(Stage& stage, DensityChanges changes, const delaunay::StarBuilder& builder) {
  sites::SiteState& state = *stage.state;
  comm::Outbox<Vec2> outbox;
  for (const mesh::Site& site : changes.come)
    outbox[state.partition().owner(state.grid().place(site.position).tile)].push_back(site.position);
  std::vector<Vec2> places = std::move(outbox[state.comm().rank()]);
  outbox.erase(state.comm().rank());
  for (const comm::Message& message : comm::send(state.comm(), outbox)) {
    const std::vector<Vec2> of_rank = comm::from_bytes<Vec2>(message.data);
    places.insert(places.end(), of_rank.begin(), of_rank.end());
  }
  std::sort(places.begin(), places.end(), geometry::lexicographically_less);
  std::vector<double> sizes;
  comm::run_agreed(state.comm(), [&] { sizes = sizing::checked_sizes_at(*stage.size, places); });
  mesh::SiteList come;
  for (const Vec2 place : places)
    come.push_back({place});
  state.edit_sites(builder, std::move(changes.gone), std::move(come), sizes);
}

} // namespace trime::start
