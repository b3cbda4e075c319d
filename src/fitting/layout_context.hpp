// SPDX-License-Identifier: BSD-3-Clause
// The input of the search for the size and of the layout of a stage.
#pragma once

#include "boundary/fixed_points.hpp"
#include "boundary/rules.hpp"
#include "fitting/fit_options.hpp"
#include "sizing/raised_size.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/log.hpp"
#include "trime/core/timer.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

#include <cmath>
#include <span>
#include <vector>

namespace trime::fitting {

/// A uniform size that the boundary may lower at some places.
class GradedSize final : public sizing::SizeField {
public:
  explicit GradedSize(const sizing::SizeField& size) : size_(size) {}
  double size(geometry::Vec2 p) const override { return size_.size(p); }
  void sizes(std::span<const geometry::Vec2> places, std::span<double> values) const override {
    size_.sizes(places, values);
  }
  bool prefers_blocks() const override { return size_.prefers_blocks(); }

private:
  const sizing::SizeField& size_;
};

/// The input of the search for the size and of the layout. Keeps references, which must outlive it; see Mesher.
struct LayoutContext {
  const comm::Communicator& comm;
  const geometry::Domain& domain;
  const sizing::SizeField& relative_size;
  const FitOptions& options;
  Log& log;
  TimerTable& timers;
  const boundary::FixedPoints&
      fixed; ///< fixed points, and the boundary on which sites are laid out, with these points as corners
  bool cuts_thin_components = false; ///< see generalise::Choice; set if every other boundary has too many points
  bool lowers_uniform =
      false; ///< the boundary may lower a uniform size at some places, as it does with a size that varies
  std::vector<sizing::LeastSize> raised{}; ///< where the size must be larger, because edges would be too short there
  GradedSize graded{relative_size};        ///< the size field that replaces a uniform one if lowers_uniform is set
  const geometry::Boundary& given_boundary =
      domain.boundary(); ///< the boundary as it was given, without corners at fixed points
  const geometry::Lattice& lattice = domain.frame().lattice();

  /// Returns by how much h may grow per unit of distance around narrow places.
  double narrow_gradation() const {
    return std::fmin(boundary::BoundaryRules::gradation, options.gradation.value_or(INFINITY));
  }
  /// Returns relative_size times this factor, within the smallest and the largest size. @pre this context outlives the
  /// result
  sizing::ScaledSize asked_size(double factor) const {
    const sizing::SizeField& relative = lowers_uniform ? static_cast<const sizing::SizeField&>(graded) : relative_size;
    return {relative, factor, options.min_size.value_or(0), options.max_size.value_or(INFINITY)};
  }
};

} // namespace trime::fitting
