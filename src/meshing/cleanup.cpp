// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/cleanup.hpp"

#include "meshing/extraction.hpp"
#include "meshing/selection.hpp"
#include "trime/comm/agree.hpp"
#include "trime/core/random.hpp"
#include "trime/core/thread_loop.hpp"
#include "trime/mesh/quality.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>

namespace trime::meshing {
namespace {

using geometry::Vec2;

constexpr int hash_bits = 44;
constexpr int classes_per_octave = 8;
constexpr int passes_of_choice = 5;
/// The worst triangles first: thresholds of the stages, as multiples of the excess that counts as bad.
constexpr std::array<double, 3> stages{4, 2, 1};
constexpr int few_of = 5; // below this part of the patches of the fullest round the next stage takes the rest along
constexpr int most_failures = 2;       // in a cell of a quarter to half of h; then it is left alone for good
constexpr double largest_loss = 0.005; // of the sites
/// Where sites, or room for more of them, are fewer than this share of all: factor on the sum of a trial that deletes.
constexpr double scarcity = 0.001, handicap_if_scarce = 1.5, handicap_if_crowded = 0.85;
constexpr double around_bad_site = 3, around_patch = 3; // h: how far stars are computed anew, beyond its reach

std::size_t at(LocalIndex i) {
  return static_cast<std::size_t>(i);
}

std::uint64_t hash_of(Vec2 p, int salt) {
  return mix_bits(mix_bits(std::bit_cast<std::uint64_t>(p.x) + static_cast<std::uint64_t>(salt)) ^
                  std::bit_cast<std::uint64_t>(p.y));
}

/// A class of sizes, eight to an octave, and its upper end.
struct SizeClass {
  std::int64_t number;
  double upper;
};

SizeClass class_of(double h) {
  int exponent = 0;
  const double mantissa = std::frexp(h, &exponent);
  const int part = static_cast<int>((mantissa - 0.5) * (2 * classes_per_octave));
  return {std::int64_t{classes_per_octave} * (exponent + 1100) + part,
          std::ldexp(0.5 + (part + 1) / (2.0 * classes_per_octave), exponent)};
}

/// Sends each rank its list; what arrives, own items first.
template <class T>
std::vector<T> send(const comm::Communicator& comm, const std::map<int, std::vector<T>>& by_rank) {
  std::vector<comm::Message> outgoing;
  std::vector<T> all;
  for (const auto& [rank, list] : by_rank)
    if (rank == comm.rank())
      all = list;
    else
      outgoing.push_back({rank, comm::to_bytes(std::span<const T>(list))});
  for (const comm::Message& message : comm.exchange_any(outgoing)) {
    const std::vector<T> arrived = comm::from_bytes<T>(message.data);
    all.insert(all.end(), arrived.begin(), arrived.end());
  }
  return all;
}

/// Positive doubles compare like the integers with their bits.
GlobalId key_of(double alpha) {
  return std::bit_cast<std::int64_t>(alpha);
}

} // namespace

void CleanupCounts::add(const CleanupCounts& other) {
  patches += other.patches;
  better += other.better;
  moved += other.moved;
  inserted += other.inserted;
  deleted += other.deleted;
  on_boundary += other.on_boundary;
  left += other.left;
}

Cleanup::Cleanup(const comm::Communicator& comm, Layout& layout, const geometry::Boundary& boundary,
                 const geometry::Lattice& lattice, const delaunay::StarBuilder& builder, GlobalId most_sites,
                 const PatchOptions& options)
    : comm_(comm), layout_(layout), state_(*layout.state), curve_(boundary), lattice_(lattice), builder_(builder),
      options_(options), most_sites_(most_sites), sites_(comm.sum(std::int64_t{state_.points().owned()})) {
  const GlobalId leeway = static_cast<GlobalId>(largest_loss * static_cast<double>(sites_)) + 1;
  most_sites_ = most_sites_ > 0 ? std::max(most_sites_, sites_) : sites_ + leeway;
  wanted_sites_ = sites_;
  least_sites_ = sites_ - leeway;
}

/// Of the cell of a place, a power of two wide, in its tile: the same on any number of ranks.
std::uint64_t Cleanup::cell_key(Vec2 p, double h) const {
  int exponent = 0;
  std::frexp(h, &exponent);
  const Vec2 cell{std::floor(std::ldexp(p.x, 2 - exponent)), std::floor(std::ldexp(p.y, 2 - exponent))};
  return mix_bits(hash_of(cell, exponent) + static_cast<std::uint64_t>(state_.grid().place(p).tile));
}

bool Cleanup::is_hopeless(LocalIndex i, double h) const {
  const Vec2 p = state_.points().position(i);
  if (hopeless_.contains(hash_of(p, 0)))
    return true;
  const auto cell = failures_.find(cell_key(p, h));
  return cell != failures_.end() && cell->second >= most_failures;
}

/// What a star of one of these places may look at, sent to the owners of all tiles there.
std::vector<Disc> Cleanup::share_places() const {
  const mesh::TileGrid& grid = state_.grid();
  std::map<int, std::vector<Disc>> by_rank;
  for (const Disc& disc : places_) {
    const geometry::Vec2 reach{disc.radius, disc.radius}, low = disc.center - reach, high = disc.center + reach;
    const int x1 = grid.tile_of(grid.fixed_x(high.x)), y1 = grid.tile_of(grid.fixed_y(high.y));
    std::vector<int> ranks;
    for (int y = grid.tile_of(grid.fixed_y(low.y)); y <= y1; ++y)
      for (int x = grid.tile_of(grid.fixed_x(low.x)); x <= x1; ++x)
        ranks.push_back(state_.partition().owner(grid.tile_at(x, y)));
    std::sort(ranks.begin(), ranks.end());
    ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
    for (const int rank : ranks)
      by_rank[rank].push_back(disc);
  }
  return send(comm_, by_rank);
}

/// In the first round of a stage, and in a periodic container, all stars; else those at the places of the last round:
/// elsewhere there is nothing bad, and nothing has changed. None if nothing has changed at all.
void Cleanup::compute_stars() {
  if (!changed_ && !all_stars_)
    return;
  if (std::exchange(all_stars_, false) || state_.grid().periods().any()) {
    state_.compute_stars(builder_, *layout_.size, Wanted::all_sites);
    return;
  }
  const mesh::BinnedPoints& points = state_.points();
  std::vector<delaunay::StarWish> wanted(at(points.owned()), delaunay::StarWish::leave);
  for (const Disc& disc : share_places())
    points.for_each_near(
        disc.center, disc.radius,
        [&](LocalIndex begin, LocalIndex end) {
          for (LocalIndex j = begin; j < std::min(end, points.owned()); ++j)
            if (geometry::squared_length(points.position(j) - disc.center) < disc.radius * disc.radius)
              wanted[at(j)] = delaunay::StarWish::compute;
        },
        [](mesh::BinRef) {});
  state_.compute_stars(builder_, *layout_.size, wanted);
}

/// Bad sites and those around them are looked at again.
void Cleanup::remember_places(const std::vector<GlobalId>& keys) {
  const StarView view = view_of(state_, *layout_.size);
  places_.clear();
  for (LocalIndex i = 0; i < state_.points().owned(); ++i)
    if (keys[at(i)] != 0)
      places_.push_back({state_.points().position(i), around_bad_site * view.size(i)});
}

/// Key of the worst triangle of each owned site, 0 below the threshold or where nothing helps.
std::vector<GlobalId> Cleanup::worst_alphas() const {
  const ExtractionContext context{state_, layout_.boundary, *layout_.size, lattice_};
  const StarView view = view_of(state_, *layout_.size);
  const mesh::BinnedPoints& points = state_.points();
  std::vector<GlobalId> keys(at(points.owned()), 0);
  thread_loop(points.owned(), 1024, [&](std::ptrdiff_t item, int) {
    const auto i = static_cast<LocalIndex>(item);
    if (!state_.stars().certain(i))
      return;
    const Fan fan = inside_fan(context, i);
    if (!fan.complete)
      return;
    const Vec2 p = points.position(i);
    double worst = 1;
    for (std::size_t k = 0; k < fan.triangles; ++k)
      worst = std::max(worst,
                       mesh::aspect_ratio(p, points.position(fan.neighbour(k)), points.position(fan.neighbour(k + 1))));
    if (worst > threshold_ && std::isfinite(worst) && !is_hopeless(i, view.size(i)))
      keys[at(i)] = key_of(worst);
  });
  return keys;
}

/// Local maxima of badness; `order` receives their rank among candidates, 0 for all other owned sites.
std::vector<Cleanup::Candidate> Cleanup::find_candidates(std::vector<GlobalId>& order) {
  const mesh::BinnedPoints& points = state_.points();
  const StarView view = view_of(state_, *layout_.size);
  std::vector<GlobalId> keys = worst_alphas();
  remember_places(keys);
  const std::vector<GlobalId> of_ghosts = state_.halo().exchange(points, keys);
  keys.insert(keys.end(), of_ghosts.begin(), of_ghosts.end());
  const geometry::Periods& periods = points.grid().periods();
  std::vector<Candidate> candidates;
  order.assign(at(points.owned()), 0);
  const double limit = 0.45 * std::min(periods.x > 0 ? periods.x : INFINITY, periods.y > 0 ? periods.y : INFINITY);
  for (LocalIndex i = 0; i < points.owned(); ++i) {
    if (keys[at(i)] == 0)
      continue;
    const auto is_worse = [&](LocalIndex j) {
      return j != delaunay::gap &&
             (keys[at(j)] > keys[at(i)] ||
              (keys[at(j)] == keys[at(i)] && periods.less(points.position(j), points.position(i))));
    };
    const auto ring = state_.stars().ring(i);
    if (std::any_of(ring.begin(), ring.end(), is_worse))
      continue;
    const SizeClass its_class = class_of(view.size(i));
    const double separation = (2 * options_.reach - PatchOptions::clearance) * its_class.upper;
    if (separation > limit)
      continue;
    candidates.push_back({i, separation});
    order[at(i)] = (its_class.number << hash_bits) |
                   static_cast<GlobalId>(hash_of(points.position(i), 1 + round_) >> (64 - hash_bits));
  }
  return candidates;
}

/// Takes out the candidates with more sites around than a patch looks at: nothing helps there.
/// @return how many
std::int64_t Cleanup::leave_crowded(std::vector<Candidate>& candidates, std::vector<GlobalId>& order) {
  const mesh::BinnedPoints& points = state_.points();
  const StarView view = view_of(state_, *layout_.size);
  return static_cast<std::int64_t>(std::erase_if(candidates, [&](const Candidate& candidate) {
    const double h = view.size(candidate.site);
    if (sites_around(candidate.site, options_.reach * h).size() <= options_.most_sites)
      return false;
    note_failure(points.position(candidate.site), h);
    order[at(candidate.site)] = 0;
    return true;
  }));
}

/// Nothing helps at a site. @param h there if it was the middle of the patch, else 0
void Cleanup::note_failure(Vec2 p, double h) {
  hopeless_.insert(hash_of(p, 0));
  if (h > 0)
    ++failures_[cell_key(p, h)];
}

/// @brief Leaves a set of candidates that keep their separations, as large as a few rounds make it (Luby 1986): who is
/// the first of its surroundings stays, whoever is near it leaves, and again.
///
/// Those of a smaller class come first, so that of two the one that has to leave looks far enough.
void Cleanup::choose_apart(std::vector<Candidate>& candidates, std::vector<GlobalId> order) const {
  const mesh::BinnedPoints& points = state_.points();
  std::vector<Candidate> chosen;
  for (int pass = 0; pass < passes_of_choice; ++pass) {
    const std::vector<GlobalId> of_ghosts = state_.halo().exchange(points, order); // 0: none, negative: chosen
    std::vector<GlobalId> all = order;
    all.insert(all.end(), of_ghosts.begin(), of_ghosts.end());
    std::erase_if(candidates, [&](const Candidate& candidate) {
      const Vec2 p = points.position(candidate.site);
      const GlobalId own = all[at(candidate.site)];
      bool first = true, leaves = false;
      const auto look = [&](LocalIndex begin, LocalIndex end) {
        for (LocalIndex j = begin; j < end; ++j)
          if (all[at(j)] != 0 && j != candidate.site &&
              geometry::squared_length(points.position(j) - p) < candidate.separation * candidate.separation) {
            leaves |= all[at(j)] < 0;
            first &= all[at(j)] > own;
          }
      };
      points.for_each_near(p, candidate.separation, look, [](mesh::BinRef) {});
      if (leaves)
        order[at(candidate.site)] = 0;
      else if (first) {
        order[at(candidate.site)] = -1;
        chosen.push_back(candidate);
      }
      return leaves || first;
    });
  }
  candidates = std::move(chosen);
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.site < b.site; });
}

/// All of them; or some, more than a patch looks at.
std::vector<PatchSite> Cleanup::sites_around(LocalIndex site, double reach) const {
  const mesh::BinnedPoints& points = state_.points();
  const StarView view = view_of(state_, *layout_.size);
  const Vec2 center = points.position(site);
  std::vector<PatchSite> sites;
  points.for_each_near(
      center, reach,
      [&](LocalIndex begin, LocalIndex end) {
        for (LocalIndex j = begin; j < end && sites.size() <= options_.most_sites; ++j)
          if (geometry::squared_length(points.position(j) - center) < reach * reach)
            sites.push_back({points.position(j), view.size(j), points.boundary(j)});
      },
      [](mesh::BinRef) {});
  std::sort(sites.begin(), sites.end(), [](const PatchSite& a, const PatchSite& b) {
    return geometry::lexicographically_less(a.position, b.position);
  });
  return sites;
}

void Cleanup::set_tolerances(std::vector<PatchSite>& sites) const {
  for (PatchSite& site : sites)
    if (site.boundary >= 0 && options_.tolerance > 0)
      site.tolerance = options_.tolerance * layout_.asked_size->size(state_.grid().periods().wrap(site.position));
}

PatchBudget Cleanup::budget() const {
  const GlobalId room = most_sites_ - sites_;
  const bool crowded = static_cast<double>(room) < scarcity * static_cast<double>(most_sites_);
  const bool scarce = static_cast<double>(sites_) < (1 - scarcity) * static_cast<double>(wanted_sites_);
  return {room, sites_ - least_sites_, crowded ? handicap_if_crowded : scarce ? handicap_if_scarce : 1};
}

std::vector<std::vector<SiteEdit>> Cleanup::try_patches(const std::vector<Candidate>& chosen) {
  const mesh::BinnedPoints& points = state_.points();
  const StarView view = view_of(state_, *layout_.size);
  const PatchBudget its_budget = budget();
  std::vector<std::vector<SiteEdit>> edits(chosen.size());
  const auto threads = static_cast<std::size_t>(thread_count());
  const auto try_share = [&](std::ptrdiff_t first, int) { // one optimizer for each thread
    PatchOptimizer optimizer(layout_.boundary, curve_, *layout_.guard, lattice_, options_);
    for (std::size_t k = static_cast<std::size_t>(first); k < chosen.size(); k += threads) {
      const LocalIndex i = chosen[k].site;
      const double h = view.size(i);
      std::vector<PatchSite> sites = sites_around(i, options_.reach * h);
      set_tolerances(sites);
      optimizer.improve(points.position(i), h, sites, its_budget, edits[k]);
    }
  };
  comm::run_agreed(comm_, [&] { thread_loop(thread_count(), 1, try_share); });
  return edits;
}

/// Empties the edits of patches that add or take too many sites. They may try again.
void Cleanup::keep_within_limits(const std::vector<Candidate>& chosen, std::vector<std::vector<SiteEdit>>& edits) {
  const auto gain_of = [](const std::vector<SiteEdit>& list) {
    int gain = 0;
    for (const SiteEdit& edit : list)
      gain += edit.kind == SiteEdit::Kind::insert ? 1 : edit.kind == SiteEdit::Kind::remove ? -1 : 0;
    return gain;
  };
  const auto key = [&](std::size_t k) { return hash_of(state_.points().position(chosen[k].site), 4 * round_); };
  const auto limit = [&](int sign, GlobalId room) {
    std::vector<std::uint64_t> keys;
    for (std::size_t k = 0; k < edits.size(); ++k) // as often as it counts
      keys.insert(keys.end(), static_cast<std::size_t>(std::max(0, sign * gain_of(edits[k]))), key(k));
    if (comm_.sum(static_cast<std::int64_t>(keys.size())) <= room)
      return;
    const std::uint64_t threshold = selection_threshold(comm_, keys, std::max<GlobalId>(0, room));
    for (std::size_t k = 0; k < edits.size(); ++k)
      if (sign * gain_of(edits[k]) > 0 && !(key(k) < threshold))
        edits[k].clear();
  };
  limit(1, most_sites_ - sites_);
  limit(-1, sites_ - least_sites_);
}

/// All edits of this rank, with canonical places, counted.
std::vector<SiteEdit> Cleanup::collect(const std::vector<Candidate>& chosen,
                                       const std::vector<std::vector<SiteEdit>>& edits, CleanupCounts& counts) {
  const StarView view = view_of(state_, *layout_.size);
  const geometry::Periods& periods = state_.grid().periods();
  std::vector<SiteEdit> all;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    if (edits[k].empty())
      continue; // put off
    const bool better = edits[k].front().kind != SiteEdit::Kind::none;
    ++(better ? counts.better : counts.left);
    if (better)
      places_.push_back(
          {state_.points().position(chosen[k].site), (options_.reach + around_patch) * view.size(chosen[k].site)});
    for (SiteEdit edit : edits[k]) {
      edit.from = periods.wrap(edit.from);
      edit.to = periods.wrap(edit.to);
      edit.patch = hash_of(state_.points().position(chosen[k].site), 0);
      counts.moved += edit.kind == SiteEdit::Kind::move;
      counts.inserted += edit.kind == SiteEdit::Kind::insert;
      counts.deleted += edit.kind == SiteEdit::Kind::remove;
      counts.on_boundary += edit.boundary >= 0;
      all.push_back(edit);
    }
  }
  return all;
}

/// What the owned sites have to do, in their canonical places.
std::vector<SiteEdit> Cleanup::send_to_owners(const std::vector<SiteEdit>& edits) const {
  const mesh::TileGrid& grid = state_.grid();
  std::map<int, std::vector<SiteEdit>> by_rank;
  for (const SiteEdit& edit : edits)
    by_rank[state_.partition().owner(grid.place(edit.from).tile)].push_back(edit);
  return send(comm_, by_rank);
}

/// All ranks learn what happens on the boundary, of which each has a copy.
void Cleanup::edit_the_boundary(const std::vector<SiteEdit>& edits) {
  std::vector<BoundaryEdit> own;
  for (const SiteEdit& edit : edits)
    if (edit.boundary >= 0 && edit.kind != SiteEdit::Kind::none) {
      const BoundaryEdit::Kind kind = edit.kind == SiteEdit::Kind::move     ? BoundaryEdit::Kind::slide
                                      : edit.kind == SiteEdit::Kind::remove ? BoundaryEdit::Kind::remove
                                                                            : BoundaryEdit::Kind::insert;
      own.push_back({edit.boundary, kind, edit.arc, edit.to, edit.patch});
    }
  std::vector<BoundaryEdit> all =
      comm::from_bytes<BoundaryEdit>(comm_.all_gather(std::as_bytes(std::span<const BoundaryEdit>(own))));
  new_index_.clear();
  index_at_.clear();
  if (all.empty())
    return;
  std::vector<LocalIndex> inserted;
  new_index_ = edit_boundary(layout_.boundary, curve_, all, inserted);
  for (std::size_t k = 0; k < all.size(); ++k)
    if (inserted[k] >= 0)
      index_at_[{all[k].position.x, all[k].position.y}] = inserted[k];
  layout_.guard = std::make_unique<BoundaryGuard>(layout_.boundary, lattice_);
}

void Cleanup::apply(const std::vector<SiteEdit>& edits) {
  const mesh::BinnedPoints& points = state_.points();
  std::vector<mesh::Site> sites;
  sites.reserve(at(points.owned()));
  for (LocalIndex i = 0; i < points.owned(); ++i) {
    sites.push_back(points.site(i));
    sites.back().lead = {};
    if (!new_index_.empty() && sites.back().boundary >= 0)
      sites.back().boundary = new_index_[at(sites.back().boundary)];
  }
  std::vector<std::uint8_t> deleted(sites.size(), 0);
  for (const SiteEdit& edit : edits) {
    if (edit.kind == SiteEdit::Kind::none)
      continue;
    if (edit.kind == SiteEdit::Kind::insert) {
      sites.push_back({edit.to, edit.boundary >= 0 ? index_at_.at({edit.to.x, edit.to.y}) : mesh::free_site});
      deleted.push_back(0);
      continue;
    }
    LocalIndex found = -1;
    points.for_each_near(
        edit.from, 0,
        [&](LocalIndex begin, LocalIndex end) {
          for (LocalIndex j = begin; j < end && j < points.owned(); ++j)
            if (points.position(j) == edit.from)
              found = j;
        },
        [](mesh::BinRef) {});
    TRIME_ASSERT(found >= 0, "no site at ({}, {})", edit.from.x, edit.from.y);
    sites[at(found)].position = edit.to;
    deleted[at(found)] = edit.kind == SiteEdit::Kind::remove;
  }
  state_.move_sites(sites, deleted);
}

CleanupCounts Cleanup::sum_over_ranks(const CleanupCounts& own) const {
  std::array<std::int64_t, 7> all{own.patches, own.better,      own.moved, own.inserted,
                                  own.deleted, own.on_boundary, own.left};
  comm_.sum(all);
  return {all[0], all[1], all[2], all[3], all[4], all[5], all[6]};
}

CleanupCounts Cleanup::round() {
  compute_stars();
  std::vector<GlobalId> order;
  std::vector<Candidate> candidates = find_candidates(order);
  std::vector<Disc> discs;
  for (const Candidate& candidate : candidates)
    discs.push_back({state_.points().position(candidate.site), candidate.separation});
  state_.reveal(discs, *layout_.size);
  CleanupCounts counts;
  crowded_ = comm_.sum(leave_crowded(candidates, order));
  choose_apart(candidates, std::move(order));
  counts.patches = static_cast<std::int64_t>(candidates.size());
  std::vector<std::vector<SiteEdit>> of_patches = try_patches(candidates);
  keep_within_limits(candidates, of_patches);
  const std::vector<SiteEdit> edits = collect(candidates, of_patches, counts), own = send_to_owners(edits);
  for (const SiteEdit& edit : own)
    if (edit.kind == SiteEdit::Kind::none)
      note_failure(edit.from, edit.arc);
  changed_ = comm_.sum(counts.better) > 0;
  if (changed_) {
    edit_the_boundary(edits);
    apply(own);
  }
  ++round_;
  counts = sum_over_ranks(counts);
  sites_ += counts.inserted - counts.deleted;
  return counts;
}

CleanupCounts Cleanup::run() {
  CleanupCounts all;
  for (const double excess : stages) {
    threshold_ = 1 + excess * (options_.bad_alpha - 1);
    all_stars_ = true;
    GlobalId most = 0;
    for (int k = 0; k < most_rounds; ++k) {
      const CleanupCounts counts = round();
      all.add(counts);
      most = std::max(most, counts.patches);
      if (counts.patches + crowded_ == 0 || (excess != stages.back() && few_of * counts.patches < most))
        break;
    }
  }
  return all;
}

} // namespace trime::meshing
