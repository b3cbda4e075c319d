// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/size_warnings.hpp"

#include "fitting/rules.hpp"
#include "sizing/size_blocks.hpp"
#include "trime/core/error.hpp"

#include <cmath>
#include <vector>

namespace trime::fitting {
namespace {

// [1] The program warns of a steeper size. Triangles can follow a gradient of about 0.5.
constexpr double warned_slope = 1;

// [h] The program warns of a shorter chord, because triangles next to it have small angles.
constexpr double warned_chord = 0.1;

} // namespace

using sites::Stage;

void warn_of_steep_sizes(const Stage& stage, const geometry::Boundary& boundary, const geometry::Lattice& lattice,
                         Log& log) {
  constexpr int per_side = LayoutRules::slope_samples;
  if (stage.size->is_uniform() || boundary.loops.empty())
    return;
  const geometry::Box box = boundary.bounding_box();
  const geometry::Vec2 stride{box.width() / per_side, box.height() / per_side};
  std::vector<geometry::Vec2> places; // pairs of neighbours
  const auto look = [&](geometry::Vec2 p, geometry::Vec2 to_next) {
    if (stage.guard->inside(lattice.snap(p)) && stage.guard->inside(lattice.snap(p + to_next)))
      places.insert(places.end(), {p, p + to_next});
  };
  for (int j = 0; j < per_side; ++j)
    for (int i = 0; i < per_side; ++i) {
      const geometry::Vec2 p{box.min.x + (i + 0.5) * stride.x, box.min.y + (j + 0.5) * stride.y};
      look(p, {stride.x, 0});
      look(p, {0, stride.y});
    }
  const std::vector<double> sizes = sizing::sizes_at(*stage.size, places);
  double steepest = 0;
  geometry::Vec2 place;
  for (std::size_t k = 0; k < places.size(); k += 2) {
    const double slope = std::fabs(sizes[k + 1] - sizes[k]) / geometry::length(places[k + 1] - places[k]);
    if (slope > steepest) {
      steepest = slope;
      place = places[k];
    }
  }
  if (steepest > warned_slope)
    log.warning("the size field has gradient {:.3g} near {}, but triangles can follow a gradient of at most about 0.5: "
                "expect fewer points and small angles, or use more points or a smoother size",
                steepest, Place(place, 4));
}

void warn_of_lowered_growth(const SteepPlaces& steep, double gradation, Log& log) {
  if (steep.limits.empty())
    return;
  log.warning("the size grows by up to {:.3g} per length near {}, but by at most {:g} in the mesh (gradation in "
              "[sizing]), so it is lowered around {} place{}{}. A larger gradation follows the size more closely, and "
              "'none' uses it as it is",
              steep.steepest.slope, Place(steep.steepest.place, 4), gradation, steep.limits.size(),
              steep.limits.size() == 1 ? "" : "s",
              steep.is_capped ? ", the largest number that is possible, and may be too steep at others" : "");
}

void warn_of_raised_sizes(const Stage& stage, const std::vector<sizing::LeastSize>& raised, double shortest_edge,
                          Log& log) {
  double most = 1;
  geometry::Vec2 place;
  for (const sizing::LeastSize& least : raised)
    if (const double ratio = least.size / stage.growing_size().size(least.place); ratio > most) {
      most = ratio;
      place = least.place;
    }
  if (most > 1)
    log.warning("shortest_edge = {:g} in [sizing] makes the size larger around parts of the shape where edges would be "
                "shorter, and the shape is simplified more there: the size is up to {:.3g} times as large, near {}",
                shortest_edge, most, Place(place, 4));
}

void warn_of_fine_features(const Stage& stage, bool has_least_size, Log& log) {
  const auto& sites = stage.polygon.sites;
  double least = warned_chord, length = 0, size = 0; // chord over local size
  geometry::Vec2 place;
  std::size_t count = 0;
  std::vector<geometry::Vec2> starts;
  for (std::size_t k = 0; k < sites.size(); ++k)
    starts.push_back(stage.polygon.chord(static_cast<LocalIndex>(k)).a);
  const std::vector<double> sizes = sizing::sizes_at(*stage.size, starts);
  for (std::size_t k = 0; k < sites.size(); ++k) {
    const geometry::Segment chord = stage.polygon.chord(static_cast<LocalIndex>(k));
    const double its_length = geometry::length(chord.b - chord.a), h = sizes[k];
    count += its_length < warned_chord * h ? 1 : 0;
    if (its_length < least * h) {
      least = its_length / h;
      length = its_length;
      size = h;
      place = 0.5 * (chord.a + chord.b);
    }
  }
  const double share = has_least_size ? LayoutRules::warned_share_of_chords : 0;
  if (static_cast<double>(count) > share * static_cast<double>(sites.size()))
    log.warning("{} of {} boundary edges {} far shorter than the size asked for there: expect small angles next to "
                "them; the worst edge is {:.3g} long where the size is {:.3g}, at {}{}",
                count, sites.size(), count == 1 ? "is" : "are", length, size, Place(place, 6),
                has_least_size ? "; a smaller min_size would help" : "");
}

} // namespace trime::fitting
