// SPDX-License-Identifier: BSD-3-Clause
#include "sites/site_state.hpp"

#include "comm/agree.hpp"
#include "core/processors.hpp"
#include "core/thread_loop.hpp"
#include "sites/edited_stars.hpp"
#include "sites/rules.hpp"
#include "sizing/size_blocks.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <numeric>

namespace trime::sites {
namespace {

// [bins] Fetched unasked around the owned tiles. A bin has 3 to 4 sites, so two are wide enough for the discs of a
// relaxed mesh; stars that need more ask for it.
constexpr int usual_halo_margin = 2;

// [bins] The same of a rank with few sites, whose sweeps are so short that asking costs more than a wider halo: 64
// ranks asked in 17 rounds in place of 46 on a coast of 10^6 points.
constexpr int wide_halo_margin = 3;

constexpr double unknown_size = 0;
constexpr int size_chunk = 1024; // sites whose size one thread evaluates in a row

} // namespace

SiteState::SiteState(const comm::Communicator& comm, const geometry::Box& box, const mesh::GridOptions& grid_options)
    : comm_(comm), grid_(box, grid_options), partition_(grid_.tile_count(), comm.size()), points_(grid_),
      halo_(comm, grid_) {}

SiteState::SiteState(const SiteState& other)
    : comm_(other.comm_), grid_(other.grid_), partition_(other.partition_), points_(grid_), halo_(comm_, grid_) {
  mesh::SiteList sites;
  sites.reserve(static_cast<std::size_t>(other.points_.owned()));
  for (LocalIndex i = 0; i < other.points_.owned(); ++i)
    sites.push_back(other.points_.site(i));
  distribute(std::move(sites));
}

/// Weights are replicated, so all ranks find the same.
void SiteState::check_counts(std::span<const std::int64_t> weights) const {
  for (int rank = 0; rank < partition_.ranks(); ++rank) {
    const std::int64_t sites = std::accumulate(weights.begin() + partition_.first_tile(rank),
                                               weights.begin() + partition_.last_tile(rank), std::int64_t{0});
    if (sites > SiteRules::most_owned)
      throw ConfigError(fmt::format("rank {} would own {} points, at most {} are possible; start more ranks", rank,
                                    sites, SiteRules::most_owned));
  }
}

/// After each sorting.
void SiteState::count_sites() const {
  LocalIndex densest = 0;
  for (LocalIndex tile = points_.first_tile(); tile < points_.last_tile(); ++tile) {
    const auto [begin, end] = points_.tile_range(tile);
    densest = std::max(densest, end - begin);
  }
  Counters& counters = comm_.counters();
  counters.note(Counter::points, points_.owned());
  counters.note(Counter::densest_tile, densest);
  counters.note(Counter::grid_bytes, static_cast<std::int64_t>(grid_.memory_bytes()));
  counters.note(Counter::rank_bytes, static_cast<std::int64_t>(partition_.memory_bytes()));
}

/// Into the container, where it is periodic.
void SiteState::wrap(mesh::SiteList& sites) const {
  const geometry::Periods& periods = grid_.periods();
  if (periods.any())
    for (mesh::Site& site : sites)
      site.position = periods.wrap(site.position);
}

int SiteState::halo_margin() const {
  return points_.owned() < SiteRules::few_owned ? wide_halo_margin : usual_halo_margin;
}

void SiteState::share_out(std::vector<mesh::Tile> tiles, std::span<const std::int64_t> weights) {
  TRIME_ASSERT(state_ == State::empty, "tiles can be shared out only before there are sites");
  grid_.set_tiles(std::move(tiles));
  partition_ = decomposition::Partition(weights, comm_.size());
}

void SiteState::distribute(mesh::SiteList sites) {
  TRIME_ASSERT(state_ == State::empty || has_sites(),
               "sites can be distributed only before release_work_space(), and not while ghosts are being received");
  wrap(sites);
  const std::vector<std::int64_t> weights = decomposition::fit_tiles(comm_, grid_, sites);
  partition_ = decomposition::Partition(weights, comm_.size());
  check_counts(weights);
  decomposition::migrate(comm_, grid_, partition_, sites);
  choose_bins(sites);
  points_.assign_owned(sites, partition_.first_tile(comm_.rank()), partition_.last_tile(comm_.rank()));
  release(sites);
  state_ = State::sorted;
  sizes_.forget();
  carried_.clear();
  stars_.reset(points_.owned());
  halo_.reset(partition_, halo_margin());
  comm_.counters().add(Counter::sites_started, points_.owned());
  count_sites();
}

/// Each owner finds what suits its tiles; then all know.
void SiteState::choose_bins(std::span<const mesh::Site> sites) {
  const LocalIndex first = partition_.first_tile(comm_.rank()), last = partition_.last_tile(comm_.rank());
  const std::vector<std::uint8_t> own = points_.suitable_bin_bits(sites, first, last);
  grid_.set_bin_bits(comm::from_bytes<std::uint8_t>(comm_.all_gather(std::as_bytes(std::span(own)))));
}

void SiteState::move_sites(std::vector<std::uint8_t> gone, mesh::SiteList more) {
  TRIME_ASSERT(has_sites(), "sites can move only after distribute(), and not while ghosts are being received");
  const std::size_t before = static_cast<std::size_t>(points_.owned());
  wrap_next();
  wrap(more);
  remember_sizes();
  list_leaving(gone, more);
  decomposition::migrate(comm_, grid_, partition_, more);
  std::vector<LocalIndex> new_index;
  points_.sort_moved(gone, more, new_index);
  new_index.resize(before);
  state_ = State::sorted;
  sizes_.forget();
  carry_sizes(new_index);
  stars_.renumber(new_index, points_.owned());
  count_sites();
}

void SiteState::edit_sites(const delaunay::StarBuilder& builder, std::vector<LocalIndex> gone, mesh::SiteList come,
                           std::span<const double> sizes) {
  TRIME_ASSERT(has_sites(), "sites can be edited only after distribute(), and not while ghosts are being received");
  TRIME_ASSERT(sizes_.known(points_.owned() - 1) || points_.owned() == 0,
               "the target edge length h of the owned sites must be known");
  wrap(come);
  std::vector<ChangedPlace> changes;
  for (const LocalIndex i : gone)
    changes.push_back({points_.position(i), false});
  for (const mesh::Site& site : come)
    changes.push_back({site.position, true});
  const bool has_ghosts = state_ == State::complete;
  const FormerGhosts former(points_);
  std::vector<LocalIndex> new_index;
  const mesh::IndexShift shift = points_.edit(std::move(gone), come, new_index);
  halo_.refresh(points_);
  state_ = State::complete;
  carried_.clear();
  if (!sizes_.is_uniform()) {
    std::vector<double>& values = sizes_.values();
    values.resize(at(shift.before())); // without the ghosts
    shift.move(values);
    for (std::size_t k = 0; k < come.size(); ++k)
      if (new_index[k] >= 0)
        values[at(new_index[k])] = sizes[k];
  }
  const std::vector<LocalIndex> ghosts = former.find_in(points_, changes);
  stars_.renumber(shift, has_ghosts ? ghosts : std::span<const LocalIndex>{});
  if (has_ghosts && !grid_.periods().any())
    doubt_stars(points_, sizes_, builder, std::move(changes), stars_);
  else
    for (LocalIndex i = 0; i < points_.owned(); ++i)
      stars_.set_certain(i, false);
  count_sites();
}

/// Into the container, where it is periodic.
void SiteState::wrap_next() {
  const geometry::Periods& periods = grid_.periods();
  if (periods.any())
    for (geometry::Vec2& place : points_.next().positions().first(static_cast<std::size_t>(points_.owned())))
      place = periods.wrap(place);
}

/// Sites whose next places belong to other ranks are gone here.
void SiteState::list_leaving(std::vector<std::uint8_t>& gone, mesh::SiteList& leaving) const {
  if (comm_.size() == 1)
    return;
  gone.resize(static_cast<std::size_t>(points_.owned()), 0);
  const LocalIndex first_tile = points_.first_tile(), last_tile = points_.last_tile();
  std::vector<mesh::SiteList> of_tile(static_cast<std::size_t>(last_tile - first_tile)); // that they come from
  thread_loop(last_tile - first_tile, 4, [&](std::ptrdiff_t t, int) {
    const auto [begin, end] = points_.tile_range(first_tile + static_cast<LocalIndex>(t));
    for (LocalIndex i = begin; i < end; ++i) {
      std::uint8_t& is_gone = gone[static_cast<std::size_t>(i)];
      if (is_gone)
        continue;
      const LocalIndex tile = grid_.tile_at(points_.next().positions()[static_cast<std::size_t>(i)]);
      if (tile < first_tile || tile >= last_tile) {
        is_gone = 1;
        of_tile[static_cast<std::size_t>(t)].push_back(next_site(points_, i));
      }
    }
  });
  for (const mesh::SiteList& list : of_tile)
    leaving.insert(leaving.end(), list.begin(), list.end());
}

/// h of the owned sites that stay where they are, if most do.
void SiteState::remember_sizes() {
  carried_.clear();
  if (points_.owned() == 0 || !sizes_.known(0) || sizes_.is_uniform())
    return;
  const auto stays = [&](LocalIndex i) {
    return points_.next().positions()[static_cast<std::size_t>(i)] == points_.position(i);
  };
  LocalIndex staying = 0;
  for (LocalIndex i = 0; i < points_.owned(); ++i)
    staying += stays(i);
  if (staying <= points_.owned() / 2)
    return;
  carried_ = std::move(sizes_.values());
  carried_.resize(static_cast<std::size_t>(points_.owned()));
  for (LocalIndex i = 0; i < points_.owned(); ++i)
    if (!stays(i))
      carried_[static_cast<std::size_t>(i)] = unknown_size;
}

/// Moves the kept sizes to their new indices.
void SiteState::carry_sizes(std::span<const LocalIndex> new_index) {
  if (carried_.empty())
    return;
  std::vector<double> carried(static_cast<std::size_t>(points_.owned()), unknown_size);
  for (std::size_t i = 0; i < new_index.size(); ++i)
    if (new_index[i] >= 0)
      carried[static_cast<std::size_t>(new_index[i])] = carried_[i];
  carried_ = std::move(carried);
}

/// Fetches the ghosts and evaluates h where it is not known.
void SiteState::refresh(const sizing::SizeField& size) {
  TRIME_ASSERT(has_sites(), "ghosts can be fetched only after distribute(), and not while ghosts are being received");
  if (state_ == State::sorted)
    halo_.refresh(points_);
  state_ = State::complete;
  evaluate_agreed(size, points_.size());
}

void SiteState::forget_sizes() {
  TRIME_ASSERT(has_sites(), "sizes can be forgotten only after distribute(), and not while ghosts are being received");
  sizes_.forget();
}

void SiteState::begin_advance(const sizing::SizeField& size, const mesh::DriftBound& drift, bool new_sizes) {
  TRIME_ASSERT(state_ == State::complete, "sites can move without sorting only if all ghosts are known");
  state_ = State::advancing;
  points_.advance();
  halo_.begin_positions(points_);
  points_.drifts().set_largest(drift);
  ghosts_need_sizes_ = new_sizes && !size.is_uniform();
  if (ghosts_need_sizes_) {
    sizes_.forget();
    sizes_.values().reserve(static_cast<std::size_t>(points_.size()));
    evaluate_agreed(size, points_.owned());
  }
}

void SiteState::finish_advance(const sizing::SizeField& size) {
  TRIME_ASSERT(state_ == State::advancing, "finish_advance() must follow begin_advance()");
  halo_.finish_positions(points_);
  state_ = State::complete;
  if (ghosts_need_sizes_)
    evaluate_agreed(size, points_.size());
  ghosts_need_sizes_ = false;
}

void SiteState::evaluate_agreed(const sizing::SizeField& size, LocalIndex end) {
  try {
    comm::run_agreed(comm_, [&] { evaluate_sizes(size, end); });
  } catch (...) {
    sizes_.forget();
    carried_.clear();
    throw;
  }
}

/// Owned sites are checked in the order of the curve, so that the first bad one does not depend on the ranks; ghosts
/// are checked by their owners.
void SiteState::evaluate_sizes(const sizing::SizeField& size, LocalIndex end) {
  if (size.is_uniform()) {
    sizes_ = mesh::LocalSizes(sizing::checked_size(size, {}));
    return;
  }
  const geometry::Periods& periods = grid_.periods();
  std::vector<double>& values = sizes_.values();
  const LocalIndex known = static_cast<LocalIndex>(values.size()); // ghosts among them: as old as those of their owners
  const LocalIndex first = std::min(end, known >= points_.owned() ? known : 0);
  values.resize(static_cast<std::size_t>(end));
  if (size.prefers_blocks())
    evaluate_blocks(size, first, end);
  else
    thread_loop(end - first, size_chunk, [&](std::ptrdiff_t k, int) {
      const LocalIndex i = first + static_cast<LocalIndex>(k);
      const double carried = carried_size(i);
      values[static_cast<std::size_t>(i)] =
          carried != unknown_size ? carried : size.size(periods.wrap(points_.position(i)));
    });
  carried_.clear();
  for (LocalIndex i = first; i < points_.owned(); ++i)
    if (const double h = values[static_cast<std::size_t>(i)]; !sizing::is_valid_size(h))
      sizing::fail_for_size(periods.wrap(points_.position(i)), h);
}

double SiteState::carried_size(LocalIndex site) const {
  return at(site) < carried_.size() ? carried_[at(site)] : unknown_size;
}

/// Asks for the sizes of a whole block of sites at a time.
void SiteState::evaluate_blocks(const sizing::SizeField& size, LocalIndex first, LocalIndex end) {
  const std::span<double> values = sizes_.values();
  sizing::loop_over_blocks(size, end - first, [&](std::ptrdiff_t begin, std::ptrdiff_t stop) {
    std::vector<geometry::Vec2> places;
    std::vector<LocalIndex> sites;
    for (LocalIndex i = first + static_cast<LocalIndex>(begin); i < first + static_cast<LocalIndex>(stop); ++i)
      if (const double carried = carried_size(i); carried != unknown_size) {
        values[at(i)] = carried;
      } else {
        places.push_back(grid_.periods().wrap(points_.position(i)));
        sites.push_back(i);
      }
    const std::vector<double> found = sizing::sizes_at(size, places);
    for (std::size_t k = 0; k < sites.size(); ++k)
      values[at(sites[k])] = found[k];
  });
}

delaunay::StarPass SiteState::compute_stars(const delaunay::StarBuilder& builder, const sizing::SizeField& size,
                                            Wanted wanted) {
  wanted_.clear();
  if (wanted == Wanted::inner_sites) {
    wanted_.resize(static_cast<std::size_t>(points_.owned()));
    thread_loop(points_.owned(), 4096, [&](std::ptrdiff_t i, int) {
      wanted_[static_cast<std::size_t>(i)] =
          points_.boundary(static_cast<LocalIndex>(i)) < 0 ? delaunay::StarWish::compute : delaunay::StarWish::none;
    });
  }
  return compute_stars(builder, size, wanted_);
}

delaunay::StarPass SiteState::compute_stars(const delaunay::StarBuilder& builder, const sizing::SizeField& size,
                                            std::span<const delaunay::StarWish> wanted) {
  refresh(size);
  delaunay::StarPass all;
  std::vector<mesh::BinRef> missing;
  for (int round = 0; round < SiteRules::most_halo_rounds; ++round) {
    missing.clear();
    const delaunay::StarPass pass = builder.update(points_, stars_, sizes_, wanted, missing);
    all.rebuilt += pass.rebuilt;
    comm_.counters().add(Counter::stars_by_emptiness, pass.computed);
    comm_.counters().add(Counter::stars_rebuilt, pass.rebuilt);
    if (comm_.sum(pass.uncertain) == 0)
      return all;
    fetch(missing, size);
  }
  throw InternalError(fmt::format("the halo still grows after {} rounds", SiteRules::most_halo_rounds));
}

void SiteState::fetch(std::span<const mesh::BinRef> missing, const sizing::SizeField& size) {
  TRIME_ASSERT(state_ == State::complete, "more bins can be fetched only after the first ghosts have arrived");
  comm_.counters().add(Counter::fetch_rounds);
  // h of a site that has moved may be older than its place: all must see that of its owner.
  halo_.extend(points_, {missing.begin(), missing.end()}, size.is_uniform() ? nullptr : &sizes_.values());
}

void SiteState::release_work_space() {
  TRIME_ASSERT(has_sites(),
               "the work space can be released only after distribute(), and not while ghosts are being received");
  state_ = State::released;
  points_.release_moves();
  sizes_.forget();
  release(sizes_.values());
  release(carried_);
  release(wanted_);
  return_free_memory();
}

} // namespace trime::sites
