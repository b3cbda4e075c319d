// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/outlook.hpp"

#include "boundary/changed_bodies.hpp"
#include "boundary/feature_report.hpp"
#include "comm/agree.hpp"
#include "fitting/expected_points.hpp"
#include "fitting/outlook.hpp"
#include "fitting/points_of_length.hpp"
#include "fitting/rules.hpp"
#include "meshing/meshed_boundary.hpp"
#include "start/point_scheme.hpp"
#include "trime/core/error.hpp"

#include <cmath>

namespace trime::meshing {
namespace {

using fitting::LaidOutlook;
using fitting::LayoutContext;
using fitting::LayoutRules;
using fitting::rounded_up;
using sites::Stage;

/// The last stage of a run with few points, laid out exactly as the run does. The stage refers to this object.
class LastStage {
public:
  LastStage(const RunContext& run, const LayoutContext& layout) : scheme_(layout, start_options(run.options)) {
    stage_ = scheme_.last_from(scheme_.first());
  }
  const Stage& stage() const { return stage_; }
  std::span<const sizing::SizeLimit> limits() const { return scheme_.limits(); }
  double factor(const LayoutContext& layout) const {
    return layout.relative_size.is_uniform() ? stage_.growing_size().size({}) / layout.relative_size.size({})
                                             : scheme_.factor();
  }
  bool keeps_all() const {
    return !stage_.curves && stage_.polygon.dropped.components + stage_.polygon.dropped.holes == 0;
  }

private:
  start::PointScheme scheme_;
  Stage stage_;
};

/// Collective.
boundary::FeatureReport features_of(const RunContext& run, MeshedBoundary& boundary, const Stage& stage,
                                    std::span<const sizing::SizeLimit> limits) {
  boundary.follow(stage.curves, stage.polygon.dropped);
  boundary::FeatureReport features;
  comm::run_agreed(run.comm, [&] {
    features = boundary::report_features(stage.polygon, limits, stage.asked_size());
    features.absolute_sizes = run.options.absolute_sizes;
    boundary::report_losses(boundary.fixed().cornered_boundary(), boundary.curves(), stage.simplified,
                            stage.polygon.dropped, stage.asked_size(), run.lattice, features);
    boundary::measure_bodies(boundary.curves(), stage.polygon, stage.asked_size(), features);
  });
  return features;
}

/// Returns whether a run with this number of points keeps everything. Collective.
bool keeps_with(const RunContext& run, const LayoutContext& layout, double points) {
  fitting::FitOptions options = run.fit;
  options.points = static_cast<GlobalId>(points);
  options.edge_length.reset();
  const LayoutContext trial{layout.comm, layout.domain, layout.relative_size, options,
                            layout.log,  layout.timers, layout.fixed};
  try {
    return LastStage(run, trial).keeps_all();
  } catch (const ConfigError&) { // too few points: all ranks throw it together
    return false;
  } catch (const GeometryError&) { // no mesh at this size: all ranks throw it together
    return false;
  }
}

/// The next smaller number with three digits.
double rounded_down(double length) {
  const double unit = std::pow(10, std::floor(std::log10(length)) - 2);
  return std::floor(length / unit) * unit;
}

/// Sets numbers that were tried. Collective.
void advise(const RunContext& run, const LayoutContext& layout, LaidOutlook& ahead, Outlook& outlook) {
  fitting::find_keeping_factor(layout, ahead);
  if (run.options.absolute_sizes) {
    (ahead.keeps ? outlook.keeping_factor : outlook.tried_factor) = ahead.keeping_factor / ahead.factor;
    return;
  }
  const bool uniform = run.relative_size.is_uniform();
  const double largest = ahead.keeping_factor * (uniform ? run.relative_size.size({}) : 1);
  outlook.keeping_points = rounded_up(uniform ? fitting::points_of_length(run.given_boundary, largest)
                                              : ahead.points_at(ahead.keeping_factor));
  if (!ahead.keeps)
    return;
  if (const double length = rounded_down(largest);
      uniform && fitting::keeps_all(layout, length / run.relative_size.size({})))
    outlook.keeping_edge_length = length;
  for (int trial = 0; trial < LayoutRules::advice_trials && outlook.keeping_points <= LayoutRules::advice_points;
       ++trial) {
    outlook.is_tried = keeps_with(run, layout, outlook.keeping_points);
    if (outlook.is_tried)
      return;
    outlook.keeping_points = rounded_up(LayoutRules::advice_step * outlook.keeping_points);
  }
}

} // namespace

Outlook look_ahead(const RunContext& run, Advice advice) {
  MeshedBoundary boundary(run);
  const LayoutContext layout{run.comm, run.domain, run.relative_size, run.fit, run.log, run.timers, boundary.fixed()};
  Outlook outlook;
  LaidOutlook ahead;
  outlook.points = ahead.points = fitting::expected_points(layout);
  if (ahead.points <= LayoutRules::outlook_points) {
    const LastStage last(run, layout);
    outlook.features = features_of(run, boundary, last.stage(), last.limits());
    outlook.keeps_all = last.keeps_all();
    ahead.factor = last.factor(layout);
    ahead.placed_first = static_cast<double>(last.stage().placed_first());
  } else {
    const Stage stage = fitting::look_ahead(layout, ahead);
    outlook.features = features_of(run, boundary, stage, {});
    outlook.keeps_all = !stage.curves && stage.polygon.dropped.components + stage.polygon.dropped.holes == 0;
  }
  if (advice == Advice::yes && !outlook.keeps_all)
    advise(run, layout, ahead, outlook);
  return outlook;
}

} // namespace trime::meshing
