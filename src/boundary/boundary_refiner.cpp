// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/boundary_refiner.hpp"

#include "boundary/rules.hpp"
#include "core/thread_loop.hpp"

#include "core/angle.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace trime::boundary {

using geometry::Vec2;

namespace {

// [radians] A junction of two arcs that turns by less lies within one circle: half a degree.
constexpr double smooth_junction = pi / 360;

// [tolerance] A chord that leaves corners farther off is divided. The layout keeps within 1.1; the rest is leeway
// for snapping and halving.
constexpr double most_deviation = 1.25;

// [radians] A junction that turns by more becomes a site when its chord is divided.
constexpr double junction_turn = pi / 4;

// [rounds] Later rounds of halving look only at chords near the new sites.
constexpr int full_rounds = 20;

// [1] Halving may make this number times the sites of the layout. More means that the boundary is at fault, and an
// error says so.
constexpr std::size_t halving_growth = 16;

// [sites] Halving of chords may always make this number; beyond, halving_growth is the bound.
constexpr std::size_t always_halved = 4000000;

constexpr std::ptrdiff_t chords_in_a_row = 64; // by one thread

double nearest_power_of_two(double v) {
  int exponent = 0;
  const double fraction = std::frexp(v, &exponent);
  return std::ldexp(1.0, fraction * fraction < 0.5 ? exponent - 1 : exponent);
}

polygon::DroppedLoops drop_loops(const geometry::Boundary& boundary, const sizing::SizeField& size,
                                 const FeatureRule& rule, std::span<const Vec2> inside) {
  polygon::DroppedLoops dropped = drop_small_loops(boundary, size, rule.least_perimeter, inside);
  drop_other_components(boundary, rule, dropped);
  return dropped;
}

} // namespace

BoundaryRefiner::BoundaryRefiner(std::shared_ptr<const LaidCurves> curves, const BoundarySizes& sizes,
                                 const geometry::Lattice& lattice, const LayoutRequest& request)
    : curves_(std::move(curves)), boundary_(curves_->boundary()), lattice_(lattice),
      corner_angle_(request.corner_angle), tolerance_{request.rule.tolerance},
      inner_tolerance_{request.rule.inner_tolerance}, inside_(request.inside), inside_tree_(tree_of(inside_)),
      dropped_(drop_loops(boundary_, sizes.asked(), request.rule, request.held)), affordable_(request.affordable) {
  const geometry::Boundary& all = curves_->all();
  metrics_.reserve(all.loops.size());
  for (std::size_t k = 0; k < all.loops.size(); ++k) {
    if (k < boundary_.loops.size() && dropped_.dropped[k])
      continue;
    metrics_.emplace_back(all, k, sizes);
    boundary_loops_ += k < boundary_.loops.size() ? 1 : 0;
  }
}

std::vector<LoopSite> BoundaryRefiner::lay_out(const Share& share) const {
  std::vector<LoopLayout> layouts;
  std::int64_t work = 0;
  for (std::size_t loop = 0; loop < metrics_.size(); ++loop) {
    layouts.emplace_back(metrics_[loop], lattice_, corner_angle_, tolerance_of(loop));
    work += layouts.back().work();
  }
  std::vector<LoopSite> made;
  std::int64_t first = share.first(work), last = share.last(work);
  for (std::size_t loop = 0; loop < layouts.size(); ++loop) {
    const std::size_t before = made.size();
    if (last > 0 && first < layouts[loop].work())
      layouts[loop].make(std::max<std::int64_t>(0, first), last, made);
    for (std::size_t k = before; k < made.size(); ++k)
      made[k].loop = static_cast<std::int32_t>(loop);
    first -= layouts[loop].work();
    last -= layouts[loop].work();
  }
  return made;
}

std::vector<BoundaryRefiner::Cut> BoundaryRefiner::begin(std::vector<LoopSite> laid, const Share& share) {
  sites_.reserve(laid.size());
  for (auto first = laid.begin(); first != laid.end();) {
    const auto end = std::find_if(first, laid.end(), [&](const LoopSite& site) { return site.loop != first->loop; });
    const std::span<LoopSite> of_loop(first, end);
    sort_along(of_loop);
    if (metrics_[static_cast<std::size_t>(first->loop)].loop().turning > 0)
      add_open_curve(of_loop);
    else
      add_loop(of_loop);
    first = end;
  }
  join_nodes();
  most_sites_ = std::max(always_halved, halving_growth * sites_.size());
  std::vector<SiteTree::Entry> items;
  items.reserve(sites_.size());
  for (LocalIndex k = 0; k < static_cast<LocalIndex>(sites_.size()); ++k)
    if (sites_[k].vertex == k)
      items.push_back({boundary_.periods.wrap(sites_[k].position), k});
  trees_.emplace_back(std::move(items));
  const std::ptrdiff_t first = share.first(std::ssize(sites_)), last = share.last(std::ssize(sites_));
  return gather_in_order<Cut>(last - first, chords_in_a_row, [&](std::ptrdiff_t k, std::vector<Cut>& cuts) {
    look_at_fresh(static_cast<LocalIndex>(first + k), cuts);
  });
}

void BoundaryRefiner::run(std::vector<Cut> cuts) {
  if (cuts.empty())
    cut_doubles(cuts);
  for (rounds_ = 0;; ++rounds_) {
    std::vector<LocalIndex> fresh_sites, fresh_chords;
    for (const Cut& cut : cuts) {
      if (places() >= affordable_) {
        overfull_ = true;
        return;
      }
      fresh_chords.push_back(cut.chord);
      fresh_sites.push_back(divide(cut));
      fresh_chords.push_back(fresh_sites.back());
      if (sites_.size() > most_sites_)
        fail(cut);
    }
    halvings_ += static_cast<LocalIndex>(cuts.size());
    if (fresh_sites.empty())
      break;
    cuts = find_cuts(fresh_sites, fresh_chords);
    if (cuts.empty())
      cut_doubles(cuts);
  }
  overfull_ = places() > affordable_;
  if (!overfull_)
    keep_areas();
}

void BoundaryRefiner::add_loop(std::span<const LoopSite> loop_sites) {
  const LocalIndex first = static_cast<LocalIndex>(sites_.size()), n = static_cast<LocalIndex>(loop_sites.size());
  loop_first_.push_back(first);
  const auto loop = static_cast<std::int32_t>(loop_first_.size() - 1);
  for (LocalIndex k = 0; k < n; ++k)
    sites_.push_back({loop_sites[k].t, loop_sites[k].position, first + (k + n - 1) % n, first + (k + 1) % n, loop,
                      loop_sites[k].kind, first + k});
}

/// Takes the sites on the way there, up to the other end.
void BoundaryRefiner::add_open_curve(std::span<const LoopSite> loop_sites) {
  const auto loop = static_cast<std::int32_t>(loop_first_.size());
  const LoopMetric& metric = metrics_[static_cast<std::size_t>(loop)];
  const double end = metric.piece_t(metric.loop().turning);
  const auto first = static_cast<LocalIndex>(sites_.size());
  loop_first_.push_back(first);
  for (const LoopSite& site : loop_sites) {
    if (site.t > end)
      break;
    const auto own = static_cast<LocalIndex>(sites_.size());
    sites_.push_back({site.t, site.position, own == first ? -1 : own - 1, own + 1, loop, site.kind, own});
  }
  TRIME_ASSERT(sites_.size() > static_cast<std::size_t>(first) + 1 && sites_.back().t == end);
  sites_.back().next = -1;
  sites_[first].kind = kind_of_junction(metric.loop(), 0, corner_angle_);
  sites_.back().kind = kind_of_junction(metric.loop(), metric.loop().turning, corner_angle_);
}

/// Gives the ends of curves at one place, and the corner of the boundary there, the same vertex.
void BoundaryRefiner::join_nodes() {
  if (metrics_.size() == boundary_loops_)
    return;
  const auto is_end = [](const Site& site) { return site.next < 0 || site.previous < 0; };
  const auto key = [this](const Site& site) {
    const Vec2 canonical = boundary_.periods.wrap(site.position);
    return std::pair(canonical.x, canonical.y);
  };
  std::map<std::pair<double, double>, LocalIndex> nodes;
  for (const Site& site : sites_)
    if (is_end(site))
      nodes[key(site)] = -1;
  for (LocalIndex k = 0; k < static_cast<LocalIndex>(sites_.size()); ++k) {
    Site& site = sites_[k];
    if (const auto node = nodes.find(key(site)); node != nodes.end()) {
      doubles_ += node->second < 0 ? 0 : 1;
      node->second = node->second < 0 ? k : node->second;
      site.vertex = node->second;
    }
  }
}

bool BoundaryRefiner::is_straight(LocalIndex chord) const {
  const Site& a = sites_[chord];
  const auto way = metrics_[a.loop].on_one_piece(a.t, end_t(a));
  return way && way->turn == 0;
}

/// Lists chords between the same two vertices as another chord, unless they are straight.
void BoundaryRefiner::cut_doubles(std::vector<Cut>& cuts) const {
  if (metrics_.size() == boundary_loops_)
    return;
  std::map<std::pair<LocalIndex, LocalIndex>, std::vector<LocalIndex>> chords;
  for (LocalIndex k = 0; k < static_cast<LocalIndex>(sites_.size()); ++k)
    if (const Site& site = sites_[k]; site.next >= 0) {
      const LocalIndex a = site.vertex, b = next(site).vertex;
      if (sites_[a].kind != SiteKind::plain && sites_[b].kind != SiteKind::plain) // else only one curve leads there
        chords[std::minmax(a, b)].push_back(k);
    }
  for (const auto& [ends, same] : chords)
    for (const LocalIndex k : same)
      if (same.size() > 1 && !is_straight(k))
        cuts.push_back({k, -1});
  std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.chord < b.chord; });
}

/// New chords against everything, old ones against the new sites only; ascending by chord.
std::vector<BoundaryRefiner::Cut> BoundaryRefiner::find_cuts(const std::vector<LocalIndex>& fresh_sites,
                                                             const std::vector<LocalIndex>& fresh_chords) {
  std::vector<SiteTree::Entry> items;
  items.reserve(fresh_sites.size());
  for (const LocalIndex k : fresh_sites)
    items.push_back({boundary_.periods.wrap(sites_[k].position), k});
  const SiteTree newest(items); // for old chords
  for (; !trees_.empty() && trees_.back().size() <= 2 * items.size(); trees_.pop_back())
    items.insert(items.end(), trees_.back().items().begin(), trees_.back().items().end());
  trees_.emplace_back(std::move(items));
  std::vector<LocalIndex> fresh = fresh_chords;
  std::sort(fresh.begin(), fresh.end());
  const auto look = [&](LocalIndex k, std::vector<Cut>& cuts) {
    if (sites_[k].next < 0)
      return;
    if (std::binary_search(fresh.begin(), fresh.end(), k))
      look_at_fresh(k, cuts);
    else if (const LocalIndex intruder = find_intruder(newest, k); intruder >= 0)
      cuts.push_back({k, intruder});
  };
  if (rounds_ < full_rounds)
    return gather_in_order<Cut>(std::ssize(sites_), chords_in_a_row, [&](std::ptrdiff_t k, std::vector<Cut>& cuts) {
      look(static_cast<LocalIndex>(k), cuts);
    });
  std::vector<Cut> cuts;
  for (const LocalIndex k : candidates(fresh_sites, fresh))
    look(k, cuts);
  return cuts;
}

/// A new chord against everything.
void BoundaryRefiner::look_at_fresh(LocalIndex k, std::vector<Cut>& cuts) const {
  if (sites_[k].next < 0)
    return;
  LocalIndex intruder = -1;
  for (std::size_t tree = 0; tree < trees_.size() && intruder < 0; ++tree)
    intruder = find_intruder(trees_[tree], k);
  const LocalIndex point = intruder < 0 ? find_intruder(inside_tree_, k, true) : -1;
  if (intruder >= 0 || point >= 0 || curve_offends(k))
    cuts.push_back({k, intruder, point});
}

/// The new chords, and the others that a new site may encroach upon; ascending.
std::vector<LocalIndex> BoundaryRefiner::candidates(const std::vector<LocalIndex>& fresh_sites,
                                                    const std::vector<LocalIndex>& fresh_chords) {
  const auto watch = [&](LocalIndex k) {
    if (sites_[k].next < 0)
      return;
    const Vec2 from = sites_[k].position;
    watch_->add(boundary_.periods.wrap(from), end_of(sites_[k]) - from, k);
  };
  if (watch_) {
    std::for_each(fresh_chords.begin(), fresh_chords.end(), watch);
  } else {
    watch_.emplace(boundary_.periods);
    for (LocalIndex k = 0; k < static_cast<LocalIndex>(sites_.size()); ++k)
      watch(k);
  }
  std::vector<LocalIndex> found = fresh_chords;
  for (const LocalIndex k : fresh_sites)
    watch_->find(boundary_.periods.wrap(sites_[k].position), found);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// A site, or an image of one, in the disc of a chord; see SiteTree. The tree holds canonical positions.
/// Numbers of foreign items are not those of sites.
LocalIndex BoundaryRefiner::find_intruder(const SiteTree& tree, LocalIndex chord, bool foreign) const {
  const Site& site = sites_[chord];
  const geometry::Periods& periods = boundary_.periods;
  const Vec2 a = periods.wrap(site.position), b = end_of(site) + (a - site.position);
  const double reach = geometry::length(b - a);
  const auto images = [reach](double period) { // to each side that the disc may meet
    return period > 0 ? static_cast<int>(std::fmin(4.0, 1 + std::floor(reach / period))) : 0;
  };
  const LocalIndex own = foreign ? -1 : site.vertex, end = foreign ? -1 : next(site).vertex;
  LocalIndex intruder = tree.find_in_disc(a, b, own, end);
  for (int i = -images(periods.x); i <= images(periods.x) && intruder < 0; ++i)
    for (int j = -images(periods.y); j <= images(periods.y) && intruder < 0; ++j)
      if (const Vec2 shift{i * periods.x, j * periods.y}; i != 0 || j != 0)
        intruder = tree.find_in_disc(a + shift, b + shift, own, end);
  return intruder;
}

SiteTree BoundaryRefiner::tree_of(std::span<const Vec2> points) const {
  std::vector<SiteTree::Entry> items;
  for (std::size_t k = 0; k < points.size(); ++k)
    items.push_back({boundary_.periods.wrap(points[k]), static_cast<LocalIndex>(k)});
  return SiteTree(std::move(items));
}

bool BoundaryRefiner::curve_offends(LocalIndex chord) const {
  const Site& a = sites_[chord];
  const auto way = metrics_[a.loop].on_one_piece(a.t, end_t(a));
  if (way && way->turn == 0)
    return a.position == end_of(a);
  const bool is_there_and_back = next(a).next == chord && metrics_[a.loop].loop().turning == 0 &&
                                 !metrics_[a.loop].loop().winds(); // two sites enclose nothing
  if (is_there_and_back || a.position == end_of(a))
    return true;
  if (way && way->turn < BoundaryRules::gentle_turn && way->length > BoundaryRules::gentle_in_steps * lattice_.step())
    return false;
  const PartSummary part = summarize(a);
  if (part.leaves_disc)
    return true;
  const double tolerance = this->tolerance(a);
  const bool strays = tolerance > 0 && part.sharpest_turn > corner_angle_ * (pi / 180) &&
                      part.deviation > most_deviation * tolerance; // from a corner, after a division
  // The arc of a circle has no corner that could be left out.
  const bool is_smooth = part.sharpest_turn < smooth_junction;
  return strays || (std::fabs(part.turn) > BoundaryRules::largest_turn && (is_smooth || part.deviation > tolerance));
}

/// Where to divide the chord from a to b, as t after a.
BoundaryRefiner::CutPlace BoundaryRefiner::cut_place(const Site& a, const Site& b, double end) const {
  const LoopMetric& metric = metrics_[a.loop];
  const PartSummary part = summarize(a);
  if (part.sharpest_turn > junction_turn) {
    const double t = metric.piece_t(static_cast<std::size_t>(part.sharpest));
    return {t > a.t ? t : t + metric.total(), part.sharpest};
  }
  const bool sharp_a = a.kind == SiteKind::sharp_corner, sharp_b = b.kind == SiteKind::sharp_corner;
  if (sharp_a != sharp_b) {
    const Site& apex = sharp_a ? a : b;
    const double radius = nearest_power_of_two(0.5 * geometry::length(b.position - a.position));
    const auto t = sharp_a ? metric.first_at_radius(a.t, end, apex.position, radius)
                           : metric.first_at_radius(end, a.t, apex.position, radius);
    if (t && *t > a.t && *t < end)
      return {*t};
  }
  if (std::fabs(part.turn) > BoundaryRules::largest_turn)
    return {part.half_turn_t};
  return {0.5 * (a.t + end)};
}

LocalIndex BoundaryRefiner::divide(const Cut& cut) {
  const Site a = sites_[cut.chord];
  Site b = next(a);
  b.position = end_of(a);
  const LoopMetric& metric = metrics_[a.loop];
  const double end = end_t(a);
  if (metric.arc_length(a.t, end) < BoundaryRules::shortest_in_steps * lattice_.step() ||
      (cut.intruder >= 0 && cut.intruder != a.vertex && cut.intruder != b.vertex &&
       (boundary_.periods.same_point(sites_[cut.intruder].position, a.position) ||
        boundary_.periods.same_point(sites_[cut.intruder].position, b.position))))
    fail(cut);
  CutPlace place = cut_place(a, b, end);
  Vec2 position = lattice_.snap(metric.point(place.t));
  if (position == a.position || position == b.position) { // the curve passes an end of the chord, or turns there
    place = {0.5 * (a.t + end)};
    position = lattice_.snap(metric.point(place.t));
  }
  if (position == a.position || position == b.position)
    fail(cut);
  const bool round = place.t >= metric.total();
  if (round)
    position = position - metric.loop().winding;
  const auto junction = static_cast<std::size_t>(place.junction);
  const double t = place.junction >= 0 ? metric.piece_t(junction) : round ? place.t - metric.total() : place.t;
  const auto index = static_cast<LocalIndex>(sites_.size());
  sites_.push_back({t, position, cut.chord, a.next, a.loop,
                    place.junction >= 0 ? kind_of_junction(metric.loop(), junction, corner_angle_) : SiteKind::plain,
                    index});
  sites_[cut.chord].next = index;
  sites_[a.next].previous = index;
  return index;
}

void BoundaryRefiner::fail(const Cut& cut) const {
  const Site& a = sites_[cut.chord];
  const Vec2 from = a.position, to = end_of(a);
  std::string cause = "the curve turns back on itself there";
  if (cut.intruder >= 0) {
    const Vec2 p = boundary_.periods.nearest_image(sites_[cut.intruder].position, from);
    const double gap = std::sqrt(std::fmin(geometry::squared_length(p - from), geometry::squared_length(p - to)));
    cause = fmt::format("another part of the boundary passes at a distance of {:.3g}, at {}", gap, Place(p, 17));
  }
  if (cut.point >= 0) {
    const Vec2 p = inside_[static_cast<std::size_t>(cut.point)];
    cause = fmt::format("the fixed point {} lies very near to it, but not on it", Place(p, 17));
  }
  throw GeometryError(fmt::format(
      "the boundary is too narrow near {}: {}; expected parts that are at least {:.3g} apart (the "
      "resolution of the container), but they are still too near after {} rounds of division, with a boundary edge of "
      "{:.3g}. More points do not help: simplify the contour there, move its parts clearly apart or together, or make "
      "the container smaller",
      Place(from, 17), cause, BoundaryRules::shortest_in_steps * lattice_.step(), rounds_,
      geometry::length(to - from)));
}

} // namespace trime::boundary
