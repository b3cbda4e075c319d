// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/point_scheme.hpp"

#include "meshing/refinement.hpp"
#include "meshing/size_fit.hpp"

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

constexpr double row_height = 0.8660254037844386;
constexpr double growth = 1.6; // of the number of points by one insertion
/// Points from which on the mesh starts from 1/4, 1/16, 1/64 of them; with fewer the coarse mesh starves narrow parts.
constexpr double one_division = 3000, two_divisions = 20000, three_divisions = 400000;

int divisions_for(double points) {
  return points < one_division ? 0 : points < two_divisions ? 1 : points < three_divisions ? 2 : 3;
}

} // namespace

PointScheme::PointScheme(const LayoutContext& context) : context_(context), options_(context.options) {
  choose();
}

double PointScheme::expected_points() const {
  if (options_.points)
    return static_cast<double>(*options_.points);
  const double h = *options_.edge_length, area = context_.boundary.area;
  return std::max(3.0, area / (row_height * h * h) + 0.5 * context_.boundary.length() / h);
}

void PointScheme::choose() {
  const bool uniform = context_.relative_size.is_uniform();
  const Start start = options_.start;
  const double fraction = options_.initial_fraction.value_or(1);
  const int divisions = divisions_for(expected_points());
  if (options_.initial_fraction && fraction < 1) {
    kind_ = Kind::insertion;
    points_now_ = std::max(3.0, std::ceil(fraction * expected_points()));
    for (double points = points_now_; points < expected_points(); points *= growth)
      ++last_stage_;
    reason_ = fmt::format("{:g} of the points first, the others in {} insertions (initial_fraction is given)", fraction,
                          last_stage_);
  } else if (start == Start::lattice || (start == Start::automatic && uniform)) {
    kind_ = Kind::lattice;
    reason_ = start == Start::lattice ? "hexagonal lattice, all points at once (asked for)"
                                      : "hexagonal lattice, all points at once: the size is uniform";
  } else if (start == Start::hilbert || options_.initial_fraction || divisions == 0) {
    kind_ = Kind::hilbert;
    reason_ = fmt::format("quantiles of the density, all points at once: {}",
                          start == Start::hilbert || options_.initial_fraction
                              ? "asked for"
                              : fmt::format("the size is graded, and fewer than {} points are too few to divide a "
                                            "coarser mesh",
                                            one_division));
  } else {
    kind_ = Kind::coarse_to_fine;
    last_stage_ = divisions;
    reason_ = fmt::format("coarse to fine, the edges of a mesh of 1/{} of the points are divided {}: {}",
                          1 << (2 * divisions), divisions == 1 ? "once" : fmt::format("{} times", divisions),
                          start == Start::coarse_to_fine ? "asked for" : "the size is graded");
  }
}

Layout PointScheme::first() {
  if (kind_ == Kind::lattice) {
    LatticeFit fit = fit_lattice(context_);
    shortage_ = std::move(fit.shortage);
    const auto time = context_.timers.scope("start");
    place_sites(context_, fit.layout,
                LatticeStart(context_.boundary, *fit.layout.guard, context_.lattice)
                    .sites(even_share(fit.layout, context_.comm), fit.spacing));
    return std::move(fit.layout);
  }
  DensityGoal goal;
  goal.points = kind_ == Kind::insertion ? points_now_ : expected_points();
  goal.divisions = kind_ == Kind::coarse_to_fine ? last_stage_ : 0;
  goal.coarsening = kind_ == Kind::coarse_to_fine ? std::ldexp(1.0, last_stage_)
                    : kind_ == Kind::insertion    ? std::sqrt(expected_points() / points_now_)
                                                  : 1;
  DensityFit fit = fit_density(context_, goal);
  shortage_ = std::move(fit.shortage);
  const auto time = context_.timers.scope("start");
  const double inner = goal.divisions > 0 || !options_.points || !shortage_.empty()
                           ? fit.inner
                           : goal.points - static_cast<double>(fit.layout.on_boundary());
  place_sites(context_, fit.layout,
              hilbert_start(context_.comm, even_share(fit.layout, context_.comm), *fit.layout.guard, *fit.layout.size,
                            context_.lattice, std::max<std::int64_t>(0, std::llround(inner)), options_.seed));
  return std::move(fit.layout);
}

Layout PointScheme::next(const Layout& previous) {
  ++stage_;
  const ExtractionContext old{*previous.state, previous.boundary, *previous.size, context_.lattice};
  const GlobalId before = context_.comm.sum(std::int64_t{previous.state->points().owned()});
  double coarsening = previous.coarsening / 2, wanted = 4 * static_cast<double>(before);
  if (kind_ == Kind::insertion) {
    points_now_ = is_last() ? expected_points() : std::floor(growth * static_cast<double>(before));
    wanted = points_now_;
    coarsening = is_last() ? 1 : std::sqrt(expected_points() / points_now_);
  }
  Layout layout = lay_boundary(context_, previous.factor, coarsening, wanted);
  const auto time = context_.timers.scope("start");
  std::vector<mesh::Site> sites = kind_ == Kind::insertion ? inner_sites(*previous.state) : split_edges(old);
  clear_strip(layout, sites);
  if (kind_ == Kind::insertion) {
    const std::int64_t here = context_.comm.sum(static_cast<std::int64_t>(sites.size()));
    insert_in_triangles(old, layout, std::llround(wanted) - layout.on_boundary() - here, sites);
  }
  if (options_.points && (is_last() || kind_ == Kind::insertion))
    trim(context_.comm, layout, std::min<std::int64_t>(std::llround(wanted), *options_.points) - layout.on_boundary(),
         sites);
  place_sites(context_, layout, std::move(sites));
  return layout;
}

} // namespace trime::meshing
