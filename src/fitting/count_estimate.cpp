// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/count_estimate.hpp"

#include "comm/agree.hpp"
#include "core/angle.hpp"
#include "fitting/density_integral.hpp"
#include "fitting/layout.hpp"
#include "fitting/rules.hpp"
#include "fitting/simplified_curves.hpp"
#include "placing/density_sampler.hpp"
#include "placing/work_share.hpp"
#include "sizing/size_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace trime::fitting {
namespace {

// [points asked for] An estimate stops counting there.
constexpr double far_too_many = 4;

// [boundary sites] If corners are more than this share of the boundary sites, they crowd: the size is lowered around
// many of them.
constexpr double sparse_corners = 0.38;

// [1] Where corners crowd the estimated factor grows by this at most.
constexpr double most_crowding = 16;

using geometry::Vec2;
using polygon::BoundarySite;
using polygon::BoundarySites;

constexpr double arc_step = pi / 8;             // of the polygon along a circular piece
constexpr std::size_t chords_in_a_row = 16;     // by one thread
constexpr std::size_t chords_together = 0x1000; // the same if the size prefers blocks

/// A chord along which 1 / h is integrated by Simpson's rule, in steps of about the local size.
struct ChordIntegral {
  geometry::Segment chord;
  double length;
  double first = 0;            // 1 / h at the end of the steps so far
  double count = 0, share = 0; // integral and share of the chord so far
  double step = 0;             // share of the present step

  Vec2 place(double at) const { return chord.a + at * (chord.b - chord.a); }
  bool is_unfinished(double most) const { return share < 1 && count < most && std::isfinite(first); }
  void choose_step() {
    step = std::max(FitRules::integral_step / (first * length), 1e-9);
    step = share + 1.25 * step < 1 ? step : 1 - share;
  }
  void pass(double middle, double last) {
    count += step * length * (first + 4 * middle + last) / 6;
    share = step < 1 - share ? share + step : 1;
    first = last;
  }
};

/// Integrates along all chords at the same time. @param most an integral ends when it is larger
void integrate(const sizing::SizeField& size, const geometry::Periods& periods, double most,
               std::span<ChordIntegral> chords) {
  std::vector<Vec2> places;
  for (const ChordIntegral& chord : chords)
    places.push_back(periods.wrap(chord.place(0)));
  std::vector<double> sizes = sizing::sizes_at(size, places);
  std::vector<ChordIntegral*> unfinished;
  for (std::size_t k = 0; k < chords.size(); ++k) {
    chords[k].first = 1 / sizes[k];
    unfinished.push_back(&chords[k]);
  }
  const auto is_finished = [most](const ChordIntegral* chord) { return !chord->is_unfinished(most); };
  for (std::erase_if(unfinished, is_finished); !unfinished.empty(); std::erase_if(unfinished, is_finished)) {
    places.clear();
    for (ChordIntegral* chord : unfinished) {
      chord->choose_step();
      places.push_back(periods.wrap(chord->place(chord->share + 0.5 * chord->step)));
      places.push_back(periods.wrap(chord->place(chord->share + chord->step)));
    }
    sizes = sizing::sizes_at(size, places);
    for (std::size_t k = 0; k < unfinished.size(); ++k)
      unfinished[k]->pass(1 / sizes[2 * k], 1 / sizes[2 * k + 1]);
  }
}

/// A vertex of the polygon on the unrolled loop, and the length of the curve up to it from the one before.
struct Vertex {
  Vec2 position;
  double length;
};

/// @param divides_lines long straight pieces get vertices, too
std::vector<Vertex> thinned(const geometry::Loop& loop, double spacing, bool divides_lines) {
  std::vector<Vertex> vertices;
  double since = 0;
  const auto pass = [&](Vec2 p, bool must) {
    if (!must && since < spacing)
      return;
    vertices.push_back({p, since});
    since = 0;
  };
  for (std::size_t k = 0; k < loop.pieces.size(); ++k) {
    const geometry::Piece& piece = loop.pieces[k];
    pass(piece.start, k == 0);
    const double length = piece.length();
    const double parts = piece.circular  ? std::ceil(std::fabs(piece.sweep) / arc_step)
                         : divides_lines ? std::fmax(1, std::ceil(length / spacing))
                                         : 1;
    for (double part = 1; part < parts; ++part) {
      since += length / parts;
      pass(piece.point(length * (part / parts)), false);
    }
    since += length / parts;
  }
  vertices.front().length = since; // closes the loop
  return vertices;
}

/// Sites at the vertices. Loops of fewer than three are left out.
/// @param divides_bands loops that wind around the container get at least three: a straight one has only one vertex
BoundarySites polygon_of(const geometry::Boundary& boundary, const geometry::Lattice& lattice, double spacing,
                         bool divides_bands, std::vector<double>& lengths) {
  BoundarySites polygon;
  const geometry::Periods& periods = polygon.periods = boundary.periods;
  polygon.loop_start.push_back(0);
  for (const geometry::Loop& loop : boundary.loops) {
    const std::vector<Vertex> vertices =
        thinned(loop, loop.winds() ? std::fmin(spacing, loop.length() / 8) : spacing, loop.winds() && divides_bands);
    const auto n = static_cast<LocalIndex>(vertices.size()), first = polygon.loop_start.back();
    if (n < 3)
      continue;
    for (LocalIndex k = 0; k < n; ++k) {
      const bool closes = k + 1 == n;
      const Vertex &at = vertices[static_cast<std::size_t>(k)],
                   &to = vertices[closes ? 0 : static_cast<std::size_t>(k) + 1];
      const Vec2 from = lattice.snap(at.position), canonical = periods.wrap(from);
      const Vec2 end = lattice.snap(to.position) + (closes ? loop.winding : Vec2{}) + (canonical - from);
      BoundarySite site;
      site.position = canonical;
      site.previous = first + (k + n - 1) % n;
      site.next = first + (k + 1) % n;
      site.next_shift = end - periods.wrap(end);
      polygon.sites.push_back(site);
      lengths.push_back(to.length);
    }
    polygon.loop_start.push_back(first + n);
  }
  return polygon;
}

double count_corners(const geometry::Boundary& boundary, double angle) {
  const double cosine = sin_cos(angle * (pi / 180)).cos;
  double corners = 0;
  for (const geometry::Loop& loop : boundary.loops)
    for (std::size_t k = 0; k < loop.pieces.size(); ++k) {
      const geometry::Piece &before = loop.pieces[k > 0 ? k - 1 : loop.pieces.size() - 1], &after = loop.pieces[k];
      corners += geometry::dot(before.tangent(before.length()), after.tangent(0)) < cosine;
    }
  return corners;
}

} // namespace

CountEstimate::CountEstimate(const LayoutContext& context, double points, double spacing, double coarsening)
    : context_(context), points_(points), coarsening_(coarsening) {
  BoundarySites polygon;
  comm::run_agreed(context.comm, [&] {
    polygon =
        polygon_of(context.fixed.cornered_boundary(), context.lattice, spacing, context.options.absolute, lengths_);
  });
  corners_ = count_corners(context.fixed.cornered_boundary(), context.options.features.corner_angle);
  if (!polygon.sites.empty() || context.given_boundary.covers_torus)
    reference_ = lay_reference(context, std::move(polygon), points, coarsening);
}

std::optional<double> CountEstimate::points(double factor) {
  if (!reference_.guard)
    return std::nullopt;
  const sizing::ScaledSize size = context_.asked_size(factor);
  const std::optional<double> on_boundary = boundary_points(size);
  if (!on_boundary)
    return std::nullopt;
  const double placed = *on_boundary + static_cast<double>(context_.fixed.inside().size());
  if (*on_boundary > far_too_many * points_)
    return placed;
  placing::share_by_density(reference_, size, context_.lattice, coarsening_);
  const mesh::TileRange tiles = placing::own_share(reference_);
  return placed + integrate_density(context_.comm, tiles,
                                    placing::DensitySampler(tiles.grid, *reference_.guard, size, context_.lattice,
                                                            coarsening_, FitRules::hopelessly_many * points_))
                      .sites;
}

double CountEstimate::crowding(double factor) const {
  const std::optional<double> sites = boundary_points(context_.asked_size(factor));
  if (!sites || !(*sites > 0))
    return 1;
  const double share = corners_ / (sparse_corners * *sites);
  return std::clamp(share * share, 1.0, most_crowding);
}

double CountEstimate::boundary_share(double factor) const {
  return boundary_points(context_.asked_size(factor)).value_or(0) / points_;
}

bool CountEstimate::use_strides(double factor) {
  if (!generalises(context_) || context_.given_boundary.periods.any())
    return false;
  const sizing::ScaledSize size = context_.asked_size(factor);
  const std::optional<double> along = integrated(size), straight = strides(size);
  return by_strides_ = along && straight && *straight < FitRules::ragged_strides * *along;
}

std::optional<double> CountEstimate::boundary_points(const sizing::SizeField& size) const {
  return by_strides_ ? strides(size) : integrated(size);
}

/// From vertex to vertex, over those that are nearer than h. All ranks do the same. Collective.
std::optional<double> CountEstimate::strides(const sizing::SizeField& size) const {
  const BoundarySites& polygon = reference_.polygon;
  const auto count_on = [&](std::size_t loop) {
    const LocalIndex first = polygon.loop_start[loop], end = polygon.loop_start[loop + 1];
    Vec2 from = polygon.sites[at(first)].position;
    double h = size.size(from), count = 0;
    for (LocalIndex k = first + 1; k <= end && count < far_too_many * points_; ++k) {
      const Vec2 to = polygon.sites[at(k < end ? k : first)].position;
      const double way = geometry::length(to - from);
      if (way < h && k < end)
        continue;
      const double next = size.size(to);
      count += 0.5 * way * (1 / h + 1 / next);
      from = to;
      h = next;
    }
    return count;
  };
  double all = 0;
  comm::run_agreed(context_.comm, [&] {
    for (std::size_t loop = 0; loop + 1 < polygon.loop_start.size(); ++loop)
      if (const double count = count_on(loop); !(count < FitRules::least_sites))
        all += count;
  });
  return std::isfinite(all) ? std::optional(all) : std::nullopt;
}

/// By integrals along all chords. Collective.
std::optional<double> CountEstimate::integrated(const sizing::SizeField& size) const {
  const BoundarySites& polygon = reference_.polygon;
  const double most = far_too_many * points_;
  const auto count_on = [&](std::size_t begin, std::size_t end, double* counts) {
    std::vector<ChordIntegral> chords;
    for (std::size_t k = begin; k < end; ++k)
      chords.push_back({polygon.chord(static_cast<LocalIndex>(k)), lengths_[k]});
    integrate(size, polygon.periods, most, chords);
    for (const ChordIntegral& chord : chords)
      *counts++ = std::isfinite(chord.first) ? chord.count : NAN;
  };
  const std::vector<double> counts = comm::compute_shared_runs<double>(
      context_.comm, polygon.sites.size(), size.prefers_blocks() ? chords_together : chords_in_a_row, count_on);
  double all = 0;
  for (std::size_t loop = 0; loop + 1 < polygon.loop_start.size(); ++loop) {
    double sites = 0;
    for (LocalIndex k = polygon.loop_start[loop]; k < polygon.loop_start[loop + 1]; ++k)
      sites += counts[static_cast<std::size_t>(k)];
    if (!std::isfinite(sites))
      return std::nullopt;
    if (sites >= FitRules::least_sites || context_.options.features.keep_all)
      all += std::max(FitRules::least_sites, sites);
  }
  return all;
}

} // namespace trime::fitting
