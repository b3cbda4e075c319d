// SPDX-License-Identifier: BSD-3-Clause
#include "start/size_warnings.hpp"

#include "start/rules.hpp"

#include <cmath>

namespace trime::start {
using sites::Stage;

void warn_of_steep_sizes(const Stage& stage, const geometry::Boundary& boundary, const geometry::Lattice& lattice,
                         Log& log) {
  constexpr int per_side = StartRules::slope_samples;
  if (stage.size->is_uniform() || boundary.loops.empty())
    return;
  const geometry::Box box = boundary.bounding_box();
  const geometry::Vec2 stride{box.width() / per_side, box.height() / per_side};
  double steepest = 0;
  geometry::Vec2 place;
  const auto look = [&](geometry::Vec2 p, geometry::Vec2 to_next) {
    if (!stage.guard->inside(lattice.snap(p)) || !stage.guard->inside(lattice.snap(p + to_next)))
      return;
    const double slope = std::fabs(stage.size->size(p + to_next) - stage.size->size(p)) / geometry::length(to_next);
    if (slope > steepest) {
      steepest = slope;
      place = p;
    }
  };
  for (int j = 0; j < per_side; ++j)
    for (int i = 0; i < per_side; ++i) {
      const geometry::Vec2 p{box.min.x + (i + 0.5) * stride.x, box.min.y + (j + 0.5) * stride.y};
      look(p, {stride.x, 0});
      look(p, {0, stride.y});
    }
  if (steepest > StartRules::warned_slope)
    log.warning("the edge length that is asked for changes by {:.3g} times the way near ({:.4g}, {:.4g}); triangles "
                "can follow about 0.5: expect fewer points and small angles, or take more points or a gentler size",
                steepest, place.x, place.y);
}

void warn_of_fine_features(const Stage& stage, Log& log) {
  const auto& sites = stage.polygon.sites;
  double least = 1, length = 0, size = 0; // chord over local size
  for (std::size_t k = 0; k < sites.size(); ++k) {
    const geometry::Segment chord = stage.polygon.chord(static_cast<LocalIndex>(k));
    const double its_length = geometry::length(chord.b - chord.a), h = stage.size->size(chord.a);
    if (its_length < least * h) {
      least = its_length / h;
      length = its_length;
      size = h;
    }
  }
  if (least < StartRules::warned_chord)
    log.warning("the boundary has chords of {:.3g} where edges of {:.3g} are asked for: expect small angles there",
                length, size);
}

} // namespace trime::start
