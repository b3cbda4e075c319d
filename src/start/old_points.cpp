// SPDX-License-Identifier: BSD-3-Clause
#include "start/old_points.hpp"

#include "start/density_changes.hpp"
#include "start/rules.hpp"
#include "trime/core/error.hpp"

#include <fmt/format.h>

namespace trime::start {
namespace {

using geometry::Vec2;

std::string text_of(Vec2 periods) {
  const auto of_axis = [](double period) { return period > 0 ? fmt::format("{:.9g}", period) : std::string("none"); };
  return fmt::format("x {}, y {}", of_axis(periods.x), of_axis(periods.y));
}

} // namespace

void OldPointsSummary::add(const DensityChanges& changes) {
  removed += changes.removed;
  inserted += changes.inserted;
}

bool OldPointsSummary::is_small() const {
  return static_cast<double>(removed + inserted) <= StartRules::small_change * static_cast<double>(kept);
}

std::string OldPointsSummary::text(const OldPoints& old) const {
  return fmt::format("from {}: {} of its {} points lie in the shape; {} of them taken out, {} new ones between them",
                     old.name, kept, all, removed, inserted);
}

mesh::SiteList sites_of(const OldPoints& old, const geometry::Frame& frame) {
  const geometry::Box& box = frame.container();
  const geometry::Periods periods = frame.periods();
  mesh::SiteList sites;
  sites.reserve(old.points.size());
  for (const Vec2 point : old.points) {
    const Vec2 p = periods.wrap(frame.snap(point));
    if (p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y)
      sites.push_back({p});
  }
  return sites;
}

std::string no_point_of(const OldPoints& old, std::int64_t in_container) {
  return fmt::format("no point of {} can be a start: {} of its points lie in the container, and none of them in the "
                     "new shape, away from its boundary; expected an old mesh that overlaps the shape. Check that both "
                     "have the same coordinates, or leave 'start' out, which makes a new mesh",
                     old.name, in_container);
}

void check_periods(const OldPoints& old, const geometry::Periods& periods) {
  if (old.periods.x == periods.x && old.periods.y == periods.y)
    return;
  throw ConfigError(fmt::format("{} has other periods than the container: expected those of the container ({}), found "
                                "{}; start from a mesh with the same periods, or leave 'start' out, which makes a new "
                                "mesh",
                                old.name, text_of({periods.x, periods.y}), text_of(old.periods)));
}

} // namespace trime::start
