// SPDX-License-Identifier: BSD-3-Clause
// Makes the result of the layout of a boundary.

#include "boundary/boundary_refiner.hpp"
#include "comm/agree.hpp"
#include "core/thread_loop.hpp"
#include "polygon/chord_curve.hpp"

#include "core/angle.hpp"

#include <cmath>
#include <limits>

namespace trime::boundary {

using geometry::Vec2;
using polygon::BoundarySites;
using polygon::name_parts;

namespace {

constexpr int chords_in_a_row = 64; // by one thread

} // namespace

/// Site k as the result has it, and its chord. A chord may be divided right at a corner that the layout had left out:
/// that one is a corner again, else the clean-up would slide it away.
BoundaryRefiner::ChordRecord BoundaryRefiner::chord_from(LocalIndex k, polygon::BoundarySite& result) const {
  const Site& site = sites_[k];
  const LoopMetric& metric = metrics_[site.loop];
  const geometry::Periods& periods = boundary_.periods;
  const Vec2 canonical = periods.wrap(site.position), end = end_of(site) + (canonical - site.position);
  const auto [piece, along] = metric.place(site.t);
  ChordRecord out;
  const SiteKind kind = site.kind == SiteKind::plain && along == 0
                            ? kind_of_junction(metric.loop(), at(piece), corner_angle_)
                            : site.kind;
  result = {canonical, 0, 0, metric.loop().tag, kind != SiteKind::plain, end - periods.wrap(end), piece, along};
  out.squared_length = geometry::squared_length(end - canonical);
  if (tolerance_.share == 0 || metric.is_on_one_piece(site.t, end_t(site)))
    return out;
  const double turn = corner_angle_ * (pi / 180);
  out.left_out = metric.corners_between(site.t, end_t(site), turn);
  if (out.left_out > 0)
    out.deviation = tolerance_.share * summarize(site).deviation / tolerance(site);
  return out;
}

std::vector<LocalIndex> BoundaryRefiner::along_loops(std::vector<LocalIndex>& loop_start) const {
  std::vector<LocalIndex> order;
  order.reserve(sites_.size());
  for (const LocalIndex first : std::span(loop_first_).first(boundary_loops_)) {
    loop_start.push_back(static_cast<LocalIndex>(order.size()));
    LocalIndex k = first;
    do {
      order.push_back(k);
      k = sites_[k].next;
    } while (k != first);
  }
  loop_start.push_back(static_cast<LocalIndex>(order.size()));
  return order;
}

/// Returns the piece of a curve on which both chords of a site lie, or the first of two pieces of one circle; nothing
/// if there is no such piece.
const geometry::Piece* BoundaryRefiner::piece_around(const Site& site) const {
  const LoopMetric& metric = metrics_[site.loop];
  const auto piece_of = [&](const Site& from) {
    return metric.is_on_one_piece(from.t, end_t(from)) ? &metric.loop().pieces[at(metric.place(from.t).piece)]
                                                       : nullptr;
  };
  const geometry::Piece *before = piece_of(sites_[site.previous]), *after = piece_of(site);
  if (!before || !after)
    return nullptr;
  const bool is_one_circle =
      before->circular && after->circular && before->center == after->center && before->radius == after->radius;
  return before == after || is_one_circle ? before : nullptr;
}

/// Decides how the clean-up may move a site, see InnerChords::track.
std::int32_t BoundaryRefiner::track_of(const Site& site, const geometry::InnerArc& arc, std::int32_t loss,
                                       polygon::InnerChords& inner) const {
  using polygon::InnerChords;
  if (site.kind != SiteKind::plain || site.previous < 0 || site.next < 0)
    return InnerChords::held;
  const geometry::Piece* piece = piece_around(site);
  if (!piece)
    return arc.is_simplified ? InnerChords::bent : InnerChords::held;
  if (!piece->circular)
    return arc.is_simplified ? InnerChords::bent : InnerChords::straight;
  if (inner.circles.empty() || inner.circles.back().center != piece->center ||
      inner.circles.back().radius != piece->radius || inner.circles.back().loss != loss)
    inner.circles.push_back({piece->center, piece->radius, arc.left, loss});
  return static_cast<std::int32_t>(inner.circles.size()) - 1;
}

/// The chords of the curves inside, and their sites that do not lie on the boundary.
polygon::InnerChords BoundaryRefiner::inner_chords() const {
  polygon::InnerChords inner;
  struct Record {
    Vec2 position;
    std::uint8_t corner;
    std::int32_t track;
  };
  std::vector<Record> sites;
  auto arcs_with_loss = static_cast<std::int32_t>(curves_->losses().size()); // as losses() lists them
  for (std::size_t loop = boundary_loops_; loop < loop_first_.size(); ++loop) {
    const geometry::InnerArc& arc = curves_->arc(loop - boundary_loops_);
    const std::int32_t loss = arc.left == arc.right ? -1 : arcs_with_loss++;
    LocalIndex k = loop_first_[loop];
    do {
      const Site& site = sites_[k];
      if (site.vertex == k) // of several curves' ends the first one
        sites.push_back({site.position, site.kind != SiteKind::plain, track_of(site, arc, loss, inner)});
      if (site.next >= 0) {
        inner.chords.push_back({{site.position, next(site).position},
                                metrics_[loop].loop().pieces[at(metrics_[loop].place(site.t).piece)].part,
                                arc.left,
                                arc.right});
      }
      k = site.next;
    } while (k >= 0 && k != loop_first_[loop]);
  }
  std::sort(sites.begin(), sites.end(),
            [](const Record& a, const Record& b) { return geometry::lexicographically_less(a.position, b.position); });
  for (const auto& [position, corner, track] : sites) {
    inner.sites.push_back(position);
    inner.corner.push_back(corner);
    inner.track.push_back(track);
  }
  inner.joined_nodes = curves_->joined_nodes();
  inner.losses = losses();
  inner.sort_ends();
  return inner;
}

BoundarySites BoundaryRefiner::result() const {
  BoundarySites out;
  out.periods = boundary_.periods;
  out.halvings = halvings_;
  out.rounds = rounds_;
  out.overfull = overfull_;
  const std::vector<LocalIndex> order = along_loops(out.loop_start);
  std::vector<ChordRecord> chords(order.size());
  out.sites.resize(order.size());
  thread_loop(std::ssize(order), chords_in_a_row, [&](std::ptrdiff_t item, int) {
    const auto k = static_cast<std::size_t>(item);
    chords[k] = chord_from(order[k], out.sites[k]);
  });
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t loop = 0; loop < boundary_loops_; ++loop) {
    const LocalIndex first = out.loop_start[loop], end = out.loop_start[loop + 1];
    for (LocalIndex k = first; k < end; ++k) {
      const ChordRecord& chord = chords[k];
      out.sites[static_cast<std::size_t>(k)].previous = k == first ? end - 1 : k - 1;
      out.sites[static_cast<std::size_t>(k)].next = k + 1 == end ? first : k + 1;
      out.corners += out.sites[static_cast<std::size_t>(k)].corner;
      out.sharp_corners += sites_[order[k]].kind == SiteKind::sharp_corner;
      out.left_out += chord.left_out;
      out.deviation = std::fmax(out.deviation, chord.deviation);
      shortest = std::fmin(shortest, chord.squared_length);
    }
  }
  out.shortest = std::sqrt(shortest);
  out.inner = inner_chords();
  out.dropped = dropped_;
  if (dropped_.any())
    name_parts(boundary_without(boundary_, dropped_), out);
  else
    name_parts(boundary_, out);
  return out;
}

BoundarySites make_boundary_sites(const comm::Communicator& comm,
                                  const std::function<std::unique_ptr<BoundaryRefiner>()>& make_ready) {
  const Share share{comm.rank(), comm.size()};
  std::unique_ptr<BoundaryRefiner> refiner;
  std::vector<LoopSite> laid = comm::gather_agreed<LoopSite>(comm, [&] {
    refiner = make_ready();
    return refiner->lay_out(share);
  });
  std::vector<BoundaryRefiner::Cut> cuts =
      comm::gather_agreed<BoundaryRefiner::Cut>(comm, [&] { return refiner->begin(std::move(laid), share); });
  BoundarySites result;
  comm::run_agreed(comm, [&] {
    refiner->run(std::move(cuts));
    result = refiner->result();
  });
  return result;
}

} // namespace trime::boundary
